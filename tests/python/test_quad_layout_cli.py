"""octafield quad-layout: files, record, picture, and what it refuses."""

import json

import meshio
import numpy as np
import octafield as of
import pytest
import pyvista
from octafield.command_line import fields as cli
from octafield.records.quad_layout import QuadLayoutRecord
from octafield.records.record_file import any_record
from pipeline_fixtures import octafield
from quad_mesh_checks import disk, four_points, irregular, require_conforming
from surface_fixtures import square
from test_quad_layout_runs import ring_points
from typer.testing import CliRunner

FILES = ["field.vtp", "layout.vtp", "mesh.msh", "mesh.vtu", "result.json"]


def run(*arguments):
    """In this process."""
    return CliRunner().invoke(cli.app, ["quad-layout", *map(str, arguments)])


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """Of a run on a disk with four points, with its JSON beside."""
    folder = tmp_path_factory.mktemp("disk")
    of.write_surface(disk(), folder / "disk.obj")
    (folder / "points.json").write_text(json.dumps(four_points()))
    octafield("quad-layout", folder / "disk.obj", "-o", folder / "out", "--singularities", folder / "points.json",
              "--quads", "200", "--no-remesh", "--json", folder / "out.json", "-q", check=0)  # fmt: skip
    return folder


@pytest.fixture(scope="module")
def record(folder):
    return json.loads((folder / "out.json").read_text())


@pytest.fixture(scope="module")
def mesh(folder):
    return of.read_cells(folder / "out" / "mesh.vtu")


def test_the_folder_has_the_files_and_nothing_else(folder, record):
    assert sorted(path.name for path in (folder / "out").iterdir()) == FILES
    assert record["files"] == ["mesh.vtu", "mesh.msh", "layout.vtp", "field.vtp", "result.json"]
    assert record == json.loads((folder / "out" / "result.json").read_text())


def test_the_json_has_what_a_table_of_layouts_needs(record, mesh):
    assert record["quads"] == len(mesh.quads) and record["patches"] == 5
    assert record["index_sum"] == 1 and record["misalignment"] == []
    assert sorted(irregular(mesh, 1).values()) == [p["index_times_four"] for p in record["singular_points"]]
    assert record["irregular_vertices"] == 4
    assert record["t_junctions"] == record["inverted"] == record["nonconforming_edges"] == 0
    assert list(record["scaled_jacobian"]) == ["min", "p05", "mean"]
    assert list(record["surface_deviation"]) == ["max", "rms"]
    phases = {"read", "mesh", "surface", "impose", "trace", "map", "check", "write"}
    assert phases - {"mesh"} <= set(record["wall_seconds"]) and set(record["cpu_seconds"]) == set(
        record["wall_seconds"]
    )
    assert max(record["phase_peak_mb"].values()) <= record["peak_mb"]
    assert record["point_source"].endswith("points.json") and record["options"]["quads"] == 200


def test_the_record_is_read_back_as_what_it_is(folder, record):
    path = folder / "out" / "result.json"
    found = any_record(path)
    assert isinstance(found, QuadLayoutRecord) and found.to_dict() == record
    assert list(record) == [name for name in QuadLayoutRecord.order() if name in record]
    with pytest.raises(of.IoError, match="no record of a frame field, but of a quad layout"):
        of.read_record(path)


def test_vtk_reads_the_quads_with_their_data(folder, mesh, record):
    grid = pyvista.read(folder / "out" / "mesh.vtu")
    assert set(grid.celltypes) == {9} and grid.n_cells == record["quads"]
    assert np.allclose(grid.cell_data["scaled_jacobian"], of.surface.scaled_jacobians(mesh), atol=1e-12)
    assert set(grid.cell_data["block"]) == set(range(5)) and grid.cell_data["chords"].shape == (grid.n_cells, 2)
    found, rim = require_conforming(mesh, 1)
    assert [found[v] for v in range(grid.n_points)] == grid.point_data["quads"].tolist()
    assert sorted(rim) == np.flatnonzero(grid.point_data["boundary"]).tolist()
    assert bytes(grid.field_data["program"]).decode().startswith("octafield ")


