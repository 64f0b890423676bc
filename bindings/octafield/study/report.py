"""The report of a study, from the runs finished so far."""

from pathlib import Path

from .. import report
from .finished_runs import rows, status
from .store import RUNS, Store

REPORT_FILE = report.PAGE_FILE


def write_report(folder: str | Path) -> Path:
    """Writes report.html, results.csv (a line per run, all numbers of its record) and tables/*.csv, *.tex (the tables
    of the page) into the folder of a study from the runs finished so far; the page's path."""
    store = Store(folder)
    study = store.study()
    runs = [report.Run(row, row.input, store.run_folder(row.key), f"{RUNS}/{row.key}") for row in rows(folder)]
    report.write_report(
        report.Report(study.name, runs, description=study.text, open_runs=status(folder).open), store.folder
    )
    return store.folder / REPORT_FILE
