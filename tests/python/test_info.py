"""The doctor for inputs: each check has a mesh made to fail it, and each remedy makes it pass."""

import json

import numpy as np
import octafield as of
import pytest
import pyvista
from conftest import box_tets
from octafield import MeshOptions
from octafield.domain.generators import generate
from octafield.inspect import checks as info_checks
from octafield.inspect import estimates
from octafield.inspect import measures as info_measures
from octafield.inspect.info import examine
from pipeline_fixtures import SHARED_SURFACES, SHARED_TETS, octafield, shared, write_cube, write_sphere


def write(mesh, path):
    of.write_surface(mesh, path) if isinstance(mesh, of.TriangleMesh) else of.to_meshio(mesh).write(path)
    return path


def states(record):
    return {r["requirement"]: r["state"] for r in record["requirements"]}


def found(record, requirement):
    return next(r for r in record["requirements"] if r["requirement"] == requirement)


def edge_length_of(finding):
    assert finding["remedy"].startswith("--edge-length ")
    return float(finding["remedy"].split()[1])


def moved(mesh, by):
    return of.TriangleMesh(np.asarray(mesh.vertices) + by, mesh.triangles)


def scaled(mesh, *factors):
    return of.TriangleMesh(np.asarray(mesh.vertices) * factors, mesh.triangles)


@pytest.mark.parametrize("name", ["box", "ball", "cylinder", "torus", "nut"])
def test_sound_bodies_pass_every_check(name, tmp_path):
    record = examine(write(generate(name), tmp_path / "body.ply"))
    assert record["ok"] and set(states(record).values()) == {"pass"}
    assert {r["requirement"] for r in record["requirements"]} >= {
        "file can be read",
        "walls are thicker than half an edge",
        "memory suffices",
    }


def test_the_expected_number_of_tets_is_near_the_true_one(tmp_path):
    for name, length in (("ball", 0.2), ("cylinder", 0.2), ("box", 0.1)):
        expected = examine(write(generate(name), tmp_path / "b.ply"), MeshOptions(edge_length=length))["expected"][
            "tets"
        ]
        true = len(of.prepare_mesh(generate(name), MeshOptions(edge_length=length)).tets.tets)
        assert 0.6 < expected / true < 1.6


@pytest.mark.parametrize("content, kind", [(None, ""), (b"solid nothing", ""), (b"\x00\xff" * 50, "")])
def test_a_file_that_cannot_be_read_fails_the_first_requirement(content, kind, tmp_path):
    path = tmp_path / "part.stl"
    if content is not None:
        path.write_bytes(content)
    record = examine(path)
    assert not record["ok"] and len(record["requirements"]) == 1 or states(record)["has triangles"] == "fail"
    assert record["requirements"][0]["requirement"] == "file can be read"
    done = octafield("info", path, "--json", "-", check=2)
    assert json.loads(done.stdout)["ok"] is False and len(done.stderr.splitlines()) == 1


def test_flat_tets_are_named(tmp_path):
    flat = of.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0]], [[0, 1, 2, 3], [0, 1, 4, 2]])
    record = examine(write(flat, tmp_path / "flat.vtu"))
    assert states(record) == {"file can be read": "pass", "tets have volume": "fail"}
    assert found(record, "tets have volume")["elements"] == [1]


@pytest.mark.parametrize("name", ["degenerate_s17", "fin_s01", "flipped_s01", "hole_s17", "insideout_s16", "soup_s04"])
def test_repair_is_the_remedy_of_broken_surfaces_and_works(name):
    path = shared(SHARED_SURFACES / f"bad_{name}.obj")
    record = examine(path)
    remedies = [r["remedy"] for r in record["requirements"] if r["state"] == "fail"]
    assert (
        not record["ok"]
        and remedies
        and all(remedy.startswith(("--repair merge ", "--repair safe ")) for remedy in remedies)
    )
    again = examine(path, MeshOptions(repair=True))
    assert again["ok"] and any(note.startswith("repair: ") for note in again["notes"])


def test_crossing_faces_need_a_higher_level():
    path = shared(SHARED_SURFACES / "bad_selfcross_s15.obj")
    finding = found(examine(path), "no self-intersection")
    assert (
        finding["state"] == "fail"
        and finding["remedy"].startswith("--repair resolve makes it sound (")
        and finding["elements"]
    )
    assert examine(path, MeshOptions(repair="resolve"))["ok"]


@pytest.mark.parametrize("factor", [1e-9, 1e9])
def test_sizes_beyond_what_is_tested_are_warned_of_with_the_factor_that_helps(factor, tmp_path):
    body = scaled(generate("box"), factor, factor, factor)
    finding = found(examine(write(body, tmp_path / "b.ply")), "size can be computed with")
    assert finding["state"] == "warn" and finding["kind"] == "size"
    by = float(finding["remedy"].split()[-1])
    assert states(examine(write(scaled(body, by, by, by), tmp_path / "b.ply")))["size can be computed with"] == "pass"


