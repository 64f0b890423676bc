"""Cylinder, boundary frames fixed against free twist: where the four singular curves end and what that costs.

    python studies/cylinder_twist.py [SURFACE] [-o DIR] [--edge-lengths 0.06,0.045]

Without SURFACE a cylinder of radius 1 and height 3 is made. Edge lengths are fractions of the bounding-box diagonal.
Ends of singular curves are given as radius over the cylinder's radius and azimuth modulo 90 degrees, apart for both
caps.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
import pyvista
from octafield.domain.meshing import prepare_mesh
from octafield.fields.frame_field import prepare_field, run_field
from octafield.runs.field_pictures import singular_curves


def generated_cylinder() -> octafield.TriangleMesh:
    solid = pyvista.Cylinder(radius=1, height=3, direction=(0, 0, 1), resolution=96).triangulate().clean()
    mesh = octafield.TriangleMesh(solid.points.astype(float), solid.regular_faces)
    return octafield.surface.repair(mesh).mesh  # pyvista's caps and wall do not share vertices


def cylinder_frame(points: np.ndarray):
    """Centre, axis direction, radius and half height of a cylinder from its surface points (principal axes)."""
    centre = (points.min(axis=0) + points.max(axis=0)) / 2
    values, vectors = np.linalg.eigh(np.cov((points - centre).T))
    alone = 2 if values[2] - values[1] > values[1] - values[0] else 0  # the two equal moments are across
    axis = vectors[:, alone]
    height = (points - centre) @ axis
    across = np.linalg.norm(points - centre - np.outer(height, axis), axis=1)
    return centre, axis, across.max(), height.max()


def curve_ends(graph, points: np.ndarray) -> dict[str, list[tuple[float, float]]]:
    centre, axis, radius, half = cylinder_frame(points)
    one = np.cross(axis, np.eye(3)[np.argmin(abs(axis))])
    one /= np.linalg.norm(one)
    two = np.cross(axis, one)
    ends = {"top": [], "bottom": []}
    for curve in graph.curves:
        for point in (graph.points[curve[0]], graph.points[curve[-1]]):
            x = point - centre
            if abs(x @ axis) < 0.9 * half:
                continue
            azimuth = np.degrees(np.arctan2(x @ two, x @ one)) % 90
            ends["top" if x @ axis > 0 else "bottom"].append(
                (float(np.hypot(x @ one, x @ two) / radius), float(azimuth))
            )
    return ends


def circular_mean(azimuths) -> float:
    """Mean of angles modulo 90 degrees."""
    return (
        float(np.degrees(np.angle(np.mean(np.exp(4j * np.radians(azimuths))))) / 4 % 90)
        if len(azimuths)
        else float("nan")
    )


def describe(ends) -> str:
    parts = []
    for cap, list_ in ends.items():
        radii, azimuths = [r for r, _ in list_], [a for _, a in list_]
        parts.append(
            f"{cap}: {len(list_)} ends, radius {np.mean(radii) if radii else float('nan'):.3f}, azimuth"
            f" {circular_mean(azimuths):5.1f}"
        )
    return "; ".join(parts)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("surface", nargs="?")
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--edge-lengths", default="0.06,0.045")
    arguments = parser.parse_args()
    surface = octafield.read_surface(arguments.surface) if arguments.surface else generated_cylinder()
    diagonal = octafield.surface.bounding_box_diagonal(surface.vertices)

    for fraction in map(float, arguments.edge_lengths.split(",")):
        problem = prepare_field(prepare_mesh(surface, octafield.MeshOptions(edge_length=fraction * diagonal)))
        print(
            f"edge length {fraction} of the diagonal, {len(problem.meshed.tets.vertices)} vertices, "
            f"{len(problem.singularities.points)} surface singular points"
        )
        for boundary in ("fixed", "aligned"):
            result = run_field(problem, octafield.FieldOptions(boundary=boundary))
            record, graph = result.record, result.singular_graph
            print(
                f"  {boundary:8s} energy {record.energy:.3f}  curves {len(graph.curves)}  length {graph.length:.2f} "
                f" iterations {record.iterations}\n    {describe(curve_ends(graph, np.asarray(surface.vertices)))}"
            )
            if arguments.output:
                arguments.output.mkdir(parents=True, exist_ok=True)
                (arguments.output / f"{boundary}-{fraction}.png").write_bytes(singular_curves(result).png)


if __name__ == "__main__":
    main()