def test_meshio_and_gmsh_read_the_same_quads_by_block(folder, mesh):
    blocks = pyvista.read(folder / "out" / "mesh.vtu").cell_data["block"]
    found = meshio.read(folder / "out" / "mesh.msh")
    assert np.array_equal(found.cells_dict["quad"], mesh.quads) and np.allclose(found.points, mesh.vertices)
    assert np.array_equal(found.cell_data["gmsh:physical"][0], np.asarray(blocks) + 1)
    chords = [found.cell_data[name][0] for name in ("first_chord", "second_chord")]
    assert np.array_equal(np.column_stack(chords), pyvista.read(folder / "out" / "mesh.vtu").cell_data["chords"])
    import gmsh

    gmsh.initialize(interruptible=False)
    try:
        gmsh.option.set_number("General.Terminal", 0)
        gmsh.open(str(folder / "out" / "mesh.msh"))
        counts = [len(gmsh.model.mesh.get_elements(2, entity)[1][0]) for _, entity in gmsh.model.get_entities(2)]
        assert counts == np.bincount(blocks).tolist()
    finally:
        gmsh.finalize()


@pytest.mark.parametrize("way", ["t-mesh", "separatrices"])
def test_the_layout_is_in_a_file_of_its_own(folder, record, tmp_path, way):
    place = folder / "out"
    if way == "separatrices":
        place = tmp_path / "out"
        done = run(folder / "disk.obj", "-o", place, "--singularities", folder / "out" / "result.json",
                   "--quads", "200", "--no-remesh", "--layout", way, "-q")  # fmt: skip
        assert done.exit_code == 0, done.output
    layout = pyvista.read(place / "layout.vtp")
    kind, number = layout.cell_data["kind"], layout.cell_data["number"]
    assert [int((kind == k).sum()) for k in (0, 1)] == [8, 12] and layout.n_verts == 8 and layout.n_lines == 12
    assert set(number[kind == 2]) == set(range(record["patches"]))
    assert (layout.cell_data["chord"][kind == 1] >= 0).all() and (layout.cell_data["chord"][kind != 1] == -1).all()
    assert sorted(layout.cell_data["index_times_four"][kind == 0]) == [0] * 4 + [1] * 4
    areas = layout.compute_cell_sizes(length=False, volume=False)["Area"][kind == 2]
    lines = layout.compute_cell_sizes(area=False, volume=False)["Length"][kind == 1]
    rim = lines[layout.cell_data["boundary"][kind == 1] > 0].sum()
    if way == "separatrices":  # polygons that tile the polygon of 48 sides
        assert areas.sum() == pytest.approx(24 * np.sin(np.pi / 24), rel=1e-9)
        assert rim == pytest.approx(2 * np.pi, rel=2e-3)
    else:  # the quads
        quads = pyvista.read(place / "mesh.vtu")
        edges = quads.extract_feature_edges(feature_edges=False, manifold_edges=False)
        assert areas.sum() == pytest.approx(quads.compute_cell_sizes()["Area"].sum(), rel=1e-9)
        assert rim == pytest.approx(edges.compute_cell_sizes()["Length"].sum(), rel=1e-9)


def test_the_field_is_in_a_file_of_its_own(folder, record):
    field = pyvista.read(folder / "out" / "field.vtp")
    assert field.n_cells == record["field_triangles"]
    assert np.allclose(np.linalg.norm(field.point_data["direction"], axis=1), 1)
    fours = field.point_data["index_times_four"]
    assert fours.sum() == 4 and np.allclose(np.linalg.norm(field.points[fours == 1], axis=1), 0.5)
    assert np.isfinite(field.point_data["log_size"]).all()


