import argparse
import time
from collections import Counter
from itertools import product
from pathlib import Path

import numpy as np
import octafield
from study_output import markdown_table, new_figure
from surface_pictures import save_drawing

from . import __doc__ as told
from .cases import CASES, SEPARATRICES, T_MESH, Case, holed_square, placed
from .drawing import draw_outline, draw_quads, finish, legend

# Rows and columns of panels, and inches of a row.
SHEETS = {
    "blocks": (2, 3, 3.1), "rings": (1, 4, 3.1), "cycles": (1, 4, 3.1), "profile": (1, 3, 3.1), "corners": (2, 3, 2.0)
}  # fmt: skip
HEADER = (
    "figure", "layout", "points inside", "V, E, F", "irregular", "quads", "SJ min", "eta mean", "worst", "tau %",
    "mismatch %", "misalignment", "the document", "what differs",
)  # fmt: skip


def laid_out(case: Case, mesh, arguments: dict, blocks: str = "few"):
    kept = octafield.SurfaceFieldOptions(remesh=False, features="none")
    wanted = octafield.QuadLayoutOptions(
        quads=case.quads,
        layout=case.layout,
        blocks=blocks,
        inadmissible=case.inadmissible,
        end_tolerance=case.end_tolerance,
    )
    return octafield.compute_quad_layout(mesh, kept, layout_options=wanted, **arguments)


def row(case: Case, points: list[dict], result) -> list[str]:
    count = Counter(4 - p["index_times_four"] for p in points)
    inside = ", ".join(f"{n} of valence {v}" for v, n in sorted(count.items())) or "none"
    head, tail = [case.title, case.layout, inside], [case.shows, case.differs]
    if isinstance(result, octafield.Error):
        return [*head, f"`{result.kind}`", *[""] * 6, "", angle_of(result), *tail]
    record, eta = result.record, np.asarray(octafield.surface.quad_angle_quality(result.mesh))
    parts = result.layout
    return [
        *head,
        f"{len(parts.positions)}, {len(parts.sides)}, {record.patches}",
        str(record.irregular_vertices),
        f"{record.quads:,}",
        f"{record.scaled_jacobian.min:.2f}",
        f"{eta.mean():.3f}",
        f"{eta.min():.2f}",
        f"{100 * (eta > 0.9).mean():.1f}",
        f"{100 * record.largest_mismatch:.2g}",
        ", ".join(f"{abs(m.angle_deg):.2f} degrees" for m in record.misalignment),
        *tail,
    ]


def angle_of(error: octafield.Error) -> str:
    """What the message says of the points' misalignment."""
    text = str(error)
    return text[text.index("is off") + len("is off the longest one by ") :].split(".")[0] if "is off" in text else ""


def draw(axes, case: Case, mesh, points: list[dict], result) -> None:
    if isinstance(result, octafield.Error):
        draw_outline(axes, mesh, points)
    else:
        draw_quads(axes, result)
    words = f": {result.kind.replace('_', ' ')}" if isinstance(result, octafield.Error) else ""
    finish(axes, case.title + words, case.window)


def eights(output: Path) -> str:
    """How layouts end that have one point of valence 8 beside a hole in a square, by place, hole and triangles."""
    found: dict[str, Counter] = {T_MESH: Counter(), SEPARATRICES: Counter()}
    for radius, x, edge in product((0.3, 0.4), np.arange(0.5, 0.81, 0.05), (0.05, 0.04, 0.03)):
        mesh, arguments = holed_square([placed(float(x), 0, -4)], radius)(edge)
        for layout, tolerance in ((SEPARATRICES, 1e-3), (T_MESH, 0.0)):
            case = Case("", "", holed_square([]), "", layout, end_tolerance=tolerance, quads=1500)
            try:
                laid_out(case, mesh, arguments)
                ending = "quads"
            except octafield.Error as error:
                ending = error.kind
            found[layout][ending] += 1
            print(f"{radius:g} {x:.2f} {edge:g} {layout} {ending}", flush=True)
    rows = [[layout, kind, str(count)] for layout, counts in found.items() for kind, count in counts.most_common()]
    text = markdown_table(("layout", "ends in", "of 42"), rows)
    (output / "eights.md").write_text(text)
    return text


def main() -> None:
    parser = argparse.ArgumentParser(description=told, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--only", default="", help="sheets or figures, with commas")
    parser.add_argument("--edge", type=float, default=0.05, help="of the triangles")
    parser.add_argument("--blocks", default="few", choices=("few", "fine"), help="of T-meshes")
    parser.add_argument("--eights", action="store_true", help="in their place: 42 points of valence 8 beside a hole")
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    if given.eights:
        print(eights(given.output))
        return
    only, rows = {word for word in given.only.split(",") if word}, []
    for sheet, (lines, columns, height) in SHEETS.items():
        cases = [case for case in CASES if case.sheet == sheet and (not only or {sheet, case.name} & only)]
        if not cases:
            continue
        figure, panels = new_figure(3.2 * columns, height * lines + 0.3, lines, columns, squeeze=False)
        valences: set[int] = set()
        free = iter(panels.ravel())
        for case in cases:
            begun = time.perf_counter()
            mesh, arguments = case.make(given.edge / case.finer)
            points = arguments["singularities"]
            try:
                result = laid_out(case, mesh, arguments, given.blocks)
            except octafield.Error as error:
                result = error
            if case.drawn:
                draw(next(free), case, mesh, points, result)
            valences |= {4 - point["index_times_four"] for point in points}
            line = row(case, points, result)
            if not case.window or case.shows:  # the second view of one domain
                rows.append(line)
            print(case.name, *line[2:12], f"{time.perf_counter() - begun:.1f} s", flush=True)
        for axes in free:
            axes.set_visible(False)
        legend(figure, sorted(valences))
        save_drawing(figure, given.output / f"quad_figures_{sheet}.png", colours=128)
    (given.output / "summary.md").write_text(markdown_table(HEADER, rows))


if __name__ == "__main__":
    main()
