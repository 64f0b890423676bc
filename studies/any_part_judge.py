"""How far a result of any_part.py is from its input: volume, topology, distance of the surfaces, alignment; and
pictures to look at."""

import re
from pathlib import Path
from typing import Any

import numpy as np
import octafield
import pyvista
import vtk
from any_part_inputs import Case
from scipy.spatial import cKDTree

VOLUME, FAR, ANGLE = 0.01, 0.01, 10.0  # relative; of the size; degrees
SAMPLES = 5000
# What a note has to speak of to tell of a changed shape, and of axes that are off. That triangles were turned or points
# merged excuses neither.
_SHAPE = re.compile(
    r"fill|wrap|remov|flatten|detail|coarse|deviat|lost|left out|perturb|moved|finer|away", re.IGNORECASE
)
_AXES = re.compile(r"flatten|detail|coarse|finer|axes|normals", re.IGNORECASE)


def words_of(record: dict[str, Any], wrong: str) -> str:
    """What the record says of what is wrong with its result, "" where it says nothing. A verdict that is not fine tells
    of anything."""
    told = record.get("verdict") or {}
    state = told if isinstance(told, str) else str(told.get("state", told.get("verdict", "fine")))
    if not state.startswith(("fine", "pass")):
        return f"verdict: {state}"
    needed = _AXES if wrong.startswith("axes") else _SHAPE
    return "; ".join(note for note in record["notes"] if needed.search(note))


def distances(points: np.ndarray, surface: pyvista.PolyData) -> tuple[np.ndarray, np.ndarray]:
    """To the nearest point of a surface, and the ids of the triangles there."""
    ids, nearest = surface.find_closest_cell(points, return_closest_point=True)
    return np.linalg.norm(points - nearest, axis=1), np.asarray(ids)


