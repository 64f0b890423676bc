"""Every public class: a telling repr, pickles and copies with every bit, pictures in notebooks."""

import copy
import dataclasses
import inspect
import pickle
import sys
import types
import warnings

import numpy as np
import octafield as of
import pydantic
import pytest
import scipy.sparse
from octafield import study
from octafield.domain.generators import generate
from octafield.view import notebook

PLACES = (of, of.frames, of.surface, of.volume, study)
CLASSES = sorted(
    {kind for place in PLACES for kind in map(vars(place).get, place.__all__) if inspect.isclass(kind)},
    key=lambda kind: kind.__name__,
)


@pytest.fixture(scope="module")
def field():
    return of.compute_field(generate("cylinder"), of.FieldOptions(edge_length=0.35, streamlines=3))


@pytest.fixture(scope="module")
def objects(field, tmp_path_factory):
    """Instances of every class, found in results of real calls."""
    folder = tmp_path_factory.mktemp("objects")
    box = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.4))
    surface, tets, frames = field.surface, field.tets, field.frames
    two = np.r_[np.zeros(1, int), np.ones(len(tets.tets) - 1, int)]
    open_box = generate("box")
    open_box.triangles = open_box.triangles[1:]
    in_tets = of.compute_field(tets, of.FieldOptions(sampling="tets", streamlines=0))
    meshed = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.4))
    described = study.parse("{name: one, inputs: [{generator: box}], mesh: {edge_length: 0.4}}")
    boundary = of.volume.boundary_surface(tets)
    combed = of.volume.comb(tets, of.volume.tet_frames(tets, frames))
    of.write_frames(folder / "field.npz", tets, frames)
    in_them = of.volume.tet_frames(tets, frames)
    coordinates = of.volume.periodic_map(tets, in_them, np.full((len(in_them), 3), 0.5))
    imposed = of.surface.impose_singular_points(
        generate("torus"), of.surface.SingularPattern([of.surface.imposed_at_vertex(generate("torus"), v, t)
            for v, t in ((3, 1), (90, -1))]), inadmissible="rotate")  # fmt: skip
    everything = [
        field, in_tets, meshed, of.prepare_field(meshed), of.compute_surface_field(generate("torus"),
            of.SurfaceFieldOptions(curvature=1)),
        of.compare(generate("box"), folder / "compared", representations=["sh4"], boundaries=["aligned"],
            options=of.FieldOptions(edge_length=0.5)),
        boundary, tets.mesh, of.TetDomain(tets.mesh, regions=two), of.TetDomain(tets.mesh, regions=two).sheets,
        of.volume.split_locking(tets), of.surface.find_defects(open_box), of.surface.repair(open_box),
        of.surface.advise_repair(open_box), of.surface.remesh(generate("box"),
            of.surface.detect_features(generate("box"))),
            of.surface.size_field(generate("box"), of.surface.detect_features(generate("box"))),
        of.surface.edge_topology(surface), of.volume.feature_tangents(tets), of.volume.sector_normals(tets),
        of.surface.principal_directions(of.surface.SurfaceDomain(surface, field.features)),
        of.volume.locate_points(tets, [[0, 0, 0.5], [9, 9, 9]]), of.sample_frames(field, [[0, 0, 0.5]]),
        of.volume.comb_vertices(tets, field.frames), of.volume.smoothed_curves(field.singular_graph),
        of.volume.frame_field(tets, field.constraints, max_steps=2, max_iterations=2), of.volume.vertex_sampling(tets),
        of.volume.tet_sampling(tets), of.volume.computed_field(tets, rounds=1),
        of.volume.computed_tet_field(tets, rounds=1),
        of.volume.cell_boundary(of.volume.MixedMesh(tets.vertices, tets=tets.tets)),
        of.volume.MixedMesh(tets.vertices, tets=tets.tets),
        of.volume.find_cell_defects(of.volume.MixedMesh(tets.vertices, tets=[[0, 1, 2, 2]])),
        of.volume.Sampling(of.volume.tet_sampling(tets).stiffness, of.volume.tet_sampling(tets).mass, 1, 1, 2, "tets"),
        of.volume.singular_edges(tets, in_tets.tet_frames), of.volume.split_between_singular(tets, in_tets.tet_frames),
        of.volume.singular_graph(tets, of.frames.random_rotations(len(frames))),
        of.volume.local_meshability(tets, of.frames.random_rotations(len(frames)),
            of.volume.singular_graph(tets, of.frames.random_rotations(len(frames)))),
        of.volume.boundary_meshability(tets, of.frames.random_rotations(len(frames))),
        of.volume.boundary_meshability(box.tets, of.frames.random_rotations(len(box.tets.vertices))),
        of.surface.DirectionConstraints([[0, 1]], [[1, 0, 0]], [2.0]), of.surface.DirectionGuide([[1, 0, 0]], [1], 3),
        of.volume.axes_stretch(tets), of.volume.AxesStretchOptions(corner_angle=0.6),
        of.volume.VertexConstraints([3], [1], [[0, 0, 1]]),
        of.volume.SmoothOptions(tolerance=1e-5), of.volume.DiffuseOptions(max_steps=3),
        of.volume.FrameFieldOptions(rounds=1), of.volume.BoundaryOptions(feature_tolerance=0.2),
        imposed, of.surface.SingularPattern(corners=[of.surface.CornerQuads(1, 3)]),
        of.surface.ImposedFieldOptions(rings=3), of.surface.fewest_points_corner_quads(open_box),
        *layout_objects(),
        of.surface.DirectionFieldOptions(symmetry=6), of.surface.FeatureOptions(angle=0.5),
        of.surface.non_orthogonal_field(generate("torus")), of.surface.NonOrthogonalFieldOptions(corners=[[0, 1]]),
        of.surface.lines_metric(of.surface.non_orthogonal_field(open_box)),
        of.surface.sized_field(open_box, np.ones(len(open_box.vertices))), of.surface.SizedFieldOptions(s=0.5),
        of.surface.wanted_sizes(open_box, np.ones(len(open_box.vertices))), of.surface.reached_sizes(imposed.field),
        of.surface.extended_region(of.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])),
        of.surface.size_families(imposed.field, of.surface.surface_singularities(imposed.field), spacing=0.5),
        of.surface.phase_search(imposed.field, 1, spacing=0.5), of.surface.SizeFamilyOptions(power=2),
        of.surface.LimitCycle(flux=0.5), of.surface.without_limit_cycles(imposed.field, seeds=2),
        of.surface.LimitCycleOptions(seeds=3),
        of.compute_atlas(generate("box")),
        of.surface.parameterize_disk(open_box), of.surface.AtlasOptions(conformity=0.2),
        of.surface.map_distortion(open_box, np.asarray(open_box.vertices)[:, :2] + np.asarray(open_box.vertices)[:, 2:],
            open_box.triangles),
        of.surface.bisected_edges(open_box, np.full(len(open_box.triangles), 0.5)),
        of.compute_remesh(box.surface, remeshing=of.RemeshingOptions(edge_length=0.4)),
        of.RemeshingOptions(vertices=90), of.surface.CloseRemeshOptions(quality=0.2),
        of.surface.WinslowOptions(rounds=3),
        of.surface.close_remesh(box.surface, box.features, np.full(len(box.surface.vertices), 0.4)),
        of.surface.winslow_smooth(box.surface, box.features, box.surface.vertices, triangles=box.surface.triangles),
        of.surface.RemeshOptions(edge_length=0.3), of.surface.SizeFieldOptions(max_cells=1000),
        *of.volume.schemes.values(),
        of.MeshOptions(repair=True), of.FieldOptions(seed=3), of.SurfaceFieldOptions(symmetry=6),
        list(of.frames.representations.values()), list(of.frames.metrics.values()),
        combed, of.volume.alignment_tables(tets, combed), of.volume.isotropic_scale(tets, frames),
        of.volume.axis_scales(tets, frames),
        of.parameterization_input(tets, frames),
        of.read_frames(folder / "field.npz"), of.analyse(tets, frames),
        of.convert_file(folder / "field.npz", folder / "field.frame"),
        list(of.frame_formats.values()), list(of.mesh_formats.values()),
        of.volume.EmbeddingScheme("own", of.frames.sh4_embed), of.volume.EdgeScheme("turns", of.frames.frame_log),
        of.compute_hex_dominant(box, hex_options=of.HexMeshOptions(cells=27)), of.HexMeshOptions(cells=27),
        of.volume.hex_dominant(tets, frames, edge_length=0.6, refinements=0),
        of.volume.HexDominantOptions(edge_length=0.1, points="frontal"), of.volume.ImproveOptions(sweeps=3),
        of.volume.PeriodicMapOptions(rounds=2), of.volume.RecombineOptions(min_scaled_jacobian=0.2),
        *hex_objects(box.volume()),
        coordinates, of.volume.lattice_cells(tets, coordinates),
        of.volume.recombine(of.volume.MixedMesh(tets.vertices, tets=tets.tets)),
        of.volume.conform(of.volume.MixedMesh(tets.vertices, tets=tets.tets)),
        described, study.plan(described), study.run(described, folder / "study"),
        *(error("what; the remedy", "a_kind", [1, 2]) for error in (of.Error, of.InvalidInput, of.GeometryError,
            of.SolverError, of.IoError, of.Cancelled)),
    ]  # fmt: skip
    found = {}
    for thing in everything:
        collect(thing, found)
    return found


