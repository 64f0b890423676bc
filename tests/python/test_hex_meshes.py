"""octafield hex-mesh: hexahedra from the seamless maps of MC3D, judged by the tests' own code; .hexex files; what is
refused."""

import gzip
import json

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import require_conforming, volume_of
from octafield.domain.generators import generate
from octafield.hexmesh.hexex import read_seamless_map, write_seamless_map
from octafield.meshes.openvolumemesh.text import read_ovm
from pipeline_fixtures import octafield

SMALL = ("s01c_cube", "s02c_prism", "scof_fanpart", "hexalab_double_torus", "s10c_cyl_cutsphere", "n13c_acute_line")


def box_map(scale=1.0):
    tets = of.prepare_mesh(generate("box"), of.FieldOptions(edge_length=0.4)).volume()
    points = np.asarray(tets.vertices)
    mesh = of.TetMesh(points, np.asarray(tets.tets))
    return of.volume.SeamlessMap(mesh, scale * points[np.asarray(tets.tets)].reshape(-1, 12))


def map_file(shared_data, name):
    return shared_data / "mc3d" / f"{name}.hexex.gz"


@pytest.mark.parametrize("name", SMALL)
def test_maps_of_others_become_sound_meshes_of_hexahedra_alone(shared_data, name):
    result = of.compute_hex_mesh(map_file(shared_data, name), cells=700)
    require_conforming(result.mesh)
    assert len(result.mesh.hexahedra) == result.record.hexahedra
    assert not len(result.mesh.tets) and not len(result.mesh.wedges) and not len(result.mesh.pyramids)
    given = result.map.mesh
    corners = np.asarray(given.vertices)[np.asarray(given.tets)]
    volume = np.linalg.det(corners[:, 1:] - corners[:, :1]).sum() / 6
    assert volume_of(result.mesh) == pytest.approx(volume, rel=0.015)
    assert result.record.hexahedra == pytest.approx(700, rel=0.2)


WALLED = ("s02c_prism", "s10c_cyl_cutsphere", "n12c_limit_cycle_genus0", "hexalab_fandisk")


@pytest.mark.parametrize("name", WALLED)
def test_walls_of_our_own_bound_fewer_blocks_than_those_of_the_file(shared_data, name):
    given = read_seamless_map(map_file(shared_data, name))
    walled = of.volume.motorcycle_complex(given)
    report = of.volume.seamless_report(walled)
    assert not len(report.flipped) and not len(report.torn)
    assert report.volume == pytest.approx(of.volume.seamless_report(given).volume, rel=1e-9)
    blocks, theirs = of.volume.block_complex(walled), of.volume.block_complex(given)
    assert len(blocks.sizes) < len(theirs.sizes)
    assert np.prod(np.asarray(blocks.sizes), axis=1).sum() == pytest.approx(report.volume)


def test_maps_without_walls_get_their_own(shared_data):
    given = read_seamless_map(map_file(shared_data, "s02c_prism"))
    bare = of.volume.SeamlessMap(
        given.mesh, given.parameters, np.zeros((0, 3), np.int32), given.features, given.corners
    )
    result = of.compute_hex_mesh(bare, cells=300)
    require_conforming(result.mesh)
    assert result.record.walls == "own" and set(result.record.irregular_edges) == {"3"}
    anew = of.compute_hex_mesh(given, cells=300, walls="own")
    assert np.array_equal(anew.mesh.vertices, result.mesh.vertices)
    assert of.compute_hex_mesh(given, cells=300).record.walls == "file"
    with pytest.raises(of.InvalidInput, match="walls"):
        of.compute_hex_mesh(given, walls="none")


