"""Singular graphs of frame fields side by side in one picture.

    python studies/singular_graphs.py -o DIR [--columns 4] MESH...

MESH: surfaces or tet meshes; default recipe. DIR gets singular_graphs.png and singular_graphs.md: energy, curves,
    nodes, what no hex mesh has.
"""

import argparse
from io import BytesIO
from pathlib import Path

import octafield
from octafield.runs.field_pictures import singular_curves
from PIL import Image, ImageDraw, ImageFont
from study_output import markdown_table
from surface_pictures import save_with_few_colours

TILE = 420


def tile(name: str, png: bytes) -> Image.Image:
    picture = Image.open(BytesIO(png)).convert("RGB")
    picture.thumbnail((TILE, TILE), Image.Resampling.LANCZOS)
    result = Image.new("RGB", (TILE, TILE + 24), "white")
    result.paste(picture, ((TILE - picture.width) // 2, (TILE - picture.height) // 2))
    ImageDraw.Draw(result).text(
        (TILE // 2, TILE + 10), name, fill="black", anchor="mm", font=ImageFont.load_default(16)
    )
    return result


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("mesh", nargs="+", type=Path)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--columns", type=int, default=4)
    arguments = parser.parse_args()
    arguments.output.mkdir(parents=True, exist_ok=True)
    tiles, rows = [], []
    for path in arguments.mesh:
        name = path.name.split(".mesh")[0].split(".vtk")[0]
        result = octafield.compute_field(path)
        tiles.append(tile(name, singular_curves(result).png))
        r = result.record
        rows.append(
            (
                name,
                f"{r.vertices:,}",
                f"{r.energy:.6g}",
                r.singular_edges,
                f"{r.singular_length:.4g} ({r.singular_length_smoothed:.4g})",
                r.singular_curves,
                r.singular_nodes,
                r.complex_edges,
                r.non_meshable_vertices,
                r.non_meshable_junctions,
                f"{r.non_meshable_feature_edges}, {r.non_meshable_corners}",
            )
        )
        print(*rows[-1], flush=True)
    columns = min(arguments.columns, len(tiles))
    sheet = Image.new("RGB", (columns * TILE, -(-len(tiles) // columns) * (TILE + 24)), "white")
    for k, picture in enumerate(tiles):
        sheet.paste(picture, (k % columns * TILE, k // columns * (TILE + 24)))
    save_with_few_colours(sheet, arguments.output / "singular_graphs.png", 64)
    header = [
        "mesh",
        "vertices",
        "E",
        "singular edges",
        "length (smoothed)",
        "curves",
        "nodes",
        "complex edges",
        "non-meshable vertices",
        "non-meshable junctions",
        "feature edges, corners",
    ]
    (arguments.output / "singular_graphs.md").write_text(markdown_table(header, rows))


if __name__ == "__main__":
    main()