def hex_objects(tets):
    """Of a box as a seamless map: all there is on the way to its hexahedra."""
    parameters = np.asarray(tets.vertices)[np.asarray(tets.tets)].reshape(-1, 12)
    given = of.volume.SeamlessMap(tets.mesh, parameters)
    blocks = of.volume.block_complex(given)
    numbers = of.volume.arc_numbers(blocks, 2.0)
    return [
        given, of.volume.seamless_report(given), blocks, numbers, of.volume.all_hex(given, cells=8),
        of.volume.block_hexahedra(given, blocks, numbers.numbers), of.volume.AllHexOptions(cells=8),
        of.compute_hex_mesh(given, cells=8), of.compute_seamless_map(tets),
        of.volume.field_map(tets, np.eye(1, 4).repeat(len(tets.vertices), axis=0)),
    ]  # fmt: skip


def layout_objects():
    """An L-shape of three squares: its layout, quads and all there is on the way."""
    plate = of.surface.split_quads(of.surface.QuadMesh([[0, 0, 0], [1, 0, 0], [2, 0, 0], [0, 1, 0], [1, 1, 0],
        [2, 1, 0], [0, 2, 0], [1, 2, 0]], quads=[[0, 1, 4, 3], [1, 2, 5, 4], [3, 4, 7, 6]]))  # fmt: skip
    field = of.surface.impose_singular_points(plate, of.surface.SingularPattern())
    layout, t_mesh = of.surface.quad_layout(field), of.surface.motorcycle_graph(field)
    quads = of.surface.quantized_quads(t_mesh, quad_count=12)
    return [
        t_mesh, quads, of.surface.integer_grid_map(t_mesh, quads), of.surface.base_complex(quads.mesh),
        of.surface.cut_along_features(plate),
        of.surface.FittedPattern(changes=[of.surface.PatternChange(3, True, np.ones((2, 3)))], before=2.0, tried=7),
        of.surface.QuantizedQuadsOptions(quad_count=7, weights="relative"),
        of.surface.FittingOptions(edge_length=0.1, places=3),
        layout, of.surface.layout_quads(layout, quad_count=12), of.surface.patch_polygons(layout),
        of.surface.LayoutCurveOptions(end_tolerance=0.1), of.surface.LayoutQuadsOptions(quad_count=7),
        of.compute_quad_layout(plate, layout_options=of.QuadLayoutOptions(quads=12)), of.QuadLayoutOptions(quads=12),
        of.compute_quad_mesh(plate, quad_options=of.QuadMeshOptions(quads=12)), of.QuadMeshOptions(quads=12),
        of.compute_fixed_boundary_quads([[(0, 0), (2, 0), (2, 2), (0, 2)]], [[(0.5, 1), (1.5, 1)]], edge_length=1.5),
        of.surface.FixedBoundaryOptions(edge_length=0.5, odd_loops="split_all"),
    ]  # fmt: skip


