"""Models of which Gmsh's first mesh cannot be used are meshed in other ways; what TetGen cannot fill is remeshed."""

import numpy as np
import octafield as of
import pytest
from conftest import SHARED_DATA
from octafield.domain import meshing
from octafield.domain.generators import generate
from octafield.domain.inputs import read_input
from octafield.meshes.gmsh import cad
from octafield.meshes.gmsh.cad_worker import WAYS
from octafield.meshes.gmsh.working import ending
from octafield.meshes.grids import Grid
from pipeline_fixtures import octafield, shared
from test_cad import part  # noqa: F401 (a fixture)


@pytest.mark.parametrize("way", range(len(WAYS)))
def test_every_way_meshes_a_sound_model(way, part):  # noqa: F811
    grid, fault = cad._meshed(part / "part.step", ".step", 0.3, way, None)
    assert fault is None and cad._fault(grid) is None
    used, triangles = np.unique(grid.cells["triangle"], return_inverse=True)
    surface = of.TriangleMesh(grid.points[used], triangles.reshape(-1, 3))
    assert of.surface.find_defects(surface) == []
    assert of.surface.signed_volume(surface) == pytest.approx(2 - np.pi * 0.09, rel=0.05)


def test_the_way_that_helped_is_told(part, monkeypatch):  # noqa: F811
    faults = iter(["4 triangles cross or touch others", "1 triangle has no area", None])
    monkeypatch.setattr(cad, "_fault", lambda grid: next(faults))
    notes = read_input(part / "part.step", edge_length=0.3).notes
    assert (
        notes[-1]
        == f"Gmsh's first mesh could not be used (4 triangles cross or touch others); made again: {WAYS[2].name}"
    )


def test_where_no_way_helps_the_first_mesh_is_taken_with_a_note(part, monkeypatch):  # noqa: F811
    monkeypatch.setattr(cad, "_fault", lambda grid: "4 triangles cross or touch others")
    notes = read_input(part / "part.step", edge_length=0.3).notes
    assert (
        notes[-1]
        == f"Gmsh was asked in {len(WAYS)} ways; none gave triangles that can be used (4 triangles cross or touch"
        " others)"
    )


def test_crossing_triangles_and_crowded_edges_are_faults_and_open_rims_are_none():
    points = np.array([[0, 0, 0], [2, 0, 0], [0, 2, 0], [0, 0, 2], [0.5, 0.5, -1], [0.5, 0.5, 1], [0.6, 0.5, 1]], float)

    def fault(*triangles):
        return cad._fault(Grid(points, {"triangle": np.array(triangles)}))

    assert fault([0, 1, 2]) is None
    assert "cross" in fault([0, 1, 2], [4, 5, 6])
    assert "more than 2 triangles" in fault([0, 1, 2], [0, 1, 3], [1, 0, 5])


def test_a_printed_path_is_not_passed_on():
    said = ending(3, 'Traceback\n  File "/home/builder/src/worker.py", line 3\n/opt/gmsh/lib.so: undefined symbol x')
    assert "/" not in said.replace("exit code 3", "") and "undefined symbol x" in said


def test_holder_gives_a_field_or_a_clear_error(tmp_path):
    done = octafield(
        "field",
        shared(SHARED_DATA / "wild" / "holder.stp"),
        "-o",
        tmp_path / "out",
        "--rounds",
        "0",
        "--streamlines",
        "0",
    )
    assert done.returncode in (0, 2)
    for foreign in ("Assertion", "tetgen.cxx", "predicates.cxx", "/build", "Aborted"):
        assert foreign not in done.stderr
    assert done.returncode == 0 or "--edge-length" in done.stderr


def test_a_surface_that_tetgen_cannot_fill_is_remeshed_finer_with_a_note(monkeypatch):
    fill, calls = meshing._fill, []

    def fails_once(meshed, progress, options):
        calls.append(len(meshed.surface.vertices))
        if len(calls) == 1:
            raise of.GeometryError(
                "TetGen could not fill the surface, in 6 ways (it stopped at a check of its own); remesh it",
                "tetgen_failed",
            )
        fill(meshed, progress, options)

    monkeypatch.setattr(meshing, "_fill", fails_once)
    meshed = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.3))
    assert calls[1] > calls[0] and any(note.startswith("TetGen could not fill") for note in meshed.notes)
    calls.clear()
    with pytest.raises(of.GeometryError, match="leave out --no-remesh"):
        of.prepare_mesh(generate("box"), of.MeshOptions(remesh=False))


def test_needles_thin_walls_and_touching_cavities_are_filled_or_refused_in_words():
    points = np.asarray(generate("box").vertices)
    for scale in ((1, 1, 1e-4), (1, 1e-5, 1e-3), (1e3, 1, 1)):
        thin = of.TriangleMesh(points * scale, generate("box").triangles)
        try:
            tets = of.volume.tetrahedralize(thin, edge_length=float(of.surface.bounding_box_diagonal(thin.vertices)))
            assert of.volume.tet_volumes(tets).sum() == pytest.approx(np.prod(scale))
        except of.GeometryError as error:
            assert error.kind == "tetgen_failed" and "/" not in str(error)
