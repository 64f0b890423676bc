"""Meshes of tets, hexahedra, wedges and pyramids, and surfaces of quads: validity, quality, files."""

import gzip

import meshio
import numpy as np
import octafield as of
import pytest
import pyvista
from octafield._core import MixedMesh, QuadMesh

KINDS = {"tets": "TETRA", "hexahedra": "HEXAHEDRON", "wedges": "WEDGE", "pyramids": "PYRAMID"}
MESHIO = {"tets": "tetra", "hexahedra": "hexahedron", "wedges": "wedge", "pyramids": "pyramid"}
BASE = np.array([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], float)
SHAPES = {
    "tets": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float),
    "hexahedra": np.concatenate([BASE, BASE + [0, 0, 1]]),
    "wedges": np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1]], float),
    "pyramids": np.concatenate([BASE, [[0.5, 0.5, 0.8]]]),
}


@pytest.fixture
def mixed():
    """A cube, a pyramid on it, a wedge beside it and a tet between the two, as in tests/volume/mixed_mesh_test.cpp."""
    points = [
        *SHAPES["hexahedra"], [0.5, 0.5, 1.7], [2, 0, 0.5], [2, 1, 0.5], [1.5, 0.5, 1.5],
    ]  # fmt: skip
    return MixedMesh(
        points,
        tets=[[5, 6, 8, 11]],
        hexahedra=[[0, 1, 2, 3, 4, 5, 6, 7]],
        wedges=[[1, 5, 9, 2, 6, 10]],
        pyramids=[[4, 5, 6, 7, 8]],
    )


def arrays(mesh):
    names = KINDS if isinstance(mesh, MixedMesh) else ("triangles", "quads")
    return [np.asarray(getattr(mesh, name)).tolist() for name in ("vertices", *names)]


def vtk_quality(kind: str, points: np.ndarray, cells: np.ndarray) -> np.ndarray:
    grid = pyvista.UnstructuredGrid({pyvista.CellType[kind]: cells}, points)
    return np.asarray(grid.cell_quality("scaled_jacobian").cell_data["scaled_jacobian"])


@pytest.mark.parametrize("name", KINDS)
def test_scaled_jacobians_are_those_of_verdict_in_vtk(name):
    rng = np.random.default_rng(5)
    shape = SHAPES[name]
    copies = 200
    jitter = rng.uniform(-1, 1, (copies, *shape.shape)) * rng.uniform(0, 0.6, (copies, 1, 1))  # some are inverted
    points = (shape + jitter).reshape(-1, 3)
    cells = np.arange(len(points)).reshape(copies, -1)
    ours = of.volume.scaled_jacobians(MixedMesh(points, **{name: cells}))
    np.testing.assert_allclose(ours, vtk_quality(KINDS[name], points, cells), atol=1e-12)
    assert ours.min() <= 0 < 0.5 < ours.max()


def test_scaled_jacobians_of_faces_are_those_of_verdict_in_vtk():
    rng = np.random.default_rng(6)
    points = (BASE + rng.uniform(-0.3, 0.3, (200, 4, 3))).reshape(-1, 3)
    quads = np.arange(800).reshape(-1, 4)
    triangles = quads[:, :3]
    ours = of.surface.scaled_jacobians(QuadMesh(points, triangles, quads))
    np.testing.assert_allclose(ours[:200], vtk_quality("TRIANGLE", points, triangles), atol=1e-12)
    np.testing.assert_allclose(ours[200:], vtk_quality("QUAD", points, quads), atol=1e-12)


def test_volumes_are_those_of_vtk_where_faces_are_plane(mixed):
    volumes = of.volume.cell_volumes(mixed)
    np.testing.assert_allclose(volumes[1:], [1, 0.5, 0.7 / 3])
    found = of.volume.cell_boundary(mixed)
    of.require_valid(found.mesh)
    assert volumes.sum() == pytest.approx(of.surface.signed_volume(of.surface.split_quads(found.mesh)))


def test_a_mesh_that_conforms_is_valid_and_defects_name_cells(mixed):
    of.require_valid(mixed)
    assert of.volume.find_cell_defects(mixed) == []
    broken = MixedMesh(
        mixed.vertices, tets=[[4, 5, 6, 8], [4, 6, 7, 8]], hexahedra=mixed.hexahedra, wedges=mixed.wedges
    )
    (defect,) = of.volume.find_cell_defects(broken)
    assert defect.kind == "mismatched_face" and defect.cells.tolist() == [0, 1, 2] and "pyramid" in defect.message
    with pytest.raises(of.GeometryError) as caught:
        of.require_valid(broken)
    assert caught.value.kind == "mismatched_face" and caught.value.elements == [0, 1, 2]
    with pytest.raises(of.GeometryError, match="do not exist") as caught:
        of.volume.scaled_jacobians(MixedMesh(mixed.vertices, pyramids=[[0, 1, 2, 3, 12]]))
    assert caught.value.elements == [0]


