"""What all records have in common: named, checked, unchangeable values, also a mapping in the order of the file.

record.energy is what code says; record["energy"], `in`, items() are for what walks over a record, tables for one. What
a record may be without is None as an attribute then, and absent from the mapping and the file.
"""

from __future__ import annotations

import functools
from collections.abc import Iterator, Mapping
from typing import Any, ClassVar, Self

from pydantic import BaseModel, ConfigDict


class Record(BaseModel, Mapping[str, Any]):
    """A JSON object. Keys it has no name for, of another version, are kept and come last.

    FIRST, LAST: names that are written before and after the others, which are written in the order of the class. A
    class need not have all of LAST."""

    model_config = ConfigDict(extra="allow", frozen=True)
    FIRST: ClassVar[tuple[str, ...]] = ()
    LAST: ClassVar[tuple[str, ...]] = ()

    @classmethod
    @functools.cache
    def order(cls) -> dict[str, bool]:
        """All names in the order they are written, and which of them every record has."""
        ends = {*cls.FIRST, *cls.LAST}
        last = (name for name in cls.LAST if name in cls.model_fields)
        names = (*cls.FIRST, *(name for name in cls.model_fields if name not in ends), *last)
        return {name: cls.model_fields[name].is_required() for name in names}

    def __iter__(self) -> Iterator[str]:  # type: ignore[override]
        there = vars(self)
        yield from (name for name, always in self.order().items() if always or there[name] is not None)
        yield from self.model_extra or ()

    def __len__(self) -> int:
        return sum(1 for _ in self)

    def __getitem__(self, name: str) -> Any:
        known = vars(self) if name in self.order() else self.model_extra or {}
        value = known[name]
        if value is None and self.order().get(name) is False:
            raise KeyError(name)
        return value

    def __eq__(self, other: object) -> bool:
        return dict(self) == dict(other) if isinstance(other, Mapping) else NotImplemented

    def changed(self, **values: Any) -> Self:
        """The record with other values."""
        return type(self)(**{**self, **values})

    def to_dict(self) -> dict[str, Any]:
        """Plain dictionaries and lists, for json.dumps."""
        return {name: _plain(value) for name, value in self.items()}


def _plain(value: Any) -> Any:
    if isinstance(value, Mapping):
        return {name: _plain(inner) for name, inner in value.items()}
    return [_plain(inner) for inner in value] if isinstance(value, list) else value
