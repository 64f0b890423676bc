"""Figures 4.3, 4.4, 4.7 and 4.8 of Beaufort's thesis (chapter 4: frames as quartics, tensors and SU(2) invariants),
drawn and checked.

    python studies/thesis_frames.py -o DIR [--figures 4.3,4.4,4.7a,4.7b,4.8] [--frames 10000] [--seed 1]

DIR gets a picture and the numbers in it (CSV) per figure, and summary.md: what the thesis says beside what is found
here.

Two conventions take part. Here u = q0 + i q1, v = q2 + i q3, and the world's x axis is special. The thesis prints u =
q0 - i q1, v = q2 + i q3 in (4.25), but computes with u = q0 - i q3, v = q2 + i q1 in section 4.2, and the world's z
axis is special.
"""

import argparse
from pathlib import Path

import numpy as np
import octafield
from octafield.view.plots import PALETTE
from quartic_pictures import (
    draw_frame,
    hits_of_isosurface,
    hits_of_sphere,
    lit,
    printed_y40_y44,
    quartic,
    quartic_by_harmonics,
    quartic_by_tensor,
    screen,
    show,
    sphere_grid,
)
from study_output import markdown_table, new_figure, save_figure, with_grid, write_csv

IDENTITY = np.array([1.0, 0, 0, 0])
TURNED = octafield.frames.quaternion_exp([[0.5, 0.3, 0.4]])  # the rotated frame of figures 4.3 and 4.4
SHARED_AXIS = np.array([[2.0, 6.0, 3.0]]) / 7  # of figure 4.8; the thesis does not name its own
Y44_TO_Y40 = np.sqrt(5 / 7)
EXPANSION = 4 * np.sqrt(np.pi) / 15  # thesis: x^4 + y^4 + z^4 = EXPANSION (Y40 + Y44_TO_Y40 Y44) + 3/5 on the sphere


# ---- conventions


def as_section_4_2(q: np.ndarray) -> np.ndarray:
    """Components that make this project's u, v the thesis's u = q0 - i q3, v = q2 + i q1."""
    return q[:, [0, 3, 2, 1]] * (1, -1, 1, 1)


def as_printed_4_25(q: np.ndarray) -> np.ndarray:
    return q * (1, -1, 1, 1)


CONVENTIONS = {
    "this project": lambda q: q,
    "thesis, section 4.2": as_section_4_2,
    "thesis, (4.25) as printed": as_printed_4_25,
}


def invariants(q: np.ndarray, convention: str = "this project") -> np.ndarray:
    return octafield.frames.su2_complex(octafield.frames.su2_embed(CONVENTIONS[convention](q)))


def c3_distance(q: np.ndarray, convention: str = "this project") -> np.ndarray:
    """To the Cartesian frame, thesis (4.26)."""
    return np.linalg.norm(invariants(q, convention) - invariants(IDENTITY[None], convention), axis=1)


def r4_distance(q: np.ndarray) -> np.ndarray:
    """To the Cartesian frame: the nearest of the 48 unit quaternions to 1."""
    return np.linalg.norm(octafield.frames.closest_representative(q, IDENTITY) - IDENTITY, axis=1)


def quaternion_product(p: np.ndarray, q: np.ndarray) -> np.ndarray:
    a, b = p[..., :1], q[..., :1]
    x, y = p[..., 1:], q[..., 1:]
    return np.concatenate([a * b - np.sum(x * y, axis=-1, keepdims=True), a * y + b * x + np.cross(x, y)], axis=-1)


# ---- figures: each writes a picture and a table, and returns rows (quantity, what the thesis says, what is found here)


