"""OpenVolumeMesh files, text (.ovm) and binary (.ovmb): tets as edges, faces of half-edges and cells of half-faces,
with properties. Layouts: docs/formats.md."""

import re
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from ...errors import InvalidInput, IoError
from ...files.reading import read_text, rows_of, table_of, write_whole
from .binary import binary_pieces, read_binary
from .mesh import ENTITIES, OvmMesh

SUFFIXES = (".ovm", ".ovmb")
_SECTIONS = ("Vertices", "Edges", "Faces", "Polyhedra")
_KEYWORDS = dict(zip(("vprop", "eprop", "fprop", "cprop", "heprop", "hfprop", "mprop"), ENTITIES, strict=True))
_KEYWORD_OF = dict(zip(ENTITIES, ("VProp", "EProp", "FProp", "CProp", "HEProp", "HFProp", "MProp"), strict=True))
_WIDTHS = {
    "int": 1,
    "unsigned": 1,
    "short": 1,
    "long": 1,
    "unsigned_int": 1,
    "double": 1,
    "float": 1,
    "bool": 1,
    "char": 1,
}
_TEXT_TYPE = {("i", 1): "int", ("f", 1): "double", ("f", 2): "vec2d", ("f", 3): "vec3d", ("f", 4): "vec4d"}


def read_ovm(path: Path, *, binary: bool) -> OvmMesh:
    mesh = read_binary(path) if binary else _read_text(path)
    for what, ids, limit in (
        ("edge", mesh.edges, len(mesh.vertices)),
        ("face", mesh.faces, 2 * len(mesh.edges)),
        ("cell", mesh.cells, 2 * len(mesh.faces)),
    ):
        outside = ((ids < 0) | (ids >= limit)).any(axis=1)
        if outside.any():
            bad = int(np.argmax(outside))
            raise InvalidInput(
                f"{path}: {what} {bad} (from 0) names an element outside 0 .. {limit - 1}", "index_out_of_range", [bad]
            )
    return mesh


def write_ovm(path: Path, mesh: OvmMesh, *, binary: bool) -> None:
    write_whole(path, binary_pieces(mesh) if binary else _text_pieces(mesh))


def _read_text(path: Path) -> OvmMesh:
    text = re.sub(r"#[^\n]*", "", read_text(path))
    heads = [
        (m.start(), m.end(), m[1].lower(), m[0].strip())
        for m in re.finditer(r"^[ \t]*([A-Za-z]\w*)[^\n]*", text, re.MULTILINE)
    ]
    if not heads or heads[0][3].lower().split() != ["ovm", "ascii"]:
        raise IoError(f"{path}, line 1: an OVM text file begins with 'OVM ASCII'")
    line = 1
    parts: dict[str, np.ndarray] = {}
    mesh = OvmMesh(np.empty((0, 3)), np.empty((0, 2)), np.empty((0, 3)), np.empty((0, 4)))
    at = 0
    foreign = False  # in the values of a property that is not read
    for (start, end, word, head), following in zip(heads, [*heads[1:], None], strict=True):
        line, at = line + text.count("\n", at, start), start
        body = text[end : following[0] if following else len(text)]
        if word in [s.lower() for s in _SECTIONS]:
            parts[word] = _section(body, f"{path}", word, line)
            if word == "polyhedra":
                missing = [s for s in _SECTIONS if s.lower() not in parts]
                if missing:
                    raise IoError(f"{path}, line {line}: section {missing[0]} is missing")
                mesh = OvmMesh(parts["vertices"], parts["edges"], parts["faces"], parts["polyhedra"])
        elif word in _KEYWORDS:
            foreign = not _take_property(mesh, head, body, path, line)
        elif word != "ovm" and not foreign:
            raise IoError(f"{path}, line {line}: unknown section {head[:40]!r}")
    if "polyhedra" not in parts:
        raise IoError(f"{path}, line {line}: ends without the section Polyhedra")
    return mesh


def _section(body: str, name: str, word: str, line: int) -> np.ndarray:
    stripped = body.lstrip()
    first = line + body[: len(body) - len(stripped)].count("\n")
    head, _, rest = stripped.partition("\n")
    if not head.strip().isdigit():
        raise IoError(f"{name}, line {first}: {word} is not followed by a count")
    width = {"vertices": 3, "edges": 2, "faces": 4, "polyhedra": 5}[word]
    if word in ("faces", "polyhedra"):  # other numbers of sides come first: they are the likely defect
        for offset, row in enumerate(rest.split("\n")):
            sides = row.split(None, 1)[:1]
            if sides and sides[0].isdigit() and sides[0] != str(width - 1):
                raise IoError(f"{name}, line {first + 1 + offset}: {sides[0]} sides; meshes of tets have {width - 1}")
    rows, lines = table_of(rest, name, width, first_line=first + 1)
    if len(rows) != int(head):
        raise IoError(
            f"{name}, line {first + 1 + rest.rstrip().count(chr(10))}: {word} has {len(rows)} rows, not {int(head)}"
        )
    if word == "vertices":
        return rows
    ids = _ids(rows, name, lines)
    if word == "edges":
        return ids
    return ids[:, 1:]


def _ids(rows: np.ndarray, name: str, lines: np.ndarray) -> np.ndarray:
    bad = np.flatnonzero(~((rows >= 0) & (rows < 2**53) & (rows == np.floor(rows))).all(axis=1))
    if len(bad):
        raise IoError(f"{name}, line {lines[bad[0]]}: holds a number that is no id")
    return rows.astype(np.int64)


def _take_property(mesh: OvmMesh, head: str, body: str, path: Path, line: int) -> bool:
    """Whether properties of this type are read."""
    match = re.match(r'(\w+)\s+(.*?)\s*"(.*)"\s*$', head)
    if not match:
        raise IoError(f'{path}, line {line}: a property is written as: CProp int "name"; not {head[:40]!r}')
    entity, kind, name = _KEYWORDS[match[1].lower()], match[2].lower().replace(" ", "_"), match[3]
    vector = re.fullmatch(r"vec([234])(?:d|f|i|ui)", kind)
    if kind not in _WIDTHS and not vector:
        mesh.skipped.append(name)
        return False
    width = int(vector[1]) if vector else 1
    rows, _ = table_of(body, str(path), width, first_line=line)
    if len(rows) != mesh.count(entity):
        raise IoError(
            f"{path}, line {line}: property {name!r} has {len(rows)} rows; there are {mesh.count(entity)} elements"
        )
    whole = (
        kind[-1] not in "df"
        and kind not in ("double", "float")
        and np.isfinite(rows).all()
        and (np.abs(rows) < 2**53).all()
    )
    values = rows.astype(np.int64) if whole else rows
    mesh.properties[entity, name] = values[:, 0] if width == 1 else values
    return True


def _text_pieces(mesh: OvmMesh) -> Iterator[bytes]:
    yield b"OVM ASCII\n"
    for section, table in zip(_SECTIONS, (mesh.vertices, mesh.edges, mesh.faces, mesh.cells), strict=True):
        yield f"{section}\n{len(table)}\n".encode()
        yield from rows_of(table, prefix={"Faces": "3 ", "Polyhedra": "4 "}.get(section, ""))
    for (entity, name), values in mesh.properties.items():
        table = np.asarray(values).reshape(mesh.count(entity), -1)
        kind = _TEXT_TYPE[table.dtype.kind, table.shape[1]]
        yield f'{_KEYWORD_OF[entity]} {kind} "{name}"\n'.encode()
        yield from rows_of(table)
