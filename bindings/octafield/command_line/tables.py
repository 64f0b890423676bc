"""Tables on stdout for people."""

from __future__ import annotations

import sys
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

from rich.console import Console
from rich.table import Table
from rich.text import Text

from ..report.numbers.columns import terminal_table
from ..report.numbers.records import Results, Run

if TYPE_CHECKING:
    from ..records.atlas import AtlasRecord
    from ..records.base import Record
    from ..records.field import FieldRecord
    from ..records.hex_dominant import HexDominantRecord
    from ..records.hex_mesh import HexMeshRecord, SeamlessMapRecord
    from ..records.parts import AxesFigures
    from ..records.quad_layout import QuadLayoutRecord
    from ..records.quad_mesh import QuadMeshRecord
    from ..records.remesh import RemeshRecord
    from ..records.surface_field import SurfaceFieldRecord


def show_record(record: FieldRecord | SurfaceFieldRecord) -> None:
    facts = []
    for name, value in record.items():
        if name in ("alignment_deg", "feature_alignment_deg", "integrability", "lengths", "wall_seconds"):
            facts.append((name, "  ".join(f"{key} {number:.3g}" for key, number in value.items())))
        elif name == "sizes":
            facts.append(
                (
                    name,
                    "  ".join(
                        f"{key} {entry if isinstance(entry, str) else f'{entry:.3g}'}" for key, entry in value.items()
                    ),
                )
            )
        elif name == "axes":
            facts += _of_axes(value)
        elif isinstance(value, (str, int, float)) and name != "input":
            facts.append((name, f"{value:.8g}" if isinstance(value, float) else str(value)))
    _facts(record.input, facts)
    verdict = getattr(record, "verdict", None)
    _show_verdict(verdict.sentences if verdict else ())


def _of_axes(figures: AxesFigures) -> list[tuple[str, str]]:
    facts = [
        ("axes off right angles", f"at {figures.oblique_share:.1%} of the vertices, by"
         f" {figures.largest_obliqueness_deg:.3g} degrees at most"),
    ]  # fmt: skip
    for wedges in figures.wedges:
        off = f"off faces {wedges.off_faces_deg.max:.2g}  off edges {wedges.off_edges_deg.max:.2g} degrees at most"
        facts.append((f"feature edges of {wedges.angle_deg} degrees", f"{wedges.edges:,}  {off}"))
    return facts


def show_hex_record(record: HexDominantRecord) -> None:
    cells, steps = record.cells.to_dict(), record.steps
    facts = [(kind, f"{count:,}") for kind, count in cells.items()]
    facts += [
        ("hexahedra, of the volume", f"{record.hex_volume_share:.1%}"),
        ("hexahedra, of the cells", f"{record.hex_number_share:.1%}"),
    ]
    facts += [
        (f"scaled Jacobian, {kind}", _several(figures, (".3f",) * 3))
        for kind, figures in record.scaled_jacobian.items()
    ]
    facts += [
        ("inverted", str(record.inverted)),
        ("not proven positive", str(record.unproven)),
        ("nonconforming faces", str(record.nonconforming_faces)),
        ("volume error", f"{record.volume_error:.2e}"),
        ("boundary deviation", _several(record.boundary_deviation, (".2e",) * 2)),
        ("edge length", _several(record.edge_length, (".4g",) * 4)),
        ("lost in the lattice", _several(steps.lost, ("d",) * 4)),
        ("left out as crossing", str(steps.crossing)),
        ("pyramids", _several(steps.pyramids, ("d",) * 3)),
        ("seconds", f"{sum(record.wall_seconds.values()):.1f}"),
        ("peak_mb", f"{record.peak_mb:.0f}"),
    ]
    _facts(record.input, facts)


def show_hex_mesh_record(record: HexMeshRecord | SeamlessMapRecord) -> None:
    from ..records.hex_mesh import SeamlessMapRecord

    if isinstance(record, SeamlessMapRecord):
        _show_map_record(record)
        return
    irregular = ", ".join(f"{number:,} of valence {valence}" for valence, number in record.irregular_edges.items())
    facts = [
        ("blocks", f"{record.blocks:,}"),
        ("hexahedra", f"{record.hexahedra:,}"),
        ("wanted", f"{record.target:,}"),
        ("irregular edges inside", irregular or "none"),
        ("scaled Jacobian", _several(record.scaled_jacobian, (".3f",) * 3)),
        ("inverted", str(record.inverted)),
        ("not proven positive", str(record.unproven)),
        ("nonconforming faces", str(record.nonconforming_faces)),
        ("volume error", f"{record.volume_error:.2e}"),
        ("boundary deviation", _several(record.boundary_deviation, (".2e",) * 2)),
        ("off features", _several(record.feature_deviation, (".2e",) * 2)),
        ("edge length", _several(record.edge_length, (".4g",) * 4)),
        ("seconds", f"{record.seconds:.1f}"),
    ]
    _facts(record.input, facts)


