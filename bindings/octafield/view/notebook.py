"""How results show themselves in Jupyter: a scene to turn where pyvista has a backend for it that works (pip install
'octafield[notebook]'), and always a picture, which stays where the notebook is saved, with the main figures beside it;
the figures alone without OpenGL.

pyvista decides: pyvista.set_jupyter_backend("static") asks for pictures, "html" for scenes that stay in exported
notebooks.
"""

from __future__ import annotations

import base64
import html
import importlib.util
import logging
import warnings
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from .. import _core
from .._core import SingularGraph, TetMesh, TriangleMesh

log = logging.getLogger("octafield")

if TYPE_CHECKING:
    import pyvista

    from ..fields.analysed import AnalysedField
    from ..fields.direction_field import SurfaceFieldResult

_FIELD = ("vertices", "tets", "energy", "singular_edges", "complex_edges", "non_meshable_vertices", "converged")
_SURFACE = ("triangles", "energy", "epsilon", "euler_characteristic", "index_sum", "converged")
_ROW = ("input", "representation", "boundary", "seed", "energy", "singular_edges", "singular_length", "complex_edges")
_MOST_WITH_EDGES = 50_000  # triangles drawn with their edges
_MOST_OPENED = 300_000  # tets of a mesh that is shown cut open


def html_of(value: Any) -> str:
    """For _repr_html_: a still picture and the main figures."""
    title, facts = describe(value)
    picture = ""
    if type(value).__name__ != "Comparison" and (data := _picture(value)):
        text = base64.b64encode(data).decode()
        picture = f'<img style="max-width:420px" alt="{html.escape(title)}" src="data:image/png;base64,{text}">'
    return (
        f"<div><b>{html.escape(title)}</b><div"
        f' style="display:flex;gap:1em;align-items:center">{picture}{_table(facts)}</div></div>'
    )


def display_live(value: Any) -> None:
    """For _ipython_display_: a scene to turn, then the HTML above: the scene is gone when its kernel is.
    NotImplementedError, which is IPython's word for it: there is no backend or it does not work, IPython then asks for
    the HTML alone."""
    if type(value).__name__ == "Comparison" or not live_backend() or not _can_draw():
        raise NotImplementedError
    from IPython.display import HTML, display  # type: ignore[import-not-found, unused-ignore]

    viewer = _viewer(value)
    if viewer is None:
        raise NotImplementedError
    display(viewer)
    display(HTML(html_of(value)))


def _viewer(value: Any) -> Any:
    """What pyvista shows of the scene; None where that is a picture, or the backend fails in whatever way it has."""
    import PIL.Image

    scene = scene_of(value)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # pyvista's advice where it falls back itself
            shown = scene.show(return_viewer=True)
    except Exception as error:
        log.warning("no scene to turn, but a picture: %s", error)
        return None
    return None if isinstance(shown, PIL.Image.Image) else shown


def live_backend() -> bool:
    """Whether pyvista shows scenes here that can be turned: in a kernel of Jupyter, with trame or a backend of the
    user's."""
    import pyvista

    theme = pyvista.global_theme.jupyter_backend
    if theme in ("none", "static") or not _in_kernel():
        return False
    known = (None, "trame", "client", "server", "html")
    return theme not in known or any(map(_installed, ("trame_pyvista", "trame_vtk")))


def _installed(package: str) -> bool:
    return importlib.util.find_spec(package) is not None


def _in_kernel() -> bool:
    try:
        from IPython import get_ipython  # type: ignore[import-not-found, unused-ignore]
    except ImportError:
        return False
    return hasattr(get_ipython(), "kernel")


def _can_draw() -> bool:
    from . import scene

    return scene.can_draw()


