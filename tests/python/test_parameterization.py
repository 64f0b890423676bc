"""Matchings, combed fields and the tables of what the boundary holds: against walks made here."""

import copy
import pickle
import subprocess
import sys
from pathlib import Path

import numpy as np
import octafield as of
import pytest
import scipy.sparse as sparse
import scipy.sparse.csgraph as csgraph
from conftest import SHARED_DATA
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import compute_field
from octafield.options import FieldOptions
from octahedral_fixtures import GROUP, INVERSE, PRODUCT, closest, matrices
from pipeline_fixtures import shared, write_cube

SMALL = ["s01c", "s02c", "s03c", "s04c", "s06c", "s07c", "s10c", "s11c", "s13c", "s05c"]


def field_of(name):
    options = FieldOptions(threads=1, streamlines=0)
    meshed = prepare_mesh(shared(SHARED_DATA / "hexme" / f"{name}.vtk.gz"), options)
    return meshed, meshed.tets, of.volume.tet_frames(meshed.tets, compute_field(meshed, options).frames)


@pytest.fixture(scope="module", params=SMALL)
def combed(request):
    meshed, mesh, of_tets = field_of(request.param)
    return meshed, mesh, of_tets, of.volume.face_matchings(mesh, of_tets), of.volume.comb(mesh, of_tets)


def carried(edge, tets, across):
    """Inverse of the product of matchings round an edge, right-handed, from its lowest tet; None where no loop closes.
    tets: {tet: (enter, leave)}."""
    start = tet = min(tets)
    product = 0
    for _ in tets:
        enter, leave = tets[tet]
        key = (*sorted((*edge, leave)),)
        if key not in across:
            return None
        one, other, m = across[key]
        product = PRODUCT[product, m if one == tet else INVERSE[m]]
        tet = other if one == tet else one
        if tets[tet][0] != leave:
            return None
    return INVERSE[product] if tet == start else None


def edges_of(mesh):
    """{(a, b): {tet: (enter, leave)}}, a < b: right-handed round a -> b."""
    found = {}
    for t, corners in enumerate(np.asarray(mesh.tets).tolist()):
        for order in ((0, 1, 2, 3), (0, 2, 3, 1), (0, 3, 1, 2), (1, 2, 0, 3), (1, 3, 2, 0), (2, 3, 0, 1)):
            a, b, c, d = (corners[x] for x in order)
            key, value = ((a, b), (c, d)) if a < b else ((b, a), (d, c))
            found.setdefault(key, {})[t] = value
    return found


def keyed(faces):
    rows = np.column_stack([faces.triangles, faces.tets, faces.matching]).tolist()
    return {tuple(row[:3]): tuple(row[3:]) for row in rows}


def test_products_round_edges_are_the_identity_but_at_the_singular_edges(combed):
    _, mesh, of_tets, faces, field = combed
    recorded = {(e.a, e.b): e.holonomy for e in of.volume.singular_edges(mesh, of_tets).edges}
    before, after = keyed(faces), keyed(field.faces)
    cut = {tuple(row) for row in np.asarray(field.faces.triangles)[np.asarray(field.cut) == 1].tolist()}
    found, touched = {}, set()
    for edge, tets in edges_of(mesh).items():
        holonomy = carried(edge, tets, before)
        if holonomy:
            found[edge] = holonomy
            # Combing conjugates: g^-1 h g in the combed frame of the lowest tet.
            g = field.element[min(tets)]
            assert carried(edge, tets, after) == PRODUCT[PRODUCT[INVERSE[g], holonomy], g]
            touched.add(any(tuple(sorted((*edge, v))) in cut for pair in tets.values() for v in pair))
        elif holonomy == 0:
            assert sum(tuple(sorted((*edge, leave))) in cut for _, leave in tets.values()) != 1  # pruned
    assert found == recorded and touched <= {True}


