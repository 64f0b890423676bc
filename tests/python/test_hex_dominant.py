"""Hex-dominant meshes on arrays and from inputs: conforming, positive, sized as wanted, judged by figures that are
right."""

import dataclasses

import numpy as np
import octafield as of
import pytest
from hex_mesh_checks import corner_jacobians, require_conforming, volume_of
from octafield.domain.generators import generate
from octafield.hexdom import hex_mesh
from octafield.hexdom.faces import nonconforming_faces
from octafield.hexdom.quality import boundary_deviation, figures_of, spread, volume_errors

CUBE = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0], [0, 0, 1], [1, 0, 1], [1, 1, 1], [0, 1, 1]]
HEX = [[0, 1, 2, 3, 4, 5, 6, 7]]


@pytest.fixture(scope="module")
def box():
    """A field on a unit cube of tets."""
    return of.compute_field(generate("box"), of.FieldOptions(edge_length=0.3))


@pytest.fixture(scope="module", params=["cylinder", "ball", "torus"])
def curved(request):
    return of.compute_hex_dominant(generate(request.param), hex_options=of.HexMeshOptions(cells=250))


def test_a_cube_is_meshed_by_as_many_cubes_as_are_wanted(box):
    result = of.compute_hex_dominant(box, hex_options=of.HexMeshOptions(cells=64))
    assert len(result.mesh.hexahedra) == 64 == len(result.scaled_jacobians)
    assert result.scaled_jacobians.min() > 0.99 and result.record.hex_volume_share == 1
    require_conforming(result.mesh)
    corners = np.asarray(result.mesh.vertices)[result.support == 3]
    assert sorted(map(tuple, corners.round(9) + 0.0)) == sorted(map(tuple, np.array(CUBE, float)))
    assert (result.support == 2).sum() == 12 * 3 and (result.support == 1).sum() == 6 * 9


def test_meshes_of_curved_shapes_conform_and_are_positive(curved):
    require_conforming(curved.mesh)
    volume = np.asarray(of.volume.tet_volumes(curved.field.tets)).sum()
    assert volume_of(curved.mesh) == pytest.approx(volume, rel=0.1)  # chords of a coarse mesh
    assert 0.4 < curved.record.hex_volume_share < 1 and len(curved.mesh.pyramids)


def test_figures_are_those_of_the_arrays(curved):
    record, mesh = curved.record, curved.mesh
    counts = {kind: len(getattr(mesh, kind)) for kind in ("tets", "hexahedra", "wedges", "pyramids")}
    assert record.cells == counts and record.vertices == len(mesh.vertices)
    assert record.hex_number_share == counts["hexahedra"] / sum(counts.values())
    volume = float(np.asarray(of.volume.tet_volumes(curved.field.tets)).sum())
    assert record.volume_error == pytest.approx(abs(volume_of(mesh) - volume) / volume, rel=1e-6)
    only = of.volume.MixedMesh(mesh.vertices, hexahedra=mesh.hexahedra)
    share = np.asarray(of.volume.cell_volumes(only)).sum() / volume_of(mesh)
    assert record.hex_volume_share == pytest.approx(share)
    worst = of.volume.scaled_jacobians(only).min()
    assert record.scaled_jacobian["hexahedra"].min == pytest.approx(worst) and worst > 0.3
    assert record.inverted == record.nonconforming_faces == 0
    assert 0 < record.boundary_deviation.rms < record.boundary_deviation.max < 0.1
    assert record.edge_length.p05 < record.edge_length.median < record.edge_length.p95
    assert record.edge_length.target == pytest.approx((volume / 250) ** (1 / 3))
    assert record.edge_length.median == pytest.approx(record.edge_length.target, rel=0.2)
    assert record.steps.lattice_hexahedra == curved.counts.lattice_hexahedra
    assert record.steps.lost.unusable == curved.counts.lost.unusable
    phases = {"sizes", "periodic_map", "lattice", "mesh_surface", "tetrahedralize", "conform", "check"}
    assert phases <= set(record.phase_peak_mb) and phases | {"read", "smooth"} <= set(record.wall_seconds)
    assert all(megabytes > 10 for megabytes in record.phase_peak_mb.values())


