"""The doctor for inputs: what was read, and which requirement it meets, barely meets or fails, with the remedy."""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from .. import _core
from .._core import TetDomain
from ..domain.inputs import Input, naming, read_input
from ..domain.meshing import TOUCHING, find_features, sheets_of, split_input
from ..domain.repairing import advise, message_with_remedy, repair_surface
from ..errors import Error
from ..fields import verdict
from ..fields.verdict import WARN
from ..options import MeshOptions
from ..progress.phases import octafield_version
from . import checks as info_checks
from . import estimates
from .checks import FAIL, NOT_TESTED, PASS, Examined, Finding
from .measures import radius_ratios

__all__ = ["FAIL", "NOT_TESTED", "PASS", "WARN", "examine", "first_failure"]


@dataclass(frozen=True)
class Requirement:
    """kinds: defects (octafield.surface.find_defects) that break it. needs: kinds without which it can be tested."""

    text: str
    kinds: tuple[str, ...]
    needs: tuple[str, ...] = ()


_ARRAYS = ("empty", "index_out_of_range", "non_finite_vertex")
_EDGES = (*_ARRAYS, "soup")
_ALL_EARLIER = (*_EDGES, "degenerate_triangle", "duplicate_vertex", "non_manifold_edge")

REQUIREMENTS = (
    Requirement("has triangles", ("empty",)),
    Requirement("vertex numbers in range", ("index_out_of_range",), ("empty",)),
    Requirement("finite coordinates", ("non_finite_vertex",), ("empty",)),
    Requirement("no triangle of zero area", ("degenerate_triangle",), _ARRAYS),
    Requirement("triangles share vertices", ("soup", "duplicate_vertex"), _ARRAYS),
    Requirement("at most two triangles at an edge", ("non_manifold_edge",), _EDGES),
    Requirement("triangles oriented alike", ("inconsistent_orientation",), _EDGES),
    Requirement("closed", ("not_closed",), _EDGES),
    Requirement("one sheet at every vertex", ("non_manifold_vertex",), _ALL_EARLIER),
    Requirement(
        "faces outward",
        ("inside_out",),
        (*_ALL_EARLIER, "inconsistent_orientation", "not_closed", "non_manifold_vertex"),
    ),
    Requirement("no self-intersection", ("self_intersection",), (*_EDGES, "degenerate_triangle", "duplicate_vertex")),
)


def examine(path: str | Path, options: MeshOptions = MeshOptions()) -> dict[str, Any]:
    """Facts about a file and the state of each requirement: the JSON object of `octafield info`. Key "ok": none failed.

    Each requirement has a state ("pass"; "warn": a field can be computed, but expect trouble; "fail"; "not tested":
    another has to be met first), kind (a stable word), message, remedy (an option of the command line where one does
    it) and elements (ids). options: as they would be given to the field; a surface is repaired (repair) and a tet mesh
    split (split) first.
    """
    try:
        found = read_input(path, interfaces=options.interfaces, edge_length=options.edge_length)
    except Error as error:  # the first requirement that can fail
        return _unread(str(path), error)
    with naming(found.name):
        repair_surface(found, options)
        whole = found.surface
        if found.interface_triangles:
            found.surface = found.volume().boundary.mesh  # interfaces are sound where the tets are
        findings = [Finding("file can be read", PASS), *_defects(found, options)]
        failed = {f.requirement for f in findings if f.state != PASS}
        facts: dict[str, Any] = {}
        if not failed & {"has triangles", "vertex numbers in range", "finite coordinates"}:
            facts = _topology(found, failed)
        if not failed:
            found.surface = whole
            more, further = _beyond_defects(found, options)
            findings += more
            facts |= further
    return {
        "input": found.name,
        "version": octafield_version(),
        "input_kind": found.kind,
        "ok": not any(f.state in (FAIL, NOT_TESTED) for f in findings),
        **_counts(found),
        **_geometry(found),
        "notes": found.notes,
        "requirements": [f.to_json() for f in findings],
        **facts,
        "verdict": verdict.of_input([f.to_json() for f in findings]).to_dict(),
    }


def first_failure(record: dict[str, Any]) -> dict[str, Any] | None:
    """The first requirement that failed."""
    return next((r for r in record["requirements"] if r["state"] == FAIL), None)


def _unread(name: str, error: Error) -> dict[str, Any]:
    flat = error.kind == "inverted_tet"
    what = Finding(
        "tets have volume" if flat else "file can be read",
        FAIL,
        error.kind or "unreadable",
        str(error),
        str(error).rpartition("; ")[2] if "; " in str(error) else "correct the file there, or write it again",
        tuple(error.elements),
    )
    findings = [Finding("file can be read", PASS), what] if flat else [what]
    record = {"input": name, "version": octafield_version(), "ok": False, "notes": []}
    requirements = [f.to_json() for f in findings]
    return record | {"requirements": requirements, "verdict": verdict.of_input(requirements).to_dict()}