def samples(mesh: pyvista.PolyData) -> np.ndarray:
    """Vertices and centres of triangles, an even share of them."""
    points = np.concatenate([mesh.points, mesh.cell_centers().points]).astype(float)
    return points[:: max(1, len(points) // SAMPLES)]


def mean_normals(source: octafield.TriangleMesh, points: np.ndarray, nearest: np.ndarray, radius: float) -> np.ndarray:
    """(k, 3) of the input's triangles within `radius` of points, weighted by area, those turned away from the nearest
    one left out: noise shorter than the edges is none of the field's business."""
    chosen = _with_area(source)
    p = np.asarray(source.vertices)[np.asarray(source.triangles)[chosen]]
    weighted = np.cross(p[:, 1] - p[:, 0], p[:, 2] - p[:, 0])
    around = cKDTree(p.mean(axis=1)).query_ball_point(np.asarray(points, float), radius)
    sums = np.array(
        [
            weighted[ids][weighted[ids] @ weighted[at] > 0].sum(axis=0) + weighted[at]
            for ids, at in zip(around, nearest, strict=True)
        ]
    )
    return sums / np.linalg.norm(sums, axis=1, keepdims=True)


def axis_angles(
    result: pyvista.PolyData, volume: pyvista.UnstructuredGrid, normals: np.ndarray, chosen: np.ndarray
) -> np.ndarray:
    """Degrees between normals (k, 3) and the nearest axis of the frame at the chosen vertices of the surface."""
    locator = vtk.vtkStaticPointLocator()
    locator.SetDataSet(volume)
    locator.BuildLocator()
    ids = np.array([locator.FindClosestPoint(p) for p in result.points[chosen]], int)
    axes = np.asarray(octafield.frames.rotation_matrices(np.asarray(volume.point_data["quaternion"], float)[ids]))
    cosines = np.abs(np.einsum("nck,nc->nk", axes, normals)).max(axis=1)
    return np.degrees(np.arccos(np.clip(cosines, 0, 1)))


def vertex_areas(mesh: octafield.TriangleMesh) -> np.ndarray:
    """(n,) A third of the triangles round each vertex."""
    triangles, areas = np.asarray(mesh.triangles), np.asarray(octafield.surface.triangle_areas(mesh))
    return np.bincount(triangles.ravel(), np.repeat(areas / 3, 3), len(mesh.vertices))


def quantile_by_area(values: np.ndarray, areas: np.ndarray, share: float) -> float:
    """The least value that so large a share of the area does not exceed: vertices are dense where a surface bends."""
    order = np.argsort(values)
    reached = np.cumsum(areas[order]) >= share * areas.sum()
    return float(values[order][np.argmax(reached)])


def judge(case: Case, path: Path, output: Path, record: dict[str, Any]) -> dict[str, Any]:
    """Figures of a row, and `wrong`: which of the four bounds are broken."""
    volume = pyvista.read(output / "field.vtu")
    result = pyvista.read(output / "surface.vtp")
    faces = np.asarray(result.faces.reshape(-1, 4)[:, 1:])
    mesh = octafield.TriangleMesh(np.asarray(result.points, float), faces.astype(np.int32))
    source = octafield.read_surface(path) if path.suffix != ".vtp" else None
    wrong, size = [], float(np.linalg.norm(np.ptp(result.points, axis=0)))
    found_volume = float(octafield.surface.signed_volume(mesh))
    euler = int(octafield.surface.euler_characteristic(mesh))
    row: dict[str, Any] = {
        "tets": record["tets"],
        "energy": record["energy"],
        "singular": record["singular_edges"],
        "euler": euler,
    }
    if case.volume is not None:
        row["volume %"] = 100 * (found_volume / case.volume - 1)
        if abs(row["volume %"]) > 100 * VOLUME:
            wrong.append(f"volume {row['volume %']:+.2g} %")
    if case.euler is not None and euler != case.euler:
        wrong.append(f"Euler characteristic {euler}, not {case.euler}")
    if source is None:
        return row | {"wrong": "; ".join(wrong)}
    triangles = np.asarray(source.triangles)
    given = pyvista.PolyData.from_regular_faces(np.asarray(source.vertices), triangles[_with_area(source)])
    there, nearest = distances(np.asarray(result.points, float), given)
    back = distances(samples(given.clean(tolerance=0)), result)[0] if case.sound else np.zeros(1)
    row["far %"] = 100 * float(max(np.quantile(there, 0.999), np.quantile(back, 0.999))) / size
    if row["far %"] > 100 * FAR and case.sound:
        wrong.append(f"surfaces {row['far %']:.2g} % of the size apart")
    away = there < FAR * size  # where a hole was filled the input has no normals
    features = output / "features.vtp"
    if features.exists() and (lines := pyvista.read(features)).n_points:
        near = vtk.vtkStaticPointLocator()
        near.SetDataSet(lines)
        near.BuildLocator()
        gap = [np.linalg.norm(np.subtract(lines.points[near.FindClosestPoint(p)], p)) for p in result.points]
        away &= np.array(gap) > 0.5 * record["edge_length"]
    if away.any():
        near = 0.5 * record["edge_length"]
        wide = max(near, min(octafield.surface.mean_edge_length(source), 0.5 * octafield.surface.shape_size(mesh) / 25))
        # An input's normals are known no better than to its own triangles: that of one, or the mean of those around.
        angles = np.minimum(
            *(
                axis_angles(result, volume, mean_normals(source, result.points[away], nearest[away], r), away)
                for r in (near, wide)
            )
        )
        row["angle 95 %"] = quantile_by_area(angles, vertex_areas(mesh)[away], 0.95)
        if row["angle 95 %"] > ANGLE:
            wrong.append(f"axes {row['angle 95 %']:.3g} degrees off on 5 % of the surface")
    _picture(result, output)
    return row | {"wrong": "; ".join(wrong)}


def _with_area(mesh: octafield.TriangleMesh) -> np.ndarray:
    return np.asarray(octafield.surface.triangle_areas(mesh)) > 0


def _picture(result: pyvista.PolyData, output: Path) -> None:
    plotter = pyvista.Plotter(off_screen=True, window_size=(320, 320))
    plotter.add_mesh(result, color="lightgrey", show_edges=True, line_width=0.3)
    singular = pyvista.read(output / "singular.vtp")
    if singular.n_points:
        plotter.add_mesh(singular, color="red", line_width=2)
    plotter.add_text(output.parent.name[-34:], font_size=6)
    plotter.screenshot(output.parent / "picture.png")
    plotter.close()


def contact_sheet(folder: Path) -> None:
    """Every picture of the runs, eight in a row, as contact.png."""
    from PIL import Image

    pictures = sorted(folder.glob("runs/*/picture.png"))
    if not pictures:
        return
    sheet = Image.new("RGB", (8 * 320, -(-len(pictures) // 8) * 320), "white")
    for k, path in enumerate(pictures):
        sheet.paste(Image.open(path), (k % 8 * 320, k // 8 * 320))
    sheet.save(folder / "contact.png")
