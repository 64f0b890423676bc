"""The whole package passes mypy --strict, as its users' scripts may ask of it."""

import shutil
from pathlib import Path

import octafield
from typed import checked


def test_the_package_passes_mypy_strict(tmp_path):
    # A copy: mypy would take the packages beside an installed one for parts of the program.
    shutil.copytree(
        Path(octafield.__file__).parent, tmp_path / "octafield", ignore=shutil.ignore_patterns("*.so", "__pycache__")
    )
    done = checked(tmp_path, "octafield")
    assert "source files" in done.stdout.splitlines()[-1], done.stdout + done.stderr
    errors = [line for line in done.stdout.splitlines() if ": error: " in line]
    assert [line for line in errors if not line.endswith("[import-untyped]")] == []  # other libraries need no types
