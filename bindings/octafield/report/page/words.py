"""Words of a report's prose: counts, lists and ranges that are right for one, two and many; HTML-safe."""

import html
from collections.abc import Iterable, Mapping

from ...view.captions import counted
from ..numbers.records import Method, Setting

__all__ = ["counted", "every", "listed", "named", "sentence", "spread", "with_boundary"]


def every(count: int, singular: str) -> str:
    """ "both methods", "all 3 methods"; of two or more."""
    return f"both {singular}s" if count == 2 else f"all {count:,} {singular}s"


def listed(words: Iterable[str], conjunction: str = "and") -> str:
    """ "a", "a and b", "a, b and c"."""
    words = list(words)
    if len(words) < 2:
        return "".join(words)
    return f"{', '.join(words[:-1])} {conjunction} {words[-1]}"


def named(methods: Iterable[Method], most: int = 0) -> str:
    """Names of methods. most: so many, then how many more (0: all)."""
    names = [html.escape(method.name) for method in methods]
    if most and len(names) > most + 1:
        names = [*names[:most], f"{len(names) - most} more"]
    return listed(names)


def with_boundary(setting: Setting) -> str:
    """ "with the boundary fixed", "with a free boundary"."""
    head = {
        "fixed": "with the boundary fixed",
        "aligned": "with the boundary aligned",
        "none": "without boundary constraints",
    }
    more = f" ({html.escape(setting.more)})" if setting.more else ""
    return head.get(setting.boundary, f"with boundary {html.escape(setting.boundary)}") + more


def spread(values: Mapping[Method, float], form: str, *, same: float = 0.0, unit: str = "") -> str:
    """ "12 (a and b) to 17 (c)"; "12" where all are the same up to a factor of 1 + same."""
    low, high = min(values.values()), max(values.values())
    if high <= low * (1 + same):
        return f"{low:{form}}{unit}"
    ends = [
        f"{end:{form}}{unit} ({named([m for m, v in values.items() if abs(v - end) <= same * abs(end)], 3)})"
        for end in (low, high)
    ]
    return f"{ends[0]} to {ends[1]}"


def sentence(text: str) -> str:
    """With a capital and a full stop."""
    text = text[:1].upper() + text[1:]
    return text if text.endswith((".", "?")) else text + "."
