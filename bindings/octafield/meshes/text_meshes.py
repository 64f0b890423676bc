"""Readers of Medit .mesh and TetGen .node/.ele/.face/.edge text: all sections, double precision, errors with their
line.

meshio reads these too, but rounds Medit files of version 1 to single precision, stops at sections it does not know, at
comments inside tables and at TetGen ids that begin elsewhere, and does not say where.
"""

import re
from dataclasses import dataclass, field
from itertools import zip_longest

import numpy as np

from ..errors import IoError
from ..files.reading import parsed_numbers

# Section: meshio's name of the cells and how many vertices one has. Every row ends with a reference.
_MEDIT_CELLS = {
    "Edges": ("line", 2),
    "Triangles": ("triangle", 3),
    "Quadrilaterals": ("quad", 4),
    "Tetrahedra": ("tetra", 4),
    "Prisms": ("wedge", 6),
    "Pyramids": ("pyramid", 5),
    "Hexahedra": ("hexahedron", 8),
    "Hexaedra": ("hexahedron", 8),
    "EdgesP2": ("line3", 3),
    "TrianglesP2": ("triangle6", 6),
    "QuadrilateralsQ2": ("quad9", 9),
    "TetrahedraP2": ("tetra10", 10),
    "PrismsP2": ("wedge18", 18),
    "PyramidsP2": ("pyramid14", 14),
    "HexahedraQ2": ("hexahedron27", 27),
    "EdgesP3": ("line4", 4),
    "TrianglesP3": ("triangle10", 10),
    "TetrahedraP3": ("tetra20", 20),
}


@dataclass
class TextMesh:
    """cells, references: per block; a reference is the id of the CAD entity or region, 0 where there is none.
    ridges: ids of the rows of the line block that are creases; None where the file does not tell. notes: what is odd
        about the file."""

    points: np.ndarray
    cells: list[tuple[str, np.ndarray]] = field(default_factory=list)
    references: list[np.ndarray] = field(default_factory=list)
    ridges: np.ndarray | None = None
    notes: list[str] = field(default_factory=list)


@dataclass
class _Section:
    """The text from one keyword to the next, comments blanked. line: number of its first line."""

    name: str
    text: str
    line: int


def read_medit(text: str, name: str) -> TextMesh:
    sections = _sections(text, name)
    found = {section.name: section for section in sections}
    if "Vertices" not in found:
        raise IoError(f"{name}: has no section Vertices; a Medit .mesh file is needed")
    dimension = int(_table(found["Dimension"], name, 1, counted=False)[0, 0]) if "Dimension" in found else 3
    if dimension != 3:
        line = found["Dimension"].line
        raise IoError(f"{name}, line {line}: points of dimension {dimension}; 3 is needed")
    mesh = TextMesh(_finite(found["Vertices"], name, _table(found["Vertices"], name, 4)[:, :3], 4))
    if sections[-1].name != "End":
        mesh.notes.append(f"the file does not end with End, but with {sections[-1].name}: it may be cut")
    for section in sections:
        if section.name not in _MEDIT_CELLS:
            continue
        kind, corners = _MEDIT_CELLS[section.name]
        rows = _table(section, name, corners + 1, whole=True)
        mesh.cells.append((kind, rows[:, :corners] - 1))
        mesh.references.append(rows[:, corners])
        _require_ids(section, name, rows[:, :corners], 1, len(mesh.points))
    if "Ridges" in found and "Edges" in found and not any(name.startswith("EdgesP") for name in found):
        mesh.ridges = _table(found["Ridges"], name, 1, whole=True).ravel() - 1
        lines = sum(len(cells) for kind, cells in mesh.cells if kind.startswith("line"))
        _require_ids(found["Ridges"], name, mesh.ridges[:, None] + 1, 1, lines)
    return mesh


