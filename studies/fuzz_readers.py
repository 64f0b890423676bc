"""Damaged files of every kind to every reader: only octafield's errors, in bounded time and memory, no signal.

    .venv/bin/python studies/fuzz_readers.py --files 200000 --seed 1 -o out/fuzz

Seeds are small files by octafield's own writers; each is altered in counts, digits, bytes, its length, or the order of
its lines. A worker process reads them under limits of memory and time; what it was reading when it died, or what raised
another error, is kept in the folder. The same seed gives the same files; a run that was cut short goes on with --first,
the number in scratch/now.
"""

import argparse
import faulthandler
import os
import re
import resource
import signal
import sys
import time
import traceback
import warnings
from pathlib import Path

import numpy as np
import octafield as of
from octafield import frame_formats, read_frames, write_frames
from octafield.domain.inputs import read_input
from octafield.meshes.registry import written_suffixes
from octafield.runs.conversion import convert_file

MEMORY, SECONDS, CHUNK = 3 << 30, 20, 2000
BESIDE = (".node", ".ele", ".face", ".edge")
NUMBER = re.compile(rb"(?<![\w.])\d+(?![\w.])")
COUNTS = (
    b"0",
    b"1",
    b"-1",
    b"2147483647",
    b"2147483648",
    b"4294967295",
    b"4294967296",
    b"9223372036854775807",
    b"9223372036854775808",
    b"1000000000",
    b"1e300",
    b"nan",
    b"1e9",
)
INTEGERS = (0, 1, -1, 2**31 - 1, -(2**31), 10**9, 2**63 - 1, -(2**63), 2**32, 7, 10**18)


def seeds(folder: Path) -> dict[str, Path]:
    """A sound file of every kind of mesh and of frames."""
    mesh = _cube()
    count = {"vertices": len(mesh.vertices), "tets": len(mesh.tets)}
    write_frames(folder / "source.npz", mesh, np.tile([1.0, 0, 0, 0], (count["vertices"], 1)))
    found = {}
    write_frames(folder / "source.msh", mesh, np.tile([1.0, 0, 0, 0], (count["tets"], 1)), "tets")
    for suffix in written_suffixes():
        found[suffix] = folder / f"mesh{suffix}"
        convert_file(folder / "source.msh", found[suffix])
    for name, form in frame_formats.items():
        if form.read and form.write:
            found[f"frames {name}"] = folder / f"frames_{name}{(*form.extensions, '.txt')[0]}"
            write_frames(
                found[f"frames {name}"], mesh, np.tile([1.0, 0, 0, 0], (count[form.where[0]], 1)), form.where[0], name
            )
    return found


def _cube() -> of.TetMesh:
    points = np.array([[i & 1, i >> 1 & 1, i >> 2 & 1] for i in range(8)], float)
    return of.TetMesh(
        points, np.array([[0, 1, 3, 7], [0, 3, 2, 7], [0, 2, 6, 7], [0, 6, 4, 7], [0, 4, 5, 7], [0, 5, 1, 7]], np.int32)
    )


def altered(content: bytes, others: list[bytes], rng: np.random.Generator) -> bytes:
    data = bytearray(content)
    for _ in range(int(rng.integers(1, 4))):
        if not data:
            break
        at = int(rng.integers(0, len(data)))
        match int(rng.integers(0, 9)):
            case 0 | 1 | 2:  # a number of the text, those at the beginning of the file more often
                numbers = list(NUMBER.finditer(bytes(data)))
                if numbers:
                    hit = numbers[int(len(numbers) * rng.random() ** 2)]
                    data[hit.start() : hit.end()] = COUNTS[int(rng.integers(0, len(COUNTS)))]
            case 3:
                size = int(rng.choice([1, 2, 4, 8]))
                value = INTEGERS[int(rng.integers(0, len(INTEGERS)))] & ((1 << (8 * size)) - 1)
                data[at : at + size] = value.to_bytes(size, "little" if rng.random() < 0.7 else "big")
            case 4:
                data[at] ^= 1 << int(rng.integers(0, 8))
            case 5:
                del data[at:]
            case 6:
                del data[at : at + int(rng.integers(1, 60))]
            case 7:
                other = others[int(rng.integers(0, len(others)))]
                start = int(rng.integers(0, len(other)))
                data[at : at + int(rng.integers(0, 60))] = other[start : start + int(rng.integers(1, 200))]
            case _:
                lines = bytes(data).split(b"\n")
                i, j = rng.integers(0, len(lines), 2)
                lines[i], lines[j] = lines[j], lines[i]
                data = bytearray(b"\n".join(lines))
    return bytes(data)


