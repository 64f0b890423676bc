"""Frames in sharp wedges: axes along both faces by axes_stretch, beside frames at right angles.

    python studies/volume_wedges.py -o DIR [--angles 15,30,45,60,75] [--edges 12]
    python studies/volume_wedges.py -o DIR --files DATA/hexme/s02c.vtk.gz ...

Prisms of height 0.6 over right triangles with a side of 1 at the angle, tets of 1 / EDGES. DIR gets wedges.md,
representations.md (one prism, every representation that is compared) and wedges.png. With --files files.md alone.
"""

import argparse
import time
from pathlib import Path

import numpy as np
import octafield
from study_output import markdown_table
from surface_wedges import prism

VOLUME = octafield.volume
OF_ONE = 30.0  # degrees, of the prism of representations.md


def domain_of(degrees: float, edges: int) -> tuple[octafield.TetDomain, np.ndarray]:
    """And directions on its surface."""
    options = octafield.MeshOptions(edge_length=1 / edges, feature_angle=np.radians(20))
    problem = octafield.prepare_field(octafield.prepare_mesh(prism(degrees), options))
    return problem.meshed.volume(), problem.directions


def angles_between(axes: np.ndarray) -> np.ndarray:
    """(n, 3) acute angles, degrees."""
    unit = axes / np.linalg.norm(axes, axis=2, keepdims=True)
    cosines = np.abs(np.einsum("vid,vid->vi", unit, np.roll(unit, 1, axis=1)))
    return np.degrees(np.arccos(np.minimum(cosines, 1)))


def figures(domain, directions, degrees: float, stretch=None, representation: str = "sh4") -> dict:
    """stretch: None for frames at right angles."""
    began = time.process_time()
    held = VOLUME.boundary_constraints(domain, directions, stretch=stretch)
    frames = VOLUME.frame_field(domain, held, representation=representation).smooth.frames
    seconds = time.process_time() - began
    at_wedge = np.linalg.norm(np.asarray(domain.vertices)[:, :2], axis=1) < 1e-9
    normals, tangents = VOLUME.sector_normals(domain), VOLUME.feature_tangents(domain)
    ids = np.asarray(domain.surface.vertex_map)
    of_faces = np.degrees(VOLUME.alignment_angles(domain, frames, stretch=stretch))
    of_edges = np.degrees(VOLUME.feature_alignment_angles(domain, frames, stretch=stretch))
    graph = VOLUME.singular_graph(domain, frames)
    places = np.array([t.point for t in graph.triangles]).reshape(-1, 3)
    identity = np.tile([1.0, 1, 1, 0, 0, 0], (len(frames), 1))
    axes = VOLUME.stretched_axes(frames, identity if stretch is None else stretch)
    return {
        "at wedge": max(of_faces[at_wedge[ids[normals.vertex]]].max(), of_edges[at_wedge[ids[tangents.vertex]]].max()),
        "anywhere": max(of_faces.max(), of_edges.max()),
        "curves": len(graph.curves),
        "types": sorted({int(turns) for turns in graph.curve_quarter_turns}),
        "nearest": np.linalg.norm(places[:, :2], axis=1).min() if len(places) else np.inf,
        "least": angles_between(axes).min(),
        "without": VOLUME.boundary_meshability(domain, frames, stretch=stretch).non_meshable_wedges,
        "graph": graph,
        "axes": axes,
        "seconds": seconds,
    }


def row_of(name, edges: int, found: dict) -> list[str]:
    valences = ", ".join(str(4 - turns) for turns in found["types"]) or "none"
    return [
        str(name), f"{found['at wedge']:.2g}", f"{found['anywhere']:.2g}", f"{found['curves']} ({valences})",
        f"{found['nearest'] * edges:.1f}", f"{found['least']:.1f}", str(found["without"]),
    ]  # fmt: skip


HEADER = ("off faces and edge at the wedge, degrees", "anywhere", "singular curves (valence)",
          "nearest to the wedge, edges", "least angle between axes, degrees",
          "feature edges without a hexahedron")  # fmt: skip


