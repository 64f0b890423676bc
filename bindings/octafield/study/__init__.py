"""Studies: a file that says which inputs, representations, solvers and boundary treatments to compare, run to the end
however often it is interrupted, on one machine or many.

    >>> from octafield import study
    >>> text = "{name: a box, inputs: [{generator: box}], runs: {boundary: [aligned, fixed]}}"
    >>> described = study.parse(text)  # or load("study.yaml")
    >>> outcome = study.run(described, "out")  # begins, or goes on where an earlier run of the same folder stopped
    >>> outcome.status
    Status(done=2, failed=0, crashed=0, open=0)
    >>> for row in study.rows("out"):  # one record per run
    ...     print(row["input"], row["representation"], row["boundary"], row["singular_edges"])
    box sh4 aligned 0
    box sh4 fixed 0
    >>> study.write_report("out").name
    'report.html'

A folder holds study.json (the description), runs.sqlite (one table), runs/KEY (the files of one run, complete or
absent) and, after write_report(), report.html, results.csv and tables/. KEY is a hash of the input's content, the
options and octafield's version.
"""

from .description import Study, load, parse
from .finished_runs import Status, rows, status
from .plan import Run, plan
from .report import write_report
from .running.engine import Outcome, run

__all__ = ["Outcome", "Run", "Status", "Study", "load", "parse", "plan", "rows", "run", "status", "write_report"]