def from_arrays(curved, threads):
    length = curved.record.edge_length.target
    return of.volume.hex_dominant(curved.field.tets, curved.field.frames, edge_length=length, threads=threads)


@pytest.fixture(scope="module")
def of_one_thread(curved):
    return from_arrays(curved, threads=1)


def test_the_function_on_arrays_gives_what_the_whole_way_gives(curved, of_one_thread):
    for name in ("vertices", "tets", "hexahedra", "wedges", "pyramids"):
        assert np.array_equal(getattr(of_one_thread.mesh, name), getattr(curved.mesh, name))
    assert np.array_equal(of_one_thread.support, curved.support) and len(of_one_thread.regions) == 0


def test_the_number_of_threads_changes_no_bit(curved, of_one_thread):
    one, three = of_one_thread.mesh, from_arrays(curved, threads=3).mesh
    assert np.array_equal(one.vertices, three.vertices)
    assert np.array_equal(one.tets, three.tets) and np.array_equal(one.hexahedra, three.hexahedra)


def test_options_are_those_of_the_struct_and_bad_ones_are_named(box):
    assert of.volume.HexDominantOptions.words["correction"] == ["none", "isotropic", "axes"]
    assert of.volume.HexDominantOptions.words["points"] == ["best", "periodic", "frontal"]
    for wrong, kind in [
        ({"correction": "all"}, "unknown_word"),
        ({"points": "front"}, "unknown_word"),
        ({"edge_length": -1.0}, "edge_length"),
        ({"edge_length": np.nan}, "not_finite"),
        ({"sizes": np.ones(3)}, "wrong_size"),
        ({"sizes": np.zeros(len(box.tets.vertices))}, "edge_length"),
        ({"min_scaled_jacobian": 1.5}, "min_scaled_jacobian"),
    ]:
        with pytest.raises(of.InvalidInput) as caught:
            of.volume.hex_dominant(box.tets, box.frames, **wrong)
        assert next(iter(wrong)).split("_")[0] in str(caught.value), kind
    with pytest.raises(TypeError, match="unexpected keyword argument 'edge'"):
        of.volume.hex_dominant(box.tets, box.frames, edge=1)
    with pytest.raises(of.InvalidInput, match="frames"):
        of.volume.hex_dominant(box.tets, box.frames[1:])


@pytest.mark.parametrize(
    "wrong",
    [
        {"edge_length": -1.0},
        {"edge_length": np.inf},
        {"cells": -3},
        {"cells": 2.5},
        {"edge_length": 1.0, "cells": 5},
        {"correction": "axis"},
        {"points": "lattice"},
        {"min_scaled_jacobian": 0.0},
        {"refinements": 7},
        {"hold_angle": 2.0},
    ],
)
def test_options_out_of_range_are_refused(wrong):
    with pytest.raises(of.InvalidInput):
        of.HexMeshOptions(**wrong)


def test_options_of_the_whole_way_have_the_defaults_of_the_struct():
    struct, ours = of.volume.HexDominantOptions(), of.HexMeshOptions()
    for field in dataclasses.fields(ours):
        if field.name != "cells":
            assert getattr(ours, field.name) == getattr(struct, field.name), field.name


def test_the_better_of_map_and_front_is_kept_and_recorded():
    field = of.compute_field(generate("torus"), of.FieldOptions(edge_length=0.4))
    made = {
        points: of.compute_hex_dominant(field, hex_options=of.HexMeshOptions(edge_length=0.4, points=points))
        for points in ("best", "periodic", "frontal")
    }
    shares = {points: result.record.hex_volume_share for points, result in made.items()}
    better = max(("periodic", "frontal"), key=shares.__getitem__)
    assert shares["periodic"] < 0.98 and shares["best"] == shares[better]
    assert made["best"].record.points == better
    assert np.array_equal(made["best"].mesh.vertices, made[better].mesh.vertices)
    assert {"periodic_map", "front"} <= made["best"].record.wall_seconds.keys()


