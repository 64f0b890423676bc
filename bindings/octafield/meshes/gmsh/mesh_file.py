"""Gmsh's .msh files, versions 2 and 4.1, text and binary in either byte order: cells with their tags and views, errors
with their line or byte.

meshio reads these too, but not views of meshes with cells of several kinds; it takes views by their order instead of
their ids, and does not say where a file is damaged. Layout: Gmsh reference manual, MSH file format.
"""

import codecs
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from ...errors import IoError
from ..cell_mesh import Block, CellMesh
from .entities import Entities, entities, partitioned
from .sections import Section, sections, version_of

_CELLS = {
    15: ("vertex", 1),
    1: ("line", 2),
    2: ("triangle", 3),
    3: ("quad", 4),
    4: ("tetra", 4),
    5: ("hexahedron", 8),
    6: ("wedge", 6),
    7: ("pyramid", 5),
}
_HIGHER = {8: 3, 9: 6, 10: 9, 11: 10, 12: 27, 13: 18, 14: 14, 16: 8, 17: 20, 18: 15, 19: 13, 20: 9, 21: 10, 22: 12,
           23: 15, 24: 15, 25: 21, 26: 4, 27: 5,
           28: 6, 29: 20, 30: 35, 31: 56, 92: 64, 93: 125}  # fmt: skip
_View = tuple[str, np.ndarray, np.ndarray]  # name, ids, values
_VOLUME, _FLAT, _CURVE = {11, 29, 30, 31}, {9, 20, 21, 22, 23, 24, 25}, {8, 26, 27, 28}
_QUADRATIC = {
    10: "quad9",
    12: "hexahedron27",
    13: "wedge18",
    14: "pyramid14",
    16: "quad8",
    17: "hexahedron20",
    18: "wedge15",
    19: "pyramid13",
    92: "hexahedron64",
    93: "hexahedron125",
}


@dataclass
class _Elements:
    """A run of elements of one kind. kind: Gmsh's number."""

    kind: int
    ids: np.ndarray
    nodes: np.ndarray
    physical: np.ndarray
    geometrical: np.ndarray


def read_gmsh(data: bytes, name: str) -> CellMesh:
    """With cell data gmsh:physical and gmsh:geometrical (0: none) and the views; where a view has no value: nan."""
    parts = list(sections(data.removeprefix(codecs.BOM_UTF8), name))
    version = version_of(parts[0])
    order = parts[0].order
    for section in parts:
        section.order = order
    wide = version >= 4
    told: Entities = {}
    tags, points, runs = np.empty(0, np.int64), np.empty((0, 3)), list[_Elements]()
    views: dict[str, list[_View]] = {"NodeData": [], "ElementData": []}
    for section in parts:
        if section.name == "Entities" and wide:
            told |= entities(section)
        elif section.name == "PartitionedEntities" and wide:
            told |= partitioned(section, told)
        elif section.name == "Nodes" and not len(points):
            tags, points = (_nodes4 if wide else _nodes2)(section)
        elif section.name == "ParametricNodes" and not wide and not len(points):
            tags, points = _parametric_nodes(section)
        elif section.name == "Elements" and not runs:  # Gmsh writes them again before every view that is appended
            runs = list(_elements4(section, told) if wide else _elements2(section))
        elif section.name in views:
            views[section.name].append(_view(section))
    if not len(points):
        raise IoError(f"{name}: holds no nodes")
    return _mesh(name, tags, points, runs, views)


def _nodes2(section: Section) -> tuple[np.ndarray, np.ndarray]:
    count = section.count("nodes") if section.order else section.size("i4", "nodes")
    if section.order:
        rows = _rows(section, count, np.dtype([("id", section.order + "i4"), ("at", section.order + "f8", 3)]))
        return rows["id"].astype(np.int64), rows["at"].astype(float)
    table = section.take("f8", 4 * count).reshape(-1, 4)
    return section._whole(np.ascontiguousarray(table[:, 0]), 4 * count), table[:, 1:]


def _rows(section: Section, count: int, dtype: np.dtype) -> np.ndarray:
    return np.frombuffer(section.take("u1", count * dtype.itemsize).tobytes(), dtype)


def _nodes4(section: Section) -> tuple[np.ndarray, np.ndarray]:
    blocks, *_ = (section.size("u8", "nodes") for _ in range(4))
    tags, points = [np.empty(0, np.int64)], [np.empty((0, 3))]
    for _ in range(blocks):
        dimension, _, parametric = section.take("i4", 3).tolist()
        count = section.size("u8", "nodes")
        tags.append(section.take("u8", count).astype(np.int64))
        width = 3 + (dimension if parametric else 0)
        points.append(section.take("f8", width * count).reshape(count, width)[:, :3])
    return np.concatenate(tags), np.concatenate(points).astype(float)


def _parametric_nodes(section: Section) -> tuple[np.ndarray, np.ndarray]:
    """Version 2: after the coordinates, dimension and tag of the CAD entity and, on curves and faces, a parameter or
    two."""
    count = section.count("nodes") if section.order else section.size("i4", "nodes")
    if count > section.end - section.at:
        raise IoError(
            f"{section.place()}: $ParametricNodes ends early: {count} nodes do not fit in {section.end - section.at}"
            " bytes"
        )
    ids, points = np.empty(count, np.int64), np.empty((count, 3))
    for row in range(count):
        ids[row] = section.take("i4", 1)[0]
        points[row] = section.take("f8", 3)
        dimension = int(section.take("i4", 2)[0])
        section.take("f8", dimension if dimension in (1, 2) else 0)
    return ids, points


def _width(section: Section, place: str, kind: int) -> int:
    width = _CELLS[kind][1] if kind in _CELLS else _HIGHER.get(kind)
    if width is None:
        raise IoError(f"{place}: elements of type {kind}, which is not read")
    return width


