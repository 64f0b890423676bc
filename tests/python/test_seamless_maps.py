"""Seamless maps of our own fields, and octafield hex-mesh from a mesh: judged by the tests' own code."""

import itertools
import json

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import require_conforming, volume_of
from octafield.domain.generators import generate
from octafield.hexmesh.hexex import read_seamless_map, write_seamless_map
from octafield.records.record_file import any_record
from pipeline_fixtures import octafield


def hexme(shared_data, name):
    return shared_data / "hexme" / f"{name}.vtk.gz"


def least_determinant(given):
    at = np.asarray(given.parameters).reshape(-1, 4, 3)
    return np.linalg.det(at[:, 1:] - at[:, :1]).min()


@pytest.mark.parametrize("name", ["s01c", "s02c", "s13c", "s17c"])
def test_fields_of_simple_parts_have_seamless_maps_without_folds(shared_data, name):
    result = of.compute_seamless_map(hexme(shared_data, name))
    assert result.record.stage == "injective" and result.record.stopped_by is None
    assert least_determinant(result.map) > 0
    report = of.volume.seamless_report(result.map)
    assert report.residual < 1e-12 and report.unaligned == 0 and not len(report.torn)
    tets = result.field.tets
    parts = np.bincount(result.parent, of.volume.tet_volumes(result.map.mesh), len(tets.tets))
    if name != "s17c":  # tets of cells with one vertex together share their volumes
        assert parts == pytest.approx(of.volume.tet_volumes(tets), rel=1e-9)
    assert parts.sum() == pytest.approx(of.volume.tet_volumes(tets).sum(), rel=1e-12)


def test_the_unit_scales_the_map():
    box = of.compute_field(generate("box"), of.FieldOptions(edge_length=0.5))
    volumes = [of.volume.seamless_report(of.compute_seamless_map(box, unit=u).map).volume for u in (0.25, 0.5)]
    solid = of.volume.tet_volumes(box.tets).sum()
    assert volumes == pytest.approx([solid / 0.25**3, solid / 0.5**3], rel=1e-6)


def quarters_round_edges(given):
    """Of edges inside, in parameters, rounded; only those that are not four."""
    tets, at = np.asarray(given.mesh.tets), np.asarray(given.parameters).reshape(-1, 4, 3)
    turned: dict[tuple[int, int], float] = {}
    for a, b in itertools.combinations(range(4), 2):
        c, d = sorted({0, 1, 2, 3} - {a, b})
        axis = at[:, b] - at[:, a]
        normals = np.cross(axis, at[:, c] - at[:, a]), np.cross(axis, at[:, d] - at[:, a])
        cosine = (
            (normals[0] * normals[1]).sum(1) / np.linalg.norm(normals[0], axis=1) / np.linalg.norm(normals[1], axis=1)
        )
        for edge, angle in zip(
            np.sort(tets[:, [a, b]], axis=1).tolist(), np.arccos(np.clip(cosine, -1, 1)), strict=True
        ):
            turned[edge[0], edge[1]] = turned.get((edge[0], edge[1]), 0) + angle / (np.pi / 2)
    triangles = np.sort(np.concatenate([np.delete(tets, k, axis=1) for k in range(4)]), axis=1)
    unique, count = np.unique(triangles, axis=0, return_counts=True)
    outside = {pair for t in unique[count == 1].tolist() for pair in itertools.combinations(t, 2)}
    return {edge: round(q) for edge, q in turned.items() if edge not in outside and abs(q - 4) > 0.1}


@pytest.mark.parametrize("name", ["s05c", "s07c", "s11c"])
def test_curves_that_go_on_with_another_type_are_unzipped(shared_data, name):
    """Judged by angles in the map: three or five quarters round each singular edge, the same all along a curve."""
    result = of.compute_seamless_map(hexme(shared_data, name))
    record = result.record
    assert record.non_meshable_junctions > 0  # of the field
    assert record.turns == record.unzipped > 0
    assert record.stage == "injective" and least_determinant(result.map) > 0
    quarters = quarters_round_edges(result.map)
    assert set(quarters.values()) == {3, 5} and set(quarters) == {tuple(e) for e in np.asarray(result.curves).tolist()}
    of_vertex: dict[int, list[int]] = {}
    for edge, count in quarters.items():
        for vertex in edge:
            of_vertex.setdefault(vertex, []).append(count)
    for vertex, counts in of_vertex.items():
        assert len(counts) != 2 or counts[0] == counts[1], vertex
    made = of.compute_hex_mesh(result.map, cells=2000).record
    assert made.inverted == 0 and set(made.irregular_edges) == {"3", "5"}