def test_a_front_is_not_tried_where_the_map_leaves_nothing(box):
    made = of.volume.hex_dominant(box.tets, box.frames, edge_length=0.25)
    assert made.points == "periodic" and len(made.mesh.tets) == 0


@pytest.mark.parametrize("shape", ["cylinder", "ball"])
def test_points_of_a_front_make_a_conforming_mesh_too(shape):
    wanted = of.HexMeshOptions(cells=400, points="frontal")
    result = of.compute_hex_dominant(generate(shape), hex_options=wanted)
    require_conforming(result.mesh)
    record = result.record
    assert record.options["points"] == "frontal" and record.steps.lattice_hexahedra == 0
    assert record.hex_volume_share > 0.5 and record.volume_error < 0.1 and record.inverted == 0
    assert record.wall_seconds["front"] > 0 and "periodic_map" not in record.wall_seconds
    assert record.steps.tets == result.field.tets.tet_count
    assert record.edge_length.median == pytest.approx(record.edge_length.target, rel=0.2)


def test_phases_are_named_and_false_stops(box):
    seen = []
    of.volume.hex_dominant(box.tets, box.frames, progress=lambda phase, *_: seen.append(phase))
    assert list(dict.fromkeys(seen))[:3] == ["sizes", "periodic map", "lattice"]
    with pytest.raises(of.Cancelled):
        of.compute_hex_dominant(box, progress=lambda phase, *_: phase != "lattice")


def test_parts_of_the_way_can_be_called_one_by_one(box):
    tets, of_tets = box.tets, of.volume.tet_frames(box.tets, box.frames)
    fine, parents, parent = of.volume.refine_tets(tets, np.ones(tets.tet_count, np.uint8))
    assert fine.tet_count == 8 * tets.tet_count == len(parent)
    assert np.allclose(fine.vertices, np.asarray(tets.vertices)[parents].mean(axis=1))
    grid = of.volume.periodic_map(tets, of_tets, np.full((tets.tet_count, 3), 0.25), hold_angle=0.7)
    cells = of.volume.lattice_cells(tets, grid, min_scaled_jacobian=0.4)
    assert len(cells.hexahedra) == 64 and cells.lost.unusable == 0
    corners = np.asarray(tets.vertices)[np.asarray(tets.tets)[cells.tet]]
    assert np.allclose(np.einsum("pc,pcx->px", cells.weights, corners), cells.points)
    with pytest.raises(of.InvalidInput, match="map.frames"):
        of.volume.lattice_cells(fine, grid)
    grid.faces.tets[0, 0] = 10**6
    with pytest.raises(of.InvalidInput, match="map.faces"):
        of.volume.lattice_cells(tets, grid)
    with pytest.raises(of.InvalidInput, match="lengths"):
        of.volume.periodic_map(tets, of_tets, np.ones((3, 3)))


def test_tets_of_a_cube_are_recombined_and_made_to_conform():
    cube = np.array(CUBE, float)
    six = [[0, 1, 2, 6], [0, 2, 3, 6], [0, 3, 7, 6], [0, 7, 4, 6], [0, 4, 5, 6], [0, 5, 1, 6]]
    joined, report = of.volume.recombine(of.volume.MixedMesh(cube, six))
    assert len(joined.hexahedra) == 1 and len(joined.tets) == 0 and report.hexahedra == 1
    beside = [[1, 2, 6, 8], [1, 6, 5, 8]]  # two tets on the side x = 1 of a hexahedron
    mixed = of.volume.MixedMesh([*CUBE, [1.7, 0.5, 0.5]], beside, HEX)
    assert nonconforming_faces(mixed) > 0
    made, report = of.volume.conform(mixed)
    require_conforming(made)
    assert len(made.pyramids) == report.combined == 1


