"""The package is a house: rooms of a few modules each, imports that go one way, few names at the door."""

import ast
import re
from collections import Counter
from pathlib import Path

import numpy as np
import octafield
import pytest
from docs_blocks import ROOT
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

PACKAGE = Path(octafield.__file__).parent
MOST_NAMES, MOST_MODULES = 90, 13


def modules_of(package: Path) -> dict[str, Path]:
    """Path by name within the package: "" is the package itself, "meshes" and "meshes.grids" are within."""
    found = {}
    for path in sorted(package.rglob("*.py")):
        parts = path.relative_to(package).with_suffix("").parts
        found[".".join(parts[:-1] if parts[-1] == "__init__" else parts)] = path
    return found


def imports_of(name: str, path: Path, modules: dict[str, Path]) -> set[str]:
    """What a module imports of its package, anywhere in its text: in functions and for type checkers, too. The compiled
    module and its namespaces import nothing."""
    around = name.split(".") if name else []
    if path.name != "__init__.py":
        around.pop()
    found = set()
    for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
        if isinstance(node, ast.Import):
            full = [alias.name.partition(".") for alias in node.names]
            found |= {inner for package, _, inner in full if package == "octafield"}
        elif isinstance(node, ast.ImportFrom):
            if node.level:
                base = around[: len(around) + 1 - node.level] + (node.module or "").split(".")
                source = ".".join(filter(None, base))
            elif (node.module or "").partition(".")[0] == "octafield":
                source = node.module.partition(".")[2]
            else:
                continue
            inner = [f"{source}.{alias.name}".lstrip(".") for alias in node.names]
            found |= {one if one in modules else source for one in inner if one != "_core"} - {"_core"}
    return found - {name}


def circles(package: Path) -> list[list[str]]:
    """Groups of modules of which each imports the others, by whatever way."""
    modules = modules_of(package)
    names = list(modules)
    arrows = [(names.index(a), names.index(b)) for a in names for b in imports_of(a, modules[a], modules)]
    ends = np.array(arrows, int).reshape(-1, 2).T
    graph = coo_array((np.ones(ends.shape[1]), tuple(ends)), shape=(len(names), len(names)))
    labels = connected_components(graph, connection="strong")[1]
    return [[n for n, at in zip(names, labels) if at == label] for label, k in Counter(labels).items() if k > 1]


def test_no_module_imports_itself_by_way_of_others():
    assert circles(PACKAGE) == []


@pytest.mark.parametrize(
    "back",
    ["from .. import one", "def f():\n    from ..one import x", "import octafield.one", "from octafield import one"],
)
def test_imports_in_functions_and_by_full_names_count(tmp_path, back):
    (tmp_path / "room").mkdir()
    (tmp_path / "__init__.py").touch()
    (tmp_path / "room/__init__.py").touch()
    (tmp_path / "one.py").write_text(
        "from typing import TYPE_CHECKING\nif TYPE_CHECKING:\n    from .room.two import y\n"
    )
    (tmp_path / "room/two.py").write_text(back)
    assert circles(tmp_path) == [["one", "room.two"]]


def test_rooms_know_those_below_them_alone():
    """In the order of bindings/README.md; modules outside of rooms are below all, but for the door itself."""
    table = (ROOT / "bindings/README.md").read_text(encoding="utf-8")
    rooms = re.findall(r"^\| `(\w+)/` \|", table, flags=re.MULTILINE)
    assert set(rooms) == {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    modules = modules_of(PACKAGE)
    level = {
        name: rooms.index(name.partition(".")[0]) if "." in name or name in rooms else len(rooms) for name in modules
    }
    level |= dict.fromkeys(("", "__main__", "pickling"), -1)
    up = [(a, b) for a in modules for b in imports_of(a, modules[a], modules) if level[b] < level[a]]
    assert up == []


def test_few_names_at_the_door():
    assert len(octafield.__all__) <= MOST_NAMES
    within = {name for space in (octafield.frames, octafield.surface, octafield.volume) for name in space.__all__}
    again = set(octafield.__all__) & within
    types = {"FeatureGraph", "SingularGraph", "TetDomain", "TetMesh", "TriangleMesh"}
    assert again == types | {"read_surface", "require_valid", "write_surface"}
    public = {name for name in vars(octafield._core) if not name.startswith("_")}
    assert public == within - {"EdgeScheme", "EmbeddingScheme"}  # of Python


def test_a_room_has_few_modules():
    counts = Counter(path.parent for path in PACKAGE.rglob("*.py"))
    assert {str(folder): count for folder, count in counts.items() if count > MOST_MODULES} == {}
