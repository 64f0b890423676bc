"""The formats of files with frames."""

from pathlib import Path

from ..errors import InvalidInput, IoError
from . import algohex, arrays, cubecover, text, vtk
from .base import FrameFormat

_AXES = "three axes, one after the other"
_SHORTEST = "fewest digits that read back to the same bits (17 at most)"
_BITS = "float64"

FORMATS: dict[str, FrameFormat] = {
    f.name: f
    for f in (
        FrameFormat(
            "arff", (".txt",), "ARFF text", ("vertices", "tets"), "9 numbers per line: " + _AXES, _SHORTEST,
            "dpa1mer/arff: src/io/ExportFrames.m, ImportFrames.m", text.read_arff, text.write_arff, holds_lengths=True,
        ),
        FrameFormat(
            "mouette", (".frame",), "mouette", ("tets",), "9 numbers per line: " + _AXES, _SHORTEST,
            "mouette 1.2.8: processing/framefield/cells.py", text.read_mouette, text.write_mouette,
        ),
        FrameFormat(
            "geogram", (), "geogram, in order", ("tets",), "3 numbers per line: one axis; 3 lines per frame", _SHORTEST,
            "BrunoLevy/geogram: src/lib/geogram/mesh/mesh_frame_field.cpp", text.read_geogram, text.write_geogram,
        ),
        FrameFormat(
            "geogram-centres", (), "geogram, with centres", ("tets", "vertices"),
            "12 numbers per line: centre, then " + _AXES, _SHORTEST,
            "BrunoLevy/geogram: src/lib/geogram/mesh/mesh_frame_field.cpp", text.read_geogram_centres,
            text.write_geogram_centres,
            needs_mesh=True,
        ),
        FrameFormat(
            "fra", (".fra",), "CubeCover, with .perm", ("tets",), "3 numbers per line: one axis; 3 lines per frame",
            _SHORTEST,
            "evouga/CubeCover: src/ReadFrameField.cpp, WriteFrameFIeld.cpp, CubeCover.h", cubecover.read_fra,
            cubecover.write_fra,
            needs_mesh=True, holds_lengths=True,
        ),
        FrameFormat(
            "bfra", (".bfra",), "MINT, binary", ("tets",), "9 doubles per tet, column by column: " + _AXES, _BITS,
            "MINT: serializeMatrixNew and readFrameField_v2", cubecover.read_bfra, cubecover.write_bfra,
            holds_lengths=True,
        ),
        FrameFormat(
            "qtn", (".qtn",), "AlgoHex quaternions", ("tets", "vertices"), "quaternion w x y z", _SHORTEST,
            "cgg-bern/AlgoHex: demo/HexMeshing/HexMeshing.hh", text.read_qtn, text.write_qtn, exact=True,
        ),
        FrameFormat(
            "ovm", (".ovm",), "OpenVolumeMesh text", ("tets", "vertices"),
            "properties quaternion (vec4d, w x y z), frame_u, frame_v, frame_w (vec3d)", _SHORTEST,
            "OpenVolumeMesh: src/OpenVolumeMesh/FileManager/FileManagerT_impl.hh", algohex.read_text,
            algohex.write_text,
            holds_mesh=True, needs_mesh=True, exact=True, holds_features=True, holds_regions=True,
        ),
        FrameFormat(
            "ovmb", (".ovmb",), "OpenVolumeMesh binary, AlgoHex", ("tets", "vertices"),
            "property FrameFieldQuaternions or vertex quaternion (Quaternion: x y z w)", _BITS,
            "OpenVolumeMesh: src/OpenVolumeMesh/IO/detail/ovmb_format.hh, ovmb_codec.cc; cgg-bern/AlgoHex: "
            "PropertyCodecsSHCoeffs.hh",
            algohex.read_binary, algohex.write_binary, holds_mesh=True, needs_mesh=True, exact=True,
            holds_features=True, holds_regions=True,
        ),
        FrameFormat(
            "ff3", (".ff3",), "MetricDrivenFrame3D, ASCII", ("tets",), "9 numbers per line: " + _AXES, _SHORTEST,
            "xianzhongfang/MetricDrivenFrame3D: README.md", text.read_ff3, text.write_ff3, holds_lengths=True,
            holds_edges=True,
        ),
        FrameFormat(
            "vtu", (".vtu",), "VTK XML", ("vertices", "tets"),
            "arrays quaternion (w x y z), frame_u, frame_v, frame_w, sh4; of axes at any angle rotation (w x y z),"
            " stretch, frame_u, frame_v, frame_w, frame_lengths",
            _BITS, "VTK itself, meshio", vtk.read_vtu, vtk.write_vtu, holds_stretch=True,
            holds_mesh=True, exact=True, needs_mesh=True, holds_lengths=True, holds_features=True, holds_regions=True,
        ),
        FrameFormat(
            "vtk", (".vtk",), "VTK legacy", ("vertices", "tets"), "the arrays of vtu", _BITS, "meshio", vtk.read_vtk,
            None,
            holds_mesh=True, exact=True,
        ),
        FrameFormat(
            "vtp", (".vtp",), "VTK XML points", ("vertices", "tets"),
            "a point per frame; arrays quaternion (w x y z), frame_u, frame_v, frame_w",
            _BITS, "VTK itself", None, vtk.write_vtp, needs_mesh=True, exact=True,
        ),
        FrameFormat(
            "msh", (".msh",), "Gmsh mesh with views", ("tets", "vertices"),
            "views frame_u, frame_v, frame_w (vectors), frame (tensor: " + _AXES + ")",
            _BITS, "Gmsh itself, meshio", vtk.read_msh, vtk.write_msh, holds_mesh=True, needs_mesh=True,
            holds_features=True, holds_regions=True,
        ),
        FrameFormat(
            "pos", (".pos",), "Gmsh views", ("tets", "vertices"),
            "views frame_u, frame_v, frame_w: vectors at points (VP)", _SHORTEST,
            "Gmsh itself", None, vtk.write_pos, needs_mesh=True,
        ),
        FrameFormat(
            "npy", (".npy",), "numpy", ("vertices", "tets"),
            "(n, 4) quaternions w x y z; (n, 9) or (n, 3, 3) axes are read, too", _BITS,
            "numpy", arrays.read_npy, arrays.write_npy, exact=True,
        ),
        FrameFormat(
            "npz", (".npz",), "numpy, with the mesh", ("vertices", "tets"),
            "arrays frames (w x y z), where, vertices, tets, lengths, features, regions; of axes at any angle rotation"
            " (w x y z) and stretch in place of frames",
            _BITS, "numpy",
            arrays.read_npz, arrays.write_npz,
            holds_mesh=True, exact=True, holds_lengths=True, holds_features=True, holds_regions=True,
            holds_stretch=True,
        ),
    )
}  # fmt: skip


READERS = {name: form.read for name, form in FORMATS.items() if form.read is not None}
WRITERS = {name: form.write for name, form in FORMATS.items() if form.write is not None}


def find_format(path: str | Path, name: str | None, *, to_write: bool = False) -> FrameFormat:
    """By name, or by the file's extension."""
    what = "write" if to_write else "read"
    known = {n: FORMATS[n] for n in (WRITERS if to_write else READERS)}
    if name is not None:
        if name not in known:
            raise InvalidInput(f"format {name!r} is not one of: {', '.join(known)}", "unknown_option_value")
        return known[name]
    for found in known.values():
        if found.owns(path):
            return found
    listed = ", ".join(f"{f.name} ({' '.join(f.extensions) or 'by name only'})" for f in known.values())
    raise IoError(f"{path}: unknown kind of file with frames; known to {what} are {listed}")
