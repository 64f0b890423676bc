"""What all pictures share: colours, camera, rendering without a display, PNG bytes of bounded size."""

import ctypes
import io
import os
from typing import TYPE_CHECKING

import numpy as np

from .._core import FeatureGraph, TriangleMesh
from ..errors import IoError

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

if not os.environ.get("DISPLAY"):  # before VTK picks a window: no attempt to reach an X server, no warning about it
    os.environ.setdefault("VTK_DEFAULT_OPENGL_WINDOW", "vtkEGLRenderWindow")

import pyvista  # noqa: E402

# Okabe and Ito's palette, told apart with any colour vision.
BLUE, VERMILLION, GREEN, PURPLE, SKY, ORANGE = "#0072B2", "#D55E00", "#009E73", "#AA4499", "#56B4E9", "#E69F00"
BROWN, GREY = "#8C510A", "#7B8794"
INK, CURVE, CROSS, BODY = "#1b1f24", "#20262d", "#3f5d7d", "#d9dfe6"

SIZE = (1200, 900)  # of windows; widths of lines are for it
PICTURE = (2000, 1500)  # pixels of pictures before they are cropped
MOST_BYTES = 2_500_000


NO_OPENGL = "pictures need the library EGL or OSMesa (Debian: apt-get install libegl1 libosmesa6)"


def can_draw() -> bool:
    """Whether VTK finds what it draws with; without, it ends the process."""
    if os.environ.get("DISPLAY") and _loads("libX11.so.6") and _loads("libGL.so.1"):
        return True
    return any(map(_loads, ("libEGL.so.1", "libOSMesa.so.8", "libOSMesa.so.6", "libOSMesa.so")))


def _loads(library: str) -> bool:
    try:
        ctypes.CDLL(library)
    except OSError:
        return False
    return True


def plotter() -> pyvista.Plotter:
    if not can_draw():
        raise IoError(NO_OPENGL, "no_opengl")
    scene = pyvista.Plotter(off_screen=True, window_size=list(SIZE), lighting="none")
    for place, strength in (
        ((-0.6, 0.9, 0.7), 0.45),
        ((0.3, -0.1, 1.0), 0.55),
    ):  # key light and fill, turning with the camera
        scene.add_light(
            pyvista.Light(position=place, focal_point=(0, 0, 0), light_type="camera light", intensity=strength)
        )
    scene.background_color = pyvista.Color("white")
    scene.enable_anti_aliasing("ssaa")
    return scene


def surface_mesh(mesh: TriangleMesh) -> pyvista.PolyData:
    """A TriangleMesh for drawing."""
    triangles: np.ndarray = np.asarray(mesh.triangles)
    surface: pyvista.PolyData = pyvista.PolyData.from_regular_faces(np.asarray(mesh.vertices), triangles)
    return surface


def segments(starts: np.ndarray, ends: np.ndarray) -> pyvista.PolyData:
    """One line per pair of points."""
    count = len(starts)
    lines = np.column_stack([np.full(count, 2), np.arange(count), np.arange(count) + count])
    return pyvista.PolyData(np.concatenate([starts, ends]), lines=lines.ravel())


def add_body(scene: pyvista.Plotter, surface: pyvista.PolyData) -> None:
    """The solid's surface in grey: round faces smooth, edges sharp."""
    surface = surface.compute_normals(cell_normals=False, split_vertices=True, feature_angle=35)
    scene.add_mesh(surface, color=BODY, smooth_shading=True, ambient=0.35, diffuse=0.8, specular=0)


def add_features(
    scene: pyvista.Plotter,
    mesh: TriangleMesh,
    features: FeatureGraph,
    width: float = 4.0,
    behind: tuple[np.ndarray, np.ndarray] | None = None,
) -> None:
    """Feature curves; `behind`: (normal, point) of a plane, only what lies behind it."""
    edges = np.asarray(features.edges)
    if not len(edges):
        return
    points = np.asarray(mesh.vertices)
    lines = segments(points[edges[:, 0]], points[edges[:, 1]])
    if behind is not None:
        lines = lines.clip(normal=behind[0], origin=behind[1], invert=True)
    if lines.n_cells:
        scene.add_mesh(lines, color=CURVE, line_width=width, lighting=False)