def moved_inside(given, seed):
    """Parameters of vertices moved whose tets all have the same charts, so that no wall goes along triangles."""
    rng = np.random.default_rng(seed)
    tets, parameters = np.asarray(given.mesh.tets), np.array(given.parameters).reshape(-1, 4, 3)
    places: dict[int, set] = {}
    for tet, at in zip(tets.tolist(), np.round(parameters, 9).tolist(), strict=True):
        for vertex, place in zip(tet, at, strict=True):
            places.setdefault(vertex, set()).add(tuple(place))
    outside = set(np.asarray(of.volume.boundary_surface(given.mesh).vertex_map).tolist())
    one_place = np.array([len(places[v]) == 1 for v in range(len(given.mesh.vertices))])
    for vertex in sorted(set(places) - outside):
        here = tets == vertex
        star, before = here.any(axis=1), parameters.copy()
        if not one_place[tets[star]].all():
            continue
        parameters[here] += rng.normal(size=3) * 0.05 * np.ptp(parameters[star], axis=(0, 1))
        old, new = (np.linalg.det(p[star, 1:] - p[star, :1]) for p in (before, parameters))
        if (new < 0.3 * old).any():
            parameters = before
    return of.volume.SeamlessMap(given.mesh, parameters.reshape(-1, 12), features=given.features)


@pytest.mark.parametrize("name", ["s02c_prism", "scof_fanpart"])
def test_walls_cut_tets_that_lie_in_their_way(shared_data, name):
    given = moved_inside(read_seamless_map(map_file(shared_data, name)), 1)
    walled = of.volume.motorcycle_complex(given)
    report = of.volume.seamless_report(walled)
    assert not len(report.flipped) and not len(report.torn)
    sizes = np.asarray(of.volume.block_complex(walled).sizes)
    assert np.prod(sizes, axis=1).sum() == pytest.approx(report.volume)
    moved = not np.array_equal(walled.mesh.vertices, given.mesh.vertices)
    assert moved or len(walled.mesh.tets) > len(given.mesh.tets)
    require_conforming(of.volume.all_hex(walled, cells=500).mesh)


def test_every_phase_has_its_seconds_and_memory():
    record = of.compute_hex_mesh(box_map(), cells=64).record
    phases = ["read", "walls", "blocks", "numbers", "hexahedra", "improve", "check"]
    assert list(record.wall_seconds) == list(record.cpu_seconds) == list(record.phase_peak_mb) == phases
    assert record.peak_mb == max(record.phase_peak_mb.values()) and record.seconds >= record.wall_seconds["improve"]


def test_irregular_edges_are_those_of_the_map(shared_data):
    """A prism over a triangle has one curve of valence 3, through all layers; a cube none."""
    assert of.compute_hex_mesh(map_file(shared_data, "s01c_cube"), cells=100).record.irregular_edges == {}
    prism = of.compute_hex_mesh(map_file(shared_data, "s02c_prism"), cells=300).record
    layers = prism.irregular_edges.pop("3")
    assert not prism.irregular_edges and prism.hexahedra % layers == 0


def test_features_and_corners_of_the_map_are_kept(shared_data):
    record = of.compute_hex_mesh(map_file(shared_data, "s07c_notch"), cells=500).record
    assert record.feature_deviation.corners < 1e-9
    assert of.compute_hex_mesh(map_file(shared_data, "s02c_prism"), cells=300).record.feature_deviation.curves < 1e-9


@pytest.mark.parametrize("scale", [1e-3, 1.0, 1e4])
def test_the_size_of_parameters_does_not_matter(scale):
    result = of.compute_hex_mesh(box_map(scale), cells=216)
    assert result.record.hexahedra == 216 and result.record.scaled_jacobian.min == pytest.approx(1)


def test_files_hold_the_map_bit_by_bit(shared_data, tmp_path):
    given = read_seamless_map(map_file(shared_data, "s10c_cyl_cutsphere"))
    for name in ("copy.hexex", "copy.hexex.gz"):
        write_seamless_map(tmp_path / name, given)
        read = read_seamless_map(tmp_path / name)
        for field in ("parameters", "walls", "features", "corners"):
            assert np.array_equal(getattr(read, field), getattr(given, field))
        assert np.array_equal(read.mesh.vertices, given.mesh.vertices)


