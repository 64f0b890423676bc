"""The doctor for inputs: what was read, and which requirement it meets or fails, with the remedy."""

import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from . import _core
from .inputs import Input, read_input
from .meshing import TOUCHING, possible_remedy
from .options import MeshOptions
from .phases import octafield_version

PASS, FAIL, NOT_TESTED = "pass", "fail", "not tested"


@dataclass(frozen=True)
class Requirement:
    """kinds: defects (octafield.find_defects) that break it. needs: kinds without which it can be tested."""

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


def examine(path: str | Path, options: MeshOptions = MeshOptions()) -> dict:
    """Facts about a file and the state of each requirement: the JSON object of `octafield info`. Key "ok": all passed.

    options.repair: the surface is repaired first, the actions are in "notes". Raises IoError,
    InvalidInput, GeometryError when there is nothing to examine.
    """
    found = read_input(path)
    if options.repair and found.tets is None:
        repaired = _core.repair(found.surface)
        found.surface = repaired.mesh
        found.notes += [f"repair: {action}" for action in repaired.actions]
    lines_are_features = found.lines_are_features()
    if found.interface_triangles:
        found.surface = _core.boundary_surface(found.tets).mesh  # interfaces are sound where the tets are
    requirements = _requirements(found, options)
    record = {
        "input": found.name,
        "version": octafield_version(),
        "input_kind": found.kind,
        "ok": all(r["state"] == PASS for r in requirements),
        **_counts(found),
        **_geometry(found),
        "notes": found.notes,
        "requirements": requirements,
    }
    failed = {r["requirement"] for r in requirements if r["state"] != PASS}
    if not failed & {"has triangles", "vertex numbers in range", "finite coordinates"}:
        record |= _topology(found, options, failed, lines_are_features)
    return record


def first_failure(record: dict) -> str | None:
    """The message of the first requirement that failed."""
    return next((r["message"] for r in record["requirements"] if r["state"] == FAIL), None)


def _requirements(found: Input, options: MeshOptions) -> list[dict]:
    # Tets of positive volume rarely make a crossing boundary, and the pipeline does not ask for this test there.
    test_crossings = found.tets is None
    defects = {d.kind: d for d in _core.find_defects(found.surface, self_intersection=test_crossings)}
    if found.tets is not None:  # whose boundary may touch itself
        for kind in TOUCHING:
            if defects.pop(kind, None):
                found.touches = True
                found.notes.append(f"the boundary touches itself ({kind}); the field is computed all the same")
    listed = []
    for requirement in REQUIREMENTS:
        if requirement.kinds == ("self_intersection",) and not test_crossings:
            continue
        broken = [defects[kind] for kind in requirement.kinds if kind in defects]
        state = FAIL if broken else NOT_TESTED if any(kind in defects for kind in requirement.needs) else PASS
        listed.append(
            {
                "requirement": requirement.text,
                "state": state,
                "kind": broken[0].kind if broken else "",
                "message": possible_remedy(broken[0].message, found, options) if broken else "",
                "elements": [int(i) for d in broken for i in d.elements],
            }
        )
    return listed


def _counts(found: Input) -> dict:
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


def _geometry(found: Input) -> dict:
    points = np.asarray(found.surface.vertices)
    finite = points[np.isfinite(points).all(axis=1)]
    if not len(finite):
        return {}
    low, high = finite.min(axis=0), finite.max(axis=0)
    return {"bounding_box": {"min": low.tolist(), "max": high.tolist(), "diagonal": float(np.linalg.norm(high - low))}}


def _topology(found: Input, options: MeshOptions, failed: set[str], lines_are_features: bool) -> dict:
    """Numbers that mean something only where the requirements they rest on are met."""
    facts = {
        "area": float(np.asarray(_core.triangle_areas(found.surface)).sum()),
        "mean_edge_length": float(_core.mean_edge_length(found.surface)),
    }
    if not failed & {"closed", "triangles oriented alike"}:
        facts["volume"] = float(_core.signed_volume(found.surface))
    sound = {"no triangle of zero area", "triangles share vertices", "at most two triangles at an edge"}
    if not failed & (sound | {"triangles oriented alike"}) and not found.touches:
        facts["euler_characteristic"] = int(_core.euler_characteristic(found.surface))
        features = _core.detect_features(found.surface, angle=options.feature_angle)
        facts["features"] = {
            "angle_deg": math.degrees(options.feature_angle),
            "edges": len(features.edges),
            "corners": len(features.corners),
        }
    if found.lines is not None:
        facts["feature_lines"] = {
            "edges": len(found.lines),
            "not_on_boundary": found.ignored_lines,
            "used_by_default": lines_are_features,
        }
    return facts
