"""Gmsh in a process of its own: models can crash it or keep it for ever."""

import contextlib
import json
import re
import signal
import subprocess
from collections.abc import Iterator
from pathlib import Path

from ...errors import IoError
from ...files.process import start_isolated
from ...files.writing import scratch_folder
from ...progress.phases import Progress, announce

_PAUSE = 0.1  # seconds between questions to the callback


@contextlib.contextmanager
def scratch_for(path: Path) -> Iterator[Path]:
    with contextlib.ExitStack() as stack:
        try:
            folder = stack.enter_context(scratch_folder())
        except OSError as error:
            raise IoError(f"{path}: there is no folder for temporary files ({error}); set TMPDIR") from error
        yield folder


def run_worker(worker: Path, path: Path, job: dict[str, object], folder: Path, progress: Progress | None) -> int:
    """Exit code, negative after a signal. No process is left, however this ends."""
    with (folder / "printed").open("w+b") as printed:
        process = start_isolated(
            worker, [json.dumps(job)], str(path), "mesh it with Gmsh (gmsh -2 or -3) and give the .msh file",
            stdin=subprocess.DEVNULL, stdout=printed, stderr=printed,
        )  # fmt: skip
        try:
            while True:
                with contextlib.suppress(subprocess.TimeoutExpired):
                    return process.wait(_PAUSE)
                announce(progress, "read")
        finally:
            process.kill()
            process.wait()


def ending(code: int, printed: str) -> str:
    """What is to be told of a process that gave no answer."""
    if code == -signal.SIGKILL:
        return (
            "Gmsh was stopped by signal SIGKILL, most likely because memory ran out; choose a larger edge length"
            " (--edge-length)"
        )
    if code < 0:
        return (
            f"Gmsh was stopped by signal {signal.Signals(-code).name}: the model is damaged, or Gmsh has a defect;"
            " export it again"
        )
    last = re.sub(r"\S*[/\\]\S*", "", printed.strip().rpartition("\n")[2]).strip()  # paths are of no use to anyone
    return (
        f"Gmsh gave no answer (exit code {code}{': ' if last else ''}{last}); export it again, or mesh it elsewhere and"
        " give the mesh"
    )
