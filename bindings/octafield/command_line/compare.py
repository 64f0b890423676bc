"""The command that compares: octafield compare."""

from typing import Annotated

import typer

from ..options import BOUNDARIES, COMPARED, REPRESENTATIONS, FieldOptions
from . import console, tables
from .console import carry_out, log
from .options import (
    ANGLE,
    EdgeLength,
    FeatureAngle,
    Features,
    InputFiles,
    Interfaces,
    Json,
    MaxCells,
    MaxHoleEdges,
    Output,
    Quiet,
    Remesh,
    Repair,
    Sampling,
    Seed,
    Sizes,
    Split,
    Threads,
    Verbose,
    WrapAlpha,
    WrapOffset,
    choices,
    mesh_options,
    named_files,
)
from .shell_completion import lists

_FIELD = FieldOptions()


def register(app: typer.Typer) -> None:
    app.command()(compare)


def compare(
    inputs: InputFiles = None,
    output: Output = ...,  # type: ignore[assignment]
    representations: Annotated[
        str,
        typer.Option(
            metavar="all|A,B",
            autocompletion=lists(REPRESENTATIONS, "all"),
            help=f"Of: {', '.join(REPRESENTATIONS)}; all: {', '.join(COMPARED)}.",
        ),
    ] = "all",
    boundaries: Annotated[
        str, typer.Option(metavar="A,B", autocompletion=lists(BOUNDARIES), help=f"Of: {choices(BOUNDARIES)}.")
    ] = "fixed,aligned",
    fields: Annotated[
        list[str] | None,
        typer.Option(
            "--field",
            metavar="NAME=FILE",
            help=(
                "A field of another program (docs/formats.md) beside the others, as it is and smoothed; may be"
                " repeated."
            ),
        ),
    ] = None,
    sampling: Sampling = _FIELD.sampling,
    seeds: Annotated[int, typer.Option(metavar="K", help="Seeds per run: --seed and the K - 1 numbers after it.")] = 1,
    starts: Annotated[
        str,
        typer.Option(
            metavar="A,B",
            autocompletion=lists(("sh4", "independent")),
            help=(
                "sh4: from its minimum; independent: each method for itself, from a linear solve (random for seeds"
                " above 0)."
            ),
        ),
    ] = "sh4",
    features: Features = _FIELD.features,
    feature_angle: FeatureAngle = ANGLE,
    edge_length: EdgeLength = _FIELD.edge_length,
    max_cells: MaxCells = _FIELD.max_cells,
    remesh: Remesh = _FIELD.remesh,
    repair: Repair = _FIELD.repair,
    max_hole_edges: MaxHoleEdges = _FIELD.max_hole_edges,
    wrap_alpha: WrapAlpha = _FIELD.wrap_alpha,
    wrap_offset: WrapOffset = _FIELD.wrap_offset,
    interfaces: Interfaces = _FIELD.interfaces,
    split: Split = _FIELD.split,
    sizes: Sizes = _FIELD.sizes,
    seed: Seed = _FIELD.seed,
    threads: Threads = _FIELD.threads,
    json: Json = None,
    quiet: Quiet = False,
    verbose: Verbose = False,
) -> None:
    """Representations and boundary treatments side by side. DIR gets report.html, results.json, a folder per run."""

    def work() -> None:
        from ..runs.compare import compare as run_comparison
        from ..runs.compare import default_input

        options = FieldOptions(
            sampling=sampling,
            sizes=sizes,
            seed=seed,
            threads=threads,
            **mesh_options(
                features,
                feature_angle,
                edge_length,
                remesh,
                repair,
                interfaces=interfaces,
                split=split,
                max_hole_edges=max_hole_edges,
                wrap_alpha=wrap_alpha,
                wrap_offset=wrap_offset,
                max_cells=max_cells,
            ),  # fmt: skip
        )
        chosen = COMPARED if representations == "all" else _listed(representations)
        with console.progress_bar(quiet, whole=True) as progress:
            comparison = run_comparison(
                inputs or [default_input()],
                output,
                representations=chosen,
                boundaries=_listed(boundaries),
                seeds=seeds,
                starts=_listed(starts),
                options=options,
                fields=named_files(fields or []),
                progress=progress,
            )
        for record in {row["input"]: row for row in comparison.rows}.values():
            console.report_notes(record)
        if json:
            console.put_json(json, comparison.rows)
        if json != "-" and not quiet:
            tables.show_comparison(comparison.rows)
        log.info("wrote %s", output / "report.html")

    carry_out(work, quiet, verbose, json)


def _listed(text: str) -> list[str]:
    return [word.strip() for word in text.split(",") if word.strip()]