def test_a_certificate_of_positivity_tells_twisted_cells_from_sound_ones():
    twisted = np.array(CUBE, float)[[0, 1, 2, 3, 6, 7, 4, 5]]  # the top turned by half a turn
    mesh = of.volume.MixedMesh([*CUBE, *twisted], hexahedra=[HEX[0], [8 + k for k in HEX[0]]])
    assert of.volume.proven_positive(mesh).tolist() == [1, 0]
    assert of.volume.proven_positive(mesh, depth=0).tolist() == [1, 0]
    with pytest.raises(of.InvalidInput, match="depth"):
        of.volume.proven_positive(mesh, depth=-1)


def test_improving_moves_free_vertices_only_and_raises_the_worst_cell():
    points = np.array([[x, y, z] for z in range(3) for y in range(3) for x in range(3)], float)
    first = np.array([0, 1, 4, 3, 9, 10, 13, 12])
    cells = [first + step for step in (0, 1, 3, 4, 9, 10, 12, 13)]
    points[13] += 0.35
    support = np.full(27, 3, np.uint8)
    support[13] = 0
    mesh = of.volume.MixedMesh(points, hexahedra=cells)
    moved = of.volume.improve_cells(mesh, support, of.TriangleMesh(), of.FeatureGraph())
    assert of.volume.scaled_jacobians(moved).min() > of.volume.scaled_jacobians(mesh).min() + 0.1
    assert np.array_equal(np.delete(moved.vertices, 13, axis=0), np.delete(points, 13, axis=0))
    support[5] = 9
    with pytest.raises(of.InvalidInput, match="vertex 5 has 9"):
        of.volume.improve_cells(mesh, support, of.TriangleMesh(), of.FeatureGraph())


def test_each_way_for_faces_not_to_match_is_counted():
    sound = of.volume.MixedMesh(CUBE, hexahedra=HEX)
    assert nonconforming_faces(sound) == 0
    split = of.volume.MixedMesh([*CUBE, [1.7, 0.5, 0.5]], [[1, 2, 6, 8], [1, 6, 5, 8]], HEX)
    assert nonconforming_faces(split) == 2
    half = of.volume.MixedMesh([*CUBE, [1.7, 0.5, 0.5]], [[1, 2, 6, 8]], HEX)
    assert nonconforming_faces(half) == 1
    crowded = of.volume.MixedMesh([*CUBE, [1.7, 0.5, 0.5]], pyramids=[[1, 2, 6, 5, 8]] * 2, hexahedra=HEX)
    assert nonconforming_faces(crowded) >= 1
    twisted = of.volume.MixedMesh([*CUBE, [1.7, 0.5, 0.5]], hexahedra=HEX, pyramids=[[1, 6, 2, 5, 8]])
    assert nonconforming_faces(twisted) == 1


def test_figures_of_a_cube_that_was_moved_are_those_of_the_move(box):
    mesh = of.compute_hex_dominant(box, hex_options=of.HexMeshOptions(cells=27)).mesh
    moved = of.volume.MixedMesh(np.asarray(mesh.vertices) + [0.02, 0, 0], hexahedra=mesh.hexahedra)
    largest, rms = boundary_deviation(moved, None, box.tets)
    assert largest == pytest.approx(0.02 / 3**0.5) and rms == pytest.approx(0.02 / 3**0.5 * (2 / 6) ** 0.5, rel=0.05)
    larger = of.volume.MixedMesh(np.asarray(mesh.vertices) * 1.1, hexahedra=mesh.hexahedra)
    assert figures_of(larger, None, box.tets).volume_error == pytest.approx(1.1**3 - 1)
    volumes = np.asarray(of.volume.cell_volumes(mesh))
    two = of.TetDomain(box.tets.mesh, regions=(np.arange(box.tets.tet_count) == 0).astype(int))
    first = float(np.asarray(of.volume.tet_volumes(two))[0])
    assert volume_errors(volumes, np.zeros(27, int), two)[1] == pytest.approx(1)  # region 1 is lost
    assert first > 0
    inside_out = of.volume.MixedMesh(mesh.vertices, hexahedra=np.asarray(mesh.hexahedra)[:, [4, 5, 6, 7, 0, 1, 2, 3]])
    assert figures_of(inside_out, None, box.tets).inverted == 27 and (corner_jacobians(inside_out) < 0).all()


