"""mypy --strict as tests run it: with one cache, so that what it knows of libraries is read once."""

import subprocess
import sys
from pathlib import Path

from docs_blocks import ROOT

# The same for all: with others mypy does not use what it kept.
_OPTIONS = ("--strict", "--follow-imports=silent", f"--cache-dir={ROOT / '.mypy_cache'}")


def checked(folder: Path, *names: str, environment: dict[str, str] | None = None) -> subprocess.CompletedProcess:
    """Of files or packages in a folder."""
    command = [sys.executable, "-m", "mypy", *_OPTIONS, *names]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, env=environment)
