"""Nearest sh4 frames: the fast projection against two proofs of optimality, branch and bound and a semidefinite
relaxation.

    python studies/certified_projection.py -o out/certified [--count 10000] [--sdp 100] [--seed 1]

Two groups of unit vectors in R^9: random directions, and sums of frames at equal distances plus noise of 1e-13 to 0.1,
near which several frames or whole curves of frames are about equally near (six families). For each family the table
counts

- misses: inputs where branch and bound (octafield.frames.sh4_project_certified) finds a frame better than
  octafield.frames.sh4_project by more than 1e-9 in v . embed(frame), and the largest loss;
- uncertified inputs and the largest certified gap;
- on the first --sdp inputs the relaxation of Palmer, Bommes and Solomon (2020, "Algebraic representations for
  volumetric frame fields", section 4.3), solved with Clarabel: how far its upper bound lies above the certified value,
  and the largest ratio of its second eigenvalue to the first (0: rank one, the relaxation is exact; ties leave a higher
  rank).

Writes certified_projection.csv, certified_projection.md and, if there are misses, misses.csv with the inputs.
"""

import argparse
import time
from pathlib import Path

import clarabel
import numpy as np
import octafield
from scipy import sparse
from study_output import markdown_table, write_csv

MISS = 1e-9  # in v . embed(frame), |v| = 1


class Relaxation:
    """max v.x over X = [1 x'; x X'] positive semidefinite (10 x 10) that satisfies the quadratic equations of the
    embedded frames.

    The equations are found, not written down: the null space of the 55 monomials of degree at most 2, evaluated on
    random frames.
    """

    SIZE = 10

    def __init__(self, frames: np.ndarray):
        n = self.SIZE
        self.rows, self.columns = np.array(
            [(i, j) for j in range(n) for i in range(j + 1)]
        ).T  # upper triangle by columns
        points = np.hstack([np.ones((len(frames), 1)), frames])
        monomials = points[:, self.rows] * points[:, self.columns]
        _, singular, right = np.linalg.svd(monomials, full_matrices=False)
        rank = int(np.sum(singular > 1e-9 * singular[0]))
        equations = right[rank:]
        if len(equations) != 15:
            raise RuntimeError(f"{len(equations)} quadratic equations instead of 15: too few frames, or not frames")
        self.equations = len(equations)
        # Clarabel's vector of a symmetric matrix has its off-diagonal entries times sqrt(2).
        self.scale = np.where(self.rows == self.columns, 1.0, np.sqrt(2))
        unit = (self.rows == 0) & (self.columns == 0)
        equality = np.vstack([equations / self.scale, unit.astype(float)])
        size = len(self.rows)
        self.matrix = sparse.csc_matrix(np.vstack([equality, -np.eye(size)]))
        self.right = np.concatenate([np.zeros(self.equations), [1.0], np.zeros(size)])
        self.cones = [clarabel.ZeroConeT(self.equations + 1), clarabel.PSDTriangleConeT(n)]
        self.linear = self.rows == 0
        self.settings = clarabel.DefaultSettings()
        self.settings.verbose = False
        self.settings.tol_gap_abs = self.settings.tol_gap_rel = self.settings.tol_feas = 1e-10

    def solve(self, v: np.ndarray) -> tuple[float, float]:
        """Upper bound of v . embed(frame) over all frames, and the second eigenvalue of X over the first."""
        cost = np.zeros(len(self.rows))
        cost[self.linear & (self.columns > 0)] = -v / np.sqrt(2)  # X_0i = x_i
        nothing = sparse.csc_matrix((len(cost), len(cost)))
        solution = clarabel.DefaultSolver(nothing, cost, self.matrix, self.right, self.cones, self.settings).solve()
        if str(solution.status) not in ("Solved", "AlmostSolved"):
            raise RuntimeError(f"Clarabel stopped: {solution.status}")
        x = np.zeros((self.SIZE, self.SIZE))
        x[self.rows, self.columns] = np.asarray(solution.x) / self.scale
        eigenvalues = np.linalg.eigvalsh(np.triu(x) + np.triu(x, 1).T)
        return -solution.obj_val_dual, max(eigenvalues[-2], 0.0) / eigenvalues[-1]


def multiply(a, b):
    """Quaternion products, w x y z."""
    aw, ax, ay, az = np.moveaxis(np.asarray(a), -1, 0)
    bw, bx, by, bz = np.moveaxis(np.asarray(b), -1, 0)
    return np.stack(
        [
            aw * bw - ax * bx - ay * by - az * bz,
            aw * bx + ax * bw + ay * bz - az * by,
            aw * by - ax * bz + ay * bw + az * bx,
            aw * bz + ax * by - ay * bx + az * bw,
        ],
        axis=-1,
    )


def turn(axis, angle):
    axis = np.asarray(axis, dtype=float)
    axis = axis / np.linalg.norm(axis, axis=-1, keepdims=True)
    return np.concatenate(
        [np.cos(np.asarray(angle) / 2)[..., None], np.sin(np.asarray(angle) / 2)[..., None] * axis], axis=-1
    )


def unit_rows(v):
    return v / np.linalg.norm(v, axis=1, keepdims=True)