def principal_axes(points: np.ndarray) -> np.ndarray:
    """Rows: long, middle and short axis of the shape. Where two are about as long, coordinate axes replace
    them; the short one points upwards."""
    values, vectors = np.linalg.eigh(np.cov(points.T))
    lengths = np.sqrt(np.maximum(values, 0))
    world = np.eye(3)
    up = vectors[:, 0] if lengths[0] < 0.8 * lengths[1] else world[2]
    up = _snapped(up) * np.sign(_snapped(up)[np.abs(up).argmax()])
    if lengths[2] > 1.25 * lengths[1] and abs(vectors[:, 2] @ up) < 0.5:
        across = vectors[:, 2]
    else:
        across = world[np.abs(world @ up).argmin()]
    across = _snapped(across - up * (across @ up))
    across /= np.linalg.norm(across)
    return np.array([across, np.cross(up, across), up])


def _snapped(axis: np.ndarray) -> np.ndarray:
    """The coordinate axis within 10 degrees of `axis`, else itself: pictures of upright parts stay upright."""
    axis = axis / np.linalg.norm(axis)
    nearest = np.abs(axis).argmax()
    if abs(axis[nearest]) < np.cos(np.radians(10)):
        return axis
    along: np.ndarray = np.sign(axis[nearest]) * np.eye(3)[nearest]
    return along


def look(scene: pyvista.Plotter, points: np.ndarray, direction: np.ndarray, up: np.ndarray) -> None:
    """Points the camera at the middle of the points from `direction`, the points filling the picture."""
    direction = direction / np.linalg.norm(direction)
    right = np.cross(up, direction)
    right /= np.linalg.norm(right)
    true_up = np.cross(direction, right)
    low, high = (
        (points @ np.array([right, true_up, direction]).T).min(0),
        (points @ np.array([right, true_up, direction]).T).max(0),
    )
    centre = ((low + high) / 2) @ np.array([right, true_up, direction])
    distance = 10 * np.linalg.norm(high - low)
    scene.camera.parallel_projection = True
    scene.camera.focal_point = centre
    scene.camera.position = centre + distance * direction
    scene.camera.up = true_up
    scene.camera.parallel_scale = 1.06 * max((high[1] - low[1]) / 2, (high[0] - low[0]) / 2 * SIZE[1] / SIZE[0])
    scene.reset_camera_clipping_range()


def diagonal(points: np.ndarray) -> float:
    return float(np.linalg.norm(points.max(0) - points.min(0)))


def render(scene: pyvista.Plotter) -> bytes:
    """The picture as PNG, cropped to what is not background; fewer colours where it would be above the bound."""
    from PIL import Image, ImageChops

    for actor in scene.renderer.actors.values():
        if isinstance(actor, pyvista.Actor):
            actor.prop.line_width *= PICTURE[0] / SIZE[0]
    scene.window_size = list(PICTURE)
    try:
        image = Image.fromarray(np.asarray(scene.screenshot(return_img=True)))
    finally:
        scene.close()
    box = ImageChops.difference(image, Image.new("RGB", image.size, "white")).getbbox()
    if box:
        image = image.crop(
            (max(box[0] - 20, 0), max(box[1] - 20, 0), min(box[2] + 20, PICTURE[0]), min(box[3] + 20, PICTURE[1]))
        )
    for colours in (0, 256, 64):
        data = io.BytesIO()
        (fewer_colours(image, colours) if colours else image).save(data, "PNG")
        if data.tell() <= MOST_BYTES:
            break
    return data.getvalue()


def fewer_colours(image: "Picture", colours: int) -> "Picture":
    """`colours` that fit the picture best, found on every ninth pixel: the time is mostly theirs."""
    from PIL import Image

    sample = image.resize((-(-image.width // 3), -(-image.height // 3)), Image.Resampling.NEAREST)
    reduced = image.quantize(palette=sample.quantize(colours, kmeans=1), dither=Image.Dither.NONE)
    background = np.array(reduced)[(np.array(image) == 255).all(axis=2)]
    if len(background):  # the mean of almost white colours would make it grey
        values = reduced.getpalette() or []
        start = 3 * int(np.bincount(background).argmax())
        values[start : start + 3] = [255, 255, 255]
        reduced.putpalette(values)
    return reduced


def three_quarter_view(shape: pyvista.Plotter, points: np.ndarray) -> None:
    """Of what lies around points; as it is where there are fewer than two."""
    if len(points) < 2:
        return
    along, across, up = principal_axes(points)
    look(shape, points, -0.45 * along - 0.75 * across + 0.62 * up, up)
