"""Every format of frames, written and read back by others, and written by others and read by octafield: the table of
docs/formats.md.

PYTHONPATH=tests/python python tests/python/format_table.py      # brings the table of the page up to date
"""

import importlib.util
import sys
import tempfile
from dataclasses import dataclass
from pathlib import Path

import algohex_reader as algohex
import meshio
import numpy as np
import octafield
import other_readers as readers
import other_writers as writers
import pyvista
from scipy.spatial.transform import Rotation

PAGE = Path(__file__).parents[2] / "docs" / "formats.md"
BEGIN, FORMATS_BEGIN, END = (
    "<!-- table of round trips -->\n",
    "<!-- table of formats -->\n",
    "<!-- end of the table -->\n",
)
HEAVY = ("mouette",)  # readers that need not be there
SAME = 2e-15  # radians: what 64-bit axes leave of a quaternion


@dataclass(frozen=True)
class Row:
    format: str
    where: str
    direction: str  # "written" by octafield or "read"
    other: str
    result: str

    def markdown(self) -> str:
        return f"| {self.format} | {self.where} | {self.direction} | {self.other} | {self.result} |\n"


def frames_at(mesh: octafield.TetMesh, where: str) -> np.ndarray:
    return np.asarray(octafield.frames.random_rotations(len(mesh.vertices if where == "vertices" else mesh.tets), 11))


def axes(frames: np.ndarray) -> np.ndarray:
    """By scipy, not by octafield."""
    return Rotation.from_quat(frames[:, [1, 2, 3, 0]]).as_matrix()


def verdict(frames: np.ndarray, found: np.ndarray) -> str:
    """What came back of the frames: quaternions or axes."""
    assert len(found) == len(frames)
    if found.shape[1:] == (4,):
        if np.array_equal(found, frames):
            return "same bits"
        found = axes(found)
    relative = np.einsum("nij,nik->njk", axes(frames), found)
    assert np.abs(np.abs(relative).max(axis=1) - 1).max() < 1e-14, "not the same frames"
    angle = np.abs(relative - np.rint(relative)).max()
    assert angle < SAME, angle
    return "same frames, 2e-15 rad"


def available(other: str) -> bool:
    return not other.startswith(HEAVY) or importlib.util.find_spec(other.split()[0]) is not None


def rows(mesh: octafield.TetMesh, folder: Path) -> list[Row]:
    return [*written(mesh, folder), *read(mesh, folder)]


def written(mesh: octafield.TetMesh, folder: Path) -> list[Row]:
    points, tets = np.asarray(mesh.vertices), np.asarray(mesh.tets)
    centres = points[tets].mean(axis=1)
    found = []

    def row(name, where, suffix, other, reader):
        if not available(other):
            return
        frames = frames_at(mesh, where)
        path = folder / f"{name}-{where}{suffix}"
        octafield.write_frames(path, mesh, frames, where, name)
        found.append(Row(name, where, "written", other, verdict(frames, reader(path))))

    row("arff", "vertices", ".txt", "numpy.loadtxt", readers.arff)
    row("mouette", "tets", ".frame", "independent parser", readers.mouette_text)
    meshio.Mesh(points, [("tetra", tets)]).write(folder / "plain.mesh")
    row("mouette", "tets", ".frame", "mouette 1.2.8", lambda p: readers.mouette_library(p, folder / "plain.mesh"))
    row("geogram", "tets", ".txt", "independent parser", readers.geogram)
    row("geogram-centres", "tets", ".txt", "independent parser", lambda p: readers.geogram_centres(p, centres))
    row("fra", "tets", ".fra", "independent parser", readers.fra)
    row("bfra", "tets", ".bfra", "independent parser", readers.bfra)
    for where in ("tets", "vertices"):
        row("qtn", where, ".qtn", "independent parser", readers.qtn)
        key = "CProp" if where == "tets" else "VProp"
        row("ovm", where, ".ovm", "independent parser", lambda p, key=key: readers.ovm_text(p)[key, "quaternion"])
        binary = "FrameFieldQuaternions" if where == "tets" else "vertex quaternion"
        row(
            "ovmb",
            where,
            ".ovmb",
            "independent parser",
            lambda p, key=key, binary=binary: readers.ovm_binary(p)[key, binary][:, [3, 0, 1, 2]],
        )
        for library, arrays in (("meshio", readers.meshio_arrays), ("VTK", readers.vtk_arrays)):
            row("vtu", where, ".vtu", library, lambda p, arrays=arrays, where=where: arrays(p, where)["quaternion"])
        row("vtp", where, ".vtp", "VTK", lambda p, where=where: readers.vtk_arrays(p, where)["quaternion"])
        for library, views in (
            ("Gmsh", readers.gmsh_views),
            ("meshio", lambda p, where=where: readers.meshio_arrays(p, where)),
        ):
            row("msh", where, ".msh", library, lambda p, views=views: of_views(views(p)))
        row(
            "pos",
            where,
            ".pos",
            "Gmsh",
            lambda p: readers.columns(*(readers.gmsh_views(p)[f"frame_{a}"][:, 3:] for a in "uvw")),
        )
    found += [of_algohex(mesh, folder, combed) for combed in (False, True)]
    row("ff3", "tets", ".ff3", "independent parser", readers.ff3)
    row("npy", "vertices", ".npy", "numpy", np.load)
    row("npz", "tets", ".npz", "numpy", lambda p: np.load(p)["frames"])
    return found