def _defects(found: Input, options: MeshOptions) -> list[Finding]:
    # Tets of positive volume rarely make a crossing boundary, and the pipeline does not ask for this test there.
    test_crossings = found.tets is None
    defects = {d.kind: d for d in _core.find_defects(found.surface, self_intersection=test_crossings)}
    if found.tets is not None:  # whose boundary may touch itself
        for kind in TOUCHING:
            if defects.pop(kind, None):
                found.touches = True
                found.notes.append(f"the boundary touches itself ({kind}); the field is computed all the same")
    advice = advise(found, options) if defects and found.tets is None else None
    listed = []
    for requirement in REQUIREMENTS:
        if requirement.kinds == ("self_intersection",) and not test_crossings:
            continue
        broken = [defects[kind] for kind in requirement.kinds if kind in defects]
        state = FAIL if broken else NOT_TESTED if any(kind in defects for kind in requirement.needs) else PASS
        if not broken:
            listed.append(Finding(requirement.text, state))
            continue
        message = message_with_remedy(broken[0].message, broken[0].kind, found, options, advice=advice)
        remedy = message.partition("; ")[2]
        elements = tuple(int(i) for d in broken for i in d.elements)
        listed.append(Finding(requirement.text, state, broken[0].kind, message, remedy, elements))
    return listed


def _beyond_defects(found: Input, options: MeshOptions) -> tuple[list[Finding], dict[str, Any]]:
    """Of a sound input: what makes fields poor, slow or impossible to compute."""
    facts: dict[str, Any] = {}
    locking = None if found.tets is None else split_input(found, options)
    sheets = sheets_of(found)
    try:
        features, source = find_features(found, options, sheets)
    except Error as error:
        return [Finding("features can be found", FAIL, error.kind, str(error), "--features angle")], facts
    facts["features"] = {
        "source": source,
        "angle_deg": math.degrees(options.feature_angle),
        "edges": len(features.edges),
        "corners": len(features.corners),
    }
    remade = found.tets is None and options.remesh
    seen = Examined(found, options, features, source, float(_core.mean_edge_length(found.surface)), locking)
    if remade:
        sizes = estimates.planned_sizes(found.surface, features, options)
        seen.lengths, seen.length = np.asarray(sizes.lengths), sizes.shortest
        found.notes += sizes.notes
        facts["edge_lengths"] = {
            "shortest": sizes.shortest,
            "median": float(np.median(seen.lengths)),
            "longest": sizes.longest,
        }
    if found.tets is not None:
        count = len(found.tets.tets)
    else:
        count = int(sizes.tets) if remade else estimates.tets_inside(found.surface, seen.length)
    facts["mesh_size"] = sizes.longest if remade else seen.length
    if found.tets is not None:
        facts["tet_quality"] = _quality(seen, found.tets)
    facts["expected"] = {
        "tets": count,
        "memory_mb": round(estimates.memory_mb(count)),
        "seconds": round(estimates.seconds(count), 1),
        "machine_mb": round(estimates.machine_mb()),
    }
    checks: tuple[Callable[[Examined], Finding], ...] = (
        *info_checks.OF_ALL,
        *(info_checks.OF_SURFACES if found.tets is None else info_checks.OF_TETS),
    )
    findings = [check(seen) for check in checks]
    return [*findings, info_checks.memory(seen, count)], facts


def _quality(seen: Examined, tets: TetDomain) -> dict[str, Any]:
    """radius_ratio: 3 inradius / circumradius, 1 for regular tets."""
    angles = seen.dihedral_angles
    ratio = radius_ratios(np.asarray(tets.vertices), np.asarray(tets.tets))
    return {
        "dihedral_min_deg": float(np.nanmin(angles)),
        "dihedral_max_deg": float(np.nanmax(angles)),
        "slivers": int((angles < 5).any(axis=1).sum()),
        "radius_ratio_min": float(ratio.min()),
        "radius_ratio_median": float(np.median(ratio)),
    }


def _counts(found: Input) -> dict[str, int]:
    counts = {"vertices": len(found.surface.vertices), "triangles": len(found.surface.triangles)}
    if found.tets is not None:
        counts |= {
            "vertices": len(found.tets.vertices),
            "tets": len(found.tets.tets),
            "boundary_vertices": len(found.surface.vertices),
            "regions": 1 if found.regions is None else len(np.unique(found.regions)),
            "interface_triangles": found.interface_triangles,
        }
    return counts


def _geometry(found: Input) -> dict[str, Any]:
    points = np.asarray(found.surface.vertices)
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        return {}
    low, high = finite.min(axis=0), finite.max(axis=0)
    return {"bounding_box": {"min": low.tolist(), "max": high.tolist(), "diagonal": float(np.linalg.norm(high - low))}}


def _topology(found: Input, failed: set[str]) -> dict[str, Any]:
    """Numbers that mean something only where the requirements they rest on are met."""
    facts: dict[str, Any] = {
        "area": float(np.asarray(_core.triangle_areas(found.surface)).sum()),
        "mean_edge_length": float(_core.mean_edge_length(found.surface)),
    }
    if not failed & {"closed", "triangles oriented alike"}:
        facts["volume"] = float(_core.signed_volume(found.surface))
    sound = {"no triangle of zero area", "triangles share vertices", "at most two triangles at an edge"}
    if not failed & (sound | {"triangles oriented alike"}) and not found.touches:
        facts["euler_characteristic"] = int(_core.euler_characteristic(found.surface))
    if found.lines is not None:
        facts["feature_lines"] = {
            "edges": len(found.lines),
            "not_on_boundary": found.ignored_lines,
            "used_by_default": found.lines_are_features(),
        }
    return facts