def read(name: str, path: Path, mesh: of.TetMesh) -> None:
    if name.startswith("frames "):
        form = frame_formats[name.split()[1]]
        read_frames(path, None if form.holds_mesh else mesh, form.name)
    else:
        read_input(path)


def work(folder: Path, found: dict[str, Path], seed: int, first: int, last: int, faults: Path) -> None:
    """In a process of its own: files first .. last - 1."""
    space = int(Path("/proc/self/statm").read_text().split()[0]) * os.sysconf("SC_PAGE_SIZE")
    resource.setrlimit(resource.RLIMIT_AS, (space + MEMORY, space + MEMORY))
    faulthandler.enable(open(folder / "traceback", "w"))  # open as long as the process
    signal.signal(signal.SIGALRM, signal.SIG_DFL)
    warnings.simplefilter("error", RuntimeWarning)
    names, mesh, contents = list(found), _cube(), {name: path.read_bytes() for name, path in found.items()}
    for number in range(first, last):
        rng = np.random.default_rng([seed, number])
        name = names[int(rng.integers(0, len(names)))]
        path = folder / f"a{found[name].suffix}"
        path.write_bytes(altered(contents[name], list(contents.values()), rng))
        (folder / "now").write_text(f"{number} {name}")
        for suffix in BESIDE if path.suffix in BESIDE else ():
            if suffix != path.suffix and found[name].with_suffix(suffix).exists():
                (folder / f"a{suffix}").write_bytes(found[name].with_suffix(suffix).read_bytes())
        signal.alarm(SECONDS)
        try:
            read(name, path, mesh)
        except of.Error as error:
            if "a." not in str(error):
                keep(faults, number, name, path, f"the message names no file: {error}")
        except BaseException:
            keep(faults, number, name, path, traceback.format_exc())
        signal.alarm(0)


def keep(faults: Path, number: int, name: str, path: Path, what: str) -> None:
    faults.mkdir(parents=True, exist_ok=True)
    (faults / f"{number}_{name.replace(' ', '_')}{path.suffix}").write_bytes(path.read_bytes())
    (faults / f"{number}.fault").write_text(what)


def fuzz(output: Path, files: int, seed: int, first: int = 0) -> int:
    """Files first .. files - 1. How many did what they must not; they are in output/faults, with those of earlier
    runs."""
    folder, faults = output / "scratch", output / "faults"
    folder.mkdir(parents=True, exist_ok=True)
    found = seeds(folder)
    while first < files:
        last = min(first + CHUNK, files)
        child = os.fork()
        if child == 0:
            try:
                work(folder, found, seed, first, last, faults)
                os._exit(0)
            except BaseException:
                traceback.print_exc()
                os._exit(1)
        status = os.waitpid(child, 0)[1]
        if os.WIFEXITED(status) and status:
            raise RuntimeError("the worker failed, not a reader: see above")
        if status:
            number, name = (folder / "now").read_text().split(" ", 1)
            keep(
                faults,
                int(number),
                name,
                folder / f"a{found[name].suffix}",
                f"status {status}\n" + (folder / "traceback").read_text(),
            )
            last = int(number) + 1
        first = last
    return len(list(faults.glob("*.fault")))


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--files", type=int, default=2000)
    parser.add_argument("--first", type=int, default=0, help="where to go on")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("-o", "--output", type=Path, required=True)
    options = parser.parse_args()
    start = time.process_time()
    count = fuzz(options.output, options.files, options.seed, options.first)
    used = time.process_time() - start + resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    print(
        f"files {options.first} to {options.files - 1}, {count} faults, {used:.0f} CPU seconds;"
        f" {options.output / 'faults'}"
    )
    return int(count > 0)


if __name__ == "__main__":
    sys.exit(main())