def of_algohex(mesh: octafield.TetMesh, folder: Path, combed: bool) -> Row:
    """The properties beside the frames."""
    path = folder / f"algohex-{combed}.ovmb"
    octafield.write_frames(path, mesh, frames_at(mesh, "tets"), "tets", combed=combed)
    there = algohex.Mesh(readers.ovm_binary(path))
    algohex.check_transitions(there)
    assert min(algohex.check_valences(there).values()) > 0
    return Row(
        "ovmb, combed" if combed else "ovmb",
        "tets",
        "written",
        "independent parser, rules of AlgoHex",
        "`HalffaceTransiton`, `edge_valance`: same integers",
    )


def of_views(views: dict[str, np.ndarray]) -> np.ndarray:
    result = readers.columns(*(views[f"frame_{a}"] for a in "uvw"))
    assert np.array_equal(views["frame"].reshape(-1, 3, 3).transpose(0, 2, 1), result)
    return result


def read(mesh: octafield.TetMesh, folder: Path) -> list[Row]:
    found = []

    def row(name, where, suffix, other, writer):
        if not available(other):
            return
        frames = frames_at(mesh, where)
        path = folder / f"theirs-{name}-{where}{suffix}"
        theirs = writer(path, frames)
        ours = octafield.read_frames(path, mesh, name, where=where if name == "geogram-centres" else None)
        assert ours.where == where
        expected = frames if theirs is None else theirs
        found.append(Row(name, where, "read", other, verdict(expected, ours.frames)))

    nine = lambda frames: axes(frames).transpose(0, 2, 1).reshape(-1, 9)  # noqa: E731
    row("arff", "vertices", ".txt", "numpy.savetxt", lambda p, q: np.savetxt(p, nine(q), fmt="%.17g"))
    row(
        "ff3",
        "tets",
        ".ff3",
        "numpy.savetxt",
        lambda p, q: np.savetxt(p, nine(q), fmt="%.17g", header=f"9 {len(q)}", comments=""),
    )
    row("geogram", "tets", ".txt", "numpy.savetxt", lambda p, q: np.savetxt(p, nine(q).reshape(-1, 3), fmt="%.17g"))
    row(
        "qtn",
        "tets",
        ".qtn",
        "numpy",
        lambda p, q: p.write_text(" ".join(map(repr, q.ravel().tolist())) + " ") and None,
    )
    points, tets = np.asarray(mesh.vertices), np.asarray(mesh.tets)
    centres, parser = points[tets].mean(axis=1), "independent writer"
    row("geogram-centres", "tets", ".txt", parser, lambda p, q: writers.geogram_centres(p, centres, axes(q)))
    row("geogram-centres", "vertices", ".txt", parser, lambda p, q: writers.geogram_centres(p, points, axes(q)))
    row("fra", "tets", ".fra", parser, lambda p, q: writers.fra(p, axes(q)))
    row("bfra", "tets", ".bfra", parser, lambda p, q: writers.bfra(p, axes(q)))
    for where, key, code, name in (
        ("tets", "CProp", 3, "FrameFieldQuaternions"),
        ("vertices", "VProp", 0, "vertex quaternion"),
    ):
        row("ovm", where, ".ovm", parser, lambda p, q, key=key: writers.ovm(p, points, tets, key, q))
        row(
            "ovmb",
            where,
            ".ovmb",
            parser,
            lambda p, q, code=code, name=name: writers.ovmb(p, points, tets, code, name, q),
        )
    row("npy", "tets", ".npy", "numpy", np.save)
    row("npz", "vertices", ".npz", "numpy", lambda p, q: np.savez(p, frames=q, where="vertices"))
    row("mouette", "tets", ".frame", "mouette 1.2.8", lambda p, q: by_mouette(p, mesh, q, folder))
    for where in ("vertices", "tets"):
        row("vtu", where, ".vtu", "meshio", lambda p, q, where=where: by_meshio(p, mesh, q, where))
        row("vtu", where, ".vtu", "VTK", lambda p, q, where=where: by_vtk(p, mesh, q, where))
        row("vtk", where, ".vtk", "meshio", lambda p, q, where=where: by_meshio(p, mesh, q, where))
    row("msh", "tets", ".msh", "Gmsh", lambda p, q: by_gmsh(p, mesh, nine(q)))
    return found


