"""HalffaceTransiton and edge_valance: what octafield writes is what AlgoHex's rules, written once more, find."""

import algohex_reader as algohex
import numpy as np
import octafield as of
import other_readers as readers
import pytest
from conftest import SHARED_DATA, box_tets
from format_table import frames_at
from octafield.domain.generators import generate
from octafield.meshes.openvolumemesh.text import read_ovm, write_ovm
from pipeline_fixtures import shared
from scipy.sparse import coo_matrix
from scipy.sparse.csgraph import connected_components


def mesh_of(path) -> algohex.Mesh:
    return algohex.Mesh(readers.ovm_binary(path))


def checked(path) -> dict[str, int]:
    mesh = mesh_of(path)
    algohex.check_transitions(mesh)
    return algohex.check_valences(mesh)


@pytest.fixture(scope="module")
def cylinder():
    return of.compute_field(generate("cylinder"), of.FieldOptions(edge_length=0.3, streamlines=0))


def test_the_24_elements_are_those_of_algohex_in_its_order():
    assert np.array_equal(of.frames.octahedral_group(), algohex.TRANSITIONS)
    assert np.array_equal(of.frames.octahedral_product_table(), algohex.PRODUCT)
    assert all(algohex.PRODUCT[a][b] == 0 for a, b in enumerate(of.frames.octahedral_inverse_table()))


@pytest.mark.parametrize("combed", [False, True])
def test_random_frames_have_edges_of_every_kind(tmp_path, combed):
    mesh = box_tets(3)
    of.write_frames(tmp_path / "a.ovmb", mesh, frames_at(mesh, "tets"), "tets", combed=combed)
    counts = checked(tmp_path / "a.ovmb")
    assert min(counts[kind] for kind in ("regular", "quarter", "half", "complex", "boundary")) > 0
    of.write_frames(tmp_path / "a.ovm", mesh, frames_at(mesh, "tets"), "tets", combed=combed)
    text, binary = readers.ovm_text(tmp_path / "a.ovm"), readers.ovm_binary(tmp_path / "a.ovmb")
    for key in (("HFProp", "HalffaceTransiton"), ("EProp", "edge_valance"), ("FProp", "AlgoHex::FeatureFaces")):
        assert np.array_equal(text[key], binary[key])


def test_valence_2_and_6_are_told_apart(tmp_path):
    mesh = box_tets(5)
    of.write_frames(tmp_path / "a.ovmb", mesh, of.frames.random_rotations(len(mesh.tets), 2), "tets")
    counts = checked(tmp_path / "a.ovmb")
    assert min(counts.get(("valence", valence), 0) for valence in (-2, -1, 1, 2)) > 0


def test_a_cylinder_has_four_curves_of_valence_3_and_a_rim_of_one_hexahedron(tmp_path, cylinder):
    tets = cylinder.tets
    of.write_frames(tmp_path / "a.ovmb", tets, cylinder.frames, at="tets")
    counts = checked(tmp_path / "a.ovmb")
    assert counts["complex"] == counts["half"] == 0
    mesh = mesh_of(tmp_path / "a.ovmb")
    valence, outer = np.array(mesh.valence), np.unique(np.sort(np.asarray(cylinder.features.edges), axis=1), axis=0)
    inside = np.array([all(h ^ 1 in mesh.cell_of for h in mesh.around()[2 * e]) for e in np.flatnonzero(valence)])
    singular, rim = mesh.edges[np.flatnonzero(valence)[inside]], mesh.edges[np.flatnonzero(valence)[~inside]]
    assert np.array_equal(rim, outer) and set(valence[np.flatnonzero(valence)[~inside]]) == {-1}
    ids = singular.T
    pieces = connected_components(
        coo_matrix((np.ones(len(singular)), ids), shape=(len(mesh.points),) * 2), directed=False
    )[1]
    assert len(np.unique(pieces[singular])) == 4
    for piece in np.unique(pieces[singular]):
        heights = mesh.points[np.unique(singular[pieces[singular[:, 0]] == piece]), 2]
        assert np.isclose(heights.min(), tets.vertices[:, 2].min()) and np.isclose(
            heights.max(), tets.vertices[:, 2].max()
        )
    along = np.abs(mesh.points[singular[:, 1], 2] - mesh.points[singular[:, 0], 2]) / np.linalg.norm(
        mesh.points[singular[:, 1]] - mesh.points[singular[:, 0]], axis=1
    )
    assert set(valence[np.flatnonzero(valence)[inside]][along > 0.5]) == {-1}


@pytest.mark.parametrize("name", ["s02c", "s03c"])
def test_hexme_meshes(tmp_path, name):
    result = of.compute_field(shared(SHARED_DATA / "hexme" / f"{name}.vtk.gz"), of.FieldOptions(streamlines=0))
    of.write_frames(tmp_path / "a.ovmb", result.tets, result.frames, at="tets", combed=True)
    assert checked(tmp_path / "a.ovmb")["quarter"] > 0


def test_edges_of_the_boundary_count_hexahedra_less_two(tmp_path):
    """Constant frames: a cube has one hexahedron at its edges, a notch three."""
    mesh = box_tets(2)
    notched = of.TetMesh(
        mesh.vertices,
        np.asarray(mesh.tets)[~(np.asarray(mesh.vertices)[mesh.tets].mean(axis=1)[:, :2] > 0.5).all(axis=1)],
    )
    used, tets = np.unique(notched.tets, return_inverse=True)
    notched = of.TetMesh(np.asarray(mesh.vertices)[used], tets.reshape(-1, 4))
    frames = np.tile([1.0, 0, 0, 0], (len(notched.tets), 1))
    of.write_frames(tmp_path / "a.ovmb", notched, frames, "tets")
    assert checked(tmp_path / "a.ovmb")["boundary"] == 6 * 2 + 2 * 8  # upright, level
    found = mesh_of(tmp_path / "a.ovmb")
    reentrant = found.edges[np.array(found.valence) == 1]
    assert len(reentrant) == 2 and (found.points[reentrant][:, :, :2] == 0.5).all()


def test_own_files_come_back_without_notes_and_byte_by_byte(tmp_path, cylinder):
    tets, features = cylinder.tets, np.asarray(cylinder.features.edges)
    for suffix in (".ovmb", ".ovm"):
        for combed in (False, True):
            first, second = tmp_path / f"first{suffix}", tmp_path / f"second{suffix}"
            of.write_frames(first, tets, cylinder.frames, at="tets", features=features, combed=combed)
            found = of.read_frames(first)
            assert found.notes == [] and found.where == "tets"
            of.write_frames(second, found.mesh, found.frames, found.where, features=found.features, combed=combed)
            assert first.read_bytes() == second.read_bytes()


def test_transitions_that_lead_elsewhere_are_told(tmp_path, cylinder):
    of.write_frames(tmp_path / "a.ovmb", cylinder.tets, cylinder.frames, at="tets")
    mesh = read_ovm(tmp_path / "a.ovmb", binary=True)
    values = np.array(mesh.properties["halfface", "HalffaceTransiton"])
    inner = np.flatnonzero(values >= 0)[:3]
    values[inner] = of.frames.octahedral_product_table()[values[inner], 4]
    mesh.properties["halfface", "HalffaceTransiton"] = values
    mesh.kinds = {key: kind for key, kind in mesh.kinds.items() if kind == "Quaternion"}
    write_ovm(tmp_path / "b.ovmb", mesh, binary=True)
    assert any("at 3 half-faces" in note for note in of.read_frames(tmp_path / "b.ovmb").notes)
