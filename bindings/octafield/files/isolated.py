"""The first thing a process does that process.py started: it becomes a part of its parent. Then it is the program asked
for.

Run as `isolated.py PARENT PROGRAM [ARGUMENT ...]`, PROGRAM being a file or the name of a module. Imports the standard
library alone, so that a program that needs little starts fast.
"""

import ctypes
import os
import runpy
import signal
import sys


def become_a_part_of(parent: int) -> None:
    """Ends with the process of this id, which alone decides on Ctrl-C (a terminal sends that to both)."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    try:
        ctypes.CDLL(None).prctl(1, signal.SIGKILL)  # PR_SET_PDEATHSIG
    except (OSError, AttributeError):
        pass  # not Linux
    if os.getppid() != parent:
        os._exit(1)


if __name__ == "__main__":
    _, parent, program, *arguments = sys.argv
    become_a_part_of(int(parent))
    sys.argv = [program, *arguments]
    if os.path.isfile(program):
        runpy.run_path(program, run_name="__main__")
    else:
        runpy.run_module(program, run_name="__main__", alter_sys=True)
