"""The command line in processes of their own that need not import it: forked from one that has.

Importing, and taking all of it down, takes longer than what most tests ask of a command. A child runs and writes as
`python -m octafield` does: it has the caller's folder and environment, its own streams and exit code, and may crash.
That the command also starts from nothing is shown elsewhere: by the commands of README.md, run as printed, and by tests
that send signals.
"""

import atexit
import gc
import importlib
import json
import os
import select
import subprocess
import sys
import tempfile
import traceback
from collections.abc import Callable, Mapping
from functools import cache
from pathlib import Path

# What commands import where they need it. Not octafield.view.scene: what it does depends on the environment.
LATE_IMPORTS = ("matplotlib.figure", "meshio", "octafield.inspect.info", "octafield.records.hex_dominant",
                "octafield.records.surface_field", "octafield.runs.frame_file_input", "octafield.study",
                "pyvista.plotting", "scipy.sparse.csgraph", "scipy.spatial", "vtk")  # fmt: skip


def run(
    arguments: list[str], timeout: float, environment: Mapping[str, str] | None = None
) -> subprocess.CompletedProcess:
    """Exit code and output of `octafield` with these arguments. environment: in addition to this process's. Raises
    TimeoutExpired; the command is killed then."""
    with tempfile.TemporaryDirectory() as folder:
        streams = [Path(folder) / name for name in ("stdout", "stderr")]
        request = {"arguments": arguments, "folder": os.getcwd(), "environment": {**os.environ, **(environment or {})}}
        code = _answer({**request, "streams": [str(path) for path in streams]}, timeout)
        return subprocess.CompletedProcess(arguments, code, *(path.read_text() for path in streams))


def _answer(request: dict, timeout: float) -> int:
    server = _server(os.getpid())
    server.stdin.write(json.dumps(request) + "\n")
    server.stdin.flush()
    if not select.select([server.stdout], [], [], timeout)[0]:
        os.killpg(server.pid, 9)
        _server.cache_clear()
        raise subprocess.TimeoutExpired(request["arguments"], timeout)
    return int(server.stdout.readline())


@cache
def _server(_process: int) -> subprocess.Popen:
    """Of this process, not of one that it was forked from. Ends with it: there are no requests then."""
    server = subprocess.Popen(
        [sys.executable, __file__], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, start_new_session=True
    )
    atexit.register(server.communicate)
    return server


def _serve() -> dict:
    """Answers a request by the exit code of the child that gets it, which is where this returns."""
    nothing = os.open(os.devnull, os.O_RDWR)
    with os.fdopen(os.dup(0)) as requests, os.fdopen(os.dup(1), "w", buffering=1) as answers:
        os.dup2(nothing, 0)
        os.dup2(nothing, 1)
        for line in requests:
            if (child := os.fork()) == 0:
                return json.loads(line)
            print(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]), file=answers)
    os._exit(0)


def _become(request: dict) -> None:
    for number, path in enumerate(request["streams"], start=1):
        file = os.open(path, os.O_WRONLY | os.O_CREAT)
        os.dup2(file, number)
        os.close(file)
    os.chdir(request["folder"])
    os.environ.clear()
    os.environ.update(request["environment"])
    sys.path[0] = request["folder"]
    sys.argv = ["octafield", *request["arguments"]]


def _end_like(program: Callable[[], None]) -> None:
    """Its exit code, written output, and no more: the interpreter is not taken down."""
    code = 0
    try:
        program()
    except SystemExit as end:
        code = end.code if isinstance(end.code, int) else int(end.code is not None)
        if isinstance(end.code, str):
            print(end.code, file=sys.stderr)
    except BaseException:
        traceback.print_exc()
        code = 1
    sys.stdout.flush()
    sys.stderr.flush()
    os._exit(code)


if __name__ == "__main__":
    from octafield.command_line.fields import main

    for late in LATE_IMPORTS:
        importlib.import_module(late)
    gc.freeze()  # what is here is not looked through by children
    _become(_serve())
    _end_like(main)
