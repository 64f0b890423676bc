"""Steps and seconds of isotropic_scale and axis_scales under refinement: polar coordinates on bent cubes, whose sizes
are known.

    python studies/benchmarks/sizes.py [N...]      # cells along an edge of the cube; default 8 16 32 48

One thread; a table as in docs/analysis.md on the standard output.
"""

import itertools
import sys
import time

import numpy as np
import octafield

ANGLE = 1.8  # radians, over which the cube is bent; 1 < r < 2


def bent_cube(n: int) -> tuple[octafield.TetMesh, np.ndarray]:
    """n^3 cubes of six tets each, and the frames of polar coordinates at the vertices."""
    x, y, z = np.moveaxis(np.stack(np.meshgrid(*3 * [np.linspace(0, 1, n + 1)], indexing="ij"), -1), -1, 0).reshape(
        3, -1
    )
    corner = np.arange((n + 1) ** 3).reshape(3 * [n + 1])[:-1, :-1, :-1].ravel()
    steps = (n + 1) ** 2, n + 1, 1
    tets = [
        np.column_stack([corner, corner + a, corner + a + b, corner + a + b + c])
        for a, b, c in itertools.permutations(steps)
    ]
    for k, order in enumerate(itertools.permutations(range(3))):
        if np.linalg.det(np.eye(3)[list(order)]) < 0:
            tets[k] = tets[k][:, [0, 2, 1, 3]]
    points = np.column_stack([(1 + x) * np.cos(ANGLE * y), (1 + x) * np.sin(ANGLE * y), z])
    return octafield.TetMesh(points, np.concatenate(tets)), octafield.frames.quaternion_exp(
        np.column_stack([0 * x, 0 * x, ANGLE * y])
    )


def main() -> None:
    print("| n | tets | isotropic_scale: steps | CPU s | axis_scales: steps | CPU s |")
    print("| --- | --- | --- | --- | --- | --- |")
    for n in map(int, sys.argv[1:] or ("8", "16", "32", "48")):
        mesh, frames = bent_cube(n)
        cells = [str(n), f"{len(mesh.tets):,}"]
        for scale in (octafield.volume.isotropic_scale, octafield.volume.axis_scales):
            start = time.process_time()
            found = scale(mesh, frames, threads=1)
            cells += [str(found.iterations), f"{time.process_time() - start:.2f}"]
        print(f"| {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