def figure_4_3(output: Path, options) -> list[tuple]:
    size = 420
    points, seen = hits_of_sphere(screen(size))
    figure, panels = new_figure(7.6, 3.6, 1, 2)
    for axes, q, title in zip(panels, (IDENTITY[None], TURNED), ("Cartesian frame", "rotated frame")):
        image = show(axes, quartic(points, q), seen, size, cmap="viridis", vmin=1 / 3, vmax=1)
        draw_frame(axes, q)
        axes.set_title(title)
    figure.colorbar(
        image,
        ax=panels,
        shrink=0.8,
        label="$x^4 + y^4 + z^4$ along the frame's axes",
        ticks=(1 / 3, 0.6, 1),
        format="%.3g",
    )
    save_figure(figure, output / "frames_4_3.png")

    grid = sphere_grid()
    direct = [quartic(grid, q) for q in (IDENTITY[None], TURNED)]
    summed = [quartic_by_harmonics(grid, q) for q in (IDENTITY[None], TURNED)]
    write_csv(
        output / "frames_4_3.csv",
        ["x", "y", "z", "f", "f_by_harmonics", "f_rotated", "f_rotated_by_harmonics"],
        np.column_stack([grid, direct[0], summed[0], direct[1], summed[1]]).tolist(),
    )
    harmonics = octafield.frames.harmonics_evaluate(4, grid)
    fitted = np.linalg.lstsq(harmonics, direct[0] - 3 / 5, rcond=None)[0]
    y40, y44 = printed_y40_y44(grid)
    without_12 = y44 - 3 / 16 * np.sqrt(35 / np.pi) * 12
    printed = 3 / 5 + EXPANSION * (y40 + Y44_TO_Y40 * y44)
    return [
        ("coefficient of Y40", f"4 sqrt(pi) / 15 = {EXPANSION:.6f}", f"{fitted[4]:.6f}"),
        ("coefficient of Y44", f"4 sqrt(pi) / 15 sqrt(5/7) = {EXPANSION * Y44_TO_Y40:.6f}", f"{fitted[8]:.6f}"),
        ("largest other coefficient of degree 4", "0", f"{abs(np.delete(fitted, (4, 8))).max():.1e}"),
        ("constant term", "3/5", f"{np.mean(direct[0] - harmonics @ fitted):.6f}"),
        ("largest error of the printed Y40", "-", f"{abs(harmonics[:, 4] - y40).max():.1e}"),
        ("largest error of the printed Y44, without its '+ 12'", "-", f"{abs(harmonics[:, 8] - without_12).max():.1e}"),
        ("largest error of the expansion with Y44 as printed", "0", f"{abs(printed - direct[0]).max():.4f}"),
        ("rotated frame: largest error of its degree-4 expansion", "0", f"{abs(summed[1] - direct[1]).max():.1e}"),
    ]


def figure_4_4(output: Path, options) -> list[tuple]:
    size = 420
    plane = screen(size)
    figure, panels = new_figure(7.0, 3.6, 1, 2)
    for axes, q, title in zip(panels, (IDENTITY[None], TURNED), ("Cartesian frame", "rotated frame")):
        _, seen, normals = hits_of_isosurface(plane, q)
        show(axes, lit(normals), seen, size)
        draw_frame(axes, q)
        axes.set_title(title)
    save_figure(figure, output / "frames_4_4.png")

    grid = sphere_grid()
    radius = [quartic(grid, q) ** -0.25 for q in (IDENTITY[None], TURNED)]
    write_csv(
        output / "frames_4_4.csv",
        ["x", "y", "z", "radius", "radius_rotated"],
        np.column_stack([grid, *radius]).tolist(),
    )
    error = max(
        abs(quartic_by_tensor(grid * r[:, None], q) - 1).max() for r, q in zip(radius, (IDENTITY[None], TURNED))
    )
    diagonal = quartic(np.ones((1, 3)) / np.sqrt(3), IDENTITY[None])[0] ** -0.25
    return [
        (
            "distance of the surface along the axes, and along (1, 1, 1)",
            "unit sphere of the 4-norm: 1, 3^(1/4) = 1.316074",
            f"{radius[0].min():.6f}, {diagonal:.6f}",
        ),
        ("largest error of A_ijkl x_i x_j x_k x_l = 1 on it, both frames", "0", f"{error:.1e}"),
    ]


def turns(angles: np.ndarray, axis: int) -> np.ndarray:
    return octafield.frames.quaternion_exp(angles[:, None] * np.eye(3)[axis])


