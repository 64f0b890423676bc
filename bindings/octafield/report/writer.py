"""From runs to the files of a report."""

import os
import tempfile
from collections.abc import Callable
from pathlib import Path

from ..view.plots import standalone
from .numbers.columns import deviation_table, input_table, run_table, summary_table
from .numbers.deviations import deviations
from .numbers.hex_meshes import hex_mesh_table
from .numbers.integrability import integrability_table
from .numbers.own_energies import own_energy_table
from .numbers.profiles import lines
from .numbers.records import Results
from .numbers.tables import Table, write_records
from .page.exhibits import Exhibits
from .page.render import Report, anchors_of, render

PAGE_FILE, RECORDS_FILE, TABLES, FIGURES = "report.html", "results.csv", "tables", "figures"


def write_report(report: Report, folder: Path) -> list[str]:
    """Writes report.html, results.csv (a line per run, all numbers of its record) and tables/*.csv, *.tex (the tables
    of the page) and figures/*.svg (its plots) and *.png (its pictures, up to 2,000 pixels wide) into an existing
    folder, each replaced at once; their names."""
    results = Results(report.runs)
    found = deviations(results)
    methods, sizes = lines(results), integrability_table(results)
    tables = [
        summary_table(results, methods, found), deviation_table(found), input_table(results, anchors_of(results)),
        run_table(results, results.runs),
        *(table for table in (sizes, own_energy_table(results), hex_mesh_table(results)) if table.rows),
    ]  # fmt: skip
    (folder / TABLES).mkdir(exist_ok=True)
    names = []
    for table in tables:
        names += _write_table(folder, table)
    _replace(folder / RECORDS_FILE, lambda path: write_records(path, [run.row for run in report.runs]))
    stems = [table.stem for table in tables]
    text, exhibits = render(report, results, methods, found, [*report.files, RECORDS_FILE], stems)
    _replace_text(folder / PAGE_FILE, text)
    return [PAGE_FILE, RECORDS_FILE, *names, *_write_figures(folder, exhibits)]


def _write_figures(folder: Path, exhibits: Exhibits) -> list[str]:
    files = {f"{FIGURES}/{name}.svg": standalone(plot).encode() for name, plot in exhibits.plots.items()}
    files |= {f"{FIGURES}/{name}.png": image for name, image in exhibits.images.items()}
    (folder / FIGURES).mkdir(exist_ok=True)
    for old in {*(folder / FIGURES).glob("figure-*.svg"), *(folder / FIGURES).glob("figure-*.png")} - {
        folder / name for name in files
    }:
        old.unlink()
    for name, data in files.items():
        _replace(folder / name, lambda partial, data=data: partial.write_bytes(data))  # type: ignore[misc]
    return list(files)


def _write_table(folder: Path, table: Table) -> list[str]:
    names = [f"{TABLES}/{table.stem}.{end}" for end in ("csv", "tex")]
    _replace(folder / names[0], table.write_csv)
    _replace(folder / names[1], table.write_latex)
    return names


def _replace_text(path: Path, text: str) -> None:
    _replace(path, lambda partial: partial.write_text(text, encoding="utf-8"))


def _replace(path: Path, write: Callable[[Path], object]) -> None:
    handle, partial = tempfile.mkstemp(prefix=f".{path.name}.", dir=path.parent)
    os.close(handle)
    try:
        write(Path(partial))
        os.chmod(partial, 0o644)
        os.replace(partial, path)
    finally:
        Path(partial).unlink(missing_ok=True)