def test_a_spread_has_its_quantiles():
    found = spread(np.arange(101.0))
    assert (found.min, found.p05, found.median, found.p95, found.mean) == (0, 5, 50, 95, 50)


def test_a_mesh_that_is_not_sound_is_an_error_and_no_result(box, monkeypatch):
    def damaged(*arguments, **options):
        made = real(*arguments, **options)
        made.mesh.hexahedra[0] = made.mesh.hexahedra[0][[4, 5, 6, 7, 0, 1, 2, 3]]
        return made

    real = hex_mesh._core.hex_dominant
    monkeypatch.setattr(hex_mesh._core, "hex_dominant", damaged)
    with pytest.raises(of.SolverError, match="is not sound") as caught:
        of.compute_hex_dominant(box)
    assert caught.value.kind == "inverted_cell" and caught.value.elements == [0]


def test_more_cells_than_anybody_wants_are_refused_before_the_work(box):
    with pytest.raises(of.InvalidInput, match="asks for about 1e\\+12 cells") as caught:
        of.compute_hex_dominant(box, hex_options=of.HexMeshOptions(edge_length=1e-4))
    assert caught.value.kind == "too_many_cells"


def test_a_field_that_is_given_is_followed(box):
    turn = of.frames.quaternion_exp(np.tile([0, 0, np.pi / 8], (len(box.frames), 1)))
    plain = of.compute_hex_dominant(box.tets, field=box.frames, hex_options=of.HexMeshOptions(cells=64))
    turned = of.compute_hex_dominant(box.tets, field=turn, hex_options=of.HexMeshOptions(cells=64))
    assert plain.record.field.source == "given" and plain.record.hex_volume_share == 1
    assert turned.record.hex_volume_share < 0.9
    with pytest.raises(of.InvalidInput, match="shape"):
        of.compute_hex_dominant(box.tets, field=box.frames[1:])
    with pytest.raises(of.InvalidInput, match="surface"):
        of.compute_hex_dominant(generate("box"), field=box.frames)
    with pytest.raises(of.InvalidInput, match="has its field"):
        of.compute_hex_dominant(box, field=box.frames)


def test_two_regions_meet_in_their_interface(box):
    """A cube and its mirror image."""
    points, tets = np.asarray(box.tets.vertices), np.asarray(box.tets.tets)
    on_plane = points[:, 0] == 0
    image = np.where(on_plane, np.arange(len(points)), len(points) + np.cumsum(~on_plane) - 1)
    mirrored = points[~on_plane] * [-1, 1, 1]
    mesh = of.TetMesh(np.concatenate([points, mirrored]), np.concatenate([tets, image[tets][:, [1, 0, 2, 3]]]))
    domain = of.TetDomain(mesh, regions=np.repeat([3, 7], len(tets)))
    result = of.compute_hex_dominant(domain, hex_options=of.HexMeshOptions(edge_length=0.25))
    require_conforming(result.mesh)
    assert sorted(set(result.regions)) == [3, 7] and result.record.regions == 2
    assert result.record.region_volume_error < 1e-9
    middles = np.concatenate([np.asarray(result.mesh.vertices)[rows].mean(axis=1) for rows in (
        result.mesh.tets, result.mesh.hexahedra, result.mesh.wedges, result.mesh.pyramids) if len(rows)])  # fmt: skip
    assert np.array_equal(result.regions == 3, middles[:, 0] > 0)


def test_the_record_reads_back_and_the_result_shows_itself(curved, tmp_path):
    from octafield.hexdom.files import write_hex_result
    from octafield.records.record_file import any_record

    write_hex_result(curved, tmp_path)
    assert any_record(tmp_path / "result.json") == curved.record
    with pytest.raises(of.IoError, match="but of a hex-dominant mesh"):
        of.read_record(tmp_path / "result.json")
    assert "of the volume in" in repr(curved)
    shot = curved.scene().screenshot(return_img=True)
    assert len(np.unique(shot.reshape(-1, 3), axis=0)) > 100
