"""The exceptions of octafield. The compiled module raises these very classes."""

from collections.abc import Iterable

__all__ = ["Cancelled", "Error", "GeometryError", "InvalidInput", "IoError", "SolverError"]


class Error(Exception):
    """Base class of all errors of octafield: what was wrong, where, and what to do.

    kind is a short stable word for the defect (for example "not_closed"), elements the 0-based ids of the elements
    concerned, of whatever sort the message names. Both may be empty.
    """

    kind: str
    elements: list[int]

    def __init__(self, message: str = "", kind: str = "", elements: Iterable[int] = ()) -> None:
        super().__init__(message)
        self.kind = kind
        self.elements = list(elements)


class InvalidInput(Error, ValueError):
    """The caller's argument or option is unusable."""


class GeometryError(Error):
    """The geometry handed in is unsound, or a mesher could not fill it."""


class SolverError(Error):
    """A numerical method broke down."""


class IoError(Error, OSError):
    """A file could not be read or written."""


class Cancelled(Error):
    """A progress callback asked to stop."""


for _class in (Error, InvalidInput, GeometryError, SolverError, IoError, Cancelled):
    _class.__module__ = "octafield"
