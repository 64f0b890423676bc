"""Windows, and the view of a result's folder in one."""

from __future__ import annotations

import os
import sys
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InvalidInput, IoError

if TYPE_CHECKING:
    import pyvista


def shown_where_possible(shape: pyvista.Plotter) -> pyvista.Plotter:
    """Made for a window or a notebook, where there is one."""
    import pyvista

    shape.off_screen = bool(pyvista.OFF_SCREEN or shape.notebook or not os.environ.get("DISPLAY"))
    return shape


def _require_display(folder: Path) -> None:
    """VTK without a display ends the process, or says nothing at all."""
    words = f"there is no display to open a window on; write a picture: octafield view {folder} -o curves.png"
    if sys.platform != "linux":
        return
    if not os.environ.get("DISPLAY"):
        raise InvalidInput(words, "no_display")
    if not _opens_windows():
        raise InvalidInput(
            f"the display {os.environ['DISPLAY']} cannot be opened; {words.partition('; ')[2]}", "no_display"
        )


def _opens_windows() -> bool:
    """VTK takes a window that is never shown where it cannot open the display."""
    import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
    from vtkmodules.vtkRenderingCore import vtkRenderWindow

    name: str = vtkRenderWindow().GetClassName()
    return "EGL" not in name and "OSOpenGL" not in name


def view_folder(folder: Path, picture: Path | None = None) -> dict[str, Any]:
    """Shows the singular curves that `octafield field` wrote, the points and separatrices of `octafield
    surface-field`, the mesh of `octafield hex-dominant` or the quads of `octafield quad-layout`, in a window, or writes
    a PNG; what it did, for --json."""
    shape, names = _scene_of(folder)
    record = {"folder": str(folder), "files": names, "picture": picture and str(picture)}
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


def _scene_of(folder: Path) -> tuple[pyvista.Plotter, list[str]]:
    """With the names of the files it shows."""
    from . import quad_layout, surface_field

    if quad_layout.is_layout(folder):
        return quad_layout.scene_of_folder(folder)
    if (folder / "mesh.vtu").is_file():
        from .hex_mesh import scene_of_folder

        return scene_of_folder(folder), ["mesh.vtu", "singular.vtp"]
    if surface_field.is_surface_field(folder):
        return surface_field.scene_of_folder(folder)
    from .curves import scene_from_files

    files = folder / "surface.vtp", folder / "singular.vtp"
    missing = next((path for path in files if not path.is_file()), None)
    if missing is not None:
        raise IoError(
            f"{missing}: no such file; give the folder of a result of `octafield field`, `surface-field`,"
            " `hex-dominant` or `quad-layout`"
        )
    return scene_from_files(*files), [path.name for path in files]
