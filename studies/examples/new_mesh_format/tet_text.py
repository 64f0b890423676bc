"""A mesh format from outside of the library: .tet text files, as small programs write them. "N vertices" and "M tets",
a line each, then N lines of three coordinates and M lines of "4 a b c d", ids from 0."""

# --8<-- [start:format]
from pathlib import Path

import numpy as np
from octafield import IoError, MeshFormat
from octafield.files.reading import head_of, read_text, rows_of, table_of, write_whole
from octafield.meshes.grids import Grid, grid_of_blocks
from octafield.meshes.parts import Parts


def read_tet(path: Path) -> Grid:
    """Errors name the file, and the line where there is one."""
    heads, body, first = head_of(read_text(path), 2)
    words = [head.split() for head in heads]
    if [word[1:] for word in words] != [["vertices"], ["tets"]] or not all(word[0].isdigit() for word in words):
        raise IoError(f"{path}: begins with {heads[0][:40]!r}; lines 'N vertices' and 'M tets' are needed")
    count, tets = (int(word[0]) for word in words)
    lines = body.split("\n")
    filled = [k for k, line in enumerate(lines) if line.strip()]
    cut = filled[count] if count < len(filled) else len(lines)
    points, _ = table_of("\n".join(lines[:cut]), str(path), 3, first)
    rows, _ = table_of("\n".join(lines[cut:]), str(path), 5, first + cut)
    if (len(points), len(rows)) != (count, tets) or (rows != np.rint(rows)).any() or (rows[:, 0] != 4).any():
        raise IoError(f"{path}: {count} lines of points and {tets} of '4 a b c d' are needed")
    return grid_of_blocks(points, [("tetra", rows[:, 1:].astype(np.int64))], None, None)


def write_tet(path: Path, parts: Parts) -> list[str]:
    """Packed where the path says so; whole or not at all."""
    head = f"{len(parts.points)} vertices\n{len(parts.tets)} tets\n".encode()
    write_whole(path, [head, *rows_of(parts.points), *rows_of(parts.tets, prefix="4 ")])
    return []


TET = MeshFormat("tet", (".tet",), "tet text", ("tets",), read_tet, write_tet)
# --8<-- [end:format]
