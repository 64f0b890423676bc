"""Meshes and results go to other libraries and come back the same; results show themselves."""

import pickle

import numpy as np
import octafield
import pytest


@pytest.fixture(scope="module")
def result(box):
    return octafield.compute_field(box, octafield.FieldOptions(features="angle"))


def same(a, b) -> bool:
    cells = "tets" if isinstance(a, octafield.TetMesh) else "triangles"
    return (
        type(a) is type(b)
        and np.array_equal(a.vertices, b.vertices)
        and np.array_equal(getattr(a, cells), getattr(b, cells))
    )


def test_meshes_come_back_from_pyvista_and_meshio_with_every_bit(box, box_surface, tmp_path):
    for mesh in (box, box_surface):
        assert same(octafield.from_pyvista(octafield.to_pyvista(mesh)), mesh)
        assert same(octafield.from_meshio(octafield.to_meshio(mesh)), mesh)
    octafield.to_meshio(box).write(tmp_path / "box.vtu")
    import meshio

    assert same(octafield.from_meshio(meshio.read(tmp_path / "box.vtu")), box)


def test_a_field_in_pyvista_holds_the_axes_of_its_quaternions(result):
    grid = octafield.to_pyvista(result)
    q, u = grid.point_data["quaternion"], grid.point_data["frame_u"]
    w, x, y, z = q.T
    first_column = np.column_stack([1 - 2 * (y * y + z * z), 2 * (x * y + w * z), 2 * (x * z - w * y)])
    assert np.allclose(u, first_column, atol=1e-14)
    assert np.array_equal(octafield.to_meshio(result).point_data["quaternion"], result.frames)


def test_singular_curves_in_pyvista_are_those_of_the_graph():
    ball = octafield.from_pyvista(__import__("pyvista").Icosphere(nsub=3))
    graph = octafield.compute_field(ball, octafield.FieldOptions(edge_length=0.3, features="none")).singular_graph
    lines = octafield.to_pyvista(graph)
    assert lines.n_cells == len(graph.curves) > 0
    assert lines.length > 0 and list(lines.cell_data["quarter_turns"]) == list(graph.curve_quarter_turns)


def test_what_cannot_be_a_mesh_is_refused(box):
    import meshio
    import pyvista

    with pytest.raises(octafield.InvalidInput, match="cells of kind voxel"):
        octafield.from_pyvista(pyvista.ImageData(dimensions=(3, 3, 3)))
    with pytest.raises(octafield.InvalidInput, match="no triangles"):
        octafield.from_pyvista(pyvista.PolyData())
    with pytest.raises(octafield.InvalidInput, match="no cells of kind"):
        octafield.from_meshio(meshio.Mesh(np.zeros((2, 3)), [("line", [[0, 1]])]))
    with pytest.raises(octafield.InvalidInput, match="not int"):
        octafield.to_pyvista(3)
    quads = octafield.from_pyvista(pyvista.Box())
    octafield.require_valid(octafield.from_pyvista(pyvista.Box().triangulate().clean()))
    assert len(quads.triangles) == 12


def test_results_have_a_short_repr_a_picture_for_notebooks_and_pickle(result):
    assert repr(result).startswith("FieldResult(mesh in memory: 216 vertices, 750 tets; sh4, aligned; E ")
    shown = result._repr_html_()
    assert "data:image/png;base64," in shown and "singular_edges" in shown
    again = pickle.loads(pickle.dumps(result))
    assert np.array_equal(again.frames, result.frames) and again.record == result.record


def test_records_become_a_data_frame(result):
    import pandas

    frame = octafield.to_pandas([result.record, result.record])
    assert isinstance(frame, pandas.DataFrame) and list(frame["energy"]) == [result.record["energy"]] * 2
    assert "cpu_seconds_smooth" in frame.columns
