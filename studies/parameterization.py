"""What a parameterization needs of frame fields: cut, alignment, sizes along the axes and the curl they leave.

    python studies/parameterization.py -o DIR [--picture NAME] MESH...

MESH: surfaces or tet meshes; default recipe. DIR gets cuts.md (cut triangles, those with a turn, patches of one axis),
    sizes.md (curl and jump before and after, range of the sizes), seconds.md and, of the mesh whose file name begins
    with NAME (default: the first), cut.png: left the cut and the singular edges, right the size of grid cells, one for
    all axes, in the half behind a plane.
"""

import argparse
import io
import time
from dataclasses import dataclass
from pathlib import Path

import numpy as np
import octafield
import pyvista
from octafield.domain.meshed_input import MeshedInput
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import compute_field
from octafield.options import FieldOptions
from octafield.view import scene
from PIL import Image
from study_output import markdown_table
from surface_pictures import save_with_few_colours

BAR = {
    "vertical": True,
    "color": "black",
    "fmt": "%.2f",
    "position_x": 0.92,
    "position_y": 0.25,
    "height": 0.5,
    "width": 0.05,
    "title_font_size": 22,
    "label_font_size": 20,
}


@dataclass
class Study:
    name: str
    meshed: MeshedInput
    singular: octafield.volume.SingularEdges
    combed: octafield.volume.CombedField
    tables: octafield.volume.AlignmentTables
    isotropic: octafield.volume.IsotropicScale
    axes: octafield.volume.AxisScales
    seconds: dict[str, float]


def study(path: Path) -> Study:
    seconds = {}

    def timed(name, function, *arguments, **options):
        start = time.process_time()
        result = function(*arguments, **options)
        seconds[name] = time.process_time() - start
        return result

    options = FieldOptions(threads=1, streamlines=0)
    meshed = prepare_mesh(path, options)
    tets = meshed.tets
    frames = timed("field", compute_field, meshed, options).frames
    of_tets = octafield.volume.tet_frames(tets, frames, threads=1)
    combed = timed("comb", octafield.volume.comb, tets, of_tets, threads=1)
    return Study(
        path.name.split(".")[0],
        meshed,
        octafield.volume.singular_edges(tets, of_tets, threads=1),
        combed,
        timed("alignment_tables", octafield.volume.alignment_tables, tets, combed),
        timed("isotropic_scale", octafield.volume.isotropic_scale, tets, frames, threads=1),
        timed("axis_scales", octafield.volume.axis_scales, tets, frames, threads=1),
        seconds,
    )


def cut_row(s: Study) -> tuple:
    cut = np.asarray(s.combed.cut) == 1
    turned = np.asarray(s.combed.faces.matching)[cut] > 0
    one_axis = np.asarray(s.tables.patch_one_axis)
    angles = np.degrees(s.tables.triangle_angle)
    return (
        s.name,
        f"{len(s.combed.frames):,}",
        len(s.singular.edges),
        f"{cut.sum():,}",
        f"{turned.sum():,}",
        len(one_axis),
        one_axis.sum(),
        f"{np.median(angles):.2f} ({np.quantile(angles, 0.95):.1f})",
    )


def size_row(s: Study) -> tuple:
    size = scene.diagonal(np.asarray(s.meshed.tets.vertices))
    one, three = s.isotropic, s.axes
    return (
        s.name,
        f"{size * one.before.curl_rms:.3f}",
        f"{size * one.after.curl_rms:.3f}",
        f"{size * three.after.curl_rms:.3f}",
        near_singular_edges(s),
        f"{one.before.jump_rms:.4f}",
        f"{one.after.jump_rms:.4f}",
        f"{three.after.jump_rms:.4f}",
        f"{np.exp(np.ptp(one.log_scale)):.2f}",
        f"{np.exp(np.ptp(three.values)):.2f}",
        three.parts,
    )


def near_singular_edges(s: Study) -> str:
    """Shares of the squared curl left per axis, and of the volume, in tets that a singular edge ends in."""
    ends = np.asarray(s.singular.vertices)
    near, volumes = np.isin(s.meshed.tets.tets, ends).any(axis=1), octafield.volume.tet_volumes(s.meshed.tets)
    squares = volumes * np.asarray(s.axes.after.curl) ** 2
    return f"{squares[near].sum() / squares.sum():.0%} ({volumes[near].sum() / volumes.sum():.1%})"


