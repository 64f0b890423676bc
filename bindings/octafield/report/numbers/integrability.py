"""Of runs with sizes along the axes: how far fields are from the gradients of a map, before and after; table and
prose."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ..page.words import counted, sentence, spread
from .columns import RUN_COLUMNS, RunColumn, field_column
from .profiles import geometric_mean
from .records import Method, Results, Run
from .tables import Table

if TYPE_CHECKING:
    from ...records.parts import SizesFigures

_NONE = 1e-9  # of curl times edge length: rounding
_WHO = ("input", "method", "boundary", "seed", "repeat")
_CURL, _JUMP = "curl", "axis jump"
_KINDS = {"isotropic": "one size for all axes", "axes": "one size per axis"}

COLUMNS = (
    *(column for column in RUN_COLUMNS if column.head in _WHO),
    field_column("sizes", "", "one for all axes, or one per axis", "", lambda r: r.sizes and _KINDS.get(r.sizes.kind)),
    field_column("before", ".4g", "of the unit axes, in 1 over the unit of the input, root mean square over the "
                                  "volume; 0 for gradients of a map", _CURL,
                 lambda r: r.sizes and r.sizes.curl_rms_before),
    field_column("after", ".4g", "of the axes with their sizes, over these", _CURL,
                 lambda r: r.sizes and r.sizes.curl_rms_after),
    RunColumn("left, %", ".1f", "the one over the other", _CURL, lambda _, run: _left(run)),
    field_column("before", ".4f", "jump of the axes along the face between two tets, root mean square; of the order of "
                                  "the mesh width", _JUMP, lambda r: r.sizes and r.sizes.jump_rms_before),
    field_column("after", ".4f", "with the sizes, over these; it rises where sizes vary", _JUMP,
                 lambda r: r.sizes and r.sizes.jump_rms_after),
    field_column("size ratio", ".3g", "the largest size over the smallest", "",
                 lambda r: r.sizes and r.sizes.size_ratio),
    field_column("CPU seconds", ".3f", "of finding the sizes and both figures", "",
                 lambda r: r.sizes and r.cpu_seconds.sizes),
)  # fmt: skip


def sizes_of(run: Run) -> SizesFigures | None:
    """None where they were not asked for."""
    return run.record.sizes if run.done else None


def _left(run: Run) -> float | None:
    """Per cent of the curl; None where there is none."""
    found = sizes_of(run)
    if found is None or found.curl_rms_before * run.record.edge_length < _NONE:
        return None
    return 100 * found.curl_rms_after / found.curl_rms_before


def integrability_table(results: Results) -> Table:
    """A line per run with sizes."""
    runs = sorted(filter(sizes_of, results.runs), key=lambda run: (results.rank(run), run.repeat))
    table = Table("integrability", COLUMNS, [[column.value(results, run) for column in COLUMNS] for run in runs])
    return table.without_dull("repeat")


def integrability(results: Results, cite: str) -> list[str]:
    """What sizes leave of the curl; a paragraph per kind."""
    return [text for kind in _KINDS if (text := _of_kind(results, kind, cite))]


def _of_kind(results: Results, kind: str, cite: str) -> str:
    runs = [run for run in results.runs if (sizes := sizes_of(run)) is not None and sizes.kind == kind]
    if not runs:
        return ""
    curled = [run for run in runs if _left(run) is not None]
    if not curled:
        return sentence(f"with {_KINDS[kind]}, fields have no curl, up to rounding, before or after {cite}")
    left: dict[Method, float] = {}
    for method in results.methods:
        shares = [share for run in curled if results.method(run) == method and (share := _left(run)) is not None]
        mean = geometric_mean(np.array(shares))
        if mean is not None:
            left[method] = mean
    over = f" on geometric mean over {counted(len(curled), 'run')}" if len(curled) > len(left) else ""
    ratios = sorted(sizes.size_ratio for run in curled if (sizes := sizes_of(run)) is not None)
    ends = " to ".join(dict.fromkeys(f"{ratio:.3g}" for ratio in (ratios[0], ratios[-1])))
    text = [
        f"{_KINDS[kind]} leaves {spread(left, '.1f', unit=' %')} of the curl of unit axes{over}; the largest size is"
        f" {ends} times the smallest {cite}"
    ]
    if len(curled) < len(runs):
        text.append(
            f"{counted(len(runs) - len(curled), 'run')} without any curl, up to rounding,"
            f" {'is' if len(runs) - len(curled) == 1 else 'are'} left out"
        )
    return " ".join(map(sentence, text))