def figure_4_7a(output: Path, options) -> list[tuple]:
    angles = np.linspace(0, np.pi / 2, 181)
    degrees = np.degrees(angles)
    curves = {name: [c3_distance(turns(angles, k), name) for k in range(3)] for name in CONVENTIONS}
    nearest = [r4_distance(turns(angles, k)) for k in range(3)]
    figure, panels = new_figure(10.5, 3.4, 1, 3)
    shown = {
        "$\\mathbb{C}^3$, u = q0 + i q1 (here)": curves["this project"],
        "$\\mathbb{C}^3$, u = q0 $-$ i q3 (thesis 4.2)": curves["thesis, section 4.2"],
        "$\\mathbb{R}^4$": nearest,
    }
    for axes, (title, three) in zip(panels, shown.items()):
        for values, name, style, color in zip(three, "ijk", ("-", "--", ":"), PALETTE):
            axes.plot(degrees, values, style, color=color, linewidth=2.2, label=f"about {name}")
        axes.set(title=title, xlabel="angle of rotation (degrees)", xticks=(0, 22.5, 45, 67.5, 90))
        with_grid(axes)
    panels[0].set_ylabel("distance to the Cartesian frame")
    panels[2].legend(frameon=False, loc="lower center")
    save_figure(figure, output / "frames_4_7a.png")

    columns = ["c3_here", "c3_section_4_2", "c3_printed_4_25", "r4"]
    write_csv(
        output / "frames_4_7a.csv",
        ["angle_deg", *(f"{c}_{k}" for c in columns for k in "ijk")],
        np.column_stack([degrees, *(v for three in (*curves.values(), nearest) for v in three)]).tolist(),
    )
    rows = [("distance in R^4 at 45 degrees, about i, j, k", "equal", ", ".join(f"{v[90]:.4f}" for v in nearest))]
    says = {
        "this project": "-",
        "thesis, section 4.2": "k appears farther than i and j",
        "thesis, (4.25) as printed": "k appears farther than i and j",
    }
    for name, three in curves.items():
        rows.append(
            (
                f"distance in C^3 at 45 degrees, about i, j, k: {name}",
                says[name],
                ", ".join(f"{v[90]:.4f}" for v in three),
            )
        )
    return rows + invariance_rows(options.seed)


def invariance_rows(seed: int) -> list[tuple]:
    """On which side the octahedral group leaves h unchanged: it must be the right one."""
    q = octafield.frames.random_rotations(100, seed=seed)[:, None, :]
    group = octafield.frames.binary_octahedral_group()
    rows = []
    for name in CONVENTIONS:
        start = invariants(q[:, 0], name)[:, None]
        change = [
            abs(invariants(moved.reshape(-1, 4), name).reshape(len(q), 48, 3) - start).max()
            for moved in (quaternion_product(q, group), quaternion_product(group, q))
        ]
        rows.append(
            (
                f"largest change of h over the 48 o, q o and o q: {name}",
                "0 for q o",
                f"{change[0]:.1e}, {change[1]:.1e}",
            )
        )
    quarter = octafield.frames.quaternion_exp([0, np.pi / 2, 0])  # takes z to x
    turned = invariants(quaternion_product(quarter[None], q[:, 0]))
    rows.append(
        (
            "largest difference of h of section 4.2 and conjugate h here of the frame turned by a quarter about y",
            "-",
            f"{abs(invariants(q[:, 0], 'thesis, section 4.2') - turned.conj()).max():.1e}",
        )
    )
    return rows