def describe(value: Any) -> tuple[str, Mapping[str, Any] | list[Mapping[str, Any]]]:
    """A title, and figures by name (a list of them: a line each)."""
    if isinstance(value, (TriangleMesh, TetMesh, SingularGraph)):
        return type(value).__name__, _facts_of_arrays(value)
    if type(value).__name__ == "Comparison":
        rows: list[Mapping[str, Any]] = [{name: row[name] for name in _ROW if name in row} for row in value.rows]
        return f"Comparison in {value.folder}", rows
    record = value.record
    names = _FIELD if "tets" in record else _SURFACE
    what = [record[name] for name in ("representation", "boundary", "method") if name in record]
    return ", ".join([str(record["input"]), *map(str, what)]), {name: record[name] for name in names if name in record}


def _facts_of_arrays(value: TriangleMesh | TetMesh | SingularGraph) -> dict[str, Any]:
    if isinstance(value, SingularGraph):
        turns = np.asarray(value.curve_quarter_turns)
        kinds = {f"valence {4 - number}": number for number in (3, 2, 1, -1, -2, -3, -4)} | {"complex": 0}
        counts = {
            name: int((turns == number).sum())
            for name, number in kinds.items()
            if number in (1, -1, 0) or number in turns
        }
        return {"curves": len(value.curves), **counts, "nodes": len(value.nodes), "length": float(value.length)}
    points = np.asarray(value.vertices)
    cells = {"tets": len(value.tets)} if isinstance(value, TetMesh) else {"triangles": len(value.triangles)}
    facts: dict[str, Any] = {"vertices": len(points), **cells}
    if len(points):
        sides = zip("xyz", points.min(axis=0), points.max(axis=0), strict=True)
        facts |= {axis: f"{low:.6g} to {high:.6g}" for axis, low, high in sides}
    return facts


def _cell(value: Any) -> str:
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def _table(facts: Mapping[str, Any] | list[Mapping[str, Any]]) -> str:
    if isinstance(facts, Mapping):
        lines = [f"<tr><td>{html.escape(name)}</td><td>{_cell(value)}</td></tr>" for name, value in facts.items()]
    else:
        heads = list(dict.fromkeys(name for row in facts for name in row))
        lines = ["<tr>" + "".join(f"<th>{html.escape(name)}</th>" for name in heads) + "</tr>"]
        lines += ["<tr>" + "".join(f"<td>{_cell(row.get(name, ''))}</td>" for name in heads) + "</tr>" for row in facts]
    return f"<table>{''.join(lines)}</table>"


def _picture(value: Any) -> bytes | None:
    from . import scene

    empty = isinstance(value, (TriangleMesh, TetMesh)) and not len(_cells(value))
    if empty or not scene.can_draw():
        return None
    return scene.render(scene_of(value))


def _cells(value: TriangleMesh | TetMesh) -> np.ndarray[Any, Any]:
    return np.asarray(value.tets if isinstance(value, TetMesh) else value.triangles)


def scene_of(value: AnalysedField | SurfaceFieldResult | SingularGraph | TriangleMesh | TetMesh) -> pyvista.Plotter:
    """A pyvista scene: singular curves inside the translucent surface; singular points and separatrices on it; the
    curves alone; a surface; a tet mesh cut open. Raises IoError without OpenGL."""
    if isinstance(value, SingularGraph):
        return _curves_scene(value)
    if isinstance(value, TriangleMesh):
        return _surface_scene(value)
    if isinstance(value, TetMesh):
        return _tets_scene(value)
    from ..fields.analysed import AnalysedField

    if isinstance(value, AnalysedField):
        from .pictures import singular_scene

        return singular_scene(value)
    return _surface_field_scene(value)


def _surface_scene(mesh: TriangleMesh) -> pyvista.Plotter:
    from . import scene

    shape = scene.plotter()
    edges = len(mesh.triangles) <= _MOST_WITH_EDGES
    shape.add_mesh(scene.surface_mesh(mesh), color=scene.BODY, show_edges=edges, edge_color=scene.INK, ambient=0.35)
    _from_above(shape, mesh.vertices)
    return shape


