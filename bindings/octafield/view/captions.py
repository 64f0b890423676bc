"""Captions of pictures: facts from the data, as sentences."""

from __future__ import annotations

from fractions import Fraction
from typing import TYPE_CHECKING

from .._core import SurfaceSingularities

if TYPE_CHECKING:
    from ..records.field import FieldRecord
    from ..records.parts import StreamlineCounts


def counted(count: int, singular: str, plural: str = "") -> str:
    """ "1 node", "2 nodes". plural: where it is not with an s."""
    return f"{count:,} {singular if count == 1 else plural or singular + 's'}"


def of_surface(found: SurfaceSingularities) -> str:
    """How many singular points of which index the cross field has."""
    indices = [Fraction(float(s.index)).limit_denominator(1000) for s in found.points]
    total, chi = sum(indices, Fraction(0)), found.euler_characteristic
    counts = ", ".join(f"{indices.count(i)} of index {_signed(i)}" for i in sorted(set(indices), reverse=True))
    points = f"{counted(len(indices), 'singular point')} ({counts})" if indices else "no singular points"
    relation = "is the" if total == chi else "is not the"
    sums = f"the sum of indices, {_signed(total)}, {relation} Euler characteristic {_signed(Fraction(chi))}"
    return f"The cross field has {points}; {sums}." + (" Points on the far side are hidden." if indices else "")


def of_curves(record: FieldRecord) -> str:
    """What the singular graph consists of."""
    kinds = record.singular_edges_by_turns
    names = {f"{turns:+d}": f"valence {4 - turns}" for turns in range(-4, 4)} | {"complex": "complex"}
    parts = ", ".join(f"{count} {names.get(kind, f'{kind} quarter turns')}" for kind, count in kinds.items())
    if not parts:
        return "The field has no singular edges."
    what = f"{counted(record.singular_edges, 'singular edge')} ({parts})"
    curves = f"{counted(record.singular_curves, 'curve')} of total length {record.singular_length:.4g}"
    ends = counted(record.singular_nodes, "node")
    if record.singular_boundary_ends is not None:  # not of older records of frames in tets
        ends += f" and {counted(record.singular_boundary_ends, 'end')} on the surface"
    bad = _not_meshable(record)
    return f"The field has {what} in {curves}, with {ends}." + (f" At {bad} it is unlike any hex mesh." if bad else "")


def _not_meshable(record: FieldRecord) -> str:
    counts = (
        (record.non_meshable_vertices, "place"),
        (record.non_meshable_feature_edges, "feature edge"),
        (record.non_meshable_corners, "corner"),
    )
    parts = [counted(count, word) for count, word in counts if count]
    return " and ".join(filter(None, [", ".join(parts[:-1]), *parts[-1:]]))


def of_streamlines(found: StreamlineCounts) -> str:
    """Where streamlines end."""
    names = {"singular": "at singular curves", "boundary": "on the surface", "closed": "of closed curves",
             "length": "at the greatest length", "stuck": "stuck", "seed": "at seeds"}  # fmt: skip
    ends = ", ".join(f"{count:,} {names[name]}" for name, count in found.ends.items())
    return (
        f"The picture shows {counted(found.curves, 'curve')} along the axes from evenly spread seeds; of their ends"
        f" there are {ends}."
    )


def _signed(value: Fraction) -> str:
    text = str(abs(value))
    return f"\N{MINUS SIGN}{text}" if value < 0 else f"+{text}" if value.denominator > 1 else text
