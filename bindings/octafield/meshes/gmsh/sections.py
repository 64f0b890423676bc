"""The sections of Gmsh's .msh files, and numbers from them, in text and binary; errors with their line or byte."""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from ...errors import IoError
from ...files.reading import numbers_of, place_in, words_per_line

CUT = ": the file is cut or damaged; write or download it again"


@dataclass
class Section:
    """What stands between $Name and $EndName; reads forward. at: byte. order: of bytes; "" in text."""

    name: str
    data: bytes
    at: int
    end: int
    order: str
    file: str
    taken: int = 0

    @cached_property
    def _numbers(self) -> np.ndarray:
        self.first_line = self.data.count(10, 0, self.at) + 1
        self.text = self.data[self.at : self.end].decode("utf-8", "replace")
        return numbers_of(self.text, self.file, self.first_line)

    def place(self) -> str:
        """Of the next number, or of the last one read where there is none."""
        if self.order or "_numbers" not in vars(self):
            return f"{self.file}, " + (
                f"byte {self.at}" if self.order else f"line {self.data.count(10, 0, self.at) + 1}"
            )
        ends = np.cumsum(words_per_line(self.text))
        return (
            f"{self.file}, line"
            f" {self.first_line + int(np.searchsorted(ends, min(self.taken, ends[-1] - 1), side='right'))}"
        )

    def line(self) -> str:
        """The next that is not blank."""
        line = b""
        while not line.strip() and self.at < self.end:
            stop = self.data.find(b"\n", self.at, self.end)
            start, self.at = self.at, self.end if stop < 0 else stop + 1
            line = self.data[start : self.at]
        return line.decode("utf-8", "replace").strip()

    def count(self, what: str) -> int:
        """From a line of text."""
        place, line = self.place(), self.line()
        if not re.fullmatch(r"\d{1,15}", line):
            raise IoError(f"{place}: ${self.name}: the number of {what} is needed, not {line[:40]!r}")
        return int(line)

    def take(self, kind: str, count: int) -> np.ndarray:
        """kind: of the number in binary files."""
        if self.order:
            dtype = np.dtype(self.order + kind)
            if count > (self.end - self.at) // dtype.itemsize:
                raise IoError(
                    f"{self.place()}: ${self.name} ends early: {count} numbers of {dtype.itemsize} bytes are needed,"
                    f" {self.end - self.at} bytes are left"
                )
            self.at += count * dtype.itemsize
            return np.frombuffer(self.data, dtype, count, self.at - count * dtype.itemsize)
        numbers = self._numbers
        if count > len(numbers) - self.taken:
            raise IoError(
                f"{self.place()}: ${self.name} ends early: {count} numbers are needed, {len(numbers) - self.taken} are"
                " left"
            )
        self.taken += count
        result = numbers[self.taken - count : self.taken]
        return result if kind == "f8" else self._whole(result, count)

    def _whole(self, numbers: np.ndarray, count: int) -> np.ndarray:
        bad = np.flatnonzero(~((numbers == np.floor(numbers)) & (np.abs(numbers) < 2**53)))
        if len(bad):
            self.taken += int(bad[0]) - count
            raise IoError(f"{self.place()}: ${self.name} holds a number that is no id")
        return numbers.astype(np.int64)

    def size(self, kind: str, what: str) -> int:
        place, value = self.place(), int(self.take(kind, 1)[0])
        if not 0 <= value < 2**53:
            raise IoError(f"{place}: ${self.name}: the number of {what} is {value}")
        return value


def sections(data: bytes, name: str) -> Iterator[Section]:
    if not data.startswith((b"$MeshFormat", b"$Comments")):
        raise IoError(f"{name}, line 1: a Gmsh .msh file begins with $MeshFormat")
    opened, begin, end = None, 0, 0
    for found in re.finditer(rb"^\$(End)?([A-Z][A-Za-z]{3,})[ \t]*\r?$", data, re.MULTILINE):
        end, closing, section = found.end(), bool(found[1]), found[2].decode()
        if closing and section != opened:
            raise IoError(
                f"{name}, {place_in(data, end)}: $End{section} closes {f'${opened}' if opened else 'nothing'}{CUT}"
            )
        if opened and not closing:
            raise IoError(f"{name}, {place_in(data, end)}: ${section} begins before $End{opened}{CUT}")
        if closing and section != "Comments":
            yield Section(section, data, begin, found.start(), "", name)
        opened, begin = (None if closing else section), end + 1
    if opened or data[end:].strip():
        raise IoError(
            f"{name}, {place_in(data, len(data))}: ends"
            f" {f'before $End{opened}' if opened else 'within the head of a section'}{CUT}"
        )


def version_of(head: Section) -> float:
    """Sets the order of bytes of binary files."""
    place, words = head.place(), head.line().split()
    if (
        head.name != "MeshFormat"
        or len(words) != 3
        or words[1] not in ("0", "1")
        or not re.fullmatch(r"\d(\.\d)?", words[0])
    ):
        raise IoError(f"{place}: $MeshFormat holds a version, 0 or 1 and a size; not {' '.join(words)[:40]!r}")
    version = float(words[0])
    if not (2 <= version < 3 or version == 4.1) or words[2] != "8":
        raise IoError(
            f"{place}: version {words[0]} with numbers of {words[2][:9]} bytes; 2, 2.2 and 4.1 with 8 are read: write"
            " it with Gmsh -format msh41"
        )
    if words[1] == "1":
        one = head.data[head.at : head.at + 4]
        head.order = {b"\1\0\0\0": "<", b"\0\0\0\1": ">"}.get(one, "")
        if not head.order:
            raise IoError(
                f"{head.file}, byte {head.at}: the number 1 in binary is needed after the version, not {one.hex(' ')}"
            )
    return version
