"""Combed frames in files: axes that correspond by number, the cut, and in .npz all that a parameterization asks for."""

import json

import numpy as np
import octafield as of
import other_readers as readers
import pytest
from conftest import box_tets
from format_table import axes, frames_at
from octafield.domain.generators import generate
from octahedral_fixtures import GROUP, matrices
from pipeline_fixtures import octafield


@pytest.fixture(scope="module")
def cylinder():
    return of.compute_field(generate("cylinder"), of.FieldOptions(edge_length=0.35, streamlines=0))


@pytest.fixture(scope="module")
def expected(cylinder):
    return of.parameterization_input(cylinder.tets, cylinder.frames)


def corresponding(parts, frames=None):
    """Every matching takes axes to the closest, and none is left off the cut."""
    q = matrices(parts["frames"] if frames is None else frames)
    one, other = parts["triangle_tets"].T
    turned = q[one] @ GROUP[parts["matching"]]
    traces = np.einsum("fij,fik,ojk->fo", q[one], q[other], GROUP)
    assert np.allclose(np.einsum("fij,fij->f", turned, q[other]), traces.max(axis=1))
    assert not parts["matching"][parts["cut"] == 0].any() and parts["matching"].any()


def test_npz_holds_all_of_it_for_numpy_alone(tmp_path, cylinder, expected):
    features = np.asarray(cylinder.features.edges)
    notes = of.write_frames(tmp_path / "a.npz", cylinder.tets, cylinder.frames, features=features, combed=True)
    assert any("combed" in note for note in notes)
    with np.load(tmp_path / "a.npz", allow_pickle=False) as found:
        parts = dict(found)
    assert set(parts) == {
        "frames", "where", "vertices", "tets", "features", "element", "triangles", "triangle_tets", "matching", "cut",
        "singular_edges", "singular_holonomy", "singular_quarter_turns", "surface_triangles",
        *(f"alignment_{name}" for name in ("triangle_tet", "triangle_axis", "triangle_angle", "triangle_patch",
            "patch_one_axis",
                                           "feature_edges", "feature_tet", "feature_axis", "feature_angle")),
    }  # fmt: skip
    corresponding(parts)
    tets = parts["tets"]
    assert (np.sort(parts["triangles"], axis=1) == parts["triangles"]).all()
    for side in (0, 1):
        assert (parts["triangles"][:, :, None] == tets[parts["triangle_tets"][:, side]][:, None, :]).any(axis=2).all()
    assert np.array_equal(parts["alignment_feature_edges"], features)
    behind = tets[parts["alignment_triangle_tet"]]
    assert (parts["surface_triangles"][:, :, None] == behind[:, None, :]).any(axis=2).all()
    points, q = parts["vertices"], matrices(parts["frames"])
    a, b, c = np.swapaxes(points[parts["surface_triangles"]], 0, 1)
    normals = np.cross(b - a, c - a) / np.linalg.norm(np.cross(b - a, c - a), axis=1, keepdims=True)
    held = (
        np.sign(parts["alignment_triangle_axis"])[:, None]
        * q[parts["alignment_triangle_tet"], :, np.abs(parts["alignment_triangle_axis"]) - 1]
    )
    assert np.allclose(
        np.arccos(np.clip((normals * held).sum(axis=1), -1, 1)), parts["alignment_triangle_angle"], atol=1e-6
    )
    assert (parts["singular_quarter_turns"] == 1).all() and len(parts["singular_edges"]) > 8
    assert ((parts["singular_holonomy"] >= 4) & (parts["singular_holonomy"] <= 9)).all()
    original = matrices(of.volume.tet_frames(cylinder.tets, cylinder.frames))
    assert np.allclose(q, original @ GROUP[parts["element"]])
    back = of.read_frames(tmp_path / "a.npz")
    assert back.notes == [] and np.array_equal(back.frames, parts["frames"])
    again = of.parameterization_input(cylinder.tets, back.frames, "tets")
    assert not np.asarray(again.combed.element).any() and np.array_equal(again.combed.cut, parts["cut"])
    for name, values in expected.arrays().items():
        assert name.startswith("alignment_feature") or np.array_equal(values, parts[name]), name


def test_holonomies_are_those_of_the_combed_frames(expected):
    parts = expected.arrays()
    recorded = {(e.a, e.b): e.holonomy for e in of.volume.singular_edges(expected.tets, expected.combed.frames).edges}
    assert recorded == {
        tuple(edge): h
        for edge, h in zip(parts["singular_edges"].tolist(), parts["singular_holonomy"].tolist(), strict=True)
    }


