"""The whole package passes mypy --strict, as its users' scripts may ask of it."""

import shutil
import subprocess
import sys
from pathlib import Path

import octafield


def test_the_package_passes_mypy_strict(tmp_path):
    # A copy: mypy would take the packages beside an installed one for parts of the program.
    shutil.copytree(
        Path(octafield.__file__).parent, tmp_path / "octafield", ignore=shutil.ignore_patterns("*.so", "__pycache__")
    )
    command = [
        sys.executable,
        "-m",
        "mypy",
        "--strict",
        "--follow-imports=silent",
        "--ignore-missing-imports",
        "octafield",
    ]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
