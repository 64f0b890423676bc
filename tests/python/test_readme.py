"""What README.md prints is true."""

import importlib
import re
import subprocess
import sys
from pathlib import Path

import meshio
import pytest

ROOT = Path(__file__).parents[2]
README = (ROOT / "README.md").read_text()


def python_blocks() -> list[str]:
    return re.findall(r"```python\n(.*?)```", README, flags=re.DOTALL)


def test_the_script_in_the_readme_runs_as_printed(tmp_path):
    (script,) = python_blocks()
    assert len([line for line in script.splitlines() if line.strip()]) == 10
    done = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    energies = {line.split()[0]: float(line.split()[1]) for line in done.stdout.splitlines()}
    assert energies["aligned"] < energies["fixed"]  # free twist leaves more to minimise over
    for boundary in energies:
        mesh = meshio.read(tmp_path / f"nut-{boundary}.vtu")
        assert mesh.point_data["frame_u"].shape == (len(mesh.points), 3)


@pytest.mark.parametrize("name", re.findall(r"\]\(([^)#]+)\)", README))
def test_links_of_the_readme_lead_somewhere(name):
    assert (ROOT / name).exists()


def test_functions_named_in_the_readme_are_where_it_says():
    listed = README.split("Every step is a function of its own")[1].split("`help(")[0]
    places = re.findall(r"^- `(octafield[.\w]*)`(.*?)(?=^- |\Z)", listed, flags=re.MULTILINE | re.DOTALL)
    assert [place for place, _ in places] == ["octafield.surface", "octafield.volume", "octafield.frames", "octafield"]
    for place, text in places:
        names = re.findall(r"`(\w+)`", text)
        assert len(names) > 6
        assert [name for name in names if not hasattr(importlib.import_module(place), name)] == []
