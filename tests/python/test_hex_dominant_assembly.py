"""octafield hex-dominant on assemblies: CAD models of several solids that touch, drawn here by Gmsh."""

import json

import numpy as np
import octafield as of
import pytest
import pyvista
from hex_mesh_checks import cells_of, faces_of, require_conforming
from pipeline_fixtures import octafield

gmsh = pytest.importorskip("gmsh")


def write_assembly(path):
    """Two cubes of edge 1 that touch at x = 1, a rod of radius 0.25 through both."""
    gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        occ = gmsh.model.occ
        solids = [occ.addBox(0, 0, 0, 1, 1, 1), occ.addBox(1, 0, 0, 1, 1, 1)]
        rod = occ.addCylinder(0, 0.5, 0.5, 2, 0, 0, 0.25)
        occ.fragment([(3, solids[0])], [(3, solids[1]), (3, rod)])
        occ.synchronize()
        gmsh.write(str(path))
    finally:
        gmsh.finalize()


@pytest.fixture(scope="module")
def made(tmp_path_factory):
    folder = tmp_path_factory.mktemp("assembly")
    write_assembly(folder / "assembly.step")
    octafield("hex-dominant", folder / "assembly.step", "-o", folder / "out", "--edge-length", "0.2", "-q", check=0)
    return folder / "out"


def test_every_solid_is_a_region_with_its_volume(made):
    grid = pyvista.read(made / "mesh.vtu")
    mesh = of.read_cells(made / "mesh.vtu")
    require_conforming(mesh)
    record = json.loads((made / "result.json").read_text())
    assert record["regions"] == 4 and record["region_volume_error"] < 0.3  # circles of six or seven edges
    volumes = grid.compute_cell_sizes(length=False, area=False)["Volume"]
    sums = sorted(volumes[grid.cell_data["region"] == region].sum() for region in np.unique(grid.cell_data["region"]))
    rod = np.pi * 0.25**2
    assert sums == pytest.approx([rod, rod, 1 - rod, 1 - rod], rel=0.3) and sum(sums) == pytest.approx(2, rel=1e-3)


def test_cells_meet_face_to_face_in_the_interfaces_and_none_reaches_through(made):
    grid, mesh = pyvista.read(made / "mesh.vtu"), of.read_cells(made / "mesh.vtu")
    regions, points = np.asarray(grid.cell_data["region"]), np.asarray(mesh.vertices)
    order = {10: 0, 12: 1, 13: 2, 14: 3}  # the kinds in the order of cells_of
    assert (np.diff([order[kind] for kind in grid.celltypes]) >= 0).all()
    between = [(corners, faces) for corners, faces in faces_of(mesh).items()
               if len(faces) == 2 and regions[faces[0][0]] != regions[faces[1][0]]]  # fmt: skip
    corners = np.unique([v for ids, _ in between for v in ids])
    off_plane = np.abs(points[corners, 0] - 1)
    off_rod = np.abs(np.hypot(points[corners, 1] - 0.5, points[corners, 2] - 0.5) - 0.25)
    assert np.minimum(off_plane, off_rod).max() < 0.03
    plane = [ids for ids, _ in between if (np.abs(points[list(ids), 0] - 1) < 1e-9).all()]
    assert any(len(ids) == 4 for ids in plane)
    area = sum(area_of(points[[*faces[0][1]]]) for ids, faces in between if ids in set(plane))
    assert area == pytest.approx(1, abs=1e-9)
    for number, (_, cell) in enumerate(cells_of(mesh)):
        x = points[list(cell), 0]
        assert x.max() <= 1 + 1e-9 or x.min() >= 1 - 1e-9, f"cell {number} of region {regions[number]}"


def area_of(corners):
    fan = [np.cross(b - corners[0], c - corners[0]) for b, c in zip(corners[1:], corners[2:], strict=False)]
    return np.linalg.norm(np.sum(fan, axis=0)) / 2