def test_a_record_of_the_folder_gives_the_same_points_again(folder, tmp_path):
    done = run(folder / "disk.obj", "-o", tmp_path / "again", "--singularities", folder / "out" / "result.json",
               "--quads", "200", "--no-remesh", "-q")  # fmt: skip
    assert done.exit_code == 0, done.output
    one, other = (of.read_cells(place / "mesh.vtu") for place in (folder / "out", tmp_path / "again"))
    assert np.allclose(one.vertices, other.vertices, atol=1e-9) and np.array_equal(one.quads, other.quads)


def test_equal_runs_write_equal_files(folder, tmp_path):
    done = run(folder / "disk.obj", "-o", tmp_path / "again", "--singularities", folder / "points.json",
               "--quads", "200", "--no-remesh", "-q")  # fmt: skip
    assert done.exit_code == 0
    for name in FILES[:-1]:
        assert (tmp_path / "again" / name).read_bytes() == (folder / "out" / name).read_bytes()


def test_the_table_for_people_has_the_main_figures(folder, tmp_path):
    done = octafield("quad-layout", folder / "disk.obj", "-o", tmp_path / "out", "--edge-length", "0.15", check=0)
    words = dict(line.rsplit(None, 1) for line in done.stdout.splitlines()[1:] if "  " in line)
    assert words["patches"] == "5" and words["T-junctions"] == "0" and "wrote" in done.stderr