def seconds_row(s: Study) -> tuple:
    return (
        s.name,
        f"{len(s.combed.frames):,}",
        *(f"{seconds:.2f}" for seconds in s.seconds.values()),
        s.isotropic.iterations,
        s.axes.iterations,
    )


def curves(s: Study) -> pyvista.PolyData:
    ends = np.array([(e.a, e.b) for e in s.singular.edges]).reshape(-1, 2)
    points = np.asarray(s.meshed.tets.vertices)
    return scene.segments(points[ends[:, 0]], points[ends[:, 1]])


def picture(s: Study) -> Image.Image:
    points, surface = np.asarray(s.meshed.tets.vertices), s.meshed.tets.surface.mesh
    cut = np.asarray(s.combed.cut) == 1
    walls = pyvista.PolyData.from_regular_faces(points, np.asarray(s.combed.faces.triangles)[cut])
    axes = scene.principal_axes(points)
    direction = axes[0] * 0.55 - axes[1] + 0.6 * axes[2]

    left = scene.plotter()
    left.enable_depth_peeling(8)
    left.add_mesh(scene.surface_mesh(surface), color=scene.BODY, opacity=0.15, lighting=False)
    left.add_mesh(walls, color=scene.SKY, opacity=0.75, ambient=0.5, diffuse=0.6)
    scene.add_features(left, surface, s.meshed.tets.features, 2.5)
    if s.singular.edges:
        left.add_mesh(curves(s), color=scene.VERMILLION, line_width=7, lighting=False)

    right = scene.plotter()
    cells = np.column_stack([np.full(len(s.meshed.tets.tets), 4), s.meshed.tets.tets]).ravel()
    body = pyvista.UnstructuredGrid(cells, np.full(len(s.meshed.tets.tets), pyvista.CellType.TETRA), points)
    body["size of cells"] = np.exp(-np.asarray(s.isotropic.log_scale))
    plane = (-axes[1], (points.min(0) + points.max(0)) / 2)
    half = body.clip(normal=axes[1], origin=plane[1], invert=False)
    right.add_mesh(half, cmap="cividis", lighting=False, scalar_bar_args=BAR)
    scene.add_features(right, surface, s.meshed.tets.features, 2.5, behind=plane)
    if s.singular.edges:
        right.add_mesh(curves(s), color=scene.VERMILLION, line_width=4, lighting=False, opacity=0.6)

    images = []
    for one in (left, right):
        scene.look(one, points, direction, axes[2])
        if one is right:
            one.camera.parallel_scale *= 1.25  # room for the colour bar
        images.append(Image.open(io.BytesIO(scene.render(one))).convert("RGB"))
    height = max(image.height for image in images)
    sheet = Image.new("RGB", (sum(image.width for image in images), height), "white")
    sheet.paste(images[0], (0, (height - images[0].height) // 2))
    sheet.paste(images[1], (images[0].width, (height - images[1].height) // 2))
    return sheet


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--picture", default="")
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    cuts, sizes, seconds, drawn = [], [], [], False
    for path in arguments.mesh:
        found = study(path)
        cuts.append(cut_row(found))
        sizes.append(size_row(found))
        seconds.append(seconds_row(found))
        print(*sizes[-1], flush=True)
        if not drawn and found.name.startswith(arguments.picture):
            save_with_few_colours(picture(found), arguments.output / "cut.png", 128)
            drawn = True
    header = [
        "mesh",
        "tets",
        "singular edges",
        "cut triangles",
        "with a turn",
        "patches",
        "of one axis",
        "angle to the normal, degrees: median (95 %)",
    ]
    (arguments.output / "cuts.md").write_text(markdown_table(header, cuts))
    header = [
        "mesh",
        "curl",
        "one size",
        "one per axis",
        "of it at singular edges (volume)",
        "jump",
        "one size",
        "one per axis",
        "largest over smallest size",
        "per axis",
        "sets of axes",
    ]
    (arguments.output / "sizes.md").write_text(markdown_table(header, sizes))
    header = [
        "mesh",
        "tets",
        "field",
        "comb",
        "alignment_tables",
        "isotropic_scale",
        "axis_scales",
        "iterations",
        "per axis",
    ]
    (arguments.output / "seconds.md").write_text(markdown_table(header, seconds))


if __name__ == "__main__":
    main()
