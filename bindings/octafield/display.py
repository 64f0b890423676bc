"""How results show themselves: one line in a terminal, facts and a picture in Jupyter, a scene to turn."""

from __future__ import annotations

import base64
import html
from pathlib import Path
from typing import TYPE_CHECKING

from .errors import IoError

if TYPE_CHECKING:
    import pyvista

    from .pipeline import FieldResult

_FACTS = ("vertices", "tets", "energy", "singular_edges", "complex_edges", "non_meshable_vertices", "converged")


def one_line(result: FieldResult) -> str:
    r = result.record
    return (
        f"FieldResult({r['input']}: {r['vertices']:,} vertices, {r['tets']:,} tets; {r['representation']}, {r['boundary']}; "
        f"E {r['energy']:.6g}, {r['singular_edges']:,} singular edges)"
    )


def as_html(result: FieldResult) -> str:
    """For Jupyter: the singular curves and the main figures."""
    from . import pictures, scene

    r = result.record
    shown = {name: f"{r[name]:.6g}" if isinstance(r[name], float) else str(r[name]) for name in _FACTS}
    lines = "".join(f"<tr><td>{html.escape(name)}</td><td>{value}</td></tr>" for name, value in shown.items())
    image = ""
    if scene.can_draw():
        data = base64.b64encode(pictures.singular_curves(result).png).decode()
        image = f'<img style="max-width:420px" alt="singular curves" src="data:image/png;base64,{data}">'
    return (
        f"<div><b>{html.escape(str(r['input']))}</b>, {html.escape(r['representation'])}, {html.escape(r['boundary'])}"
        f'<div style="display:flex;gap:1em;align-items:center">{image}<table>{lines}</table></div></div>'
    )


def scene_of(result: FieldResult) -> pyvista.Plotter:
    """A pyvista scene of the singular curves inside the translucent surface: .show() opens a window, or in Jupyter a view to
    turn (with trame) or a picture."""
    from .pictures import singular_scene

    return singular_scene(result)


def view_folder(folder: Path, picture: Path | None = None) -> None:
    """Shows the singular curves that `octafield field` wrote, in a window, or writes them to a PNG."""
    from .pictures import scene_from_files

    files = folder / "surface.vtp", folder / "singular.vtp"
    missing = next((path for path in files if not path.is_file()), None)
    if missing is not None:
        raise IoError(f"{missing}: no such file; give the folder of a result of `octafield field`")
    shape = scene_from_files(*files)
    if picture is None:
        shape.off_screen = False
        shape.show(title=f"octafield: {folder}")
        return
    from . import scene

    partial = picture.with_name(f".{picture.name}.partial")
    try:
        partial.write_bytes(scene.render(shape))
        partial.replace(picture)
    except OSError as error:
        raise IoError(f"{picture}: cannot write there ({error.strerror})") from error
