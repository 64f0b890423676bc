"""The modules that scripts meet pass mypy --strict themselves."""

import shutil
import subprocess
import sys
from pathlib import Path

import octafield

MODULES = ["__init__", "analysis", "cli", "cli_inspect", "cli_options", "completion", "defaults", "display", "doctor", "errors", "estimates", "info",
           "info_checks", "info_measures", "inputs", "interop", "locking", "meshing", "notebook", "options", "output", "phases", "pickling", "pipeline", "results",
           "study_cli", "surface_pipeline", "tet_analysis", "study/__init__", "study/generators", "study/plan", "study/results"]  # fmt: skip


def test_public_modules_pass_mypy_strict(tmp_path):
    # A copy: mypy would take the packages beside an installed one for parts of the program.
    shutil.copytree(Path(octafield.__file__).parent, tmp_path / "octafield", ignore=shutil.ignore_patterns("*.so", "__pycache__"))
    files = [f"octafield/{name}.py" for name in MODULES]
    command = [sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", "--ignore-missing-imports", *files]
    done = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True)
    assert done.returncode == 0, done.stdout