def figure_4_7b(output: Path, options) -> list[tuple]:
    q = octafield.frames.random_rotations(options.frames, seed=options.seed)
    r4 = r4_distance(q)
    clouds = {
        "this project": c3_distance(q),
        "thesis, section 4.2": c3_distance(q, "thesis, section 4.2"),
        "sh4, for comparison": octafield.frames.metrics["sh4"].distance(q, IDENTITY),
    }
    figure, panels = new_figure(9, 4, 1, 2)
    for axes, name, label in zip(
        panels, ("this project", "sh4, for comparison"), ("$\\mathbb{C}^3$", "$\\mathbb{R}^9$ (sh4)")
    ):
        axes.scatter(r4, clouds[name], s=3, color=PALETTE[0], alpha=0.35, linewidths=0)
        axes.set(xlabel="distance in $\\mathbb{R}^4$", ylabel=f"distance in {label}", xlim=(0, 0.56), ylim=(0, 2.1))
        with_grid(axes)
    save_figure(figure, output / "frames_4_7b.png", dpi=110)

    write_csv(
        output / "frames_4_7b.csv",
        ["r4", "c3_here", "c3_section_4_2", "sh4"],
        np.column_stack([r4, *clouds.values()]).tolist(),
    )
    farthest = 2 * np.sin(np.arctan(np.sqrt(2 * (np.sqrt(2) - 1) ** 2 + (np.sqrt(2) - 1) ** 4)) / 2)  # 62.7994 degrees
    rows = [("largest distance in R^4", "-", f"{r4.max():.4f} (no two frames are farther apart than {farthest:.4f})")]
    for name, values in clouds.items():
        if "sh4" not in name:
            near = r4[values < 0.3]
            rows.append(
                (
                    f"distances in R^4 of frames nearer than 0.3 in C^3: {name}",
                    "either close or far",
                    f"{near.min():.3f} to {near.max():.3f} ({len(near)} frames)",
                )
            )
        ranks = [np.argsort(np.argsort(x)) for x in (r4, values)]
        rows.append(
            (
                f"rank correlation with the distance in R^4: {name}",
                "-" if "sh4" in name else "do not correspond at all",
                f"{np.corrcoef(ranks)[0, 1]:.4f}",
            )
        )
    return rows


def frames_about(axis: np.ndarray, angles: np.ndarray) -> np.ndarray:
    across = np.cross(axis, [[0, 0, 1.0]])
    start = octafield.frames.frame_from_axes(across / np.linalg.norm(across), axis)
    return octafield.frames.frame_exp(start, angles[:, None] * axis)


def ellipses_here(n: np.ndarray, angles: np.ndarray) -> tuple[complex, np.ndarray, np.ndarray]:
    a = 1j * (n[0, 1] + 1j * n[0, 2]) / 2
    center0, center1, plus, minus, ratio = octafield.frames.su2_axis_ellipse(n)[0]
    wave = plus * np.exp(4j * angles) + minus * np.exp(-4j * angles)
    return a, (center0 + wave) / a**4, (center1 + ratio * wave) / a**6


def ellipses_section_4_2(n: np.ndarray, angles: np.ndarray) -> tuple[complex, np.ndarray, np.ndarray]:
    """With exponent 2 in p, where the thesis has 4."""
    a = (n[0, 0] - 1j * n[0, 1]) / 2
    p = ((1 - n[0, 2]) / (1 + n[0, 2])) ** 2
    wave = p * np.exp(4j * angles) + np.exp(-4j * angles) / p
    return a, wave + 14, wave - 2


def distance_to_ellipse(z: np.ndarray, semi_axes: tuple[float, float]) -> float:
    """Largest deviation of points about 0 from an ellipse along the real and imaginary axis, relative to its size."""
    return float(abs(np.hypot(z.real / semi_axes[0], z.imag / semi_axes[1]) - 1).max())


