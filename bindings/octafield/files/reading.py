"""Bytes of a file in and out: packed or not, written whole or not at all, and numbers of text with the line of a
defect."""

import contextlib
import gzip
import io
import os
import tempfile
import warnings
import zlib
from collections.abc import Iterable, Iterator
from pathlib import Path

import numpy as np

from ..errors import Error, IoError
from .writing import require_utf8

_ROWS_AT_ONCE = 1 << 16
_PIECE = 1 << 20
_UNPACKED, _RATIO = 256 << 20, 100  # bytes; text of meshes packs to a tenth at best, a stream of zeros to a thousandth
_UNFIT = "unlike any mesh; if the file is sound, save it without packing"


def plain_name(path: str | Path) -> str:
    """The file's name in small letters without .gz."""
    return Path(path).name.lower().removesuffix(".gz")


def read_bytes(path: str | Path) -> bytes:
    """The content, unpacked. Raises IoError naming the file."""
    require_utf8(path)
    path = Path(path)
    if path.is_dir():
        raise IoError(f"{path}: is a folder; give a file")
    require_file(path)
    try:
        data = path.read_bytes()
        return _unpacked(data, path) if path.name.lower().endswith(".gz") or data.startswith(b"\x1f\x8b") else data
    except Error:
        raise
    except (gzip.BadGzipFile, EOFError, zlib.error) as error:
        raise IoError(f"{path}: damaged gzip file ({error}); unpack or download it again") from error
    except OSError as error:
        raise IoError(f"{path}: cannot be read ({error.strerror})") from error


def most_unpacked(size: int) -> int:
    """Bytes that so many bytes of a packed file may become: 256 MiB, or 100 times as many where that is more. No packed
    file fills the memory."""
    return max(_UNPACKED, _RATIO * size)


def _unpacked(data: bytes, path: Path) -> bytes:
    most, whole = most_unpacked(len(data)), io.BytesIO()
    with gzip.GzipFile(fileobj=io.BytesIO(data)) as packed:
        while piece := packed.read(_PIECE):
            if whole.tell() + len(piece) > most:
                raise IoError(f"{path}: {len(data):,} packed bytes become more than {most:,}: {_UNFIT}")
            whole.write(piece)
    return whole.getvalue()


def require_unpackable(name: str, announced: int, size: int) -> None:
    """For formats that announce how many bytes their packed parts become. size: of the file."""
    if announced > most_unpacked(size):
        raise IoError(
            f"{name}: {size:,} bytes announce {announced:,} unpacked, more than {most_unpacked(size):,}: {_UNFIT}"
        )


@contextlib.contextmanager
def reading(path: Path, kind: str) -> Iterator[None]:
    """Whatever a reader stumbles over becomes an IoError that names the file."""
    try:
        yield
    except Error:
        raise
    except Exception as error:
        reason = " ".join(str(error).split())[:300] or type(error).__name__
        raise IoError(f"{path}: cannot be read as {kind} ({reason})") from error


def require_file(path: Path) -> None:
    if not path.exists():
        raise IoError(f"{path}: no such file")
    if not path.is_file():
        raise IoError(f"{path}: is a pipe or a device; save it to a file first")


def read_text(path: str | Path) -> str:
    data = read_bytes(path)
    try:
        return data.decode("utf-8-sig")  # Windows programs begin with a mark
    except UnicodeDecodeError as error:
        line = data.count(b"\n", 0, error.start) + 1
        raise IoError(f"{path}, line {line}: no text (byte {error.start}); is it a binary file?") from error


def write_whole(path: str | Path, pieces: Iterable[bytes]) -> None:
    """Writes the pieces, packed where the name ends with .gz; the file appears only when complete."""
    write_all([(path, pieces)])


def write_all(files: Iterable[tuple[str | Path, Iterable[bytes]]]) -> None:
    """Writes files that belong together: they appear when all of them are complete. Links are followed."""
    staged: list[tuple[str, Path]] = []
    try:
        for path, pieces in files:
            staged.append(_stage(Path(path), pieces))
        while staged:
            os.replace(*staged[0])
            staged.pop(0)
    except OSError as error:
        if isinstance(error, IoError):
            raise
        raise IoError(f"{staged[0][1]}: cannot write there ({error.strerror})") from error
    finally:
        for staging, _ in staged:
            os.unlink(staging)


