"""Schemes of one's own: what smoothing minimises, as functions on arrays of frames, without C++.

    import numpy as np
    import octafield
    from octafield.volume import EmbeddingScheme

    def squares(frames):  # (k, 4) quaternions w x y z -> (k, 81): the sum of the axes' fourth powers
        axes = octafield.frames.rotation_matrices(frames)  # (k, 3, 3), in columns
        tensor = np.einsum("kia,kja,kla,kma->kijlm", axes, axes, axes, axes)
        return tensor.reshape(len(frames), -1)

    scheme = EmbeddingScheme("squares", squares)
    result = octafield.compute_field("part.stl", octafield.FieldOptions(representation=scheme))

On the command line and in the file of a study a scheme is FILE.py:NAME, the file that makes it and its name there.
"""

import contextlib
import functools
import hashlib
import importlib.util
import re
import sys
from collections.abc import Callable
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from . import _core
from .errors import InvalidInput, IoError

Frames = NDArray[np.float64]  # (k, 4) unit quaternions w x y z
_IN_FILE = re.compile(r"(?P<path>.+\.py):(?P<name>[A-Za-z_]\w*)")
_NAME = re.compile(r"[A-Za-z][\w.+-]{0,63}")
_COLOUR = re.compile(r"#[0-9a-fA-F]{6}")


@dataclass(frozen=True, repr=False)
class _Described:
    """What both kinds share."""

    name: str
    dimension: int = field(init=False, repr=False, compare=False)

    def __repr__(self) -> str:
        equation = getattr(self, "equation", "")
        told = f": {equation}" if equation else ""
        return f"{type(self).__name__}({self.name}, {self.dimension} numbers{told})"

    def _check(self, function: object, what: str, *frames: Frames) -> None:
        if not isinstance(self.name, str) or not _NAME.fullmatch(self.name):
            raise InvalidInput(
                "a scheme's name begins with a letter and has letters, digits and _ . + - only, 64 at most (folders of"
                f" runs are named after it), not {self.name!r:.100}",
                "bad_scheme",
            )
        if self.name in _core.schemes:
            raise InvalidInput(f"{self.name!r} is a scheme of octafield's; choose another name", "bad_scheme")
        if not callable(function):
            raise InvalidInput(f"scheme {self.name!r}: {what} must be a function, not {function!r}", "bad_scheme")
        answer = function(*frames)
        try:
            shape = np.shape(answer)
        except ValueError as error:
            raise InvalidInput(
                f"scheme {self.name!r}: {what} gave no array of numbers ({error})", "bad_scheme"
            ) from error
        if len(shape) != 2 or shape[0] != len(frames[0]) or shape[1] < 1:
            raise InvalidInput(
                f"scheme {self.name!r}: {what} gave an array of shape {shape} for {len(frames[0])} rows of quaternions;"
                f" ({len(frames[0])}, d) is wanted, a row for each",
                "bad_scheme",
            )
        object.__setattr__(self, "dimension", shape[1])

    def _check_rest(self, differential: object, colour: str) -> None:
        if differential is not None and not callable(differential):
            raise InvalidInput(
                f"scheme {self.name!r}: differential must be a function, or None for differences, not {differential!r}",
                "bad_scheme",
            )
        if colour and not _COLOUR.fullmatch(colour):
            raise InvalidInput(f"scheme {self.name!r}: colour must be #rrggbb, not {colour!r}", "bad_scheme")


@dataclass(frozen=True, repr=False)
class EmbeddingScheme(_Described):
    """Frames as vectors a = embed(frame), with the Dirichlet energy 1/2 sum over components c of a_c^T L a_c.

    name: in records and reports. embed: (k, 4) unit quaternions w x y z -> (k, d), for any k; the 24 quaternions (and
    their negatives) of one frame must give one vector: octafield.laws.EmbeddingLaws tests it. differential: (k, 4) ->
    (k, d, 3), derivatives of embed(exp(w) q) by the world rotation vector w at w = 0; none: central differences.
    equation, meaning: one line and one clause for reports. colour: in plots, "#rrggbb".

    Smoothing takes the trust region (Palmer, Bommes, Solomon 2020, section 5) with the exact Hessian; embed is called
    some twenty times a step on all frames. Raises InvalidInput.

        >>> import octafield
        >>> from octafield.volume import EmbeddingScheme
        >>> fourth = octafield.frames.representations["sh4"].embed
        >>> EmbeddingScheme("mine", lambda frames: 2 * fourth(frames)).dimension
        9
    """

    embed: Callable[[Frames], Any]
    differential: Callable[[Frames], Any] | None = None
    equation: str = ""
    meaning: str = ""
    colour: str = ""

    def __post_init__(self) -> None:
        self._check(self.embed, "embed", _core.random_rotations(3, 1))
        self._check_rest(self.differential, self.colour)


