"""Whether this installation works: versions, threads, memory, and one small run of every part that may be missing or
broken."""

import importlib.metadata
import importlib.util
import os
import tempfile
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import numpy as np

from .._core import TriangleMesh
from ..errors import Error, SolverError
from ..progress.phases import libraries, versions
from .info import FAIL, PASS

MISSING = "not installed"
_OPTIONAL = {
    "distributed": "studies on several machines: pip install octafield[cluster]",
    "pandas": "octafield.to_pandas, from_pandas: pip install pandas",
    "gmsh": "CAD input: pip install octafield[cad]",
    "trame": "scenes to turn in Jupyter: pip install octafield[notebook]",
}


def examine() -> dict[str, Any]:
    """The JSON object of `octafield doctor`. Key "ok": everything that is not optional works."""
    checks = [_tried(name, check) for name, check in _CHECKS]
    checks += [_optional(name, remedy) for name, remedy in _OPTIONAL.items()]
    return {
        "ok": all(check["state"] != FAIL for check in checks),
        "versions": versions(),
        "libraries": libraries(),
        "cores": len(os.sched_getaffinity(0)),
        "memory_gb": round(os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 1e9, 1),
        "checks": checks,
    }


def _tried(name: str, check: Callable[[], str]) -> dict[str, Any]:
    begin = time.perf_counter()
    try:
        state, message = PASS, check()
    except Error as error:
        state, message = MISSING if error.kind == "no_opengl" else FAIL, str(error)
    except Exception as error:  # whatever is wrong is what a doctor is asked for
        state, message = FAIL, f"{type(error).__name__}: {error}"
    return {"name": name, "state": state, "message": message, "seconds": round(time.perf_counter() - begin, 2)}


def _optional(name: str, remedy: str) -> dict[str, Any]:
    if importlib.util.find_spec(name) is None:
        return {"name": name, "state": MISSING, "message": remedy, "seconds": 0.0}
    return {"name": name, "state": PASS, "message": importlib.metadata.version(name), "seconds": 0.0}


def _frames() -> str:
    from .. import _core

    q = _core.random_rotations(1000, 1)
    found, _ = _core.sh4_project(_core.sh4_embed(q))
    worst = float(np.max(_core.distance(found, q)))
    if worst > 1e-7:
        raise ArithmeticError(f"projections miss by {worst:g} radians")
    return f"1000 projections, largest error {worst:.1e} radians"


def _cube() -> TriangleMesh:
    from ..domain.generators import generate

    return generate("box")


def _tetgen() -> str:
    from .. import _core

    tets = _core.tetrahedralize(_core.remesh(_cube(), _core.detect_features(_cube())).mesh)
    volume = float(np.sum(_core.tet_volumes(tets)))
    if abs(volume - 1) > 1e-12:
        raise ArithmeticError(f"a cube of volume 1 became tets of volume {volume!r}")
    return f"a cube in {len(tets.tets):,} tets"


def _field(solver: str) -> Callable[[], str]:
    def check() -> str:
        from ..fields.frame_field import compute_field
        from ..options import FieldOptions

        options = FieldOptions(edge_length=0.3, solver=solver)
        record = compute_field(_cube(), options).record
        if not (record.energy < 1e-9 and record.singular_edges == 0):
            raise ArithmeticError(
                f"the field of a cube has energy {record.energy:g}, {record.singular_edges} singular edges"
            )
        return "the field of a cube is constant"

    return check


def _threads() -> str:
    """Matrices factorized in two threads at once, as alone: a BLAS that is not made for threads mixes them up without a
    word."""
    from .. import _core

    surface = _core.remesh(_cube(), _core.detect_features(_cube()), edge_length=0.08).mesh

    def energies(times: int) -> set[float]:
        return {_core.direction_field(surface).energy for _ in range(times)}

    alone = energies(1)
    try:
        with ThreadPoolExecutor(2) as pool:
            together = set[float]().union(*pool.map(energies, (4, 4)))
    except SolverError:
        together = set()
    if together != alone:
        raise ArithmeticError(
            "fields computed in two threads at once differ from the same alone: the BLAS library is not safe in"
            " threads; install libopenblas0-pthread (update-alternatives --config libblas.so.3-x86_64-linux-gnu), or"
            " compute in one thread at a time"
        )
    return "8 fields in two threads are as one alone"


def _pictures() -> str:
    from ..view import scene

    shape = scene.plotter()
    scene.add_body(shape, scene.surface_mesh(_cube()))
    return f"a picture of {len(scene.render(shape)):,} bytes"


def _files() -> str:
    import pyvista

    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder) / "cube.vtp"
        from ..runs.interop import to_pyvista

        to_pyvista(_cube()).save(path)
        return f"VTK files written and read, {pyvista.read(path).n_cells} triangles"


_CHECKS = (
    ("frames", _frames),
    ("meshing (CGAL, TetGen)", _tetgen),
    ("smoothing (trust region)", _field("default")),
    ("smoothing (Ceres)", _field("levenberg_marquardt")),
    ("threads (BLAS, CHOLMOD)", _threads),
    ("files (VTK)", _files),
    ("pictures (VTK without a display)", _pictures),
)