def read_tetgen(files: dict[str, tuple[str, str]]) -> TextMesh:
    """files: text and name by suffix, ".node" and ".ele", with ".face" and ".edge" where there are such files.

    The first attribute of a tet is its region. Markers of faces are CAD faces where there are several. Edges are
    feature
    edges: all, or those of a marker other than 0 where both kinds occur.
    """
    (node_text, node_name), (ele_text, ele_name) = files[".node"], files[".ele"]
    nodes = _headed(node_text, node_name, "points", (3, "dimension"))
    base = int(nodes[0, 0]) if len(nodes) else 0
    wrong = np.flatnonzero(nodes[:, 0] != np.arange(base, base + len(nodes)))
    if len(wrong):
        row = wrong[0]
        raise IoError(f"{node_name}: row {row + 1} of the points has number {nodes[row, 0]:g}; number them in order")
    _finite(_Section("points", _without_comments(node_text), 1), node_name, nodes[:, 1:4], nodes.shape[1], skip=4)
    tets = _headed(ele_text, ele_name, "tets", (4, "vertices per tet"), quadratic=10)
    width = tets.shape[1]
    quadratic = int(_without_comments(ele_text).split(None, 2)[1]) == 10
    if quadratic:  # four corners, then points on the six edges
        tets = np.delete(tets, slice(5, 11), axis=1)
    ids = _whole(tets[:, 1:5])
    if ids is None:
        bad = int(np.argmin(((np.abs(tets[:, 1:5]) < 2**53) & (tets[:, 1:5] == np.floor(tets[:, 1:5]))).all(axis=1)))
        line = _line_of_row(_Section("", _without_comments(ele_text), 1), bad, width, skip=3)
        raise IoError(f"{ele_name}, line {line}: a vertex id is no whole number")
    outside = np.flatnonzero(((ids < base) | (ids >= base + len(nodes))).any(axis=1))
    if len(outside):
        line = _line_of_row(_Section("", _without_comments(ele_text), 1), outside[0], width, skip=3)
        raise IoError(
            f"{ele_name}, line {line}: a tet names a point outside {base} .. {base + len(nodes) - 1}, "
            f"the ids of {node_name}"
        )
    regions = np.unique(tets[:, 5], return_inverse=True)[1] + 1 if tets.shape[1] > 5 else np.zeros(len(tets), np.int64)
    whole = _whole(tets[:, 5:6])
    if tets.shape[1] > 5 and whole is not None:
        regions = whole.ravel()
    mesh = TextMesh(nodes[:, 1:4], [("tetra", ids - base)], [regions])
    if quadratic:
        mesh.notes.append(
            f"cells of higher order were read by their corners, with straight edges: {len(tets)} of type tetra"
        )
    for suffix, kind, corners in ((".face", "triangle", 3), (".edge", "line", 2)):
        if suffix in files:
            cells, markers = _marked(
                *files[suffix], corners, base, len(nodes), corners * (corners - 1) // 2 if quadratic else 0
            )
            if kind == "line" and (markers != 0).any():
                cells, markers = cells[markers != 0], markers[markers != 0]
            elif len(np.unique(markers[markers > 0])) < 2:
                markers = np.zeros_like(markers)  # one marker for the whole boundary tells no faces apart
            mesh.cells.append((kind, cells - base))
            mesh.references.append(markers)
    return mesh


def _marked(text: str, name: str, corners: int, base: int, count: int, middles: int) -> tuple[np.ndarray, np.ndarray]:
    """Vertex ids and markers (0: none) of a .face or .edge file. Rows may end with more than the header tells. middles:
    points on edges, which may stand after the corners of cells of second order."""
    section = _Section("faces" if corners == 3 else "edges", _without_comments(text), 1)
    try:
        rows, marked = (int(word) for word in section.text.split(None, 2)[:2])
    except ValueError:
        raise IoError(
            f"{name}: does not begin with the number of {section.name} and whether they have markers"
        ) from None
    first = next((line.split() for line in section.text.strip().split("\n")[1:] if line.strip()), [])
    width = max(len(first), 1 + corners + marked)
    table = _table(section, name, width, skip=2, count=rows)
    if middles and width >= 1 + corners + middles + marked:
        table = np.delete(table, slice(1 + corners, 1 + corners + middles), axis=1)
    table = table[:, : 1 + corners + marked]
    whole = _whole(table)
    if whole is None:
        outside = ~((np.abs(table) < 2**53) & (table == np.floor(table))).all(axis=1)
    else:
        outside = ((whole[:, 1 : 1 + corners] < base) | (whole[:, 1 : 1 + corners] >= base + count)).any(axis=1)
    if whole is None or outside.any():
        bad = int(outside.argmax())
        line = _line_of_row(section, bad, width, skip=2)
        raise IoError(
            f"{name}, line {line}: row {bad + 1} of the {section.name} names a point outside {base} .."
            f" {base + count - 1}"
        )
    ids = whole[:, 1 : 1 + corners]
    return ids, whole[:, 1 + corners] if marked else np.zeros(rows, np.int64)


def _headed(text: str, name: str, what: str, second: tuple[int, str], quadratic: int = 0) -> np.ndarray:
    """Rows of a TetGen file with id, coordinates or vertices, attributes and markers. second: of the head; quadratic:
    what it may be, too."""
    section = _Section(what, _without_comments(text), 1)
    first = section.text.split(None, 4)[:4] if what == "points" else section.text.split(None, 3)[:3]
    try:
        header = [int(word) for word in first]
    except ValueError:
        header = []
    if len(header) < (4 if what == "points" else 3):
        raise IoError(f"{name}: does not begin with the number of {what} and what each row holds")
    if min(header[2:]) < 0:
        raise IoError(f"{name}: its head tells of {min(header[2:])} attributes or markers; 0 or more are needed")
    if header[1] not in (second[0], quadratic or second[0]):
        raise IoError(f"{name}: {second[1]} is {header[1]}; {second[0]} is needed")
    return _table(section, name, 1 + header[1] + sum(header[2:]), skip=len(header), count=header[0])