def _tets_scene(tets: TetMesh) -> pyvista.Plotter:
    """The half behind the middle, so that the inside shows."""
    from . import scene
    from .interop import to_pyvista

    if len(tets.tets) > _MOST_OPENED:
        return _surface_scene(_core.boundary_surface(tets).mesh)
    shape = scene.plotter()
    points = np.asarray(tets.vertices)
    axes = scene.principal_axes(points)
    half = to_pyvista(tets).clip(normal=axes[1], origin=(points.min(0) + points.max(0)) / 2, crinkle=True)
    edges = half.n_cells <= _MOST_WITH_EDGES
    shape.add_mesh(
        half.extract_surface(algorithm=None), color=scene.BODY, show_edges=edges, edge_color=scene.INK, ambient=0.35
    )
    scene.look(shape, points, axes[1] + 0.4 * axes[0] + 0.4 * axes[2], axes[2])
    return shape


def _curves_scene(graph: SingularGraph) -> pyvista.Plotter:
    from . import scene
    from .pictures import TURNS

    shape = scene.plotter()
    points = np.asarray(_core.smoothed_curves(graph).points)
    if not len(points):
        return shape
    from ..runs.run_folder import polylines

    radius = 0.006 * scene.diagonal(points)
    of_kind: dict[int, list[np.ndarray[Any, Any]]] = {}
    for curve, turns in zip(graph.curves, np.asarray(graph.curve_quarter_turns).tolist(), strict=True):
        of_kind.setdefault(turns if turns in TURNS else 2, []).append(points[np.asarray(curve)])
    for kind, lines in of_kind.items():
        tubes = polylines(lines).tube(radius=radius, n_sides=12)
        shape.add_mesh(tubes, color=TURNS[kind][0], smooth_shading=True, ambient=0.3)
    _from_above(shape, points)
    return shape


def _surface_field_scene(result: SurfaceFieldResult) -> pyvista.Plotter:
    import pyvista

    from ..runs.run_folder import polylines
    from . import scene

    shape = scene.plotter()
    points = np.asarray(result.surface.vertices)
    scene.add_body(shape, scene.surface_mesh(result.surface))
    scene.add_features(shape, result.surface, result.features, 5)
    radius = 0.009 * scene.diagonal(points)
    lines = [
        _beginning(np.asarray(line.points), scene.diagonal(points))
        for line in result.separatrices
        if len(line.points) > 1
    ]
    if lines:
        shape.add_mesh(polylines(lines).tube(radius=0.2 * radius, n_sides=8), color=scene.GREEN, lighting=False)
    for sign, colour in ((1, scene.VERMILLION), (-1, scene.BLUE)):
        centres = np.array([s.position for s in result.singularities.points if s.index * sign > 0])
        if len(centres):
            balls = pyvista.PolyData(centres).glyph(geom=pyvista.Sphere(radius=radius), scale=False, orient=False)
            shape.add_mesh(balls, color=colour, smooth_shading=True, ambient=0.3)
    _from_above(shape, points)
    return shape


def _beginning(points: np.ndarray[Any, Any], length: float) -> np.ndarray[Any, Any]:
    """Of a polyline as much as is legible where many cross."""
    run = np.linalg.norm(np.diff(points, axis=0), axis=1).cumsum()
    return points[: 2 + int(np.searchsorted(run, length))]


def _from_above(shape: pyvista.Plotter, points: Any) -> None:
    from . import scene

    array = np.asarray(points)
    if len(array) < 2:
        return
    along, across, up = scene.principal_axes(array)
    scene.look(shape, array, -0.45 * along - 0.75 * across + 0.62 * up, up)


def shown(kind: type) -> type:
    """Gives a class its pictures: results by decoration, compiled classes from __init__.py."""
    kind._repr_html_ = html_of
    kind._ipython_display_ = display_live
    return kind