def parts(value):
    """Names and values of what an object holds."""
    if dataclasses.is_dataclass(value):
        return {f.name: getattr(value, f.name) for f in dataclasses.fields(value)}
    if isinstance(value, of.Error):
        return {"message": str(value), "kind": value.kind, "elements": value.elements}
    if isinstance(value, pydantic.BaseModel):
        return dict(value)
    if type(value).__module__.startswith("octafield"):
        properties = [n for n in dir(type(value)) if isinstance(getattr(type(value), n), property)]
        return {name: getattr(value, name) for name in properties} or vars(value)
    return {}


def collect(value, found):
    if isinstance(value, (list, tuple)):
        for item in value[:50]:
            collect(item, found)
        return
    kind = type(value)
    if kind.__module__.startswith("octafield") and len(found.setdefault(kind, [])) < 4:
        found[kind].append(value)
    for part in parts(value).values():
        if not isinstance(part, (np.ndarray, dict, str)):
            collect(part, found)


def identical(a, b, where="value"):
    assert type(a) is type(b), where
    if isinstance(a, np.ndarray):
        assert a.dtype == b.dtype and a.shape == b.shape and a.tobytes() == b.tobytes(), where
    elif scipy.sparse.issparse(a):
        assert all((getattr(a, part) == getattr(b, part)).all() for part in ("data", "indices", "indptr")), where
    elif isinstance(a, (list, tuple)):
        assert len(a) == len(b), where
        for k, (x, y) in enumerate(zip(a, b, strict=True)):
            identical(x, y, f"{where}[{k}]")
    elif isinstance(a, dict):
        assert list(a) == list(b), where
        for key in a:
            identical(a[key], b[key], f"{where}[{key!r}]")
    elif inner := {} if isinstance(a, types.BuiltinFunctionType) else parts(a):
        for name in inner:
            identical(inner[name], parts(b)[name], f"{where}.{name}")
    elif isinstance(a, float):
        assert a.hex() == b.hex(), where
    else:
        assert a == b, where


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_pickles_and_copies_hold_every_bit(cls, objects):
    assert objects.get(cls), f"add something that holds a {cls.__name__} to the objects above"
    for value in objects[cls]:
        for again in (pickle.loads(pickle.dumps(value)), copy.deepcopy(value), copy.copy(value)):
            identical(value, again, cls.__name__)