def _without_comments(text: str) -> str:
    return re.sub(r"#[^\n]*", "", text) if "#" in text else text


def _sections(text: str, name: str) -> list[_Section]:
    text = _without_comments(text)
    starts = list(re.finditer(r"^[ \t]*(?!(?i:nan|inf)\b)([A-Za-z]\w*)", text, flags=re.MULTILINE))
    sections, line, at = [], 1, 0
    for start, following in zip_longest(starts, starts[1:]):
        line, at = line + text.count("\n", at, start.start()), start.start()
        end = following.start() if following else len(text)
        sections.append(_Section(start.group(1), text[start.end() : end], line))
    if not sections or sections[0].name != "MeshVersionFormatted":
        raise IoError(f"{name}, line 1: a Medit .mesh file begins with MeshVersionFormatted")
    return sections


def _table(
    section: _Section,
    name: str,
    width: int,
    *,
    counted: bool = True,
    whole: bool = False,
    skip: int = 1,
    count: int | None = None,
) -> np.ndarray:
    """The rows of a section: after `skip` numbers, the first of them their count (unless it is given)."""
    try:
        numbers = parsed_numbers(section.text)
    except ValueError as error:
        raise IoError(_defect(section, name, f"no number in {section.name}")) from error
    if not counted:
        skip, count = 0, 1
    if count is None:
        if not len(numbers) or not 0 <= numbers[0] < 2**63 or numbers[0] != int(numbers[0]):
            raise IoError(f"{name}, line {section.line}: {section.name} is not followed by a count")
        count = int(numbers[0])
    if count < 0:
        line = _line_of_row(section, 0, width, skip=0)
        raise IoError(f"{name}, line {line}: the number of {section.name} is {count}")
    if len(numbers) < skip + count * width:
        have = max(0, len(numbers) - skip) // width
        last = section.line + section.text.rstrip().count("\n")
        raise IoError(f"{name}, line {last}: {section.name} ends after {have} of {count} rows of {width} numbers")
    if len(numbers) > skip + count * width:
        line = _line_of_row(section, count, width, skip)
        raise IoError(
            f"{name}, line {line}: {section.name} goes on after the {count} rows of {width} numbers that its head"
            " announces; correct the count"
        )
    rows = numbers[skip:].reshape(count, width)
    if not whole:
        return rows
    ids = _whole(rows)
    if ids is None:
        bad = int(np.flatnonzero(~((np.abs(rows) < 2**53) & (rows == np.floor(rows))).all(axis=1))[0])
        line = _line_of_row(section, bad, width, skip)
        raise IoError(f"{name}, line {line}: {section.name} holds a number that is no id")
    return ids


def _finite(section: _Section, name: str, points: np.ndarray, width: int, skip: int = 1) -> np.ndarray:
    bad = np.flatnonzero(~np.isfinite(points).all(axis=1))
    if len(bad):
        raise IoError(
            f"{name}, line {_line_of_row(section, int(bad[0]), width, skip)}: the coordinates of point {bad[0] + 1}"
            " (from 1) are not finite"
        )
    return points


def _whole(rows: np.ndarray) -> np.ndarray | None:
    return rows.astype(np.int64) if (np.abs(rows) < 2**53).all() and (rows == np.floor(rows)).all() else None


def _require_ids(section: _Section, name: str, ids: np.ndarray, low: int, high: int) -> None:
    outside = np.flatnonzero(((ids < low) | (ids > high)).any(axis=1))
    if len(outside):
        line = _line_of_row(section, int(outside[0]), ids.shape[1] + (section.name != "Ridges"))
        raise IoError(
            f"{name}, line {line}: row {outside[0] + 1} of {section.name} names a number outside {low} .. {high}"
        )


def _line_of_row(section: _Section, row: int, width: int, skip: int = 1) -> int:
    """Of the number that begins a row of the table, counted line by line: only for messages."""
    wanted, seen = skip + row * width, 0
    for offset, line in enumerate(section.text.split("\n")):
        seen += len(line.split())
        if seen > wanted:
            return section.line + offset
    return section.line


def _defect(section: _Section, name: str, what: str) -> str:
    """The first word that is no number, and its line."""
    for offset, line in enumerate(section.text.split("\n")):
        for word in line.split():
            try:
                float(word)
            except ValueError:
                return f"{name}, line {section.line + offset}: {what}: {word[:40]!r}"
    return f"{name}, line {section.line}: {what}"