def nut(folder):
    """Some tets of which are flat in every map of its field."""
    surface = generate("nut")
    lines = [f"v {x} {y} {z}" for x, y, z in np.asarray(surface.vertices)]
    lines += [f"f {a} {b} {c}" for a, b, c in np.asarray(surface.triangles) + 1]
    path = folder / "nut.obj"
    path.write_text("\n".join(lines) + "\n")
    return path


def test_what_stops_a_map_is_told_with_its_places(tmp_path):
    result = of.compute_seamless_map(nut(tmp_path))
    record = result.record
    assert record.stage == "field" and record.stopped_by == "locked_tet"
    assert record.locked == len(result.locked) > 0 and least_determinant(result.map) <= 0
    corners = np.asarray(result.map.mesh.vertices)[np.asarray(result.map.mesh.tets)[result.locked[0]]]
    assert record.stopped_at[0] == pytest.approx(corners.mean(axis=0).tolist())


def twisted_ring(turns, count=8, tilted=True):
    """So many of eight tets round an edge, whose parameters go round it so many times all eight, with the edge along no
    axis where they are tilted."""
    angles = np.arange(9) * np.pi / 4
    around = np.stack([np.cos(angles), np.sin(angles), 0 * angles], 1)
    points = np.array([[0, 0, -1], [0, 0, 1], *around[: min(count + 1, 8)]])
    places = np.array([[0, 1, 2 + k, 3 + k] for k in range(count)])
    mapped = np.array(
        [[0, 0, -1], [0, 0, 1], *np.stack([np.cos(turns * angles), np.sin(turns * angles), 0 * angles], 1)]
    )
    tilt = np.array([[1, 2, 2], [2, 1, -2], [-2, 2, -1]]) / 3 if tilted else np.eye(3)  # columns at right angles
    tilt *= np.sign(np.linalg.det(tilt))
    tets = np.where(places == 10, 2, places).astype(np.int32)
    return of.volume.SeamlessMap(of.TetMesh(points, tets), (mapped @ tilt.T)[places].reshape(-1, 12))


@pytest.mark.parametrize(
    ("turns", "count", "tilted", "wound"),
    [
        (1, 8, True, False),
        (2, 8, True, True),
        (0.75, 8, False, False),  # valence 3
        (0.25, 8, False, True),  # one hexahedron round an edge inside
        (1, 4, True, False),  # two quarters at the boundary
        (1, 6, True, True),
        (1, 6, False, False),
        (0.1, 4, False, True),
    ],
)
def test_parameters_that_wind_round_an_edge_are_seen_though_no_tet_is_flipped(turns, count, tilted, wound):
    given = twisted_ring(turns, count, tilted)
    assert least_determinant(given) > 0
    report = of.volume.seamless_report(given)
    assert not len(report.flipped) and not len(report.torn)
    assert ([0, 1] in np.asarray(report.wound).tolist()) == wound


@pytest.mark.parametrize("name", ["s07c", "s08c", "s11c"])
def test_these_fields_have_curves_that_go_on_with_another_type(shared_data, name):
    """Three hexahedra round one part, five round the other: the same matchings, against the axis."""
    field = of.compute_field(hexme(shared_data, name))
    graph = of.volume.singular_graph(field.tets, field.frames)
    told = of.volume.local_meshability(field.tets, field.frames, graph)
    bad = [vertex for vertex in told.vertices if not vertex.meshable]
    assert bad and {(vertex.valence3, vertex.valence5, vertex.complex) for vertex in bad} == {(1, 1, 0)}


