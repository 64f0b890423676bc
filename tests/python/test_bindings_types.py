"""Classes of the module: construction, views without a copy, repr, copies and pickles."""

import copy
import gc
import pickle

import numpy as np
import octafield as of
import pytest

POINTS = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]]
CLASSES = [
    of.TriangleMesh,
    of.surface.EdgeTopology,
    of.FeatureGraph,
    of.surface.Defect,
    of.surface.RepairResult,
    of.surface.RemeshResult,
    of.surface.DirectionField,
    of.surface.DirectionConstraints,
    of.surface.DirectionGuide,
    of.surface.SurfaceSingularity,
    of.surface.SurfaceSingularities,
    of.surface.Streamline,
    of.surface.PrincipalDirections,
    of.TetMesh,
    of.volume.BoundarySurface,
    of.volume.BoundaryConstraints,
    of.volume.SectorNormals,
    of.volume.SmoothResult,
    of.volume.SingularTriangle,
    of.SingularGraph,
    of.volume.SingularEdge,
    of.volume.SingularEdges,
    of.surface.SurfaceDomain,
    of.surface.QuadMesh,
    of.volume.MixedMesh,
    of.volume.CellDefect,
    of.volume.CellBoundary,
    of.volume.FieldAnalysis,
    of.volume.TetFieldAnalysis,
    of.volume.ComputedField,
    of.volume.ComputedTetField,
]


def fields(cls):
    return [name for name in vars(cls) if isinstance(getattr(cls, name), property)]


def test_array_properties_are_views_of_the_same_memory():
    mesh = of.TriangleMesh(POINTS, [[0, 2, 1]])
    assert mesh.vertices.dtype == np.float64 and mesh.triangles.dtype == np.int32 and mesh.triangles.flags.c_contiguous
    mesh.vertices[3, 2] = 5
    assert mesh.vertices[3, 2] == 5 and np.shares_memory(mesh.vertices, mesh.vertices)
    assert of.surface.bounding_box_diagonal(mesh.vertices) == pytest.approx(27**0.5)


def test_views_outlive_their_owner():
    vertices = of.TriangleMesh(POINTS, [[0, 2, 1]]).vertices
    mesh = of.volume.BoundarySurface(of.TriangleMesh(POINTS, []), [0, 1, 2, 3]).mesh
    inner = mesh.vertices
    del mesh
    gc.collect()
    np.testing.assert_array_equal(vertices, POINTS)
    np.testing.assert_array_equal(inner, POINTS)


def test_a_view_keeps_the_old_values_when_its_array_is_replaced():
    mesh = of.TriangleMesh(np.ones((100000, 3)), [])
    for size in (50000, 100000, 150000):
        old = mesh.vertices
        before = old.copy()
        mesh.vertices = np.full((size, 3), float(size))
        np.testing.assert_array_equal(old, before)
        assert not np.shares_memory(old, mesh.vertices) and mesh.vertices[-1, 0] == size
    del old, mesh
    gc.collect()


def test_an_array_can_be_assigned_to_itself():
    mesh = of.TriangleMesh(POINTS, [])
    mesh.vertices = mesh.vertices
    mesh.vertices = mesh.vertices[::2]
    np.testing.assert_array_equal(mesh.vertices, POINTS[::2])


def test_the_nested_mesh_is_the_same_memory():
    boundary = of.volume.BoundarySurface(of.TriangleMesh(POINTS, [[0, 2, 1]]), [0, 1, 2, 3])
    boundary.mesh.vertices[0] = 7
    boundary.mesh.triangles = [[0, 1, 3], [1, 2, 3]]
    assert (boundary.mesh.vertices[0] == 7).all() and len(boundary.mesh.triangles) == 2
    with pytest.raises(AttributeError):
        boundary.mesh = of.TriangleMesh()


@pytest.mark.parametrize(
    "array",
    [
        np.array(POINTS, dtype=np.float32),
        np.asfortranarray(POINTS),
        np.array(POINTS * 2)[::2],
        tuple(map(tuple, POINTS)),
    ],
)
def test_any_layout_and_type_of_numbers_is_taken(array):
    np.testing.assert_array_equal(of.TriangleMesh(array, []).vertices, np.array(array, dtype=float))


def test_fields_by_position_and_by_name():
    a = of.FeatureGraph([[0, 1]], [0, 1])
    b = of.FeatureGraph(corners=np.array([0, 1], dtype=np.uint64), edges=[[0, 1]])
    assert (a.edges == b.edges).all() and (a.corners == b.corners).all() and a.corners.dtype == np.int32
    with pytest.raises(TypeError, match="no field"):
        of.FeatureGraph(colour=1)
    with pytest.raises(TypeError, match="two values"):
        of.FeatureGraph([[0, 1]], edges=[[0, 1]])
    with pytest.raises(TypeError, match="at most 2"):
        of.FeatureGraph([], [], [])
    with pytest.raises(TypeError, match="energy"):
        of.volume.SmoothResult(energy="much")


@pytest.mark.parametrize("cls", CLASSES)
def test_every_class_is_built_empty_shown_copied_and_pickled(cls):
    value = cls()
    assert repr(value).startswith(cls.__name__ + "(") and cls.__doc__
    for other in (copy.copy(value), copy.deepcopy(value), pickle.loads(pickle.dumps(value))):
        assert type(other) is cls and repr(other) == repr(value)
    assert fields(cls)


