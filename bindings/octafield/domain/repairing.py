"""Repair of an input by level, and which level would make it sound: what a message advises has been tried."""

from typing import Any

import numpy as np

from .. import _core
from .._core import RepairAdvice, TriangleMesh
from ..meshes.registry import MESH_FORMATS
from ..options import REPAIR_LEVELS, MeshOptions
from .inputs import Input

Array = np.ndarray[Any, Any]
_BEYOND_REPAIR = ("empty", "index_out_of_range", "non_finite_vertex")


def level_of(found: Input, options: MeshOptions) -> str:
    """merge for files without shared points (STL), and none otherwise, where the options do not say."""
    if options.repair != "default":
        return options.repair
    return "merge" if any(form.soup and form.owns(found.name) for form in MESH_FORMATS.values()) else "none"


def repair_surface(found: Input, options: MeshOptions, closed: bool = True) -> None:
    """Drops unused points and repairs as far as the level says, each with a note. Tet meshes are left alone. closed:
    False keeps rims."""
    if found.tets is not None:
        return
    _drop_unused(found)
    level = level_of(found, options)
    if level == "none":
        return
    result = _core.repair(found.surface, level=level, closed=closed, **_bounds(options))
    if not result.actions:
        return
    before, found.surface, found.faces = found.surface, result.mesh, None
    found.notes += [f"repair: {action}" for action in result.actions]
    if found.lines is not None:
        _carry_lines(found, before)


def advise(found: Input, options: MeshOptions, closed: bool = True, fills: bool = False) -> RepairAdvice:
    """Tries the levels above that of the options on a copy of a surface. fills: with its holes filled as well, where
    rims need not be but nothing else helps."""
    level = level_of(found, options)
    advice = _core.advise_repair(found.surface, level=level, closed=closed, **_bounds(options))
    if closed or not fills or advice.level != "none":
        return advice
    return _core.advise_repair(found.surface, level=level, closed=True, **_bounds(options))


def message_with_remedy(
    message: str,
    kind: str,
    found: Input,
    options: MeshOptions,
    closed: bool = True,
    advice: RepairAdvice | None = None,
    fills: bool = False,
) -> str:
    """The message of a defect with what helps instead of the general advice. advice: of `advise`, where it is there
    already."""
    fact = message.partition("; ")[0]
    if found.tets is not None:
        return f"{fact}; correct the tet mesh where it was made"
    if kind in _BEYOND_REPAIR:
        return message
    where = "correct the surface where it was made"
    if kind == "not_closed":
        where = (
            f"{'export the model as solids' if found.of_cad else where}, or take octafield surface-field, which needs"
            " no volume"
        )
    return f"{fact}; {remedy(advice or advise(found, options, closed, fills), level_of(found, options), where)}"


def remedy(advice: RepairAdvice, done: str, where: str) -> str:
    """done: the level that was applied before. where: what to do where no level helps."""
    if advice.level != "none":
        return f"--repair {advice.level} makes it sound ({', '.join(advice.actions)})"
    if advice.not_tried:
        return f"--repair merge, safe and fill do not make it sound, and {advice.not_tried}; {where}"
    left = advice.left[0].message.partition("; ")[0] if advice.left else ""
    why = next((f", {action}" for action in advice.actions if action.startswith("not wrapped")), "")
    if any(defect.kind == "inconsistent_orientation" for defect in advice.left):
        where = "one-sided surfaces, as Moebius strips are, have to be cut open; else " + where
    after = f"after --repair {done}" if done == REPAIR_LEVELS[-1] else f"after --repair {REPAIR_LEVELS[-1]}"
    return f"no level of --repair makes it sound ({after}: {left}{why}); {where}"


def _bounds(options: MeshOptions) -> dict[str, Any]:
    return {
        "max_hole_edges": options.max_hole_edges,
        "wrap_alpha": options.wrap_alpha,
        "wrap_offset": options.wrap_offset,
    }


def _drop_unused(found: Input) -> None:
    triangles, points = np.asarray(found.surface.triangles), np.asarray(found.surface.vertices)
    if not len(triangles) or triangles.min() < 0 or triangles.max() >= len(points):
        return
    used = np.zeros(len(points), bool)
    used[triangles] = True
    if used.all():
        return
    new_id = np.where(used, np.cumsum(used) - 1, -1)
    found.surface = TriangleMesh(points[used], new_id[triangles].astype(np.int32))
    found.notes.append(f"{int((~used).sum())} vertices that no triangle uses were left out")
    if found.lines is not None:
        lines = new_id[found.lines]
        found.lines = lines[(lines >= 0).all(axis=1)].astype(np.int32)


def _carry_lines(found: Input, before: TriangleMesh) -> None:
    """The feature lines of the file whose ends are still there and joined by an edge."""
    assert found.lines is not None
    points = np.concatenate([np.asarray(found.surface.vertices), np.asarray(before.vertices)]) + 0.0  # -0 is 0
    count = len(found.surface.vertices)
    _, first, place = np.unique(points, axis=0, return_index=True, return_inverse=True)
    new_id = first[place.ravel()][count:]
    lines = np.sort(new_id[found.lines], axis=1).astype(np.int64)
    lines = np.unique(lines[(lines < count).all(axis=1) & (lines[:, 0] < lines[:, 1])], axis=0)
    triangles = np.asarray(found.surface.triangles).astype(np.int64)
    sides = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    kept = lines[np.isin(lines[:, 0] * count + lines[:, 1], sides[:, 0] * count + sides[:, 1])]
    if len(kept) < len(found.lines):
        found.notes.append(
            f"repair: {len(found.lines) - len(kept)} of {len(found.lines)} feature lines of the file are no edges any"
            " more, and left out"
        )
    found.lines = kept.astype(np.int32)
