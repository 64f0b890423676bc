"""An option stands once, in its C++ struct: classes, functions, FieldOptions and the command line take it from it."""

import dataclasses
import inspect
import json
import math
import pickle

import numpy as np
import octafield as of
import pytest
from octafield.command_line import fields as cli
from octafield.command_line.options import PARAMETERS
from octafield.domain.generators import generate
from octafield.options import FieldOptions, MeshOptions, SurfaceFieldOptions
from pipeline_fixtures import octafield

STRUCTS = {
    "diffuse": [of.volume.DiffuseOptions],
    "smooth": [of.volume.SmoothOptions],
    "frame_field": [of.volume.FrameFieldOptions, of.volume.DiffuseOptions, of.volume.SmoothOptions],
    "boundary_constraints": [of.volume.BoundaryOptions],
    "tet_boundary_constraints": [of.volume.BoundaryOptions],
    "direction_field": [of.surface.DirectionFieldOptions],
    "non_orthogonal_field": [of.surface.NonOrthogonalFieldOptions],
    "detect_features": [of.surface.FeatureOptions],
    "remesh": [of.surface.RemeshOptions],
    "close_remesh": [of.surface.CloseRemeshOptions],
    "winslow_smooth": [of.surface.WinslowOptions],
    "size_field": [of.surface.SizeFieldOptions],
    "layout_curves": [of.surface.LayoutCurveOptions],
    "quad_layout": [of.surface.LayoutCurveOptions],
    "fixed_boundary_quads": [of.surface.FixedBoundaryOptions],
}


def function_of(name):
    return getattr(of.volume, name, None) or getattr(of.surface, name)


def options_of(struct):
    return [name for name, value in vars(struct).items() if isinstance(value, property)]


@pytest.mark.parametrize("function", STRUCTS)
def test_a_function_lists_the_fields_of_its_structs_with_their_defaults(function):
    signature = function_of(function).__doc__.splitlines()[0]
    for struct in STRUCTS[function]:
        for name in options_of(struct):
            value = getattr(struct(), name)
            if isinstance(value, (str, int, float)):
                assert f"{name}: {type(value).__name__} = {value!r}" in signature
    assert "kwargs" not in signature


@pytest.mark.parametrize("function", STRUCTS)
def test_a_function_refuses_what_is_no_option(function):
    box = generate("box")
    arguments = {
        "detect_features": [box], "remesh": [box, of.FeatureGraph()], "size_field": [box, of.FeatureGraph()],
        "close_remesh": [box, of.FeatureGraph(), np.ones(8)], "winslow_smooth": [box, of.FeatureGraph(), box.vertices],
        "direction_field": [box], "non_orthogonal_field": [box],
        "layout_curves": [of.surface.ImposedField()], "quad_layout": [of.surface.ImposedField()],
        "fixed_boundary_quads": [of.surface.PlanarOutline()],
    }  # fmt: skip
    tets = of.volume.tetrahedralize(box)
    given = arguments.get(function) or (
        [tets, np.zeros((8, 3))]
        if "boundary" in function
        else [tets, of.volume.BoundaryConstraints(), np.zeros((0, 4))][: 2 if function == "frame_field" else 3]
    )
    with pytest.raises(TypeError, match=rf"{function}\(\) got an unexpected keyword argument 'toleranse'"):
        function_of(function)(*given, toleranse=1)
    name = options_of(STRUCTS[function][0])[0]
    with pytest.raises(TypeError, match=name):
        function_of(function)(*given, **{name: object()})


def test_words_are_those_of_the_command_line():
    assert of.volume.SmoothOptions.words["solver"] == ["default", "trust_region", "levenberg_marquardt", "lbfgs"]
    assert list(of.surface.direction_field_methods) == ["gl", "mbo", "eigen"]
    with pytest.raises(of.InvalidInput, match="default, trust_region"):
        of.volume.SmoothOptions(solver="automatic")