def test_shapes_far_from_the_origin_are_warned_of(tmp_path):
    text = "coordinates have digits for the shape"
    far = moved(generate("ball"), [2e4, 0, 0])
    single = of.TriangleMesh(np.asarray(far.vertices, np.float32), far.triangles)
    assert states(examine(write(far, tmp_path / "b.ply")))[text] == "pass"  # all digits of doubles
    finding = found(examine(write(single, tmp_path / "b.ply")), text)
    assert (finding["state"], finding["kind"]) == ("warn", "far_from_origin")
    assert "20000" in finding["remedy"]


def test_feature_curves_that_end_in_a_face_are_warned_of(tmp_path):
    # A ridge on a plate that fades out: its dihedral angle passes the feature angle half way.
    x, y = np.meshgrid(np.linspace(0, 4, 41), np.linspace(-1, 1, 21), indexing="ij")
    z = np.maximum(0, 1 - np.abs(y)) * (4 - x) / 4
    top = pyvista.StructuredGrid(x, y, z).extract_surface(algorithm=None).triangulate()
    top.clear_data()
    body = (
        top.extrude((0, 0, -3), capping=True)
        .triangulate()
        .clean()
        .compute_normals(auto_orient_normals=True, split_vertices=False)
    )
    path = write(of.from_pyvista(body), tmp_path / "ridge.ply")
    finding = found(examine(path), "feature curves end at corners")
    assert (finding["state"], finding["kind"]) == ("warn", "open_features") and len(finding["elements"]) >= 1
    assert "--features none" in finding["remedy"]
    assert states(examine(path, MeshOptions(features="none")))["feature curves end at corners"] == "pass"


def test_lines_of_a_file_that_are_no_edges_are_warned_of(tmp_path, box):
    import meshio

    points = np.asarray(box.vertices)
    inside = int(np.argmin(np.abs(points - 0.4).sum(axis=1)))
    cells = [("tetra", np.asarray(box.tets)), ("line", np.array([[0, 1], [inside, inside + 1]]))]
    path = tmp_path / "lines.vtu"
    meshio.Mesh(points, cells).write(path)
    finding = found(examine(path), "feature lines are edges of the surface")
    assert (finding["state"], finding["kind"]) == ("warn", "lines_off_surface")
    assert states(examine(path, MeshOptions(features="angle")))["feature lines are edges of the surface"] == "pass"


def test_features_asked_from_a_file_without_lines_fail_with_the_option_that_helps(tmp_path):
    cube = write_cube(tmp_path)
    record = examine(cube, MeshOptions(features="file"))
    finding = found(record, "features can be found")
    assert not record["ok"] and finding["kind"] == "no_feature_lines" and finding["remedy"] == "--features angle"
    assert examine(cube, MeshOptions(features="angle"))["ok"]


def check_remedy(path, text, kind):
    """Of edges of 0.2 the check warns, with a length that makes it pass; lengths that fit the shape pass."""
    assert states(examine(path))[text] == "pass"
    finding = found(examine(path, MeshOptions(edge_length=0.2)), text)
    assert (finding["state"], finding["kind"]) == ("warn", kind)
    again = examine(path, MeshOptions(edge_length=edge_length_of(finding)))
    assert states(again)[text] == "pass"


def test_short_feature_curves(tmp_path):
    slab = of.TriangleMesh(np.asarray(generate("box").vertices) * [1, 1, 0.01], generate("box").triangles)
    path = write(slab, tmp_path / "slab.ply")
    check_remedy(path, "feature curves are longer than the edges", "short_features")


def test_thin_walls(tmp_path):
    slab = scaled(generate("box"), 1, 1, 0.02)
    check_remedy(write(slab, tmp_path / "slab.ply"), "walls are thicker than half an edge", "thin_walls")


def test_walls_are_measured_across_the_body_and_wedges_are_none(tmp_path):
    thick, share = info_measures.thicknesses(scaled(generate("box"), 3, 2, 1))
    assert np.allclose(sorted(set(np.round(thick, 3))), [1, 2, 3], atol=0.01) and share.sum() == pytest.approx(1)
    wedge = of.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])
    assert not np.isfinite(info_measures.thicknesses(wedge)[0]).any()


def test_curvature_finer_than_the_edges(tmp_path):
    bent = (
        pyvista.ParametricTorus(ringradius=1, crosssectionradius=0.03, u_res=400, v_res=24, w_res=24)
        .triangulate()
        .clean()
    )
    bent = bent.compute_normals(auto_orient_normals=True, split_vertices=False)
    check_remedy(
        write(of.from_pyvista(bent), tmp_path / "ring.ply"),
        "edges are shorter than radii of curvature",
        "coarse_for_curvature",
    )