def test_ovmb_tells_the_cut(tmp_path, cylinder, expected):
    of.write_frames(tmp_path / "a.ovmb", cylinder.tets, cylinder.frames, combed=True)
    found = readers.ovm_binary(tmp_path / "a.ovmb")
    cut = found["FProp", "octafield::cut"].ravel()
    across = found["HFProp", "HalffaceTransiton"].reshape(-1, 2)
    assert cut.sum() == np.asarray(expected.combed.cut).sum() > 0 and set(across[cut == 0].ravel()) <= {-1, 0}
    ends = found["Edges"]
    triangles = {tuple(sorted({v for h in loop for v in ends[h // 2]})) for loop in found["Faces"][cut == 1]}
    assert triangles == set(
        map(tuple, np.asarray(expected.combed.faces.triangles)[np.asarray(expected.combed.cut) == 1].tolist())
    )


def test_perm_lists_the_cut_alone(tmp_path, cylinder, expected):
    of.write_frames(tmp_path / "a.fra", cylinder.tets, cylinder.frames, combed=True)
    count, listed = readers.perm(tmp_path / "a.perm")
    faces, cut = expected.combed.faces, np.asarray(expected.combed.cut) == 1
    assert count == len(cylinder.tets.tets)
    assert {tuple(row) for row in listed[:, :2].tolist()} <= {
        tuple(row) for row in np.asarray(faces.tets)[cut].tolist()
    }
    triads = readers.fra(tmp_path / "a.fra")
    assert np.allclose(triads, axes(np.asarray(expected.combed.frames)))
    for one, other, *p in listed:
        p = np.array(p)
        mapped = np.sign(p) * triads[other][:, np.abs(p) - 1]
        assert np.trace(triads[one].T @ mapped) > np.trace(triads[one].T @ triads[other])


def test_lengths_go_with_their_axes(tmp_path):
    mesh = box_tets(2)
    frames = frames_at(mesh, "tets")
    lengths = np.random.default_rng(3).uniform(1, 9, (len(frames), 3))
    of.write_frames(tmp_path / "a.fra", mesh, frames, "tets", lengths=lengths, combed=True)
    vectors, given = readers.fra(tmp_path / "a.fra"), axes(frames) * lengths[:, None, :]
    relative = np.einsum("nij,nik->njk", given, vectors) / np.linalg.norm(given, axis=1)[:, :, None]
    assert np.allclose(np.sort(np.abs(relative).max(axis=2), axis=1), np.sort(lengths, axis=1))
    assert np.allclose(np.abs(relative).max(axis=1), np.linalg.norm(vectors, axis=1))


def test_vtu_and_the_command(tmp_path, cylinder, expected):
    of.write_frames(tmp_path / "a.vtu", cylinder.tets.mesh, cylinder.frames)  # without its features
    done = octafield("convert", tmp_path / "a.vtu", "-o", tmp_path / "b.npz", "--combed", "--json", "-", check=0)
    record = json.loads(done.stdout)
    assert (
        record["where"] == "tets"
        and record["frames"] == len(cylinder.tets.tets)
        and "were found by angle" in done.stderr
    )
    corresponding(dict(np.load(tmp_path / "b.npz")))
    octafield("convert", tmp_path / "b.npz", "-o", tmp_path / "c.vtu", "--combed", check=0)
    triads = readers.vtk_arrays(tmp_path / "c.vtu", "tets")
    corresponding(expected.arrays(), np.asarray(of.read_frames(tmp_path / "c.vtu").frames))
    assert np.allclose(triads["frame_u"], axes(np.asarray(expected.combed.frames))[:, :, 0])
    done = octafield("convert", tmp_path / "a.vtu", "-o", tmp_path / "d.npz", "--combed", "--at", "vertices", check=2)
    assert "combed frames sit in the tets" in done.stderr


def test_what_cannot_be_combed_is_refused(tmp_path, cylinder):
    frames = np.asarray(cylinder.frames)
    with pytest.raises(of.InvalidInput, match="with the mesh; give it"):
        of.write_frames(tmp_path / "a.npy", None, frames, combed=True)
    with pytest.raises(of.InvalidInput, match="combed with their mesh"):
        of.write_frames(tmp_path / "a.npy", None, frames, "tets", combed=True)
    with pytest.raises(of.InvalidInput, match="is a surface"):
        of.parameterization_input(generate("box"), frames)
    with pytest.raises(of.InvalidInput, match="are needed, one per vertex"):
        of.parameterization_input(cylinder.tets, frames[1:])
    with pytest.raises(of.InvalidInput, match="not on the surface"):
        mesh = box_tets(2)
        of.write_frames(tmp_path / "a.npz", mesh, frames_at(mesh, "tets"), "tets", features=[[0, 13]], combed=True)
    assert list(tmp_path.iterdir()) == []


def test_regions_hold_axes_at_their_interface(tmp_path):
    mesh = box_tets(2)
    halves = (np.asarray(mesh.vertices)[mesh.tets].mean(axis=1)[:, 0] > 0.5).astype(np.int32)
    frames = np.tile([1.0, 0, 0, 0], (len(mesh.tets), 1))
    of.write_frames(tmp_path / "a.npz", mesh, frames, "tets", regions=halves, combed=True)
    parts = dict(np.load(tmp_path / "a.npz"))
    assert (
        len(parts["surface_triangles"]) == 6 * 8 + 8
        and parts["alignment_patch_one_axis"].all()
        and not parts["cut"].any()
    )
