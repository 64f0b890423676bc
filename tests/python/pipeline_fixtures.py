"""Small inputs and the command line for the tests of the pipeline."""

import subprocess
from pathlib import Path

import command_server
import pytest
import pyvista

SHARED_SURFACES = Path(__file__).resolve().parents[3] / "shared" / "data" / "surfaces"
SHARED_TETS = SHARED_SURFACES.parent / "hexme"


def shared(path: Path) -> Path:
    """A file of the shared test data; skips the test where it is not there."""
    if not path.exists():
        pytest.skip(f"needs the shared test data: {path} is absent")
    return path


def write_cube(folder: Path, size: float = 1.0) -> Path:
    """A cube as OBJ: 12 feature curves, 8 corners."""
    corners = [(x, y, z) for z in (0, size) for y in (0, size) for x in (0, size)]
    quads = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    lines = [f"v {x} {y} {z}" for x, y, z in corners]
    lines += [f"f {a + 1} {b + 1} {c + 1} {d + 1}" for a, b, c, d in quads]
    path = folder / "cube.obj"
    path.write_text("\n".join(lines) + "\n")
    return path


def write_sphere(folder: Path) -> Path:
    path = folder / "sphere.ply"
    pyvista.Icosphere(radius=1.0, nsub=3).save(path)
    return path


def octafield(*arguments, check: int | None = None) -> subprocess.CompletedProcess:
    """Runs the command line in a process of its own; `check` is the exit code it must have."""
    done = command_server.run([str(argument) for argument in arguments], timeout=600)
    if check is not None:
        assert done.returncode == check, done.stderr
    return done