def test_thin_triangles_matter_only_where_they_are_kept(tmp_path):
    path = write(generate("cylinder"), tmp_path / "c.ply")
    finding = found(examine(path, MeshOptions(remesh=False)), "triangles are well shaped")
    assert (finding["state"], finding["kind"], finding["remedy"]) == ("warn", "thin_triangles", "leave out --no-remesh")
    assert states(examine(path))["triangles are well shaped"] == "pass"


def test_slivers_are_warned_of_and_a_new_mesh_of_the_surface_has_none(tmp_path):
    tets = box_tets(3)  # an inner vertex goes almost onto the face opposite in one of its tets; the star is convex
    inner = int(np.argmin(np.linalg.norm(tets.vertices - 1 / 3, axis=1)))
    flat = next(t for t in range(len(tets.tets)) if inner in tets.tets[t])
    face = tets.vertices[[v for v in tets.tets[flat] if v != inner]].mean(axis=0)
    tets.vertices[inner] += 0.999 * (face - tets.vertices[inner])
    record = examine(write(tets, tmp_path / "flat.vtu"))
    finding = found(record, "tets are well shaped")
    assert (finding["state"], finding["kind"]) == ("warn", "slivers") and flat in finding["elements"]
    assert record["tet_quality"]["dihedral_min_deg"] < 0.5 and record["tet_quality"]["slivers"] >= 1
    anew = of.volume.tetrahedralize(of.volume.boundary_surface(tets).mesh)
    assert states(examine(write(anew, tmp_path / "anew.vtu")))["tets are well shaped"] == "pass"


def test_the_worst_tets_of_a_public_mesh_are_found():
    record = examine(shared(SHARED_TETS / "i11c.vtk.gz"))
    assert record["tet_quality"]["slivers"] == 3 and record["ok"]


def test_dihedral_angles_are_those_of_known_tets():
    regular = np.array([[1, 1, 1], [1, -1, -1], [-1, 1, -1], [-1, -1, 1]], float)
    assert info_measures.dihedral_angles(regular, np.array([[0, 1, 2, 3]])) == pytest.approx(
        np.degrees(np.arccos(1 / 3))
    )
    corner = np.array([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], float)
    assert (
        sorted(info_measures.dihedral_angles(corner, np.array([[0, 1, 2, 3]]))[0].round(4)) == [54.7356] * 3 + [90] * 3
    )
    assert info_measures.radius_ratios(regular, np.array([[0, 1, 2, 3]])) == pytest.approx(1)
    inradius, circumradius = 1 / (3 + 3**0.5), 3**0.5 / 2
    assert info_measures.radius_ratios(corner, np.array([[0, 1, 2, 3]])) == pytest.approx(3 * inradius / circumradius)


def test_split_is_the_remedy_of_locking_tets_and_works(tmp_path):
    coarse = box_tets(2)
    path = write(coarse, tmp_path / "coarse.vtu")
    text = "nothing inside joins the surface to itself"
    finding = found(examine(path), text)
    assert (finding["state"], finding["kind"], finding["remedy"]) == ("warn", "locking", "--split")
    again = examine(path, MeshOptions(split=True))
    assert states(again)[text] == "pass" and again["tets"] > len(coarse.tets)
    octafield("info", path, "--split", "-q", check=0)


def test_memory_is_weighed_against_the_machine(tmp_path, monkeypatch):
    path = write_sphere(tmp_path)
    assert states(examine(path))["memory suffices"] == "pass"
    finding = found(examine(path, MeshOptions(edge_length=1e-4)), "memory suffices")
    assert (finding["state"], finding["kind"]) == ("warn", "memory")
    again = examine(path, MeshOptions(edge_length=edge_length_of(finding)))
    assert (
        states(again)["memory suffices"] == "pass" and again["expected"]["memory_mb"] < again["expected"]["machine_mb"]
    )
    monkeypatch.setattr(estimates, "machine_mb", lambda: 100.0)
    assert "machine with" in found(examine(path), "memory suffices")["remedy"]


def test_regions_and_interfaces_are_told(tmp_path, box):
    half = (np.asarray(box.vertices)[np.asarray(box.tets)].mean(axis=1)[:, 0] > 0.4).astype(int) + 1
    path = tmp_path / "two.vtu"
    of.volume.write_field(path, of.TetDomain(box, regions=half), np.tile([1.0, 0, 0, 0], (len(box.vertices), 1)))
    record = examine(path)
    assert record["ok"] and record["regions"] == 2 and record["interface_triangles"] == 50


def test_every_check_is_told_apart_by_its_words_and_kind():
    checks = (*info_checks.OF_ALL, *info_checks.OF_SURFACES, *info_checks.OF_TETS)
    assert len({check.__name__ for check in checks}) == len(checks) == 10


def test_info_shows_states_and_remedies_and_a_warning_is_no_failure(tmp_path):
    shown = octafield("info", write(box_tets(2), tmp_path / "c.vtu"), check=0)
    assert "warn" in shown.stdout and "--split" in shown.stdout and shown.stderr == ""