def _show_map_record(record: SeamlessMapRecord) -> None:
    facts = [
        ("reached", record.stage),
        ("stopped by", record.stopped_by or "nothing"),
        ("tets", f"{record.tets:,}"),
        ("singular edges", f"{record.singular_edges:,}"),
        ("curves unzipped", f"{record.unzipped} of {record.turns}"),
        ("locked tets", f"{record.locked:,}"),
        ("flipped at first", f"{record.flipped_at_first:,}"),
        ("flipped", f"{record.flipped:,}"),
        ("axes to gradients, degrees", f"{record.angle_deg:.3g}"),
        ("seconds", f"{record.seconds:.1f}"),
    ]
    _facts(record.input, facts)


def show_layout_record(record: QuadLayoutRecord) -> None:
    inside = [point for point in record.singular_points if not point.boundary]
    missed = [abs(condition.angle_deg) for condition in record.misalignment]
    facts = [
        ("singular points inside", f"{len(inside)}"),
        ("and at corners", f"{len(record.singular_points) - len(inside)}"),
        ("sum of indices", f"{record.index_sum:g}"),
        ("largest misalignment, degrees", f"{max(missed, default=0.0):.3g}"),
        ("patches", f"{record.patches:,}"),
        ("chords", f"{record.chords:,}"),
        ("quads", f"{record.quads:,}"),
        ("irregular vertices", f"{record.irregular_vertices:,}"),
        ("T-junctions", f"{record.t_junctions}"),
        ("inverted", f"{record.inverted}"),
        ("nonconforming edges", f"{record.nonconforming_edges}"),
        ("scaled Jacobian", _several(record.scaled_jacobian, (".3f",) * 3)),
        ("edge length", _several(record.edge_length, (".4g",) * 4)),
        ("deviation from the surface", _several(record.surface_deviation, (".2e",) * 2)),
        ("seconds", f"{sum(record.wall_seconds.values()):.1f}"),
        ("peak_mb", f"{record.peak_mb:.0f}"),
    ]
    _facts(record.input, facts)


def show_quad_mesh_record(record: QuadMeshRecord) -> None:
    facts = [
        ("quads", f"{record.quads:,}"),
        ("wanted", f"{record.target:,}"),
        ("irregular vertices by quads", _counts(record.irregular_vertices)),
        ("on the boundary", _counts(record.irregular_boundary_vertices)),
        ("inverted", f"{record.inverted}"),
        ("nonconforming edges", f"{record.nonconforming_edges}"),
        ("scaled Jacobian", _several(record.scaled_jacobian, (".3f",) * 3)),
        ("angle, degrees", _several(record.angle, (".1f",) * 2)),
        ("size over the wanted one", _several(record.size_ratio, (".3f",) * 3)),
        *([("from the field, degrees", _several(record.field_angle, (".2f",) * 2))] if record.field_angle else []),
        ("deviation from features", _several(record.feature_deviation, (".2e",) * 2)),
        ("deviation from the surface", _several(record.surface_deviation, (".2e",) * 2)),
        ("seconds", f"{record.seconds:.1f}"),
        ("peak_mb", f"{record.peak_mb:.0f}"),
    ]
    _facts(record.input, facts)


def show_atlas_record(record: AtlasRecord) -> None:
    facts = [
        ("triangles", f"{record.triangles:,}"),
        ("added in coarse faces", f"{record.added_triangles:,}"),
        ("faces", f"{record.faces:,}"),
        ("handles", f"{record.handles:,}"),
        ("charts", f"{record.charts:,}"),
        ("not positive in the plane", f"{record.not_positive:,}"),
        ("conformity", _several(record.conformity, (".3g",) * 3)),
        ("charts below", f"{record.charts_below:,}"),
        ("edges cut", f"{record.cut_edges:,}"),
        ("seconds", f"{sum(record.wall_seconds.values()):.1f}"),
        ("peak_mb", f"{record.peak_mb:.0f}"),
    ]
    _facts(record.input, facts)