def test_combed_axes_correspond_across_all_faces_but_the_cut(combed):
    _, mesh, of_tets, faces, field = combed
    one, other = np.asarray(faces.tets).T
    best, angle = closest(matrices(of_tets)[one], matrices(of_tets)[other])
    # But for ties, where the two ways are equally far.
    assert np.mean(best == faces.matching) > 0.999
    frames = matrices(field.frames)
    np.testing.assert_allclose(frames, matrices(of_tets) @ GROUP[field.element], atol=1e-12)
    left = np.linalg.norm(
        np.einsum("fij,fjk->fik", frames[one], GROUP[field.faces.matching]) - frames[other], axis=(1, 2)
    )
    np.testing.assert_allclose(left, np.sqrt(8) * np.sin(angle / 2), atol=1e-6)
    uncut = np.asarray(field.cut) == 0
    assert not np.asarray(field.faces.matching)[uncut].any()
    between = np.degrees(np.arccos(np.clip(np.einsum("fji,fji->fi", frames[one][uncut], frames[other][uncut]), -1, 1)))
    assert between.max() < 62.8 and np.quantile(between, 0.99) < 45
    q = np.asarray(field.frames)
    assert np.mean(np.einsum("fi,fi->f", q[one][uncut], q[other][uncut]) > 0) > 0.999  # signs of quaternions too


def test_the_complement_of_the_cut_is_simply_connected(combed):
    """It is what its dual complex is: tets, faces not cut, and the edges and vertices inside that only such faces meet
    in."""
    _, mesh, _, faces, field = combed
    tets, cut = np.asarray(mesh.tets), np.asarray(field.cut) == 1
    closed = np.concatenate([np.asarray(faces.triangles)[cut], boundary_of(mesh)])
    points = np.zeros(len(mesh.vertices), bool)
    points[closed] = True
    pairs = np.sort(np.concatenate([closed[:, [0, 1]], closed[:, [1, 2]], closed[:, [0, 2]]]), axis=1)
    barred = set(map(tuple, pairs.tolist()))
    loops = {edge: around for edge, around in edges_of(mesh).items() if edge not in barred}
    inside = np.setdiff1d(tets, np.flatnonzero(points))
    joined = sparse.coo_matrix((np.ones(len(pairs)), pairs.T), shape=(len(points),) * 2)
    pieces = len(np.unique(csgraph.connected_components(joined, directed=False)[1][points]))
    # Alexander duality: each piece of cut and boundary beyond the first is a void.
    uncut = np.flatnonzero(~cut)
    assert len(tets) - len(uncut) + len(loops) - len(inside) == pieces
    number = {tuple(row): k for k, row in enumerate(np.asarray(faces.triangles)[uncut].tolist())}
    sides = np.asarray(faces.tets)[uncut]
    rows, columns, signs = [], [], []
    for k, (edge, around) in enumerate(loops.items()):
        for tet, (_, leave) in around.items():
            face = number[tuple(sorted((*edge, leave)))]
            rows.append(face)
            columns.append(k)
            signs.append(1 if sides[face, 0] == tet else -1)
    graph = sparse.coo_matrix((np.ones(len(sides)), sides.T), shape=(len(tets),) * 2)
    assert csgraph.connected_components(graph, directed=False)[0] == field.parts == 1
    if len(uncut) < 3000:  # no loop is left: the walls of edges span all loops
        walls = sparse.coo_matrix((signs, (rows, columns)), shape=(len(uncut), len(loops))).toarray()
        assert len(uncut) - (len(tets) - 1) == np.linalg.matrix_rank(walls)


def boundary_of(mesh):
    surface = of.volume.boundary_surface(mesh)
    return np.asarray(surface.vertex_map)[surface.mesh.triangles]


def test_tables_tell_the_axes_of_normals_and_feature_edges(combed):
    meshed, mesh, _, _, field = combed
    surface, features = meshed.tets.surface, meshed.tets.features
    found = of.volume.alignment_tables(meshed.tets, field)
    frames, points = matrices(field.frames), np.asarray(mesh.vertices)
    corners = points[np.asarray(surface.vertex_map)[surface.mesh.triangles]]
    check_axes(
        frames, found.triangle_tet, found.triangle_axis, found.triangle_angle, of.surface.triangle_normals(surface.mesh)
    )
    assert (np.isin(np.asarray(mesh.tets)[found.triangle_tet], np.asarray(surface.vertex_map)).sum(axis=1) >= 3).all()
    assert np.degrees(np.median(found.triangle_angle)) < 10 and len(corners) == len(found.triangle_patch)
    a, b = np.asarray(found.feature_edges).T
    np.testing.assert_array_equal(np.asarray(surface.vertex_map)[features.edges], found.feature_edges)
    check_axes(frames, found.feature_tet, found.feature_axis, found.feature_angle, points[b] - points[a])
    around = edges_of(mesh)
    assert [min(around[tuple(sorted(edge))]) for edge in np.asarray(found.feature_edges).tolist()] == list(
        found.feature_tet
    )
    np.testing.assert_array_equal(found.triangle_patch, patches(surface.mesh.triangles, features.edges))