def test_pickles_hold_every_field():
    triangle = of.volume.SingularTriangle(1, 2, 3, holonomy=4, quarter_turns=-1, boundary=True, point=[1, 2, 3])
    graph = of.SingularGraph([triangle], [[0, 0, 1], [0, 0, 2]], [[0, 1], [1, 0, 1]], [1, -1], [1], 2.5, 3)
    again = pickle.loads(pickle.dumps(graph))
    assert (
        again.length == 2.5 and again.complex_triangles == 3 and [list(c) for c in again.curves] == [[0, 1], [1, 0, 1]]
    )
    assert list(again.curve_quarter_turns) == [1, -1] and list(again.nodes) == [1]
    assert (
        again.triangles[0].boundary is True
        and list(again.triangles[0].point) == [1, 2, 3]
        and again.triangles[0].holonomy == 4
    )
    np.testing.assert_array_equal(again.points, graph.points)


def test_enumerations_are_words():
    line = of.surface.Streamline([[0, 0, 0], [1, 0, 0]], [5], 1.0, "singularity", "boundary", 3)
    assert repr(line) == "Streamline(2 points, length 1, singularity to boundary)" and line.last_singularity == -1
    again = pickle.loads(pickle.dumps(line))
    assert (again.first_end, again.last_end, again.first_singularity) == ("singularity", "boundary", 3)
    line.last_end = "closed"
    assert line.last_end == "closed"
    with pytest.raises(of.InvalidInput, match="last_end: unknown word 'far'") as caught:
        line.last_end = "far"
    assert caught.value.kind == "unknown_word" and line.last_end == "closed"
    with pytest.raises(TypeError, match="last_end"):
        line.last_end = 3


def test_singular_points_are_kept_with_their_sums():
    point = of.surface.SurfaceSingularity([1, 2, 3], 1, 0.25, 7, -1, False)
    found = pickle.loads(pickle.dumps(of.surface.SurfaceSingularities([point, point], 0.5, 2, False, 0.1)))
    assert [list(p.position) for p in found.points] == [[1, 2, 3]] * 2 and found.points[1].triangle == 7
    assert (found.index_sum, found.euler_characteristic, found.agree, found.boundary_deviation) == (0.5, 2, False, 0.1)
    assert repr(found) == "SurfaceSingularities(2 points, index sum 0.5, Euler characteristic 2)"


def test_reprs_count():
    assert (
        repr(of.TriangleMesh(POINTS, [[0, 2, 1]]))
        == "TriangleMesh(4 vertices, 1 triangle, box [0, 1] x [0, 1] x [0, 1])"
    )
    assert repr(of.TetMesh(POINTS, [[0, 1, 2, 3]])) == "TetMesh(4 vertices, 1 tet, box [0, 1] x [0, 1] x [0, 1])"
    assert repr(of.FeatureGraph([[0, 1]], [0, 1])) == "FeatureGraph(1 edge, 2 corners)"
    assert repr(of.volume.BoundaryConstraints(kind=[0, 1, 1, 2])) == "BoundaryConstraints(1 free, 2 axis, 1 fixed)"


@pytest.mark.parametrize(
    "build",
    [
        lambda: of.TriangleMesh(np.ones((3, 2)), []),
        lambda: of.TriangleMesh(np.ones(3), []),
        lambda: of.TriangleMesh("mesh", []),
        lambda: of.TriangleMesh(POINTS, [[0.5, 1, 2]]),
        lambda: of.TriangleMesh(POINTS, [[0, 1, 2, 3]]),
        lambda: of.TriangleMesh(POINTS, [[0, 1, 2**31]]),
        lambda: of.TriangleMesh(POINTS, [[0, 1, 10**30]]),
        lambda: of.TriangleMesh(POINTS, [[0, 1], [2]]),
        lambda: of.TriangleMesh(np.array(POINTS) * 1j, []),
        lambda: of.TetMesh(POINTS, [[0, 1, 2]]),
        lambda: of.FeatureGraph([0, 1], []),
        lambda: of.FeatureGraph([], [[0]]),
        lambda: of.volume.BoundaryConstraints(kind=[300]),
        lambda: of.surface.SurfaceSingularity([1, 2]),
        lambda: of.surface.DirectionConstraints(edges=[[0, 1, 2]]),
        lambda: of.surface.PrincipalDirections(curvatures=[[0, 0, 1]]),
        lambda: of.surface.DirectionGuide(np.eye(2)),
        lambda: of.surface.Streamline(triangles=[[0]]),
        lambda: of.surface.DirectionField(values=["a"]),
        lambda: of.SingularGraph(curves=[[0.5]]),
    ],
)
def test_wrong_arrays_are_refused_with_the_field_named(build):
    with pytest.raises(
        of.InvalidInput,
        match=r"^(vertices|triangles|tets|edges|corners|kind|position|values|curves|curvatures|directions): ",
    ):
        build()


def test_setting_a_wrong_array_leaves_the_old_one():
    mesh = of.TriangleMesh(POINTS, [[0, 2, 1]])
    with pytest.raises(of.InvalidInput):
        mesh.triangles = [[0, 1]]
    np.testing.assert_array_equal(mesh.triangles, [[0, 2, 1]])
