"""How far octafield hex-mesh gets from the meshes of HexMe (Beaufort et al. 2022): fields, seamless maps, hexahedra.

    python -m studies.seamless_maps -o DIR [--only s01,s17c] [--cells 2000] [--picture]

The map is judged here, by determinants and by edges over triangles, not by what made it; the hexahedra by
studies.hex_dominant.checker. DIR gets rows.jsonl, stages.md and when.md; with --picture curves.png in their place:
singular curves of the fields, above, and of the maps.
"""

import argparse
import json
import time
from pathlib import Path

import numpy as np
import octafield
from octafield.hexmesh.hex_mesh import compute_hex_mesh
from octafield.hexmesh.seamless import compute_seamless_map

from .benchmarks.pages import when
from .hex_dominant import checker
from .study_output import markdown_table

DATA = Path(__file__).resolve().parents[2] / "shared" / "data" / "hexme"
FIRST = ("s01", "s02", "s12", "s13", "s14", "s15", "s16", "s17", "s05", "s08", "s11")
HEADER = (
    "file", "tets", "non-meshable", "unzipped", "map's tets", "angle °", "flipped at first", "flipped", "steps",
    "stage", "stopped by", "hexahedra", "SJ min", "volume error %", "irregular edges", "CPU s",
)  # fmt: skip


def order(path: Path) -> tuple:
    name = path.name
    found = [i for i, beginning in enumerate(FIRST) if name.startswith(beginning)]
    return (found[0] if found else len(FIRST), path.stat().st_size if not found else 0, name)


def judged(given: octafield.volume.SeamlessMap) -> tuple[int, float]:
    """Tets that are not mapped with their sense; the largest difference of an edge's length, in parameters, between
    two tets: rotations and translations keep it."""
    tets = np.asarray(given.mesh.tets)
    at = np.asarray(given.parameters).reshape(-1, 4, 3)
    flipped = int((np.linalg.det(at[:, 1:] - at[:, :1]) <= 0).sum())
    lengths: dict[tuple[int, int], tuple[float, float]] = {}
    for a in range(4):
        for b in range(a):
            found = np.linalg.norm(at[:, a] - at[:, b], axis=1)
            for edge, length in zip(np.sort(tets[:, [a, b]], axis=1).tolist(), found.tolist(), strict=True):
                low, high = lengths.get((edge[0], edge[1]), (length, length))
                lengths[edge[0], edge[1]] = (min(low, length), max(high, length))
    return flipped, max(high - low for low, high in lengths.values())


def run(path: Path, cells: int) -> dict:
    name, begun = path.name.removesuffix(".vtk.gz"), time.process_time()
    row: dict = {"file": name}
    try:
        result = compute_seamless_map(path)
    except octafield.Error as error:
        return {**row, "stage": "none", "stopped_by": error.kind, "cpu": time.process_time() - begun}
    record = result.record
    flipped, torn = judged(result.map)
    sound = flipped == 0 and record.stopped_by != "winding_edge"
    if sound != (record.stage == "injective") and record.stage != "field" or torn > 1e-6:
        raise AssertionError(f"{name}: {flipped} flipped, edges differ by {torn}; the record says {record.stage}")
    row |= {
        "tets": record.field_tets, "non_meshable": record.non_meshable_junctions,
        "unzipped": f"{record.unzipped} of {record.turns}" if record.turns else "", "map_tets": record.tets,
        "angle": record.angle_deg, "first": record.flipped_at_first, "flipped": flipped, "steps": record.steps,
        "stage": record.stage, "stopped_by": record.stopped_by, "at": record.stopped_at,
    }  # fmt: skip
    if record.stage == "injective":
        row |= hexahedra(result, cells)
    row["cpu"] = time.process_time() - begun
    return row


def hexahedra(result: octafield.SeamlessMapResult, cells: int) -> dict:
    try:
        made = compute_hex_mesh(result.map, cells=cells)
    except octafield.Error as error:
        return {"stopped_by": error.kind, "message": str(error)}
    given = result.map.mesh
    edges = np.asarray(result.map.features)
    figures = checker.check(
        np.asarray(made.mesh.vertices), {"hexahedra": np.asarray(made.mesh.hexahedra)}, np.asarray(given.vertices),
        np.asarray(given.tets), made.record.edge_length.median, edges,
    )  # fmt: skip
    return {
        "stage": "extracted", "stopped_by": None, "hexahedra": made.record.hexahedra, "faults": figures["faults"],
        "sj": figures["hex_sj_min"], "volume": figures["volume_error"], "irregular": made.record.irregular_edges,
    }  # fmt: skip