def by_mouette(path: Path, mesh: octafield.TetMesh, frames: np.ndarray, folder: Path) -> np.ndarray:
    """mouette projects its harmonics before it writes: the frames it then has are those in the file."""
    import mouette
    from mouette.processing.framefield.cells import FrameField3DCells

    meshio.Mesh(np.asarray(mesh.vertices), [("tetra", np.asarray(mesh.tets))]).write(folder / "plain.mesh")
    field = FrameField3DCells(mouette.mesh.load(str(folder / "plain.mesh")), verbose=False)
    field.frames = list(Rotation.from_matrix(axes(frames)))
    field.compute_sh_from_frames()
    field.export_frames_to_file(str(path))
    return np.array([frame.as_quat()[[3, 0, 1, 2]] for frame in field.frames])


def by_meshio(path: Path, mesh: octafield.TetMesh, frames: np.ndarray, where: str) -> None:
    data = {"point_data": {"quaternion": frames}} if where == "vertices" else {"cell_data": {"quaternion": [frames]}}
    meshio.Mesh(np.asarray(mesh.vertices), [("tetra", np.asarray(mesh.tets))], **data).write(path)


def by_vtk(path: Path, mesh: octafield.TetMesh, frames: np.ndarray, where: str) -> None:
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: np.array(mesh.tets)}, np.array(mesh.vertices))
    data = grid.point_data if where == "vertices" else grid.cell_data
    for k, name in enumerate("uvw"):
        data[f"frame_{name}"] = np.ascontiguousarray(axes(frames)[:, :, k])
    grid.save(path)


def by_gmsh(path: Path, mesh: octafield.TetMesh, nine: np.ndarray) -> None:
    import gmsh

    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        gmsh.option.setNumber("Mesh.Binary", 1)
        gmsh.model.add("box")
        volume = gmsh.model.addDiscreteEntity(3)
        count = len(mesh.vertices)
        gmsh.model.mesh.addNodes(3, volume, np.arange(1, count + 1), np.asarray(mesh.vertices).ravel())
        tags = np.arange(1, len(mesh.tets) + 1)
        gmsh.model.mesh.addElementsByType(volume, 4, tags, np.asarray(mesh.tets).ravel() + 1)
        view = gmsh.view.add("frame")
        gmsh.view.addHomogeneousModelData(view, 0, "box", "ElementData", tags, nine.ravel(), numComponents=9)
        gmsh.view.write(view, str(path))
    finally:
        gmsh.finalize()


def table_of(found: list[Row]) -> str:
    head = "| format | frames at | octafield has | by | what came back |\n|---|---|---|---|---|\n"
    return head + "".join(row.markdown() for row in found)


def table_of_formats() -> str:
    text = (
        "| format | extension | what | frames at | read | written | holds, per frame | precision |\n"
        + "|---" * 8
        + "|\n"
    )
    for form in octafield.frame_formats.values():
        does = ("yes" if form.read else "no", "yes" if form.write else "no")
        cells = (
            form.name,
            " ".join(form.extensions) or "(by name)",
            form.title,
            ", ".join(form.where),
            *does,
            form.holds,
            form.precision,
        )
        text += "| " + " | ".join(cells) + " |\n"
    return text


def on_page(begin: str = BEGIN) -> str:
    text = PAGE.read_text(encoding="utf-8")
    start = text.index(begin) + len(begin)
    return text[start : text.index(END, start)]


def put_on_page(begin: str, table: str) -> None:
    text = PAGE.read_text(encoding="utf-8")
    start = text.index(begin) + len(begin)
    PAGE.write_text(text[:start] + table + text[text.index(END, start) :], encoding="utf-8")


if __name__ == "__main__":
    import mesh_table
    from conftest import box_tets

    with tempfile.TemporaryDirectory() as name:
        table = table_of(rows(box_tets(3), Path(name)))
        meshes = mesh_table.table_of(mesh_table.rows(Path(name)))
    put_on_page(FORMATS_BEGIN, table_of_formats())
    put_on_page(BEGIN, table)
    put_on_page(mesh_table.BEGIN, meshes)
    sys.stdout.write(table + meshes)
