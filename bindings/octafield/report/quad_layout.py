"""The page of one quad layout: pictures of its blocks and of its quads, and its record as tables."""

from __future__ import annotations

import base64
import html
import json
from collections.abc import Iterator
from pathlib import Path

from ..errors import IoError
from ..files.writing import write_file
from ..records.base import Record
from ..records.quad_layout import QuadLayoutRecord
from ..records.record_file import RECORD_FILE, any_record
from ..view import quad_layout as drawn
from ..view import scene
from ..view.picture import Picture
from .numbers.tables import Column, Table
from .page.exhibits import Exhibits, filled
from .writer import FIGURES, PAGE_FILE, TABLES

_NOT_SHOWN = ("input", "version", "notes", "files", "options", "field_options", "versions", "machine")


def write_layout_report(folder: str | Path) -> Path:
    """Writes report.html, tables/*.csv and *.tex, figures/*.png into the folder of octafield quad-layout; the page's
    path. Raises IoError."""
    folder = Path(folder)
    record = any_record(folder / RECORD_FILE)
    if not isinstance(record, QuadLayoutRecord):
        raise IoError(
            f"{folder / RECORD_FILE}: no record of a quad layout; give a folder of octafield quad-layout (of studies:"
            " octafield study report)",
            "other_record",
        )
    exhibits, pictures = Exhibits(), _pictures(folder, record)
    figures = [
        exhibits.add(p.title, base64.b64encode(p.small).decode(), p.title, p.caption, "shot", p.legend)
        for p in pictures
    ]
    tables = [
        table for table in (_figures(record), _points(record), _misalignment(record), _phases(record)) if table.rows
    ]
    shown = [exhibits.add(table.stem, table, table.stem.capitalize(), _CAPTIONS[table.stem]) for table in tables]
    page = filled(
        "layout.html",
        title=f"Quad layout of {Path(record.input).name}",
        record=record,
        files=[name for name in record.files or () if name != RECORD_FILE],
        stems=[table.stem for table in tables],
        texts=[_sentence(record)],
        figures=figures,
        tables=shown,
        options=json.dumps({"layout_options": record.options, "options": record.field_options}, indent=1),
    )
    try:
        for name in (TABLES, FIGURES):
            (folder / name).mkdir(exist_ok=True)
        for table in tables:
            table.write_csv(folder / TABLES / f"{table.stem}.csv")
            table.write_latex(folder / TABLES / f"{table.stem}.tex")
    except OSError as error:
        raise IoError(f"{folder}: cannot write there ({error.strerror})") from error
    for exhibit, picture in zip(figures, pictures, strict=True):
        write_file(folder / FIGURES / f"{exhibit.id}.png", picture.png)
    write_file(folder / PAGE_FILE, page.encode())
    return folder / PAGE_FILE


_CAPTIONS = {
    "figures": "The record, without options.",
    "points": "Singular points and corners that were imposed.",
    "misalignment": "By how much the points missed that each boundary curve is followed, or that the field closes.",
    "phases": "Time and memory.",
}


def _sentence(record: QuadLayoutRecord) -> str:
    name = html.escape(Path(record.input).name)
    return (
        f"{record.quads:,} quads in {record.patches:,} blocks and {record.chords:,} chords on <code>{name}</code>,"
        f" {record.triangles:,} triangles; {record.irregular_vertices:,} irregular vertices inside;"
        f" scaled Jacobian {record.scaled_jacobian.min:.3f} at least, {record.scaled_jacobian.mean:.3f} on average; up"
        f" to {100 * record.surface_deviation.max:.2g} % of the diagonal off the surface."
    )


def _pictures(folder: Path, record: QuadLayoutRecord) -> list[Picture]:
    layout, _ = drawn.scene_of_folder(folder)
    points = [("index above 0", scene.VERMILLION), ("index below 0", scene.BLUE), ("sides of blocks", scene.INK)]
    return [
        Picture(
            "Blocks",
            f"{record.patches:,} blocks, neighbours in different colours; points where other than four quads meet, on"
            " the boundary other than two.",
            scene.render(layout),
            [(colour, meaning) for meaning, colour in points],
        ),
        Picture(
            "Scaled Jacobian",
            f"Of each quad: least {record.scaled_jacobian.min:.3f}, 5th percentile {record.scaled_jacobian.p05:.3f},"
            f" mean {record.scaled_jacobian.mean:.3f}.",
            scene.render(drawn.jacobian_scene_of_folder(folder)),
        ),
    ]


# ---- tables


def _figures(record: QuadLayoutRecord) -> Table:
    return Table("figures", [Column("name"), Column("value"), Column("meaning")], list(_facts(record)))


def _facts(record: Record, of: str = "") -> Iterator[tuple[str, str, str]]:
    for name, info in type(record).model_fields.items():
        value = getattr(record, name)
        if isinstance(value, Record) and name not in _NOT_SHOWN:
            yield from _facts(value, f"{of}{name} ")
        elif isinstance(value, (str, int, float)) and (of or name not in _NOT_SHOWN):
            yield f"{of}{name}", f"{value:.6g}" if isinstance(value, float) else str(value), info.description or ""


def _points(record: QuadLayoutRecord) -> Table:
    columns = [
        Column("x", ".6g"),
        Column("y", ".6g"),
        Column("z", ".6g"),
        Column("index times four", "d"),
        Column("where"),
    ]
    return Table(
        "points",
        columns,
        [(*p.position, p.index_times_four, "boundary" if p.boundary else "inside") for p in record.singular_points],
    )


def _misalignment(record: QuadLayoutRecord) -> Table:
    columns = [Column("of"), Column("vertex", "d"), Column("degrees", ".3f"), Column("size factor", ".4g")]
    return Table(
        "misalignment",
        columns,
        [
            ("boundary" if m.boundary else "generator", m.vertex, m.angle_deg, m.size_factor)
            for m in record.misalignment
        ],
    )


def _phases(record: QuadLayoutRecord) -> Table:
    columns = [Column("phase"), Column("wall s", ".3f"), Column("CPU s", ".3f"), Column("peak MB", ".0f")]
    rows = [
        (name, seconds, record.cpu_seconds.get(name), record.phase_peak_mb.get(name))
        for name, seconds in record.wall_seconds.items()
    ]
    return Table("phases", columns, rows)