def cells_of(row: dict) -> list[str]:
    def shown(name: str, form: str = ",", factor: float = 1) -> str:
        return "" if row.get(name) is None else format(row[name] * factor, form)

    irregular = ", ".join(f"{n} of {valence}" for valence, n in row.get("irregular", {}).items())
    return [
        row["file"], shown("tets"), shown("non_meshable"), row.get("unzipped", ""), shown("map_tets"),
        shown("angle", ".1f"), shown("first"), shown("flipped"), shown("steps"), row["stage"],
        row.get("stopped_by") or "", shown("hexahedra"), shown("sj", ".2f"), shown("volume", ".2f", 100), irregular,
        f"{row['cpu']:.1f}",
    ]  # fmt: skip


def summary(rows: list[dict]) -> str:
    def count(*stages: str) -> int:
        return sum(row["stage"] in stages for row in rows)

    made = [row for row in rows if row["stage"] == "extracted"]
    seamless, injective = count("seamless", "injective", "extracted"), count("injective", "extracted")
    sound = sum(not row["faults"] for row in made)
    return (
        f"{len(rows)} files: {seamless} seamless maps, {injective} of them injective, {len(made)} meshes of"
        f" hexahedra alone ({sound} without a fault). {sum(row['cpu'] for row in rows):.0f} s of CPU time in all.\n"
    )


def quarters(given: octafield.volume.SeamlessMap, curves: np.ndarray) -> list[int]:
    """Round each of the edges, by angles in the map."""
    tets, at = np.asarray(given.mesh.tets), np.asarray(given.parameters).reshape(-1, 4, 3)
    turned = dict.fromkeys(map(tuple, curves.tolist()), 0.0)
    for a in range(4):
        for b in range(a):
            c, d = sorted({0, 1, 2, 3} - {a, b})
            axis = at[:, b] - at[:, a]
            one, other = np.cross(axis, at[:, c] - at[:, a]), np.cross(axis, at[:, d] - at[:, a])
            cosine = (one * other).sum(1) / np.linalg.norm(one, axis=1) / np.linalg.norm(other, axis=1)
            for pair, angle in zip(np.sort(tets[:, [a, b]], axis=1).tolist(), np.arccos(cosine), strict=True):
                if tuple(pair) in turned:
                    turned[tuple(pair)] += angle
    return [round(angle / (np.pi / 2)) for angle in turned.values()]


def draw(path: Path, files: list[Path]) -> None:
    import pyvista

    plotter = pyvista.Plotter(shape=(2, len(files)), off_screen=True, window_size=(450 * len(files), 800), border=False)
    for column, file in enumerate(files):
        result = compute_seamless_map(file)
        field, curves = result.field, np.asarray(result.curves)
        graph = octafield.volume.singular_graph(field.tets, field.frames)
        points = np.asarray(graph.points)
        before = [
            (points[np.repeat(curve, 2)[1:-1]], 4 - turns)
            for curve, turns in zip(graph.curves, np.asarray(graph.curve_quarter_turns), strict=True)
            if len(curve) > 1
        ]
        places = np.asarray(result.map.mesh.vertices)
        after = [(places[edge], count) for edge, count in zip(curves, quarters(result.map, curves), strict=True)]
        surface = field.tets.surface.mesh
        for row, lines in enumerate((before, after)):
            plotter.subplot(row, column)
            outside = pyvista.PolyData.from_regular_faces(np.array(surface.vertices), np.array(surface.triangles, int))
            plotter.add_mesh(outside, color="white", opacity=0.25)
            plotter.add_mesh(outside.extract_feature_edges(40), color="black", line_width=1)
            for count, color in ((3, "#d55e00"), (5, "#0072b2")):
                ends = [part for part, found in lines if found == count]
                if ends:
                    plotter.add_mesh(pyvista.line_segments_from_points(np.concatenate(ends)), color=color, line_width=4)
            plotter.add_text(file.name.removesuffix(".vtk.gz") + (", field" if row == 0 else ", map"), font_size=9)
            plotter.view_vector((1, -1.6, 0.7), viewup=(0, 0, 1))
    plotter.screenshot(str(path))


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m studies.seamless_maps", description=__doc__)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--only", default="", help="beginnings of names with commas")
    parser.add_argument("--cells", type=int, default=2000)
    parser.add_argument("--picture", action="store_true")
    a = parser.parse_args()
    a.output.mkdir(parents=True, exist_ok=True)
    only = tuple(filter(None, a.only.split(","))) or ("",)
    if a.picture:
        draw(a.output / "curves.png", sorted(p for p in DATA.glob("*.vtk.gz") if p.name.startswith(only)))
        return
    rows = []
    with (a.output / "rows.jsonl").open("w") as file:
        for path in sorted((p for p in DATA.glob("*.vtk.gz") if p.name.startswith(only)), key=order):
            rows.append(run(path, a.cells))
            file.write(json.dumps(rows[-1]) + "\n")
            file.flush()
            print(" | ".join(cells_of(rows[-1])), flush=True)
    (a.output / "stages.md").write_text(summary(rows) + "\n" + markdown_table(HEADER, map(cells_of, rows)))
    (a.output / "when.md").write_text(when())
    print(summary(rows))


if __name__ == "__main__":
    main()