@pytest.mark.parametrize("cls", CLASSES, ids=lambda cls: cls.__name__)
def test_reprs_are_one_short_line_with_the_class(cls, objects):
    for value in objects[cls]:
        text = repr(value)
        if issubclass(cls, of.Error) or cls is of.surface.Defect:
            assert text.startswith(cls.__name__)
            continue
        assert text.startswith(f"{cls.__name__}(") and text.endswith(")")
        assert "\n" not in text and len(text) < 320 and " object at 0x" not in text and "array(" not in text
        assert any(c.isdigit() for c in text) or cls in (
            of.MeshFormat,  # words and suffixes
            of.MeshOptions,
            of.FieldOptions,
            of.frames.Metric,
            of.volume.BoundaryOptions,
        )


def test_reprs_tell_counts_and_ranges(field, objects):
    assert repr(field.tets).startswith(f"TetDomain({len(field.tets.vertices)} vertices, {len(field.tets.tets)} tets, ")
    assert repr(field).startswith("FieldResult(mesh in memory: ")
    (comparison,) = objects[of.Comparison]
    assert repr(comparison).startswith("Comparison(1 run: 1 input, 1 representation, 1 boundary; E ")
    assert "complex" in repr(field.singular_graph) and "length" in repr(field.singular_graph)
    assert repr(of.volume.VertexConstraints([1, 2], [1, 2])) == "VertexConstraints(2 vertices: 0 free, 1 axis, 1 fixed)"
    assert (
        repr(study.parse("{name: two, inputs: [{generator: box}], runs: {boundary: [aligned, fixed]}, seeds: 3}"))
        == "Study(two: 1 input, boundary: aligned, fixed; 3 seeds)"
    )
    assert repr(of.frames.metrics["geodesic"]).startswith("Metric(geodesic: ")


def test_reprs_of_options_are_what_differs_from_the_defaults():
    options = of.SurfaceFieldOptions(symmetry=6, features="none")
    assert repr(options) == "SurfaceFieldOptions(features='none', symmetry=6)"
    assert eval(repr(options), vars(of)) == options


SHOWN = ("FieldResult", "SurfaceFieldResult", "SingularGraph", "TriangleMesh", "TetMesh")


@pytest.mark.parametrize("name", [*SHOWN, "Comparison"])
def test_notebooks_get_a_picture_and_the_figures_or_these_alone(name, objects, monkeypatch):
    value = objects[getattr(of, name)][0]
    shown = value._repr_html_()
    assert ("data:image/png;base64," in shown) == (name in SHOWN) and "<table>" in shown and "</div>" in shown
    monkeypatch.setattr("octafield.view.scene.can_draw", lambda: False)
    plain = value._repr_html_()
    assert "<img" not in plain and "<table>" in plain