def sums_of_frames(family: str, q: np.ndarray, generator) -> np.ndarray:
    """Sums of frames of which q is one, (n, 9)."""
    n = len(q)
    embed = octafield.frames.sh4_embed
    if family == "farthest pair":  # 62.8 degrees, the corner of the Voronoi cell
        t = np.tan(np.pi / 8)
        return embed(q) + embed(multiply(q, np.array([1, t, t, 1 - 2 * t]) / np.linalg.norm([1, t, t, 1 - 2 * t])))
    if family == "45 degrees about an axis":
        return embed(q) + embed(multiply(q, turn([0, 0, 1], np.pi / 4)))
    if family == "60 degrees about a diagonal":
        return embed(q) + embed(multiply(q, turn([1, 1, 1], np.pi / 3)))
    if family == "3 twists about an axis":
        return sum(embed(multiply(q, turn([0, 0, 1], k * np.pi / 6))) for k in range(3))
    if family == "3 to 5 round any axis":
        axis, count = generator.normal(size=(n, 3)), generator.integers(3, 6, n)
        terms = [embed(multiply(turn(axis, 2 * np.pi * k / count), q)) * (k < count)[:, None] for k in range(5)]
        return sum(terms)
    if family == "2 to 4 random frames":
        count = generator.integers(2, 5, n)
        others = [unit_rows(generator.normal(size=(n, 4))) for _ in range(3)]
        return embed(q) + sum(embed(o) * (k + 1 < count)[:, None] for k, o in enumerate(others))
    raise ValueError(family)


FAMILIES = (
    "farthest pair",
    "45 degrees about an axis",
    "60 degrees about a diagonal",
    "3 twists about an axis",
    "3 to 5 round any axis",
    "2 to 4 random frames",
)


def make_inputs(count: int, seed: int) -> dict[str, np.ndarray]:
    """Unit vectors: `count` random ones, and `count` near the cut locus divided among its families."""
    generator = np.random.default_rng(seed)
    inputs = {"random direction": unit_rows(generator.normal(size=(count, 9)))}
    for k, family in enumerate(FAMILIES):
        share = count // len(FAMILIES) + (k < count % len(FAMILIES))
        q = unit_rows(generator.normal(size=(share, 4)))
        noise = 10.0 ** generator.uniform(-13, -1, (share, 1)) * unit_rows(generator.normal(size=(share, 9)))
        inputs[family] = unit_rows(unit_rows(sums_of_frames(family, q, generator)) + noise)
    return inputs


def values(v, frames):
    return np.einsum("ij,ij->i", v, octafield.frames.sh4_embed(frames))


def compare(v: np.ndarray, relaxation: Relaxation, sdp: int) -> dict:
    """Figures of one family; see the top of this file."""
    fast, _ = octafield.frames.sh4_project(v)
    start = time.process_time()
    certified, _, gaps = octafield.frames.sh4_project_certified(v)
    seconds = time.process_time() - start
    fast_values, best_values = values(v, fast), values(v, certified)
    loss = best_values - fast_values
    result = {
        "inputs": len(v),
        "misses": int(np.sum(loss > MISS)),
        "loss": float(max(loss.max(), 0)),
        "uncertified": int(np.sum(gaps > MISS)),
        "gap": float(np.max(gaps)),
        "cpu": seconds / len(v),
        "missed": v[loss > MISS],
    }
    bounds = [relaxation.solve(row) for row in v[:sdp]]
    above = np.array([b for b, _ in bounds]) - best_values[:sdp]
    result |= {
        "sdp": len(bounds),
        "sdp_above": float(above.max(initial=0)),
        "sdp_below": float(max((-above).max(initial=0), 0)),
        "rank_two": int(np.sum([r > 1e-4 for _, r in bounds])),
    }
    return result


HEADER = (
    "inputs",
    "number",
    "misses",
    "largest loss",
    "uncertified",
    "largest gap",
    "CPU ms each",
    "SDP solved",
    "SDP above by at most",
    "SDP below by at most",
    "SDP rank > 1",
)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True, help="folder for the tables")
    parser.add_argument("--count", type=int, default=10000, help="inputs in each of the two groups")
    parser.add_argument("--sdp", type=int, default=100, help="inputs of each family also given to the relaxation")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    relaxation = Relaxation(octafield.frames.sh4_embed(octafield.frames.random_rotations(200, seed=arguments.seed)))
    rows, missed = [], []
    for family, v in make_inputs(arguments.count, arguments.seed).items():
        r = compare(v, relaxation, arguments.sdp)
        missed += [(family, *map(float, row)) for row in r["missed"]]
        rows.append(
            (
                family,
                r["inputs"],
                r["misses"],
                r["loss"],
                r["uncertified"],
                r["gap"],
                1e3 * r["cpu"],
                r["sdp"],
                r["sdp_above"],
                r["sdp_below"],
                r["rank_two"],
            )
        )
        print(
            ", ".join(
                f"{name} {x:.3g}" if isinstance(x, float) else f"{name} {x}" for name, x in zip(HEADER, rows[-1])
            ),
            flush=True,
        )
    write_csv(arguments.output / "certified_projection.csv", HEADER, rows)
    table = markdown_table(HEADER, [[f"{x:.2g}" if isinstance(x, float) else x for x in row] for row in rows])
    (arguments.output / "certified_projection.md").write_text(table)
    if missed:
        write_csv(arguments.output / "misses.csv", ("family", *(f"v{m}" for m in range(-4, 5))), missed)


if __name__ == "__main__":
    main()
