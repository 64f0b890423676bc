"""Text without a mesh: ARFF, mouette, geogram, AlgoHex .qtn and MetricDrivenFrame3D. Layouts: docs/formats.md."""

from pathlib import Path

import numpy as np

from ..domain.rotations import axes_in_rows
from ..errors import IoError
from ..files.reading import head_of, numbers_of, read_text, rows_of, table_of, words_per_line, write_whole
from .base import Field, FrameFile, from_axes, from_quaternions


def columns_of(rows: np.ndarray) -> np.ndarray:
    """(n, 3, 3) axes in columns of (n, 9) rows with one axis after the other."""
    return np.swapaxes(rows.reshape(-1, 3, 3), 1, 2)


def read_arff(path: Path) -> FrameFile:
    rows, lines = table_of(read_text(path), str(path), 9)
    return from_axes(path, "arff", "vertices", columns_of(rows), lines)


def write_arff(path: Path, field: Field) -> None:
    write_whole(path, rows_of(axes_in_rows(field.frames, field.lengths)))


def read_mouette(path: Path) -> FrameFile:
    (head, number), body, first = head_of(read_text(path), 2)
    if head != "FRAME":
        raise IoError(f"{path}, line 1: FRAME is needed, not {head[:40]!r}")
    count = count_in(number, f"{path}, line 2", "frames")
    ending = body.rstrip()
    closed = ending.endswith("END")
    if closed:
        body = ending[:-3]
    rows, lines = table_of(body, str(path), 9, first_line=first)
    require_count(len(rows), count, path, first + body.rstrip().count("\n"), "frames")
    result = from_axes(path, "mouette", "tets", columns_of(rows), lines)
    if not closed:
        result.notes.append("the file does not end with END: its last number may be cut")
    return result


def write_mouette(path: Path, field: Field) -> None:
    rows = axes_in_rows(field.frames)
    write_whole(path, [f"FRAME\n{len(rows)}\n".encode(), *rows_of(rows), b"END\n"])


def read_geogram(path: Path) -> FrameFile:
    rows, lines = table_of(read_text(path), str(path), 3)
    if len(rows) % 3:
        raise IoError(f"{path}, line {lines[-1]}: ends after {len(rows)} axes; a frame has 3")
    return from_axes(path, "geogram", "tets", columns_of(rows.reshape(-1, 9)), lines[::3])


def write_geogram(path: Path, field: Field) -> None:
    write_whole(path, rows_of(axes_in_rows(field.frames).reshape(-1, 3)))


def read_geogram_centres(path: Path) -> FrameFile:
    rows, lines = table_of(read_text(path), str(path), 12)
    bad = np.flatnonzero(~np.isfinite(rows[:, :3]).all(axis=1))
    if len(bad):
        raise IoError(f"{path}, line {lines[bad[0]]}: the centre is not finite")
    result = from_axes(path, "geogram-centres", "tets", columns_of(rows[:, 3:]), lines)
    result.centres = rows[:, :3]
    return result


def write_geogram_centres(path: Path, field: Field) -> None:
    write_whole(path, rows_of(np.hstack([field.sites(), axes_in_rows(field.frames)])))


def read_qtn(path: Path) -> FrameFile:
    text = read_text(path)
    numbers = numbers_of(text, str(path))
    if len(numbers) % 4:
        last = 1 + text.rstrip().count("\n")
        raise IoError(f"{path}, line {last}: holds {len(numbers)} numbers; a quaternion has 4")
    per_line = words_per_line(text)
    line_of_number = np.repeat(np.arange(1, len(per_line) + 1), per_line)
    return from_quaternions(path, "qtn", "tets", numbers, line_of_number[::4])


def write_qtn(path: Path, field: Field) -> None:
    """One frame per line: readers take any blanks."""
    write_whole(path, rows_of(field.frames))


def read_ff3(path: Path) -> FrameFile:
    (head,), body, first = head_of(read_text(path), 1)
    words = head.split()
    if len(words) != 2 or words[0] != "9":
        raise IoError(
            f"{path}, line 1: '9 N' is needed (ASCII .ff3), not {head[:40]!r}; convert binary files with prog=mat_b2a"
        )
    count = count_in(words[1], f"{path}, line 1", "frames")
    rows, lines = table_of(body, str(path), 9, first_line=first)
    require_count(len(rows), count, path, first + body.rstrip().count("\n"), "frames")
    return from_axes(path, "ff3", "tets", columns_of(rows), lines)


def write_ff3(path: Path, field: Field) -> None:
    rows = axes_in_rows(field.frames, field.lengths)
    write_whole(path, [f"9 {len(rows)}\n".encode(), *rows_of(rows)])


def count_in(word: str, place: str, what: str) -> int:
    try:
        count = int(word)
    except ValueError:
        count = -1
    if count < 0:
        raise IoError(f"{place}: the number of {what} is needed, not {word.strip()[:40]!r}")
    return count


def require_count(have: int, count: int, path: Path, line: int, what: str) -> None:
    if have != count:
        raise IoError(f"{path}, line {line}: holds {have} {what}, but its head says {count}")


def read_txt(path: Path) -> FrameFile:
    """Text whose first line tells what it is: 3 numbers (geogram), 12 (geogram with centres), else 9 (ARFF)."""
    first = next((line.split() for line in read_text(path).lstrip()[:10000].splitlines()), [])
    return {3: read_geogram, 12: read_geogram_centres}.get(len(first), read_arff)(path)
