"""From a surface or a tet mesh to its field through the public API: the field turns, grows and moves with the part."""

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from scipy.spatial.transform import Rotation

TURNS = [Rotation.from_rotvec(v) for v in ([0.3, 0.5, -0.2], [0, 0, np.pi / 4], [1.1, -0.7, 2.0])]
IDS = ["small", "diagonal", "large"]


def part() -> of.TriangleMesh:
    """A cylinder: curved faces, feature curves without corners, and no symmetry between its axes."""
    return generate("cylinder", radius=1.0, height=3.0)


def moved(mesh, turn=None, scale=1.0, shift=(0, 0, 0)):
    """The same mesh elsewhere."""
    points = np.array(mesh.vertices)  # a domain's own cannot be written, which SciPy asks for
    points = (points if turn is None else turn.apply(points)) * scale + np.asarray(shift)
    if isinstance(mesh, of.TriangleMesh):
        return of.TriangleMesh(points, mesh.triangles)
    return of.TetMesh(points, mesh.tets)


def turned(frames, turn: Rotation) -> np.ndarray:
    """Quaternions w x y z of the frames, turned from the left."""
    q = np.asarray(frames)[:, [1, 2, 3, 0]]
    return (turn * Rotation.from_quat(q)).as_quat()[:, [3, 0, 1, 2]]


def field(mesh, **options):
    return of.compute_field(mesh, of.FieldOptions(streamlines=0, **options))


@pytest.fixture(scope="module")
def from_surface():
    return field(part())


@pytest.fixture(scope="module")
def tets():
    """Of the cylinder: the mesh that every motion moves."""
    return of.prepare_mesh(part(), of.MeshOptions(edge_length=0.45)).tets


@pytest.mark.parametrize("turn", TURNS, ids=IDS)
@pytest.mark.parametrize("boundary", ["aligned", "fixed"])
def test_the_field_in_a_turned_mesh_is_the_turned_field(tets, boundary, turn):
    """On the same tets: the energy to rounding, and every frame."""
    here, there = field(tets, boundary=boundary), field(moved(tets, turn), boundary=boundary)
    assert there.record["energy"] == pytest.approx(here.record["energy"], rel=1e-6)
    assert there.record["singular_edges"] == here.record["singular_edges"]
    np.testing.assert_allclose(of.frames.distance(turned(here.frames, turn), there.frames), 0, atol=1e-3)


@pytest.mark.parametrize("scale", [2.0**-20, 1e-3, 1e4])
def test_the_field_of_a_scaled_mesh_is_the_same_and_its_energy_grows_like_a_length(tets, scale):
    here, there = field(tets), field(moved(tets, scale=scale))
    assert there.record["energy"] == pytest.approx(scale * here.record["energy"], rel=1e-6)
    np.testing.assert_allclose(of.frames.distance(here.frames, there.frames), 0, atol=1e-3)


def test_the_field_of_a_mesh_elsewhere_is_the_same(tets):
    here, there = field(tets), field(moved(tets, shift=(300, -200, 100)))
    assert there.record["energy"] == pytest.approx(here.record["energy"], rel=1e-6)
    np.testing.assert_allclose(of.frames.distance(here.frames, there.frames), 0, atol=1e-3)


def same_part(here, there, scale: float) -> None:
    """Remeshing a moved part takes other roundings, so other triangles: the length asked for, and with it the field,
    agree all the same."""
    a, b = here.record, there.record
    assert b["edge_length"] == pytest.approx(scale * a["edge_length"], rel=0.02)
    assert b["tets"] == pytest.approx(a["tets"], rel=0.1)
    assert b["energy"] == pytest.approx(scale * a["energy"], rel=0.05)
    for key in ("euler_characteristic", "index_sum"):
        assert b["surface_field"][key] == a["surface_field"][key]
    assert of.surface.signed_volume(there.surface) == pytest.approx(
        scale**3 * of.surface.signed_volume(here.surface), rel=1e-3
    )


@pytest.mark.parametrize("turn", TURNS, ids=IDS)
def test_a_turned_surface_gives_as_fine_a_mesh_and_as_good_a_field(from_surface, turn):
    same_part(from_surface, field(moved(part(), turn)), 1.0)


@pytest.mark.parametrize("scale", [1e-4, 1e5])
def test_a_scaled_surface_gives_the_same_field(from_surface, scale):
    same_part(from_surface, field(moved(part(), scale=scale)), scale)


def test_a_surface_elsewhere_gives_the_same_field(from_surface):
    same_part(from_surface, field(moved(part(), shift=(50, -30, 20))), 1.0)


def test_units_of_a_power_of_two_change_no_bit(from_surface):
    """Nothing in the whole way is measured in units: every rounding is the same."""
    there = field(moved(part(), scale=2.0**12))
    np.testing.assert_array_equal(np.asarray(there.tets.tets), np.asarray(from_surface.tets.tets))
    np.testing.assert_array_equal(np.asarray(there.tets.vertices), 2.0**12 * np.asarray(from_surface.tets.vertices))