def check_axes(frames, tets, axes, angles, directions):
    rows, axes = np.arange(len(axes)), np.asarray(axes)
    unit = directions / np.linalg.norm(directions, axis=1, keepdims=True)
    along = np.einsum("fij,fi->fj", frames[tets], unit)
    np.testing.assert_allclose(np.sign(axes) * along[rows, abs(axes) - 1], abs(along).max(axis=1), atol=1e-12)
    np.testing.assert_allclose(np.cos(angles), abs(along).max(axis=1), atol=1e-12)


def patches(triangles, features):
    """By scipy's connected components, numbered by lowest triangle."""
    sides = {}
    for t, corners in enumerate(np.asarray(triangles).tolist()):
        for k in range(3):
            sides.setdefault((*sorted((corners[k], corners[(k + 1) % 3])),), []).append(t)
    held = set(map(tuple, np.sort(features, axis=1).tolist()))
    pairs = [found for edge, found in sides.items() if len(found) == 2 and edge not in held]
    graph = sparse.coo_matrix((np.ones(len(pairs)), np.array(pairs).T), shape=(len(triangles),) * 2)
    labels = csgraph.connected_components(graph, directed=False)[1]
    _, first, numbers = np.unique(labels, return_index=True, return_inverse=True)
    return np.argsort(np.argsort(first))[numbers]


def test_a_cylinder_has_one_axis_normal_to_each_of_its_patches_though_four_curves_cross_it(tmp_path):
    meshed, mesh, of_tets = field_of("s02c")
    field = of.volume.comb(mesh, of_tets)
    assert field.cut.any()
    found = of.volume.alignment_tables(meshed.tets, field)
    assert found.patch_one_axis.all()


def test_records_are_pickled_and_other_meshes_refused(box):
    field = of.volume.comb(box, np.tile([1.0, 0, 0, 0], (len(box.tets), 1)))
    assert not field.cut.any() and field.parts == 1 and not field.element.any()
    again = pickle.loads(pickle.dumps(field))
    np.testing.assert_array_equal(again.faces.matching, field.faces.matching)
    domain = of.TetDomain(box)
    domain = domain.with_features(of.surface.detect_features(domain.surface.mesh))
    assert len(copy.deepcopy(of.volume.alignment_tables(domain, again)).patch_one_axis) == 6
    with pytest.raises(of.InvalidInput):
        of.volume.alignment_tables(domain, of.volume.CombedField())
    with pytest.raises(of.InvalidInput):
        of.volume.comb(box, field.frames[:5])
    with pytest.raises(of.InvalidInput):
        of.volume.face_matchings(box, 2 * field.frames)


def test_the_study_writes_its_tables_and_picture(tmp_path):
    script = Path(__file__).parents[2] / "studies" / "parameterization.py"
    mesh = shared(SHARED_DATA / "hexme" / "s02c.vtk.gz")
    done = subprocess.run(
        [sys.executable, script, "-o", tmp_path, write_cube(tmp_path), mesh, "--picture", "s02c"],
        capture_output=True,
        text=True,
        timeout=300,
    )
    assert done.returncode == 0, done.stderr
    cuts = (tmp_path / "cuts.md").read_text().splitlines()
    assert cuts[2].startswith("| cube |") and "| 0 | 0 | 0 | 6 | 6 |" in cuts[2] and "| 5 | 5 |" in cuts[3]
    assert (
        len((tmp_path / "sizes.md").read_text().splitlines())
        == len((tmp_path / "seconds.md").read_text().splitlines())
        == 4
    )
    assert (tmp_path / "cut.png").read_bytes()[:8] == b"\x89PNG\r\n\x1a\n"
