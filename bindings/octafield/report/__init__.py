"""The report of comparisons and studies: one HTML page that needs nothing but itself, its tables as CSV and LaTeX
beside it.

    report = Report("Frame fields on part.stl", [Run(record, "part.stl", folder, "part-sh4"), ...])
    write_report(report, folder)  # report.html, results.csv, tables/*.csv, tables/*.tex

The page is made from the records (result.json) of the runs, and from the files beside them where these were kept.
"""

from .numbers.records import Run
from .page.render import Report
from .writer import PAGE_FILE, write_report

__all__ = ["PAGE_FILE", "Report", "Run", "write_report"]