def _stage(path: Path, pieces: Iterable[bytes]) -> tuple[str, Path]:
    """A complete file beside the place wanted, and that place."""
    require_utf8(path)
    if path.is_dir():
        raise IoError(f"{path}: is a folder; give a file")
    if path.exists() and not path.is_file():
        raise IoError(f"{path}: is no regular file; give the name of a file")
    staging = None
    try:
        place = Path(os.path.realpath(path)) if path.is_symlink() else path
        place.parent.mkdir(parents=True, exist_ok=True)
        handle, staging = tempfile.mkstemp(prefix=f".{place.name}.", dir=place.parent)
        with os.fdopen(handle, "wb") as raw:
            if path.name.lower().endswith(".gz"):
                with gzip.GzipFile(
                    filename="", mode="wb", fileobj=raw, mtime=0
                ) as packed:  # no name, no time: equal bytes
                    packed.writelines(pieces)
            else:
                raw.writelines(pieces)
        umask = os.umask(0)
        os.umask(umask)
        os.chmod(staging, 0o666 & ~umask)
        return staging, place
    except BaseException as error:
        if staging is not None:
            os.unlink(staging)
        if isinstance(error, OSError) and not isinstance(error, IoError):
            raise IoError(f"{path}: cannot write there ({error.strerror})") from error
        raise


def head_of(text: str, count: int) -> tuple[list[str], str, int]:
    """The first `count` lines that are not blank, stripped; the text after them; the number of its first line."""
    lines: list[str] = []
    number = 1
    while len(lines) < count and text:
        line, _, text = text.partition("\n")
        number += 1
        if line.strip():
            lines.append(line.strip())
    return lines + [""] * (count - len(lines)), text, number


def rows_of(table: np.ndarray, prefix: str = "") -> Iterable[bytes]:
    """The rows as lines. Floats with the fewest digits (17 at most) that read back to the same bits."""
    table = np.asarray(table)
    form = repr if table.dtype.kind == "f" else str
    for start in range(0, len(table), _ROWS_AT_ONCE):
        lines = (prefix + " ".join(map(form, row)) for row in table[start : start + _ROWS_AT_ONCE].tolist())
        yield ("\n".join(lines) + "\n").encode()


def numbers_of(text: str, name: str, first_line: int = 1) -> np.ndarray:
    """All numbers of a text; IoError with the line of the first word that is none. first_line: number of its first."""
    try:
        return parsed_numbers(text)
    except ValueError:
        pass
    for offset, line in enumerate(text.split("\n")):
        for word in line.split():
            try:
                float(word)
                continue
            except ValueError:
                raise IoError(f"{name}, line {first_line + offset}: no number: {word[:40]!r}") from None
    raise IoError(f"{name}, line {first_line}: numbers separated by blanks are needed")


def parsed_numbers(text: str) -> np.ndarray:
    """All numbers of a text; ValueError where a word is none. Before NumPy 2.3 that was a warning, and what followed
    was lost."""
    if not text.strip():
        return np.empty(0)
    with warnings.catch_warnings():
        warnings.simplefilter("error", DeprecationWarning)
        try:
            return np.fromstring(text, sep=" ")
        except DeprecationWarning as error:
            raise ValueError(str(error)) from error


def table_of(text: str, name: str, width: int, first_line: int = 1) -> tuple[np.ndarray, np.ndarray]:
    """Rows of `width` numbers, one per line, blank lines left out, and the line of each; else IoError with the line."""
    counts = words_per_line(text)
    filled = np.flatnonzero(counts)
    wrong = filled[counts[filled] != width]
    if len(wrong):
        numbers_of(text.split("\n")[wrong[0]], name, first_line + int(wrong[0]))
        raise IoError(
            f"{name}, line {first_line + wrong[0]}: {counts[wrong[0]]} numbers; {width} are needed on every line"
        )
    return numbers_of(text, name, first_line).reshape(-1, width), first_line + filled


def words_per_line(text: str) -> np.ndarray:
    """How many words each line has."""
    data = np.frombuffer((text + "\n").encode(), np.uint8)
    blank = data <= 32
    begins = ~blank & np.concatenate([[True], blank[:-1]])
    ends = np.flatnonzero(data == 10)
    before = np.searchsorted(np.flatnonzero(begins), ends)
    return np.diff(before, prepend=0)


def place_in(data: bytes, at: int) -> str:
    """Bytes where the file is binary."""
    return f"byte {at}" if b"\0" in data else f"line {data.count(10, 0, max(at - 1, 0)) + 1}"