@pytest.mark.parametrize("value", [of.TriangleMesh(), of.TetMesh(), of.SingularGraph()], ids=repr)
def test_empty_objects_show_themselves_too(value):
    assert "<table>" in value._repr_html_()


def test_names_from_files_are_no_markup(field):
    result = copy.copy(field)
    result.record = field.record.changed(input="<script>alert(1)</script>")
    assert "<script>" not in result._repr_html_()


class _Display(list):
    """IPython's display functions, as far as they are used."""

    def install(self, monkeypatch, kernel):
        module = types.ModuleType("IPython.display")
        module.display, module.HTML = self.append, lambda text: text
        ipython = types.ModuleType("IPython")
        ipython.display = module
        ipython.get_ipython = lambda: types.SimpleNamespace(kernel=1) if kernel else types.SimpleNamespace()
        monkeypatch.setitem(sys.modules, "IPython", ipython)
        monkeypatch.setitem(sys.modules, "IPython.display", module)


@pytest.mark.parametrize("name", SHOWN)
def test_in_jupyter_pyvista_shows_the_scene_where_it_has_a_backend(name, objects, monkeypatch):
    import pyvista

    value = objects[getattr(of, name)][0]
    with pytest.raises(NotImplementedError):  # IPython then takes the HTML
        value._ipython_display_()
    shown = _Display()
    shown.install(monkeypatch, kernel=True)
    monkeypatch.setattr(notebook, "_installed", lambda package: package == "trame_vtk")
    monkeypatch.setattr(pyvista.Plotter, "show", lambda self, **how: ("a view", how))
    value._ipython_display_()
    assert shown[0] == ("a view", {"return_viewer": True}) and shown[1] == value._repr_html_()
    assert "data:image/png;base64," in shown[1] and "<table>" in shown[1]  # of the two, a saved notebook keeps this
    monkeypatch.setattr(pyvista.global_theme, "_jupyter_backend", "static", raising=False)
    with pytest.raises(NotImplementedError):
        value._ipython_display_()


def test_no_scene_without_a_kernel_without_trame_or_without_opengl(objects, monkeypatch):
    value = objects[of.TriangleMesh][0]
    _Display().install(monkeypatch, kernel=False)
    monkeypatch.setattr(notebook, "_installed", lambda package: True)
    assert not notebook.live_backend()
    _Display().install(monkeypatch, kernel=True)
    assert notebook.live_backend()
    monkeypatch.setattr("octafield.view.scene.can_draw", lambda: False)
    with pytest.raises(NotImplementedError):
        value._ipython_display_()
    monkeypatch.setattr(notebook, "_installed", lambda package: False)
    assert not notebook.live_backend()


@pytest.mark.parametrize("failure", ["raises", "picture", "nothing"])
def test_a_backend_that_does_not_work_leaves_the_picture(objects, monkeypatch, failure, recwarn):
    """pyvista gives a picture where trame is there in part; trame raises what it likes."""
    import PIL.Image
    import pyvista

    def show(self, **how):
        if failure == "raises":
            raise RuntimeError("no server")
        warnings.warn("Falling back to a static output.", stacklevel=1)
        return PIL.Image.new("RGB", (2, 2)) if failure == "picture" else None

    shown = _Display()
    shown.install(monkeypatch, kernel=True)
    monkeypatch.setattr(notebook, "_installed", lambda package: True)
    monkeypatch.setattr(pyvista.Plotter, "show", show)
    with pytest.raises(NotImplementedError):  # IPython then takes the HTML
        objects[of.TriangleMesh][0]._ipython_display_()
    assert shown == [] and not [w for w in recwarn if "static output" in str(w.message)]


def test_the_scene_of_a_result_can_be_drawn_without_a_display(field, monkeypatch):
    monkeypatch.delenv("DISPLAY", raising=False)
    scene = field.scene()
    assert scene.screenshot(return_img=True).std() > 1
    scene.close()


def test_drawing_leaves_the_settings_of_pyvista_alone(field):
    import pyvista

    before = pyvista.OFF_SCREEN
    field._repr_html_()
    assert pyvista.OFF_SCREEN == before
