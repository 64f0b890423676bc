"""What README.md prints is true."""

import re

import meshio
import octafield
import pytest
from docs_blocks import ROOT, blocks, run_page
from octafield.domain.generators import generate

PAGE = ROOT / "README.md"
README = PAGE.read_text(encoding="utf-8")


def test_the_blocks_of_the_readme_run_as_printed(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    octafield.write_surface(generate("box"), "part.stl")
    assert run_page(PAGE, from_nothing=True) >= 2
    mesh = meshio.read(tmp_path / "cylinder.vtu")
    assert mesh.point_data["frame_u"].shape == (len(mesh.points), 3)
    for made in ("field.png", "field/field.vtu", "report/report.html", "field.ovmb"):
        assert (tmp_path / made).stat().st_size > 1000


def test_free_twist_leaves_more_to_minimise_over():
    fixed, aligned = (
        octafield.compute_field(generate("cylinder"), octafield.FieldOptions(boundary=boundary, edge_length=0.3))
        for boundary in ("fixed", "aligned")
    )
    assert aligned.record["energy"] < fixed.record["energy"]


def test_the_readme_is_short_and_shows_pictures():
    (script,) = (block.text for block in blocks(PAGE) if block.language == "python")
    assert len([line for line in script.splitlines() if line.strip()]) <= 12
    assert len(README.split()) < 800
    pictures = re.findall(r'<img src="([^"]+)"', README)
    assert len(pictures) >= 2 and all((ROOT / name).stat().st_size < 150_000 for name in pictures)


@pytest.mark.parametrize("name", re.findall(r'\]\(([^)#]+)\)|src="([^"]+)"', README))
def test_links_of_the_readme_lead_somewhere(name):
    assert (ROOT / (name[0] or name[1])).exists()
