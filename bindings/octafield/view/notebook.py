"""How results show themselves in Jupyter: a scene to turn where pyvista has a backend for it that works (pip install
'octafield[notebook]'), and always a picture, which stays where the notebook is saved, with the main figures beside it;
the figures alone without OpenGL.

pyvista decides: pyvista.set_jupyter_backend("static") asks for pictures, "html" for scenes that stay in exported
notebooks.
"""

from __future__ import annotations

import abc
import base64
import html
import importlib.util
import logging
import warnings
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

log = logging.getLogger("octafield")

if TYPE_CHECKING:
    import pyvista


# A title, and figures by name (or lines of them).
Facts = tuple[str, Mapping[str, Any] | Sequence[Mapping[str, Any]]]
Draw = Callable[[], "pyvista.Plotter | None"]


class ShownInNotebooks(abc.ABC):
    """What IPython asks of an object that is more than a line of text."""

    @abc.abstractmethod
    def _facts(self) -> Facts:
        """The title and the main figures."""

    def _drawn(self) -> pyvista.Plotter | None:
        """None where there is nothing to draw. Raises IoError without OpenGL."""
        return None

    def _repr_html_(self) -> str:
        return html_of(self._facts(), self._drawn)

    def _ipython_display_(self) -> None:
        display_live(self._facts(), self._drawn)


def facts_of_record(record: Mapping[str, Any], names: Sequence[str]) -> Facts:
    """names: of the figures to show, where the record has them."""
    what = [record[name] for name in ("representation", "boundary", "method") if name in record]
    return ", ".join([str(record["input"]), *map(str, what)]), {name: record[name] for name in names if name in record}


def html_of(facts: Facts, draw: Draw) -> str:
    """For _repr_html_: a still picture and the main figures."""
    title, figures = facts
    picture = ""
    if data := _picture(draw):
        text = base64.b64encode(data).decode()
        picture = f'<img style="max-width:420px" alt="{html.escape(title)}" src="data:image/png;base64,{text}">'
    return (
        f"<div><b>{html.escape(title)}</b><div"
        f' style="display:flex;gap:1em;align-items:center">{picture}{_table(figures)}</div></div>'
    )


def display_live(facts: Facts, draw: Draw) -> None:
    """For _ipython_display_: a scene to turn, then the HTML above: the scene is gone when its kernel is.
    NotImplementedError, which is IPython's word for it: there is no backend or it does not work, IPython then asks for
    the HTML alone."""
    if not live_backend() or not _can_draw():
        raise NotImplementedError
    from IPython.display import HTML, display  # type: ignore[import-not-found, unused-ignore]

    viewer = _viewer(draw())
    if viewer is None:
        raise NotImplementedError
    display(viewer)
    display(HTML(html_of(facts, draw)))


def _picture(draw: Draw) -> bytes | None:
    from . import scene

    if not scene.can_draw():
        return None
    shape = draw()
    return None if shape is None else scene.render(shape)


def _viewer(shape: pyvista.Plotter | None) -> Any:
    """What pyvista shows of the scene; None where that is a picture, or the backend fails in whatever way it has."""
    if shape is None:
        return None
    import PIL.Image

    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # pyvista's advice where it falls back itself
            shown = shape.show(return_viewer=True)
    except Exception as error:
        log.warning("no scene to turn, but a picture: %s", error)
        return None
    return None if isinstance(shown, PIL.Image.Image) else shown


def _can_draw() -> bool:
    from . import scene

    return scene.can_draw()


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


def _cell(value: Any) -> str:
    return html.escape(f"{value:.6g}" if isinstance(value, float) else str(value))


def _table(facts: Mapping[str, Any] | Sequence[Mapping[str, Any]]) -> str:
    if isinstance(facts, Mapping):
        lines = [f"<tr><td>{html.escape(name)}</td><td>{_cell(value)}</td></tr>" for name, value in facts.items()]
    else:
        heads = list(dict.fromkeys(name for row in facts for name in row))
        lines = ["<tr>" + "".join(f"<th>{html.escape(name)}</th>" for name in heads) + "</tr>"]
        lines += ["<tr>" + "".join(f"<td>{_cell(row.get(name, ''))}</td>" for name in heads) + "</tr>" for row in facts]
    return f"<table>{''.join(lines)}</table>"