def _elements2(section: Section) -> Iterator[_Elements]:
    count = section.count("elements") if section.order else section.size("i4", "elements")
    rows: list[list[int]] = []
    while count > 0:
        place = section.place() if section.order else ""
        if section.order:
            kind, number, tags = section.take("i4", 3).tolist()
            if number < 1 or tags < 0:
                raise IoError(f"{place}: $Elements: {number} elements with {tags} tags")
            width = 1 + tags + _width(section, place, kind)
            table = section.take("i4", number * width).reshape(number, width).astype(np.int64)
            count -= number
            yield _run(kind, table, tags)
            continue
        first, kind, tags = section.take("i4", 3).tolist()
        if tags < 0 or not (kind in _CELLS or kind in _HIGHER):
            section.taken -= 2
            raise IoError(
                f"{section.place()}: $Elements: an element of type {kind} with {tags} tags, which is not read"
            )
        row = [kind, tags, first, *section.take("i4", tags + _width(section, "", kind)).tolist()]
        count -= 1
        if rows and rows[0][:2] != row[:2]:
            yield _run(rows[0][0], np.array(rows)[:, 2:], rows[0][1])
            rows = []
        rows.append(row)
    if rows:
        yield _run(rows[0][0], np.array(rows)[:, 2:], rows[0][1])


def _run(kind: int, table: np.ndarray, tags: int) -> _Elements:
    none = np.zeros(len(table), np.int64)
    return _Elements(
        kind, table[:, 0], table[:, 1 + tags :], table[:, 1] if tags > 0 else none, table[:, 2] if tags > 1 else none
    )


def _elements4(section: Section, told: Entities) -> Iterator[_Elements]:
    blocks, *_ = (section.size("u8", "elements") for _ in range(4))
    for _ in range(blocks):
        place = section.place()
        dimension, entity, kind = section.take("i4", 3).tolist()
        number, width = section.size("u8", "elements"), 1 + _width(section, place, kind)
        table = section.take("u8", number * width).reshape(number, width).astype(np.int64)
        group, parent = told.get((dimension, entity), (0, entity))
        if parent is not None:  # else between partitions
            yield _Elements(kind, table[:, 0], table[:, 1:], np.full(number, group), np.full(number, parent))


def _view(section: Section) -> _View:
    names = [section.line().strip('"') for _ in range(min(section.count("words"), 100))]
    for _ in range(min(section.count("real numbers"), 100)):
        section.line()
    place = section.place()
    whole = [section.count("components and rows") for _ in range(min(section.count("whole numbers"), 100))]
    if not names or len(whole) < 3 or whole[1] > 9:
        raise IoError(f"{place}: ${section.name} begins with a name, and time step, components and rows")
    width, count = whole[1:3]
    if section.order:
        rows = _rows(
            section, count, np.dtype([("id", section.order + "i4"), ("values", section.order + "f8", (width,))])
        )
        return names[0], rows["id"].astype(np.int64), rows["values"].astype(float)
    table = section.take("f8", count * (1 + width)).reshape(count, 1 + width)
    return names[0], section._whole(np.ascontiguousarray(table[:, 0]), count * (1 + width)), table[:, 1:]


def _mesh(
    name: str, tags: np.ndarray, points: np.ndarray, runs: list[_Elements], views: dict[str, list[_View]]
) -> CellMesh:
    if len(np.unique(tags)) < len(tags):
        raise IoError(f"{name}: two nodes have the same number")
    cells = []
    for run in runs:
        nodes = _rows_of(tags, run.nodes.ravel()).reshape(run.nodes.shape)
        if (nodes < 0).any():
            bad = int(np.argmax((nodes < 0).any(axis=1)))
            raise IoError(
                f"{name}: element {run.ids[bad]} names node {run.nodes[bad][nodes[bad] < 0][0]}, which is not there"
            )
        cells.append(Block(_kind(run.kind), nodes))
    ids = np.concatenate([run.ids for run in runs]) if runs else np.empty(0, np.int64)
    ends = np.cumsum([len(run.ids) for run in runs])[:-1]
    of_points = {key: _placed(values, _rows_of(tags, where), len(tags)) for key, where, values in views["NodeData"]}
    of_cells = {
        key: np.split(_placed(values, _rows_of(ids, where), len(ids)), ends)
        for key, where, values in views["ElementData"]
    }
    of_cells["gmsh:physical"], of_cells["gmsh:geometrical"] = (
        [run.physical for run in runs],
        [run.geometrical for run in runs],
    )
    return CellMesh(points, cells, of_points, of_cells if runs else {})


def _kind(kind: int) -> str:
    """meshio's names; of what is not used, one that begins with what it is made of."""
    if kind in _CELLS:
        return _CELLS[kind][0]
    plain = "tetra" if kind in _VOLUME else "triangle" if kind in _FLAT else "line" if kind in _CURVE else ""
    return f"{plain}{_HIGHER[kind]}" if plain else _QUADRATIC.get(kind, f"hexahedron of Gmsh's type {kind}")


def _rows_of(known: np.ndarray, wanted: np.ndarray) -> np.ndarray:
    """Where each wanted number is among the known ones, -1 where it is not."""
    if not len(known):
        return np.full(len(wanted), -1)
    order = np.argsort(known, kind="stable")
    at = np.minimum(np.searchsorted(known, wanted, sorter=order), len(known) - 1)
    return np.where(known[order[at]] == wanted, order[at], -1)


def _placed(values: np.ndarray, rows: np.ndarray, count: int) -> np.ndarray:
    result = np.full((count, values.shape[1]), np.nan)
    result[rows[rows >= 0]] = values[rows >= 0]
    return result[:, 0] if values.shape[1] == 1 else result
