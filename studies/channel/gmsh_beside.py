"""The same outline meshed by Gmsh, segment by segment, triangles joined to quads by Blossom-Quad."""

import gmsh
import numpy as np

TRIANGLE, QUAD = 2, 3  # of Gmsh
ALGORITHMS = {"Gmsh Delaunay": 5, "Gmsh Delaunay for quads": 8}


def meshed(outline, algorithm: int, edge_length: float) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(n, 2) points, (t, 3) triangles, (q, 4) quads."""
    gmsh.initialize(readConfigFiles=False, interruptible=False)
    try:
        gmsh.option.setNumber("General.Terminal", 0)
        for name, value in {"Algorithm": algorithm, "RecombinationAlgorithm": 1, "RecombineAll": 1}.items():
            gmsh.option.setNumber(f"Mesh.{name}", value)
        points = [gmsh.model.geo.addPoint(x, y, 0, edge_length) for x, y in np.asarray(outline.points).tolist()]
        loops = []
        for chain in octafield_chains(outline):
            lines = [gmsh.model.geo.addLine(points[a], points[b]) for a, b in zip(chain, chain[1:], strict=False)]
            for line in lines:
                gmsh.model.geo.mesh.setTransfiniteCurve(line, 2)
            loops.append(gmsh.model.geo.addCurveLoop(lines))
        gmsh.model.geo.addPlaneSurface(loops)
        gmsh.model.geo.synchronize()
        gmsh.model.mesh.generate(2)
        tags, places, _ = gmsh.model.mesh.getNodes()
        row = np.zeros(int(tags.max()) + 1, int)
        row[tags.astype(int)] = np.arange(len(tags))
        cells = {n: np.zeros((0, n), int) for n in (3, 4)}
        for kind, _, nodes in zip(*gmsh.model.mesh.getElements(2), strict=True):
            cells[{TRIANGLE: 3, QUAD: 4}[kind]] = row[nodes.astype(int)].reshape(-1, 3 if kind == TRIANGLE else 4)
        return places.reshape(-1, 3)[:, :2], cells[3], cells[4]
    finally:
        gmsh.finalize()


def octafield_chains(outline) -> list[list[int]]:
    from octafield.planar.outline import chains

    loops = np.asarray(outline.loops)
    return sorted(chains(loops, np.zeros(len(outline.points), bool)), key=len, reverse=True)