def test_curves_of_a_cylinder_share_planes_or_lie_apart(shared_data):
    """Planes of walls nearly in one another leave no tets between them."""
    walled = of.volume.motorcycle_complex(of.compute_seamless_map(hexme(shared_data, "s15c")).map)
    assert of.volume.tet_volumes(walled.mesh).min() > 0
    of.volume.block_complex(walled)  # raises where a block is no box


def test_the_command_goes_from_a_ball_to_hexahedra_alone(shared_data, tmp_path):
    folder = tmp_path / "out"
    octafield("hex-mesh", hexme(shared_data, "s17c"), "-o", folder, "--cells", "500", "-q", check=0)
    names = ["mesh.mesh", "mesh.msh", "mesh.vtu", "result.json", "seamless.hexex", "seamless.json"]
    assert sorted(path.name for path in folder.iterdir()) == names
    mesh = of.read_cells(folder / "mesh.vtu")
    require_conforming(mesh)
    given = read_seamless_map(folder / "seamless.hexex")
    assert volume_of(mesh) == pytest.approx(of.volume.tet_volumes(given.mesh).sum(), rel=0.02)
    told = any_record(folder / "result.json")
    assert told.stage == "extracted" and told.inverted == 0 and set(told.irregular_edges) == {"3"}
    assert sorted(told.files) == names
    assert any_record(folder / "seamless.json").stage == "injective"


def test_whole_numbers_do_not_end_the_process(shared_data, tmp_path):
    """Bounds that cross while Cbc preprocesses these end in an assertion of Clp."""
    octafield("hex-mesh", hexme(shared_data, "s10c"), "-o", tmp_path / "out", "--cells", "2000", "-q", check=0)
    assert any_record(tmp_path / "out" / "result.json").stage == "extracted"


def test_the_command_tells_what_stops_it(tmp_path):
    octafield("hex-mesh", nut(tmp_path), "-o", tmp_path / "out", "--json", tmp_path / "told.json", "-q",
              "--fallback", "none", check=0)  # fmt: skip
    names = ["result.json", "seamless.hexex", "seamless.json"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == names
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["stage"] == "field" and told["stopped_by"] == "locked_tet" and told["stopped_at"]
    octafield("hex-mesh", nut(tmp_path), "-o", tmp_path / "no", "--fallback", "tets", "-q", check=2)


def test_what_does_not_become_hexahedra_alone_becomes_mostly_hexahedra(tmp_path):
    folder = tmp_path / "out"
    octafield("hex-mesh", nut(tmp_path), "-o", folder, "--cells", "500", "-q", check=0)
    told, other = any_record(folder / "result.json"), any_record(folder / "hex_dominant.json")
    assert sorted(told.files) == sorted(path.name for path in folder.iterdir())
    assert told.stage == "field" and told.stopped_by == "locked_tet"
    mesh = of.read_cells(folder / "mesh.vtu")
    require_conforming(mesh)
    assert len(mesh.hexahedra) == other.cells.hexahedra > 300 and other.hex_volume_share > 0.8


def test_other_fields_and_options_are_refused(tmp_path):
    box = generate("box")
    for options in (of.FieldOptions(axes="free"), of.FieldOptions(sampling="tets")):
        with pytest.raises(of.InvalidInput):
            of.compute_seamless_map(box, options)
    with pytest.raises(of.InvalidInput):
        of.compute_seamless_map(box, unit=-1.0)
    tets = of.prepare_mesh(box).volume()
    with pytest.raises(of.InvalidInput):
        of.volume.field_map(tets, np.full((len(tets.vertices), 4), np.nan))
    halves = of.TetDomain(tets.mesh, regions=np.arange(len(tets.tets)) % 2)
    with pytest.raises(of.InvalidInput, match="region"):
        of.volume.field_map(halves, np.eye(1, 4).repeat(len(tets.vertices), axis=0))
    write_seamless_map(tmp_path / "box.hexex", of.compute_seamless_map(box).map)
    for option in (("--tet-length", "1"), ("--fallback", "none")):
        octafield("hex-mesh", tmp_path / "box.hexex", "-o", tmp_path / "out", *option, "-q", check=2)