def figure_4_8(output: Path, options) -> list[tuple]:
    angles = np.random.default_rng(options.seed).uniform(0, 2 * np.pi, 500)
    q = frames_about(SHARED_AXIS, angles)
    steps = np.linspace(0, np.pi / 2, 361)
    figure, panels = new_figure(7.6, 6.8, 2, 1, sharex=True, sharey=True)
    columns, rows = [], []
    closed_forms = {"this project": ellipses_here, "thesis, section 4.2": ellipses_section_4_2}
    for axes, (name, closed_form), special in zip(panels, closed_forms.items(), (0, 2)):
        a, curve0, curve1 = closed_form(SHARED_AXIS, steps)
        h = invariants(q, name)
        H0, H1 = h[:, 0] / a**4, h[:, 1] / a**6
        for values, curve, center, color, label in (
            (H1, curve1, -2, PALETTE[1], "$H_1$"),
            (H0, curve0, 14, PALETTE[0], "$H_0$"),
        ):
            axes.scatter(values.real, values.imag, s=14, color=color, linewidths=0)
            axes.plot(curve.real, curve.imag, color="black", linewidth=0.8)
            axes.text(center, 0, label, color=color, ha="center", va="center", fontsize=14)
        axes.set(title=name, ylabel="imaginary part", aspect="equal", xlim=(-10, 22), ylim=(-7.5, 7.5))
        with_grid(axes)
        columns += [H0.real, H0.imag, H1.real, H1.imag]
        rows += ellipse_rows(name, H0, H1, h, a, SHARED_AXIS[0, special])
    panels[-1].set_xlabel("real part")
    save_figure(figure, output / "frames_4_8.png")
    write_csv(
        output / "frames_4_8.csv",
        ["angle", *(f"{part}_{h}_{c}" for c in ("here", "section_4_2") for h in ("H0", "H1") for part in ("re", "im"))],
        np.column_stack([angles, *columns]).tolist(),
    )
    return rows


def ellipse_rows(name: str, H0: np.ndarray, H1: np.ndarray, h: np.ndarray, a: complex, component: float) -> list[tuple]:
    p = ((1 - component) / (1 + component)) ** 2
    semi_axes = (p + 1 / p, abs(p - 1 / p))
    wrong = (p**2 + p**-2, abs(p**2 - p**-2))
    square = (H0 - 14) ** 2 - 4  # (w^4 - w^-4)^2
    return [
        (
            f"largest deviation of H0 - 14 from an ellipse of semi-axes {semi_axes[0]:.4f}, {semi_axes[1]:.4f}: {name}",
            "0",
            f"{distance_to_ellipse(H0 - 14, semi_axes):.1e}",
        ),
        (
            f"the same with the exponent 4 printed for p, semi-axes {wrong[0]:.3f}, {wrong[1]:.3f}: {name}",
            "0",
            f"{distance_to_ellipse(H0 - 14, wrong):.2f}",
        ),
        (f"largest error of H0 - H1 = 16, that is a^2 h0 - h1 = 16 a^6: {name}", "0", f"{abs(H0 - H1 - 16).max():.1e}"),
        (
            f"largest error of h2^2 = a^6 (w^4 - w^-4)^2 (h1 - 32 a^6)^2: {name}",
            "printed with 32 for 32 a^6",
            f"{abs(h[:, 2] ** 2 - a**6 * square * (h[:, 1] - 32 * a**6) ** 2).max():.1e}",
        ),
        (
            f"the same with 32 as printed: {name}",
            "0",
            f"{abs(h[:, 2] ** 2 - a**6 * square * (h[:, 1] - 32) ** 2).max():.1f}",
        ),
    ]


FIGURES = {"4.3": figure_4_3, "4.4": figure_4_4, "4.7a": figure_4_7a, "4.7b": figure_4_7b, "4.8": figure_4_8}


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--figures", default=",".join(FIGURES), help="any of " + ", ".join(FIGURES))
    parser.add_argument("--frames", type=int, default=10_000, help="random frames of figure 4.7b")
    parser.add_argument("--seed", type=int, default=1)
    arguments = parser.parse_args()
    wanted = arguments.figures.split(",")
    if unknown := [name for name in wanted if name not in FIGURES]:
        parser.error(f"no figure {', '.join(unknown)}; there are {', '.join(FIGURES)}")
    arguments.output.mkdir(parents=True, exist_ok=True)
    rows = [(name, *row) for name in wanted for row in FIGURES[name](arguments.output, arguments)]
    text = markdown_table(["figure", "quantity", "thesis", "here"], rows)
    (arguments.output / "summary.md").write_text(text)
    print(text)


if __name__ == "__main__":
    main()