@pytest.mark.parametrize("suffix", [".ovm", ".ovmb"])
def test_half_faces_hold_the_parameters_of_the_vertex_opposite(shared_data, tmp_path, suffix):
    given = read_seamless_map(map_file(shared_data, "s02c_prism"))
    write_seamless_map(tmp_path / f"map{suffix}", given)
    mesh = read_ovm(tmp_path / f"map{suffix}", binary=suffix == ".ovmb")
    values = mesh.properties["halfface", "HexHex::Parametrization"]
    triangles, points = mesh.triangles(), np.asarray(mesh.vertices)
    expected = {}
    for tet, at in zip(np.asarray(given.mesh.tets).tolist(), np.asarray(given.parameters), strict=True):
        for k in range(4):
            expected[frozenset(tet), tet[k]] = at[3 * k : 3 * k + 3]
    for cell in mesh.cells:
        corners = frozenset(triangles[cell // 2].ravel().tolist())
        for half in cell:
            (apex,) = corners - set(triangles[half // 2].tolist())
            assert np.array_equal(values[half], expected[corners, apex])
    assert np.array_equal(points, given.mesh.vertices)


def test_rationals_are_rounded_to_the_nearest_number(shared_data):
    path = map_file(shared_data, "s01c_cube")
    lines = gzip.decompress(path.read_bytes()).decode().splitlines()
    words = lines[int(lines[0]) + 2].split()[4:]
    exact = [int(a) / int(b or 1) for a, _, b in (word.partition("/") for word in words)]
    assert np.array_equal(read_seamless_map(path).parameters[0], exact)


def with_word(text, word):
    """In place of the first vertex's x."""
    words = text.split()
    return " ".join([words[0], word, *words[2:]])


DAMAGED = {
    "empty": (lambda text: "", "ends within"),
    "cut short": (lambda text: text[: len(text) // 2], "cut short|ends within|announced"),
    "a word": (lambda text: with_word(text, "zero"), "finite numbers"),
    "nan": (lambda text: with_word(text, "nan"), "finite numbers"),
    "division by zero": (lambda text: with_word(text, "1/0"), "finite numbers"),
    "count below zero": (lambda text: "-" + text, "whole number"),
    "count too high": (lambda text: "999999999" + text, "announced"),
    "count too low": (lambda text: "1" + text[text.index("\n") :], "follow|whole number|finite numbers|announced"),
    "words behind": (lambda text: text + "\n1 2 3\n", "follow"),
}


@pytest.mark.parametrize("damage", DAMAGED)
def test_damaged_files_are_named(tmp_path, damage):
    path = tmp_path / "map.hexex"
    write_seamless_map(path, box_map())
    change, message = DAMAGED[damage]
    path.write_text(change(path.read_text()))
    with pytest.raises(of.IoError, match=message) as error:
        read_seamless_map(path)
    assert str(path) in str(error.value)


def test_maps_that_have_no_blocks_are_refused_by_kind(shared_data):
    given = read_seamless_map(map_file(shared_data, "s02c_prism"))
    parameters = np.array(given.parameters)
    for kind, change in {
        "flipped_tet": lambda p: p[7].reshape(4, 3).__setitem__(slice(None), p[7].reshape(4, 3)[[1, 0, 2, 3]]),
        "torn_map": lambda p: p.__setitem__(7, 1.1 * p[7]),
    }.items():
        changed = parameters.copy()
        change(changed)
        for walls in ("file", "own"):
            with pytest.raises(of.GeometryError) as error:
                of.compute_hex_mesh(of.volume.SeamlessMap(given.mesh, changed, given.walls), walls=walls)
            assert error.value.kind == kind and 7 in error.value.elements
    with pytest.raises(of.GeometryError) as error:
        of.volume.block_complex(of.volume.SeamlessMap(given.mesh, parameters))
    assert error.value.kind in ("not_a_box", "bent_wall")


def test_numbers_too_large_or_small_to_compute_with_are_refused_as_such():
    for scale in (1e-300, 1e300):
        with pytest.raises(of.InvalidInput, match="parameters reach") as error:
            of.compute_hex_mesh(box_map(scale))
        assert error.value.kind == "size_out_of_range"


def test_other_inputs_and_options_are_refused(tmp_path):
    of.write_surface(generate("box"), tmp_path / "box.stl")
    with pytest.raises(of.InvalidInput, match="compute_seamless_map"):
        of.compute_hex_mesh(tmp_path / "box.stl")
    with pytest.raises(of.IoError):
        of.compute_hex_mesh(tmp_path / "missing.hexex")
    for options in ({"cells": -1}, {"edge_length": -1.0}, {"cells": 5, "edge_length": 1.0}, {"edge_length": 1e-5}):
        with pytest.raises(of.InvalidInput):
            of.compute_hex_mesh(box_map(), **options)


def test_the_command_writes_a_whole_folder_or_none(tmp_path):
    write_seamless_map(tmp_path / "box.hexex", box_map())
    octafield("hex-mesh", tmp_path / "box.hexex", "-o", tmp_path / "out", "--cells", "64", "--json",
              tmp_path / "told.json", "-q", check=0)  # fmt: skip
    names = ["mesh.mesh", "mesh.msh", "mesh.vtu", "result.json"]
    assert sorted(path.name for path in (tmp_path / "out").iterdir()) == names
    told = json.loads((tmp_path / "told.json").read_text())
    assert told["hexahedra"] == 64 and told["stage"] == "extracted" and told["inverted"] == 0
    for name in names[:3]:
        mesh = of.read_cells(tmp_path / "out" / name)
        require_conforming(mesh)
        assert len(mesh.hexahedra) == 64
    (tmp_path / "bad.hexex").write_text("1\n0 0 0\n")
    octafield("hex-mesh", tmp_path / "bad.hexex", "-o", tmp_path / "none", "-q", check=2)
    assert not (tmp_path / "none").exists()


def test_hexahedra_that_stay_turned_over_in_part_are_no_result(shared_data):
    given = read_seamless_map(map_file(shared_data, "s07c_notch"))
    stretched = np.array(given.parameters) * np.tile([1, 1, 100], 4)
    map_ = of.volume.SeamlessMap(given.mesh, stretched, given.walls)
    with pytest.raises(of.SolverError, match="more cells") as error:
        of.compute_hex_mesh(map_, cells=500)
    assert error.value.kind == "inverted_cells" and len(error.value.elements)


def test_a_number_that_blocks_do_not_allow_is_told(shared_data):
    result = of.compute_hex_mesh(map_file(shared_data, "s10c_cyl_cutsphere"), cells=20).record
    assert result.hexahedra > 22 and any("20 wanted" in note for note in result.notes)
    assert not any("wanted" in note for note in of.compute_hex_mesh(box_map(), cells=64).record.notes)


def test_the_command_blames_the_number_where_hexahedra_stay_inverted(shared_data, tmp_path):
    path = map_file(shared_data, "s10c_cyl_cutsphere")
    done = octafield("hex-mesh", path, "-o", tmp_path / "none", "--edge-length", "1e9", "-q")
    assert done.returncode in (0, 2) and "please report" not in done.stderr


def test_parts_give_what_the_whole_gives(shared_data):
    given = read_seamless_map(map_file(shared_data, "s02c_prism"))
    report = of.volume.seamless_report(given)
    assert not len(report.flipped) and not len(report.torn) and report.unaligned == 0 and report.residual < 1e-9
    blocks = of.volume.block_complex(given)
    assert len(blocks.sizes) == 3 and sorted(set(np.asarray(blocks.tet_block))) == [0, 1, 2]
    assert np.prod(np.asarray(blocks.sizes), axis=1).sum() == pytest.approx(report.volume)
    numbers = of.volume.arc_numbers(blocks, 0.5)
    made = of.volume.block_hexahedra(given, blocks, numbers.numbers)
    assert len(made.mesh.hexahedra) == numbers.hexahedra == len(made.blocks)
    assert numbers.bound <= numbers.deviation + 1e-9
