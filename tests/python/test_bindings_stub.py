"""The stub says what the module holds, and every name explains itself."""

import ast
import inspect
from pathlib import Path

import octafield
import pytest
from octafield import _core
from typed import checked

STUB = ast.parse(Path(octafield.__file__).with_name("_core.pyi").read_text())
ALIASES = {"Complex128s", "Float64s", "Int32s", "UInt8s", "Path", "Progress", "Sizes"}


def stub_names(body):
    names = set()
    for node in body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        elif isinstance(node, ast.AnnAssign):
            names.add(node.target.id)
    return names


def public(namespace):
    return {name for name in namespace if not name.startswith("_")}


FUNCTIONS = sorted(
    name for name in public(vars(_core)) if callable(getattr(_core, name)) and not inspect.isclass(getattr(_core, name))
)
NAMESPACES = octafield.frames, octafield.surface, octafield.volume
CLASSES = sorted(name for name in public(vars(_core)) if inspect.isclass(getattr(_core, name)))


def test_stub_and_module_hold_the_same_names():
    assert stub_names(STUB.body) - ALIASES - {"__version__", "__libraries__"} == public(vars(_core))


@pytest.mark.parametrize("name", CLASSES)
def test_stub_and_class_hold_the_same_fields(name):
    stub = next(node for node in STUB.body if isinstance(node, ast.ClassDef) and node.name == name)
    assert public(stub_names(stub.body)) == public(vars(getattr(_core, name)))


@pytest.mark.parametrize("name", FUNCTIONS)
def test_stub_and_function_take_the_same_arguments(name):
    """Names, order and which are keyword-only, compared with the signatures in the docstring."""

    def arguments(node):
        return [a.arg for a in node.args.args], [a.arg for a in node.args.kwonlyargs]

    stub = [arguments(node) for node in STUB.body if isinstance(node, ast.FunctionDef) and node.name == name]
    lines = [line for line in getattr(_core, name).__doc__.splitlines() if f"{name}(" in line and " -> " in line]
    bound = []
    for line in lines:
        line = line[line.index(f"{name}(") :]
        bound.append(arguments(ast.parse(f"def {line}: ...").body[0]))
    assert bound and bound == stub


@pytest.mark.parametrize("name", FUNCTIONS + CLASSES)
def test_every_public_name_has_a_docstring_and_is_exported(name):
    text = getattr(_core, name).__doc__.split(" -> ", 1)[-1]
    assert len(text.split()) > 4
    found = [space for space in NAMESPACES if name in space.__all__]
    assert found and all(getattr(space, name) is getattr(_core, name) for space in found)


@pytest.mark.parametrize("name", CLASSES)
def test_every_field_has_a_docstring(name):
    fields = [field for field in public(vars(getattr(_core, name)))]
    assert fields and all(inspect.getdoc(getattr(getattr(_core, name), field)) for field in fields)


def test_all_names_exist_and_the_version_is_the_packages():
    from importlib.metadata import version

    for space in (octafield, *NAMESPACES):
        assert all(hasattr(space, name) for name in space.__all__)
    assert octafield.__version__ == version("octafield")


EXAMPLE = """
import numpy as np
from numpy.typing import NDArray
import octafield

mesh: octafield.TriangleMesh = octafield.TriangleMesh([[0.0, 0, 0]], np.zeros((0, 3), dtype=np.int32))
mesh.vertices = [[1, 2, 3]]
points: NDArray[np.float64] = mesh.vertices
def report(phase: str, fraction: float, merit: float) -> bool | None:
    return fraction < 1
features = octafield.surface.detect_features(mesh, angle=0.5)
domain = octafield.surface.SurfaceDomain(mesh, features)
field: octafield.surface.DirectionField = octafield.surface.direction_field(
    domain, method="eigen", progress=report)
guided = octafield.surface.direction_field(
    domain, edge_epsilon=np.ones(3), constraints=octafield.surface.DirectionConstraints([[0, 1]], [[1, 0, 0]]),
    guide=octafield.surface.DirectionGuide(octafield.surface.principal_directions(domain).directions),
    boundary_alignment="weak")
found: octafield.surface.SurfaceSingularities = octafield.surface.surface_singularities(field)
lines: list[octafield.surface.Streamline] = octafield.surface.separatrices(
    field, found, progress=report)
length: float = sum(line.length for line in lines) + octafield.surface.core_energy
tets = octafield.volume.tetrahedralize(mesh)
octafield.require_valid(tets)
octafield.require_valid(mesh, closed=False)
frames, distances = octafield.frames.sh4_project(octafield.frames.sh4_embed(octafield.frames.random_rotations(3)))
try:
    octafield.read_surface("part.stl")
except octafield.IoError as error:
    ids: list[int] = error.elements
"""


def test_a_typed_program_passes_mypy_strict(tmp_path):
    (tmp_path / "example.py").write_text(EXAMPLE)
    run = checked(tmp_path, "example.py")
    assert run.returncode == 0, run.stdout
    wrong = EXAMPLE + '\noctafield.surface.direction_field(domain, epsilon="wide")\n'
    (tmp_path / "example.py").write_text(wrong)
    assert checked(tmp_path, "example.py").returncode == 1
