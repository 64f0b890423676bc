"""What the steps of hex_dominant are worth: the same files with a step left out or changed."""

from pathlib import Path

import octafield
from study_output import markdown_table

from ..benchmarks.pages import when
from .run import THREADS

FILES = "s02u s04u s06u s07u s10u s12u".split()
# What is changed of the map alone, in words and as options.
WAYS = [
    ("the default: map or front, the better", {"points": "best"}),
    ("map alone", {}),
    ("tets cut once", {"refinements": 1}),
    ("tets not cut", {"refinements": 0}),
    ("sizes give way alike along all axes", {"correction": "isotropic"}),
    ("sizes do not give way", {"correction": "none"}),
    ("neither cut nor giving way", {"refinements": 0, "correction": "none"}),
    ("tets not joined", {"recombine": False}),
    ("vertices not moved", {"improve": False}),
    ("hexahedra with scaled Jacobians from 0.15", {"min_scaled_jacobian": 0.15}),
    ("hexahedra with scaled Jacobians from 0.5", {"min_scaled_jacobian": 0.5}),
    ("hexahedra with scaled Jacobians from 0.8", {"min_scaled_jacobian": 0.8}),
    ("front alone", {"points": "frontal"}),
]  # fmt: skip
HEADER = [
    "file", "way", "working tets", "lattice hexahedra", "hexahedra", "hex volume %", "hex number %", "hex SJ mean",
    "SJ min", "volume error %", "CPU s",
]  # fmt: skip


def row(name: str, words: str, result: octafield.HexDominantResult) -> list[str]:
    told = result.record
    lowest = min(figures.min for figures in told.scaled_jacobian.values())
    return [
        name, words, f"{result.counts.tets:,}", f"{result.counts.lattice_hexahedra:,}", f"{told.cells.hexahedra:,}",
        f"{100 * told.hex_volume_share:.1f}", f"{100 * told.hex_number_share:.1f}",
        f"{told.scaled_jacobian['hexahedra'].mean:.3f}", f"{lowest:.3f}", f"{100 * told.volume_error:.3f}",
        f"{sum(told.cpu_seconds.values()):.1f}",
    ]  # fmt: skip


def work(data: Path, output: Path, only: tuple[str, ...]) -> None:
    """ways.md and ways_when.md in the folder. Cells have the mean edge of the boundary."""
    output.mkdir(parents=True, exist_ok=True)
    options = octafield.FieldOptions(threads=THREADS, streamlines=0)
    rows = []
    for name in only or FILES:
        field = octafield.compute_field(data / "hexme" / f"{name}.vtk.gz", options)
        for words, changed in WAYS:
            cells = octafield.HexMeshOptions(**{"points": "periodic", **changed})
            rows.append(row(name, words, octafield.compute_hex_dominant(field, options, hex_options=cells)))
            print(*rows[-1], flush=True)
            (output / "ways.md").write_text(markdown_table(HEADER, rows))
    (output / "ways_when.md").write_text(when())
