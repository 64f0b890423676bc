"""How results show themselves in a terminal and in a window; notebooks are in notebook.py."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InvalidInput, IoError

if TYPE_CHECKING:
    import pyvista

    from ..domain.meshing import MeshedInput
    from ..fields.analysed import AnalysedField
    from ..fields.direction_field import SurfaceFieldResult
    from ..fields.frame_field import FieldResult, Problem
    from ..options import MeshOptions
    from ..runs.compare import Comparison
    from ..study.description import Study


def field_line(result: FieldResult) -> str:
    r = result.record
    return (
        f"FieldResult({r['input']}: {r['vertices']:,} vertices, {r['tets']:,} tets; {r['representation']},"
        f" {r['boundary']}; E {r['energy']:.6g}, {r['singular_edges']:,} singular edges)"
    )


def analysed_line(result: AnalysedField) -> str:
    r = result.record
    return (
        f"AnalysedField({r['input']}: {r['vertices']:,} vertices, {r['tets']:,} tets; E {r['energy']:.6g},"
        f" {r['singular_edges']:,} singular edges)"
    )


def surface_field_line(result: SurfaceFieldResult) -> str:
    r = result.record
    return (
        f"SurfaceFieldResult({r['input']}: {r['triangles']:,} triangles; symmetry {result.direction_field.symmetry}; "
        f"{len(result.singularities.points):,} singular points, index sum {result.singularities.index_sum:g})"
    )


def meshed_line(meshed: MeshedInput) -> str:
    tets = "" if meshed.tets is None else f", {len(meshed.tets.tets):,} tets"
    regions = f", {meshed.interface_triangles:,} interface triangles" if meshed.interface_triangles else ""
    return (
        f"MeshedInput({meshed.name}: {len(meshed.surface.triangles):,} triangles{tets}{regions}; "
        f"{len(meshed.features.edges):,} feature edges by {meshed.feature_source})"
    )


def problem_line(problem: Problem) -> str:
    return (
        f"Problem({meshed_line(problem.meshed)}, seed {problem.seed}, "
        f"{len(problem.singularities.points):,} singular points on the surface)"
    )


def comparison_line(comparison: Comparison) -> str:
    """inputs, how many runs of what, the range of energies, and where."""
    rows = comparison.rows
    energies = [row["energy"] for row in rows if "energy" in row]

    def count(name: str, one: str, many: str) -> str:
        return _counted(len({row[name] for row in rows if name in row}), one, many)

    spread = f"; E {min(energies):.6g} to {max(energies):.6g}" if energies else ""
    return (
        f"Comparison({_counted(len(rows), 'run', 'runs')}: {count('input', 'input', 'inputs')}, "
        f"{count('representation', 'representation', 'representations')}, {count('boundary', 'boundary', 'boundaries')}"
        f"{spread}; {comparison.folder})"
    )


def options_line(options: MeshOptions) -> str:
    """The options that are not as they are by default: evaluates to an equal object."""
    default = type(options)()
    changed = {name: value for name, value in vars(options).items() if value != getattr(default, name)}
    return f"{type(options).__name__}({', '.join(f'{name}={value!r}' for name, value in changed.items())})"


def study_line(study: Study) -> str:
    """What it varies; an input may stand for several files."""
    varied = "".join(f", {name}: {', '.join(map(str, values))}" for name, values in study.runs.items())
    repeats = f", {study.repeats} repeats" if study.repeats > 1 else ""
    inputs, seeds = _counted(len(study.inputs), "input", "inputs"), _counted(len(study.seeds), "seed", "seeds")
    return f"Study({study.name}: {inputs}{varied}; {seeds}{repeats})"


def _counted(count: int, one: str, many: str) -> str:
    return f"{count:,} {one if count == 1 else many}"


def scene_of(result: AnalysedField) -> pyvista.Plotter:
    """A pyvista scene of the singular curves inside the translucent surface: .show() opens a window, or in Jupyter a
    view to turn (with trame) or a picture. Without a display .screenshot(PNG) draws it all the same."""
    import pyvista

    from .pictures import singular_scene

    shape = singular_scene(result)
    shape.off_screen = bool(pyvista.OFF_SCREEN or shape.notebook or not os.environ.get("DISPLAY"))
    return shape


def _require_display(folder: Path) -> None:
    """VTK without a display ends the process, or says nothing at all."""
    import pyvista

    words = f"there is no display to open a window on; write a picture: octafield view {folder} -o curves.png"
    if sys.platform != "linux":
        return
    if not os.environ.get("DISPLAY"):
        raise InvalidInput(words, "no_display")
    if not pyvista.system_supports_plotting():
        raise InvalidInput(
            f"the display {os.environ['DISPLAY']} cannot be opened; {words.partition('; ')[2]}", "no_display"
        )


def view_folder(folder: Path, picture: Path | None = None) -> dict[str, Any]:
    """Shows the singular curves that `octafield field` wrote, in a window, or writes them to a PNG; what it did, for
    --json."""
    from .pictures import scene_from_files

    files = folder / "surface.vtp", folder / "singular.vtp"
    missing = next((path for path in files if not path.is_file()), None)
    if missing is not None:
        raise IoError(f"{missing}: no such file; give the folder of a result of `octafield field`")
    shape = scene_from_files(*files)
    record = {"folder": str(folder), "files": [path.name for path in files], "picture": picture and str(picture)}
    if picture is None:
        _require_display(folder)
        shape.off_screen = False
        shape.show(title=f"octafield: {folder}")
        return record
    from . import scene

    partial = picture.with_name(f".{picture.name}.partial")
    try:
        partial.write_bytes(scene.render(shape))
        partial.replace(picture)
    except OSError as error:
        raise IoError(f"{picture}: cannot write there ({error.strerror})") from error
    return record
