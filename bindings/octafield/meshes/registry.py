"""The formats of mesh files, and what is said of them: every list of suffixes is made here."""

from collections.abc import Callable, Mapping
from pathlib import Path
from types import MappingProxyType

from .._core import TriangleMesh
from ..errors import InvalidInput, IoError
from ..files.reading import plain_name, reading
from ..progress.phases import Progress
from . import surface_files, writers
from .gmsh.cad import read_cad
from .grids import Grid, read_cell_grid, read_medit_binary, read_medit_text, read_openvolumemesh, read_tetgen_files
from .mesh_format import HELD, MeshFormat

_TRIANGLES, _CELLS, _TETS = ("triangles",), HELD, ("tets", "features", "faces", "regions")

MESH_FORMATS: dict[str, MeshFormat] = {
    f.name: f
    for f in (
        MeshFormat("stl", (".stl",), "STL", _TRIANGLES, surface_files.read_triangles, surface_files.write_stl,
                   closed=True, soup=True),
        MeshFormat("obj", (".obj",), "Wavefront OBJ", _TRIANGLES, surface_files.read_triangles,
                   surface_files.write_triangles, closed=True),
        MeshFormat("off", (".off",), "OFF", _TRIANGLES, surface_files.read_triangles, surface_files.write_triangles,
                   closed=True),
        MeshFormat("ply", (".ply",), "PLY", _TRIANGLES, surface_files.read_triangles, surface_files.write_triangles,
                   closed=True),
        MeshFormat("vtp", (".vtp",), "VTK XML surface", ("triangles", "features"), surface_files.read_vtp_file,
                   surface_files.write_vtp),
        MeshFormat("vtk", (".vtk",), "VTK legacy", _CELLS, read_cell_grid("vtk"), writers.write_vtk),
        MeshFormat("vtu", (".vtu",), "VTK XML", _CELLS, read_cell_grid("vtu"), writers.write_vtu),
        MeshFormat("msh", (".msh",), "Gmsh mesh", _CELLS, read_cell_grid("msh"), writers.write_msh),
        MeshFormat("mesh", (".mesh",), "Medit text", _CELLS, read_medit_text, writers.write_medit),
        MeshFormat("meshb", (".meshb",), "Medit binary", _CELLS, read_medit_binary, writers.write_medit),
        MeshFormat("tetgen", (".node", ".ele"), "TetGen", _TETS, read_tetgen_files, writers.write_tetgen,
                   together=True),
        MeshFormat("ovm", (".ovm",), "OpenVolumeMesh text", _TETS, read_openvolumemesh, writers.write_openvolumemesh),
        MeshFormat("ovmb", (".ovmb",), "OpenVolumeMesh binary", _TETS, read_openvolumemesh,
                   writers.write_openvolumemesh),
        MeshFormat("step", (".step", ".stp"), "STEP", HELD, mesh=read_cad),
        MeshFormat("brep", (".brep",), "BREP of Open CASCADE", HELD, mesh=read_cad),
        MeshFormat("iges", (".iges", ".igs"), "IGES", HELD, mesh=read_cad),
    )
}  # fmt: skip


mesh_formats: Mapping[str, MeshFormat] = MappingProxyType(MESH_FORMATS)


def register_mesh_format(form: MeshFormat) -> None:
    """Adds a format for this process: files of its suffixes are read and written as those of the library's own. Raises
    InvalidInput where its name or a suffix is taken, it holds what no mesh file does, or nothing reads or writes it."""
    taken = {suffix: known for known in MESH_FORMATS.values() for suffix in known.suffixes}
    for suffix in form.suffixes:
        if suffix in taken:
            raise InvalidInput(f"{suffix} files are {taken[suffix].title} files already; take another", "suffix_taken")
        if not suffix.startswith(".") or suffix != suffix.lower() or suffix.endswith(".gz"):
            raise InvalidInput(f"{suffix!r}: a suffix begins with a dot, in small letters, without .gz", "bad_suffix")
    if form.name in MESH_FORMATS:
        raise InvalidInput(f"a mesh format {form.name} is there already; take another name", "name_taken")
    if not form.suffixes or not set(form.holds) <= set(HELD) or not {"triangles", "tets"} & set(form.holds):
        raise InvalidInput(
            f"{form.name}: a mesh format has suffixes and holds triangles or tets, of {', '.join(HELD)}", "bad_format"
        )
    ways = [way for way in (form.read, form.write, form.mesh) if way is not None]
    if not ways or not all(map(callable, ways)) or len(set(form.suffixes)) < len(form.suffixes):
        raise InvalidInput(
            f"{form.name}: a mesh format has suffixes that differ and a function that reads, writes or meshes",
            "bad_format",
        )
    MESH_FORMATS[form.name] = form


def find_mesh_format(path: str | Path, *, to_write: bool = False) -> MeshFormat:
    """By the file's suffix, the longest that fits. Raises IoError that lists what is known."""
    name = plain_name(path)
    known = [f for f in MESH_FORMATS.values() if not to_write or f.write is not None]
    suffix = max((s for f in known for s in f.suffixes if name.endswith(s)), key=len, default="")
    if suffix:
        return next(form for form in known if suffix in form.suffixes)
    if to_write:
        raise IoError(f"{path}: unknown kind of mesh file; known are {' '.join(written_suffixes())}, also .gz")
    raise IoError(f"{path}: unknown kind of file; known are {kinds_in_words('surfaces', 'tet meshes', 'CAD models')}")


def read_mesh_file(path: Path, edge_length: float, progress: Progress | None) -> Grid | TriangleMesh:
    """What the file holds, or what Gmsh makes of a CAD model. Whatever a reader stumbles over becomes an IoError."""
    form = find_mesh_format(path)
    if form.mesh is not None:
        return form.mesh(path, edge_length, progress)
    if form.read is None:
        raise IoError(f"{path}: {form.title} files are written only")
    with reading(path, form.suffix_of(path)):
        found = form.read(path)
        if not isinstance(found, (Grid, TriangleMesh)):
            raise TypeError(f"the reader of {form.name} gave {found!r:.100}, not a Grid or TriangleMesh")
        return found


def kinds_in_words(surface: str, tets: str, cad: str) -> str:
    """ "surface (.stl ...), tet mesh (.vtk ...) and CAD model (.step ...), also .gz", with these words."""
    of_surfaces, of_tets, of_cad = (
        " ".join(_suffixes(lambda form, kind=kind: (form.read or form.mesh) is not None and _kind(form) == kind))  # type: ignore[misc]
        for kind in ("surface", "tets", "cad")
    )
    return f"{surface} ({of_surfaces}), {tets} ({of_tets}) and {cad} ({of_cad}), also .gz"


def written_suffixes(*, surfaces: bool = False) -> tuple[str, ...]:
    """Of formats that are written. surfaces: those that hold triangles without tets, too."""
    return _suffixes(lambda form: form.write is not None and (not surfaces or "triangles" in form.holds))


def is_written(path: str | Path) -> bool:
    """Whether octafield writes such mesh files."""
    return plain_name(path).endswith(written_suffixes())


def _suffixes(wanted: Callable[[MeshFormat], bool]) -> tuple[str, ...]:
    return tuple(suffix for form in MESH_FORMATS.values() if wanted(form) for suffix in form.suffixes)


def _kind(form: MeshFormat) -> str:
    return "cad" if form.mesh is not None else "tets" if "tets" in form.holds else "surface"