def test_view_draws_blocks_edges_and_points(folder, tmp_path):
    done = octafield("view", folder / "out", "-o", tmp_path / "p.png", "--json", "-", check=0)
    assert json.loads(done.stdout)["files"] == ["mesh.vtu", "layout.vtp"]
    image = pyvista.read(tmp_path / "p.png").active_scalars.reshape(-1, 3)[::5].astype(int)
    assert ((image[:, 0] > 180) & (image[:, 1] < 130) & (image[:, 2] < 60)).any()  # points of valence 3
    assert (image.max(axis=1) < 60).any()  # sides
    pale = np.unique((image[(image.min(axis=1) > 130) & (np.ptp(image, axis=1) > 25)] // 16), axis=0)
    assert len(pale) >= 3  # blocks
    (folder / "out" / "layout.vtp").rename(tmp_path / "layout.vtp")
    try:
        done = octafield("view", folder / "out", "-o", tmp_path / "q.png", "--json", "-", check=0)
        assert json.loads(done.stdout)["files"] == ["mesh.vtu"]
    finally:
        (tmp_path / "layout.vtp").rename(folder / "out" / "layout.vtp")


def test_a_defect_found_at_the_end_writes_nothing(folder, tmp_path, monkeypatch):
    from octafield.layout import blocks

    real = blocks._core.quantized_quads

    def damaged(*arguments, **options):
        made = real(*arguments, **options)
        made.mesh.quads[3] = made.mesh.quads[3][[1, 0, 2, 3]]
        return made

    monkeypatch.setattr(blocks._core, "quantized_quads", damaged)
    done = run(folder / "disk.obj", "-o", tmp_path / "out", "--quads", "200", "--json", tmp_path / "e.json", "-q")
    assert done.exit_code == 2 and [path.name for path in tmp_path.iterdir()] == ["e.json"]
    assert json.loads((tmp_path / "e.json").read_text())["error"]["kind"] == "degenerate_face"


@pytest.fixture(scope="module")
def inputs(tmp_path_factory):
    """Surfaces and files of points, sound and damaged, by name."""
    folder = tmp_path_factory.mktemp("inputs")
    plate, points = disk(5), four_points()
    fin = of.TriangleMesh([*plate.vertices, [0, 0, 1]], [*plate.triangles, [*plate.triangles[40][:2], 91]])
    turned = np.array(plate.triangles)
    turned[7] = turned[7][::-1]
    angles = 2 * np.pi * np.arange(36) / 36
    ring = [[r * np.cos(a), r * np.sin(a), 0] for r in np.geomspace(0.4, 1, 8) for a in angles]
    rows = [[k * 36 + i, (k + 1) * 36 + i, (k + 1) * 36 + j, k * 36 + j] for k in range(7) for i in range(36)
            for j in [(i + 1) % 36]]  # fmt: skip
    u, v = np.divmod(np.arange(24 * 12), 12) * np.array([[2 * np.pi / 24], [2 * np.pi / 12]])
    torus = np.column_stack([(2 + np.cos(v)) * np.cos(u), (2 + np.cos(v)) * np.sin(u), np.sin(v)])
    cells = [[12 * i + j, 12 * ((i + 1) % 24) + j, 12 * ((i + 1) % 24) + (j + 1) % 12, 12 * i + (j + 1) % 12]
             for i in range(24) for j in range(12)]  # fmt: skip
    split = of.surface.split_quads
    meshes = {
        "DISK": plate, "FIN": fin, "TURNED": of.TriangleMesh(plate.vertices, turned), "SQUARE": square(5),
        "RING": split(of.surface.QuadMesh(ring, quads=rows)), "TORUS": split(of.surface.QuadMesh(torus, quads=cells)),
    }  # fmt: skip
    for name, mesh in meshes.items():
        of.write_surface(mesh, folder / f"{name}.obj")
    outside = [*points[:3], {"position": [2, 0, 0], "index": 0.25}]
    texts = {
        "FOUR.json": points, "THREE.json": points[:3], "FIVE.json": [*points, {"position": [0, 0, 0], "index": 0.25}],
        "OUTSIDE.json": outside, "TWICE.json": [*points[:3], points[2]],
        "THIRD.json": [{"position": [0, 0, 0], "index": 0.3}], "SIX.json": [{"position": [0, 0, 0], "valence": 0}],
        "NONE.json": {"places": points}, "NO_PLACE.json": [{"index": 0.25}], "NO_INDEX.json": [{"position": [0, 0, 0]}],
        "WORDS.json": [{"position": ["a", "b", "c"], "index": 1}], "FLAT.json": [{"position": [0], "index": 1}],
        "NAN.json": [{"position": [float("nan"), 0, 0], "index": 1}], "LIST.json": [1, 2], "TEXT.json": "points",
        "VERTEX.json": [{"vertex": 5000, "index": 1}], "HALF.json": [{"vertex": 1.5, "index": 1}],
        "HUGE.json": [{"position": [0, 0, 0], "index": 1e9}], "RING.json": ring_points(np.radians(10)),
        "EMPTY.json": [], "INNER.json": [{"vertex": 0, "quads": 1}], "ZERO.json": [{"vertex": 0, "quads": 0}],
        "CORNER.json": [{"position": [0, 0, 0], "index": 0.25}], "FIRST.json": [{"vertex": 0, "quads": 1}],
    }  # fmt: skip
    for name, content in texts.items():
        (folder / name).write_text(json.dumps(content))
    (folder / "CUT.json").write_text(json.dumps(points)[:30])
    (folder / "BINARY.json").write_bytes(b"\xff\xfe\x00\x01")
    (folder / "HEAD.csv").write_text("a,b,c\n1,2,3\n")
    (folder / "SHORT.csv").write_text("x,y,z,index\n1,2\n")
    (folder / "POINTS.txt").write_text("0 0 0 1\n")
    return folder


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["DISK", "--singularities", "THREE.json"], "1/4 too little; add 1 point of valence 3"),
        (["DISK", "--singularities", "FIVE.json"], "1/4 too much; remove 1 point of valence 3"),
        (["DISK", "--singularities", "OUTSIDE.json"], "point 3 (from 0): the point (2, 0, 0) is not on the surface"),
        (["DISK", "--singularities", "TWICE.json"], "singular points 2 and 3 are in the same place; merge them"),
        (["DISK", "--singularities", "THIRD.json"], "index 0.3 is no multiple of 1/4"),
        (["DISK", "--singularities", "SIX.json"], "leave no quad round them"),
        (["DISK", "--singularities", "HUGE.json"], "out of range"),
        (["DISK", "--singularities", "absent.json"], "absent.json"),
        (["DISK", "--singularities", "CUT.json"], "no whole JSON"),
        (["DISK", "--singularities", "BINARY.json"], "is it a binary file?"),
        (["DISK", "--singularities", "NONE.json"], "holds no points"),
        (["DISK", "--singularities", "TEXT.json"], "holds no list of points"),
        (["DISK", "--singularities", "LIST.json"], "point 0 (from 0): is no object"),
        (["DISK", "--singularities", "NO_PLACE.json"], "has neither position nor vertex"),
        (["DISK", "--singularities", "NO_INDEX.json"], "has no index or valence"),
        (["DISK", "--singularities", "WORDS.json"], "is no list of 3 numbers"),
        (["DISK", "--singularities", "FLAT.json"], "is no list of 3 numbers"),
        (["DISK", "--singularities", "NAN.json"], "is not finite"),
        (["DISK", "--singularities", "VERTEX.json"], "no vertex 5000"),
        (["DISK", "--singularities", "HALF.json"], "vertex 1.5 is no whole number"),
        (["DISK", "--singularities", "HEAD.csv"], "the first line names the columns"),
        (["DISK", "--singularities", "SHORT.csv"], "line 2 has 2 columns, not 4"),
        (["DISK", "--singularities", "POINTS.txt"], "known are .json and .csv"),
        (["DISK", "--singularities", "FOUR.json", "--corners", "INNER.json"], "not on the boundary"),
        (["SQUARE", "--singularities", "EMPTY.json", "--corners", "ZERO.json"], "fewer than 1 quads"),
        (["SQUARE", "--singularities", "CORNER.json", "--corners", "FIRST.json"], "or as points; leave one out"),
        (["RING", "--singularities", "RING.json"], "inadmissible: move"),
        (["RING", "--singularities", "RING.json", "--inadmissible", "rotate", "--layout", "separatrices"],
         "rotated too far"),
        (["RING", "--singularities", "RING.json", "--inadmissible", "mvoe"], "did you mean 'move'?"),
        (["TORUS", "--singularities", "EMPTY.json", "--layout", "separatrices"],
         "other patches need singular points inside"),
        (["FIN"], "more than 2 triangles share 1 edge"),
        (["TURNED"], "opposite orientation"),
        (["absent.obj"], "absent.obj"),
        (["DISK", "--quads", "-3"], "quads must be an integer"),
        (["DISK", "--quads", "10", "--edge-length", "1"], "leave it or the number of quads out"),
        (["DISK", "--edge-length", "nan"], "must be positive"),
        (["DISK", "--edge-length", "1e-7"], "asks for about 3.1e+14 quads"),
        (["DISK", "--tolerance", "90"], "between 0 and 45 degrees"),
        (["DISK", "--singularities", "FOUR.json", "--max-length", "0.1"], "longer than 0.1"),
        (["DISK", "--symmetry", "6"], "No such option"),
    ],
)  # fmt: skip
def test_damaged_input_is_one_line_exit_code_2_and_no_folder(inputs, tmp_path, arguments, words):
    def named(word):
        if (inputs / word).is_file():
            return inputs / word
        return inputs / f"{word}.obj" if (inputs / f"{word}.obj").is_file() else word

    kept = [] if "absent" in arguments[0] or "--symmetry" in arguments else ["--no-remesh"]
    done = run(*map(named, arguments), "-o", tmp_path / "out", *kept)
    if "--symmetry" in arguments:
        assert done.exit_code == 2 and words in done.output
        return
    lines = [line for line in done.output.splitlines() if "error" in line or "defect" in line]
    assert done.exit_code == 2 and len(lines) == 1, done.output
    assert words in lines[0], lines[0]
    assert list(tmp_path.iterdir()) == []