def of_file(path: Path) -> list[str]:
    problem = octafield.prepare_field(octafield.prepare_mesh(path))
    domain = problem.meshed.volume()
    directions = problem.directions[: len(domain.surface.mesh.vertices)]
    stretch = VOLUME.axes_stretch(domain)
    row = [path.name.split(".")[0], f"{len(domain.tets):,}", f"{len(stretch.sharp):,} of {len(stretch.followed):,}"]
    for given in (stretch.values, None):
        held = VOLUME.boundary_constraints(domain, directions, stretch=given)
        frames = VOLUME.frame_field(domain, held).smooth.frames
        for found in (VOLUME.alignment_angles, VOLUME.feature_alignment_angles):
            off = np.degrees(found(domain, frames, stretch=given))
            row.append(", ".join(f"{value:.1f}" for value in np.percentile(off, [50, 95, 100])))
        row.append(f"{len(VOLUME.singular_graph(domain, frames).triangles):,}")
        found_at = VOLUME.boundary_meshability(domain, frames, stretch=given)
        row.append(f"{found_at.non_meshable_wedges:,}, {found_at.non_meshable_corners:,}")
    return row


OF_FILES = [
    "file", "tets", "sharp vertices of those followed",
    "free: off faces, degrees: median, p95, max", "off edges", "singular triangles", "edges, corners no hex mesh has",
    "right angles: off faces", "off edges", "singular triangles", "edges, corners no hex mesh has",
]  # fmt: skip


def draw(path: Path, shown: list[tuple[str, octafield.TetDomain, dict]]) -> None:
    import pyvista

    plotter = pyvista.Plotter(shape=(2, len(shown) // 2), off_screen=True, window_size=(450 * len(shown) // 2, 700))
    for i, (title, domain, found) in enumerate(shown):
        plotter.subplot(i % 2, i // 2)
        surface = domain.surface.mesh
        top = np.flatnonzero(np.asarray(surface.vertices)[:, 2] > 0.6 - 1e-9)
        plotter.add_mesh(
            pyvista.PolyData.from_regular_faces(np.array(surface.vertices), np.array(surface.triangles, int)),
            color="white", opacity=0.3,
        )  # fmt: skip
        ids = np.asarray(domain.surface.vertex_map)[top]
        centres, size = np.asarray(domain.vertices)[ids], 0.028
        for k in range(3):
            along = found["axes"][ids, k] / np.linalg.norm(found["axes"][ids, k], axis=1, keepdims=True)
            for sign in (1, -1):
                ends = np.stack([centres, centres + sign * size * along], axis=1).reshape(-1, 3)
                plotter.add_mesh(pyvista.line_segments_from_points(ends), color="#0072b2", line_width=2)
        points = found["graph"].points
        for curve in found["graph"].curves:
            if len(curve) > 1:
                plotter.add_mesh(pyvista.lines_from_points(np.asarray(points)[curve]), color="#d55e00", line_width=5)
        plotter.add_text(title, font_size=9)
        plotter.enable_parallel_projection()
        plotter.view_vector((0.25, -0.45, 1), viewup=(0, 1, 0))
        plotter.camera.zoom(1.35)
    plotter.screenshot(str(path))


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--angles", default="15,30,45,60,75")
    parser.add_argument("--edges", type=int, default=12)
    parser.add_argument("--files", type=Path, nargs="+", help="tet meshes in place of prisms")
    a = parser.parse_args()
    a.output.mkdir(parents=True, exist_ok=True)
    if a.files:
        rows = [of_file(path) for path in a.files]
        (a.output / "files.md").write_text(markdown_table(OF_FILES, rows) + "\n")
        return
    rows, shown = [], []
    for degrees in map(float, a.angles.split(",")):
        domain, directions = domain_of(degrees, a.edges)
        began = time.process_time()
        stretch = VOLUME.axes_stretch(domain).values
        seconds = time.process_time() - began
        free, right = (figures(domain, directions, degrees, given) for given in (stretch, None))
        rows.append(
            [
                f"{degrees:.0f}",
                f"{len(domain.tets):,}",
                *row_of("free", a.edges, free),
                f"{seconds + free['seconds']:.1f}",
            ]
        )
        rows.append(["", "", *row_of("right angles", a.edges, right), f"{right['seconds']:.1f}"])
        if degrees in (15, 30, 60):
            shown += [(f"{degrees:.0f} degrees, free", domain, free), ("right angles", domain, right)]
    header = ["angle", "tets", "axes", *HEADER, "CPU s"]
    (a.output / "wedges.md").write_text(markdown_table(header, rows) + "\n")
    domain, directions = domain_of(OF_ONE, a.edges)
    stretch = VOLUME.axes_stretch(domain).values
    rows = [
        row_of(name, a.edges, figures(domain, directions, OF_ONE, stretch, name))
        for name, scheme in VOLUME.schemes.items()
        if scheme.compared
    ]
    (a.output / "representations.md").write_text(markdown_table(["representation", *HEADER], rows) + "\n")
    draw(a.output / "wedges.png", shown)


if __name__ == "__main__":
    main()