@pytest.mark.parametrize("struct", sorted({s for structs in STRUCTS.values() for s in structs}, key=str))
def test_a_struct_is_made_changed_and_pickled_as_any_other(struct):
    made = struct()
    name = next(n for n in options_of(struct) if isinstance(getattr(made, n), (int, float)))
    setattr(made, name, getattr(made, name) + 1)
    again = pickle.loads(pickle.dumps(made))
    assert getattr(again, name) == getattr(made, name) != getattr(struct(), name)
    assert repr(made).startswith(struct.__name__ + "(")


@pytest.mark.parametrize("kind", [FieldOptions, SurfaceFieldOptions])
def test_defaults_are_those_of_the_structs(kind):
    recipe, surface = of.volume.FrameFieldOptions(), of.surface.DirectionFieldOptions()
    structs = {
        FieldOptions: [recipe.smooth, recipe.diffuse, recipe, of.volume.BoundaryOptions()],
        SurfaceFieldOptions: [surface],
    }[kind]
    seen = 0
    for option in dataclasses.fields(kind):
        for struct in structs:
            if option.name in options_of(type(struct)):
                assert option.default == getattr(struct, option.name)
                seen += 1
    assert seen >= {FieldOptions: 15, SurfaceFieldOptions: 7}[kind]


@pytest.mark.parametrize(
    "command, kind, absent",
    [(cli.field, FieldOptions, 8), (cli.surface_field, SurfaceFieldOptions, 2)],
    ids=["field", "surface-field"],
)
def test_a_command_has_the_options_of_its_class(command, kind, absent):
    parameters = inspect.signature(command).parameters
    known = {option.name: option.default for option in dataclasses.fields(kind)}
    missing = [name for name in known if name not in parameters]
    assert len(missing) == absent, missing  # of the heat flow, for Python and studies; of tet meshes
    for name in known.keys() - set(missing):
        default = parameters[name].default
        assert known[name] == (math.radians(default) if name in ("feature_angle", "feature_tolerance") else default)
    assert {option.name for option in dataclasses.fields(MeshOptions)} <= set(PARAMETERS)


def test_iterations_and_tolerance_are_told_on_the_command_line(tmp_path):
    ball = tmp_path / "ball.stl"
    of.write_surface(generate("ball"), ball)
    more = ("--edge-length", "0.4", "--solver", "lbfgs", "--rounds", "0", "--json", "-")
    records = [
        json.loads(octafield("field", ball, "-o", tmp_path / str(k), *more, *given, check=0).stdout)
        for k, given in enumerate([(), ("--max-iterations", "1"), ("--tolerance", "1")])
    ]
    assert [record["options"]["max_iterations"] for record in records] == [200, 1, 200]
    assert records[1]["iterations"] == 1 and not records[1]["converged"]
    assert records[2]["iterations"] < records[0]["iterations"]
    assert "tolerance" in octafield("field", ball, "-o", tmp_path / "no", "--tolerance", "-1", check=2).stderr


def test_options_of_the_heat_flow_reach_it():
    meshed = of.prepare_mesh(generate("ball"), of.MeshOptions(edge_length=0.4))
    problem = of.prepare_field(meshed)
    steps = of.run_field(problem).record["diffusion_steps"]
    assert of.run_field(problem, of.FieldOptions(edge_length=0.4, max_steps=2)).record["diffusion_steps"] == 4 < steps
    with pytest.raises(of.InvalidInput, match="first time must be positive"):
        of.FieldOptions(first_time=0)
    with pytest.raises(of.InvalidInput, match="linear_solver"):
        of.FieldOptions(linear_solver="lu")


def test_feature_edges_inside_are_followed_as_asked():
    cylinder = generate("cylinder")
    free, held = (
        of.compute_surface_field(cylinder, of.SurfaceFieldOptions(edge_length=0.4, feature_alignment=word)).record
        for word in ("none", "strong")
    )
    assert free["energy"] < held["energy"]
    assert free["options"]["feature_alignment"] == "none"