def show_remesh_record(record: RemeshRecord) -> None:
    facts = [
        ("vertices", f"{record.vertices:,}"),
        ("triangles", f"{record.triangles:,}"),
        ("mean edge", f"{record.mean_edge:.4g}"),
        ("quality", _several(record.quality, (".3f",) * 3)),
        ("smallest angle, degrees", f"{record.smallest_angle:.1f}"),
        ("deviation over the diagonal", _several(record.deviation, (".2e",) * 2)),
        ("vertices off the surface", f"{record.off_surface:.1e}"),
        ("corners missed", f"{record.features.missed_corners} of {record.features.corners}"),
        ("watertight", "yes" if record.watertight else f"no: {record.open_edges:,} open edges"),
        ("seconds", f"{record.seconds:.1f}"),
        ("peak_mb", f"{record.peak_mb:.0f}"),
    ]
    _facts(record.input, facts)


def _counts(by_number: dict[str, int]) -> str:
    return "  ".join(f"{number}: {count:,}" for number, count in by_number.items()) or "none"


def _several(figures: Record, formats: Sequence[str]) -> str:
    return "  ".join(f"{name} {value:{form}}" for (name, value), form in zip(figures.items(), formats, strict=True))


def show_comparison(rows: list[FieldRecord]) -> None:
    table = terminal_table(Results([Run(row, Path(row.input).name) for row in rows]))
    cells = [[column.show(value) for column, value in zip(table.columns, line, strict=True)] for line in table.rows]
    _table([column.name for column in table.columns], cells, left=3)


def show_info(record: dict[str, Any]) -> None:
    facts = [
        (name, f"{value:.8g}" if isinstance(value, float) else str(value))
        for name, value in record.items()
        if isinstance(value, (str, int, float)) and name not in ("input", "ok")
    ]
    facts += [
        (f"{name} {key}", f"{value:.6g}" if isinstance(value, float) else str(value))
        for name in ("bounding_box", "features", "feature_lines", "tet_quality", "expected")
        for key, value in record.get(name, {}).items()
    ]
    _facts(record["input"], facts)
    _table(
        ["", "requirement", "what is wrong", "remedy"],
        [[r["state"], r["requirement"], _fact(r), r["remedy"]] for r in record["requirements"]],
        left=4,
    )
    _show_verdict(record["verdict"]["sentences"] if "verdict" in record else ())


def _show_verdict(sentences: Sequence[str]) -> None:
    for sentence in sentences:
        _stdout().print(Text(f"verdict: {sentence}"), soft_wrap=True)


def _fact(requirement: dict[str, Any]) -> str:
    """The message without the remedy, which has a column of its own."""
    message = str(requirement["message"])
    return message.removesuffix(f"; {requirement['remedy']}") if requirement["remedy"] else message


def show_doctor(record: dict[str, Any]) -> None:
    facts = [
        (name, str(value)) for name, value in {**record["versions"], **record["libraries"]}.items() if name != "vtk"
    ]
    facts.append(("VTK of pictures", record["versions"]["vtk"]))
    facts += [("cores", str(record["cores"])), ("memory", f"{record['memory_gb']:g} GB")]
    _facts("octafield doctor", facts)
    _table(["", "part", "what was found"], [[c["state"], c["name"], c["message"]] for c in record["checks"]], left=3)


def show_registry(record: dict[str, Any]) -> None:
    rows = [
        [r["name"], "yes" if r["rotates_linearly"] else "no", str(r["dimension"]), _speed(r)]
        for r in record["representations"]
    ]
    _table(["representation", "rotates linearly", "numbers", "per radian"], rows, left=2)
    _table(
        ["metric", "measures", "per radian"],
        [[m["name"], m["description"], _speed(m)] for m in record["metrics"]],
        left=2,
    )


def _speed(entry: dict[str, Any]) -> str:
    return "varies" if entry["speed"] is None else f"{entry['speed']:.6g}"


def _facts(title: str, facts: list[tuple[str, str]]) -> None:
    _stdout().print(Text(title, style="bold"), soft_wrap=True)
    table = Table(show_header=False, box=None, pad_edge=False)
    table.add_column(style="dim")
    table.add_column(justify="right")
    for name, value in facts:
        table.add_row(name, Text(value))
    _stdout().print(table)


def _table(heads: list[str], rows: list[list[str]], left: int = 1) -> None:
    """A table whose first `left` columns are text and the others numbers."""
    table = Table(box=None, pad_edge=False, header_style="bold")
    for number, head in enumerate(heads):
        table.add_column(head, justify="left" if number < left else "right", no_wrap=number >= left)
    for row in rows:
        table.add_row(*map(Text, row))  # Text: brackets in file names are no markup
    _stdout().print(table)


def _stdout() -> Console:
    """Wide where nobody reads on a terminal, so that pipes get whole lines."""
    return Console(width=None if sys.stdout.isatty() else 280, highlight=False)