@pytest.mark.parametrize("suffix", [".vtu", ".msh", ".mesh", ".meshb", ".vtu.gz", ".mesh.gz"])
def test_files_give_back_the_same_mesh(tmp_path, mixed, suffix):
    mixed.vertices[:] += 1 / 3  # no short decimal numbers
    path = tmp_path / f"mixed{suffix}"
    of.write_cells(path, mixed)
    assert arrays(of.read_cells(path)) == arrays(mixed)
    faces = of.volume.cell_boundary(mixed).mesh
    of.write_cells(path, faces)
    assert arrays(of.read_cells(path)) == arrays(faces)


@pytest.mark.parametrize("suffix", [".vtu", ".msh", ".mesh"])
def test_other_programs_read_the_files(tmp_path, mixed, suffix):
    path = tmp_path / f"mixed{suffix}"
    of.write_cells(path, mixed)
    found = meshio.read(path)
    np.testing.assert_array_equal(found.points, mixed.vertices)
    for name, kind in MESHIO.items():
        cells = np.asarray(getattr(mixed, name))
        if suffix == ".vtu" and kind == "wedge":  # meshio takes the other way of VTK's documentation
            cells = cells[:, [0, 2, 1, 3, 5, 4]]
        np.testing.assert_array_equal(found.cells_dict[kind], cells)
    if suffix == ".vtu":
        grid = pyvista.read(path)
        ours = of.volume.scaled_jacobians(mixed)
        np.testing.assert_array_equal(grid.cell_data["scaled_jacobian"], ours)
        np.testing.assert_allclose(grid.cell_quality("scaled_jacobian").cell_data["scaled_jacobian"], ours)
        np.testing.assert_allclose(grid.compute_cell_sizes()["Volume"], of.volume.cell_volumes(mixed))


@pytest.mark.parametrize("suffix", [".vtk", ".vtu", ".mesh"])
def test_files_of_other_programs_are_read(tmp_path, mixed, suffix):
    blocks = [(kind, np.asarray(getattr(mixed, name))) for name, kind in reversed(MESHIO.items())]
    blocks.append(("triangle", np.array([[4, 5, 8]])))  # of the boundary
    path = tmp_path / f"mixed{suffix}"
    meshio.Mesh(np.array(mixed.vertices), blocks).write(path)
    assert arrays(of.read_cells(path)) == arrays(mixed)


def test_voxels_are_hexahedra(tmp_path):
    path = tmp_path / "voxels.vtu"
    pyvista.ImageData(dimensions=(3, 3, 2)).cast_to_unstructured_grid().save(path)
    found = of.read_cells(path)
    of.require_valid(found)
    assert len(found.hexahedra) == 4
    np.testing.assert_allclose(of.volume.scaled_jacobians(found), 1)


def test_cells_that_are_not_linear_and_unknown_files_are_refused(tmp_path, mixed):
    path = tmp_path / "quadratic.vtu"
    meshio.Mesh(np.random.default_rng(1).random((20, 3)), [("hexahedron20", [list(range(20))])]).write(path)
    with pytest.raises(of.InvalidInput, match="hexahedron20") as caught:
        of.read_cells(path)
    assert caught.value.kind == "unsupported_cells"
    for call in (lambda: of.write_cells(tmp_path / "a.stl", mixed), lambda: of.read_cells(tmp_path / "a.step")):
        with pytest.raises(of.IoError, match="unknown kind"):
            call()
    lost = MixedMesh(mixed.vertices, hexahedra=[[0, 1, 2, 3, 4, 5, 6, 99]])
    for suffix in (".vtu", ".msh", ".mesh"):
        with pytest.raises(of.GeometryError, match="do not exist"):
            of.write_cells(tmp_path / f"lost{suffix}", lost)
    lost = MixedMesh(np.where(np.arange(len(mixed.vertices))[:, None] == 1, np.nan, mixed.vertices), mixed.tets)
    for suffix in (".vtu", ".msh", ".mesh", ".meshb"):
        with pytest.raises(of.GeometryError, match=r"vertex 1 \(from 0\)"):
            of.write_cells(tmp_path / f"lost{suffix}", lost)
        with pytest.raises(of.InvalidInput, match="no cells"):
            of.write_cells(tmp_path / f"lost{suffix}", MixedMesh(mixed.vertices))
    assert not list(tmp_path.glob("lost*"))
    short = tmp_path / "short.mesh.gz"
    short.write_bytes(gzip.compress(b"MeshVersionFormatted 2\nDimension 3\nVertices 4\n0 0 0 1\n"))
    with pytest.raises(of.IoError, match=r"short\.mesh"):
        of.read_cells(short)