@dataclass(frozen=True, repr=False)
class EdgeScheme(_Described):
    """A difference of frames for each edge: minimised is 1/2 sum over edges ij of w_ij |r_ij|^2, w_ij = -L_ij;
    where these are negative, whole tets with residuals from their first vertex.

    name: in records and reports. residual: two arrays (k, 4) of unit quaternions w x y z, row by row the frames at the
    ends of an edge -> (k, d); it must vanish for the same frame, whichever of its quaternions, and be as long from j to
    i as from i to j: octafield.laws.EdgeLaws tests it. differential: the same arguments -> two arrays (k, d, 3),
    derivatives by the world rotation vectors of the first and of the second; none: central differences. equation,
    meaning: one line and one clause for reports. colour: in plots, "#rrggbb".

    Smoothing takes the trust region with steps of Gauss and Newton; residual is called some twenty times a step on all
    edges. Raises InvalidInput.

        >>> import octafield
        >>> from octafield.volume import EdgeScheme
        >>> EdgeScheme("turns", octafield.frames.frame_log).dimension
        3
    """

    residual: Callable[[Frames, Frames], Any]
    differential: Callable[[Frames, Frames], Any] | None = None
    equation: str = ""
    meaning: str = ""
    colour: str = ""

    def __post_init__(self) -> None:
        frames = _core.random_rotations(6, 1)
        self._check(self.residual, "residual", frames[:3], frames[3:])
        self._check_rest(self.differential, self.colour)


OwnScheme = EmbeddingScheme | EdgeScheme


def is_in_file(word: object) -> bool:
    """Whether a representation is named as FILE.py:NAME."""
    return isinstance(word, str) and _IN_FILE.fullmatch(word) is not None


def minimised(representation: "str | OwnScheme") -> "str | OwnScheme":
    """A key of octafield.volume.schemes as it is, FILE.py:NAME as the scheme that it is. Raises IoError,
    InvalidInput."""
    if not isinstance(representation, str) or not is_in_file(representation):
        return representation
    found = loaded(representation)
    if not isinstance(found, OwnScheme):
        raise InvalidInput(f"{representation} is no EmbeddingScheme or EdgeScheme but {found!r}", "bad_scheme")
    return found


def loaded(word: str) -> Any:
    """What FILE.py:NAME names; the file is run once, and again when it has changed. Raises IoError, InvalidInput."""
    path, _, name = word.rpartition(":")
    names = _run(str(Path(path).absolute()), digest_of(word))
    if name not in names:
        there = [key for key, value in names.items() if isinstance(value, OwnScheme)]
        raise InvalidInput(
            f"{path}: no {name!r} in this file; schemes in it: {', '.join(there) or 'none'}", "bad_scheme"
        )
    return names[name]


def name_of(representation: "str | OwnScheme") -> str:
    """In records, reports and names of folders."""
    found = minimised(representation)
    return found if isinstance(found, str) else found.name


def digest_of(word: str) -> str:
    """SHA-256 of the file of FILE.py:NAME. Raises IoError."""
    path = word.rpartition(":")[0]
    try:
        return hashlib.sha256(Path(path).read_bytes()).hexdigest()
    except OSError as error:
        raise IoError(f"{path}: cannot read the scheme ({error.strerror})") from error


def in_folder(representation: Any, folder: Path) -> Any:
    """FILE.py:NAME with the file relative to that folder; anything else as it is."""
    if not is_in_file(representation):
        return representation
    path, _, name = representation.rpartition(":")
    return f"{(folder / path).absolute()}:{name}"


@functools.lru_cache(maxsize=32)
def _run(path: str, digest: str) -> dict[str, Any]:
    module_name = f"octafield_scheme_{digest[:16]}"
    specification = importlib.util.spec_from_file_location(module_name, path)
    assert specification is not None and specification.loader is not None
    module = importlib.util.module_from_spec(specification)
    sys.modules[module_name] = module  # dataclasses and pickle look there
    try:
        with contextlib.redirect_stdout(sys.stderr):  # standard output is the document of --json
            specification.loader.exec_module(module)
    except (Exception, SystemExit) as error:  # sys.exit() would end a command as if it were done
        del sys.modules[module_name]
        told = f"{path}{_line_in(error, path)}: the file fails: {type(error).__name__}: {error}{_beside(error, path)}"
        raise InvalidInput(told, "bad_scheme") from error
    return vars(module)


def _beside(error: BaseException, path: str) -> str:
    """The remedy where a module was not found that lies in the folder of the file: the digest would not know it."""
    name = error.name if isinstance(error, ModuleNotFoundError) else None
    if not name or not Path(path).with_name(f"{name}.py").is_file():
        return ""
    return f"; a file of schemes stands alone (runs are done again when it changes): put what it needs of {name}.py in"


def _line_in(error: BaseException, path: str) -> str:
    """ ":12" where the traceback passes through the file, the innermost line of it."""
    trace, line = error.__traceback__, getattr(error, "lineno", None)
    while trace is not None:
        if trace.tb_frame.f_code.co_filename == path:
            line = trace.tb_lineno
        trace = trace.tb_next
    return f":{line}" if line else ""
