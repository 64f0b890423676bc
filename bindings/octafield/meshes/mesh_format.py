"""What a kind of mesh file is: its suffixes, what it holds, how it is read and written."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

from .._core import TriangleMesh
from ..files.reading import plain_name
from ..progress.phases import Progress
from .grids import Grid
from .parts import Parts

HELD = ("triangles", "tets", "features", "faces", "regions")


@dataclass(frozen=True)
class MeshFormat:
    """A kind of mesh file.

    name: one word. suffixes: in small letters; files may also be packed, with .gz after it. title: words for people.
    holds: of HELD: "triangles" (a surface), "tets", and beside them feature edges, CAD faces of triangles, regions of
        tets.
    read(path): the cells, or the surface; None where octafield cannot. Whatever it raises becomes an IoError.
    write(path, parts): writes what the format holds, packed where the path says so, and says in sentences what changed;
        None where octafield cannot.
    mesh(path, edge_length, progress): of CAD models, which are meshed here: the cells.
    closed: readers of such files want a closed surface, so that interfaces between regions are left out. soup: each
        triangle has points of its own. together: the suffixes are files of one mesh, which lie side by side.
    """

    name: str
    suffixes: tuple[str, ...]
    title: str
    holds: tuple[str, ...]
    read: Callable[[Path], Grid | TriangleMesh] | None = None
    write: Callable[[Path, Parts], list[str]] | None = None
    mesh: Callable[[Path, float, Progress | None], Grid] | None = None
    closed: bool = False
    soup: bool = False
    together: bool = False

    def __repr__(self) -> str:
        does = (("read", self.read or self.mesh), ("written", self.write))
        done = " and ".join(word for word, how in does if how is not None)
        return f"MeshFormat({self.name}: {self.title}, {' '.join(self.suffixes)}; {', '.join(self.holds)}; {done})"

    def owns(self, path: str | Path) -> bool:
        return plain_name(path).endswith(self.suffixes)

    def suffix_of(self, path: str | Path) -> str:
        """Of a file it owns, without .gz."""
        return max((suffix for suffix in self.suffixes if plain_name(path).endswith(suffix)), key=len)
