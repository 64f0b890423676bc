"""The VTK inside the extension and the one of pyvista in one process, in both orders of loading."""

import subprocess
import sys

import pytest

PROGRAM = """
import importlib, sys
for name in sys.argv[1].split(","):
    importlib.import_module(name)
import numpy as np
import octafield as of
import pyvista
from vtkmodules.vtkCommonCore import vtkVersion
mesh = of.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
for round in range(3):
    of.volume.write_field("field.vtu", mesh, of.frames.random_rotations(4, round))
    grid = pyvista.read("field.vtu")
    assert grid.n_cells == 1 and abs(grid.volume - 1 / 6) < 1e-12
    assert np.allclose(grid.point_data["quaternion"], of.frames.random_rotations(4, round))
    pyvista.Sphere().triangulate().save("sphere.stl")
    assert of.surface.euler_characteristic(of.read_surface("sphere.stl")) == 2
print(vtkVersion.GetVTKVersion())
"""


@pytest.mark.parametrize(
    "order", ["octafield._core,vtkmodules.all", "vtkmodules.all,octafield._core", "pyvista,octafield"]
)
def test_both_load_and_work_in_either_order(order, tmp_path):
    run = subprocess.run([sys.executable, "-c", PROGRAM, order], cwd=tmp_path, capture_output=True, text=True)
    assert run.returncode == 0 and run.stderr == "", run.stderr


def test_the_extension_shows_nothing_but_its_entry_point():
    from octafield import _core

    symbols = subprocess.run(
        ["nm", "-D", "--defined-only", "--extern-only", _core.__file__], capture_output=True, text=True, check=True
    )
    assert [line.split()[-1] for line in symbols.stdout.splitlines()] == ["PyInit__core"]
