"""The documentation builds without a warning, and what it shows runs."""

import doctest
import importlib
import os
import pkgutil
import re
import subprocess
import sys
from collections.abc import Mapping

import numpy as np
import octafield
import octafield.study
import pytest
import yaml
from docs_blocks import ROOT, blocks, python_of, run_page
from octafield import _core
from octafield.domain.generators import generate
from typed import checked

sys.path.insert(0, str(ROOT / "scripts" / "docs"))
from gallery import alike, shown  # noqa: E402

DOCS = ROOT / "docs"
PAGES = {str(page.relative_to(ROOT)): page for page in [ROOT / "README.md", *sorted(DOCS.rglob("*.md"))]}
RUN = [
    name
    for name, page in PAGES.items()
    if any(b.is_command or b.language == "python" for b in blocks(page)) and name != "README.md"
]
MODULES = [
    m.name
    for m in pkgutil.walk_packages(octafield.__path__, "octafield.")
    if not m.name.endswith(("__main__", "_core"))
]


def test_the_pages_meant_to_run_do_have_blocks():
    assert {
        "docs/first_steps.md",
        "docs/concepts.md",
        "docs/studies.md",
        "docs/reproducibility.md",
        "docs/install.md",
        "docs/command_line.md",
    } <= set(RUN)


@pytest.mark.parametrize("name", RUN)  # README.md: test_readme.py
def test_the_blocks_of_a_page_run_as_printed(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    monkeypatch.syspath_prepend(tmp_path)  # for files that a page shows and imports
    assert run_page(PAGES[name]) > 0
    assert [p.name for p in shown(PAGES[name]) if not alike(p, tmp_path / p.name)] == []


def test_the_gallery_shows_a_dozen_tasks_in_small_pictures():
    pictures = shown(PAGES["docs/gallery.md"])
    assert len(pictures) >= 12 and sum(p.stat().st_size for p in pictures) < 2e6
    assert len([b for b in blocks(PAGES["docs/gallery.md"]) if b.language == "python" or b.is_command]) > len(pictures)


def test_pictures_of_other_things_are_told_apart():
    one, other = shown(PAGES["docs/gallery.md"])[:2]
    assert alike(one, one) and not alike(one, other)


def test_a_page_that_says_something_else_than_its_code_prints_is_found(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    page = tmp_path / "page.md"
    page.write_text('```python\nprint(1 + 1)\n```\n\n```text title="output"\n2\n```\n')
    assert run_page(page) == 1
    page.write_text(page.read_text().replace("\n2\n", "\n3\n"))
    with pytest.raises(AssertionError, match="page.md:6"):
        run_page(page)
    page.write_text("```sh\noctafield info nowhere.stl\n```\n")
    with pytest.raises(AssertionError, match="page.md:2.*nowhere.stl"):
        run_page(page)


def test_the_python_of_the_pages_passes_mypy_strict(tmp_path):
    for name, page in PAGES.items():
        if text := python_of(page):
            (tmp_path / (re.sub(r"\W", "_", name) + ".py")).write_text(text)
    environment = {**os.environ, "MYPYPATH": str(ROOT / "studies" / "examples" / "own_scheme")}
    done = checked(tmp_path, ".", environment=environment)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("name", ["octafield", *MODULES])
def test_examples_in_docstrings_run(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    found = doctest.testmod(importlib.import_module(name))
    assert found.failed == 0
    if name in ("octafield", "octafield.study", "octafield.runs.interop"):
        assert found.attempted > 2


def _examples_of_the_compiled_module():
    documented = {name: getattr(thing, "__doc__", None) or "" for name, thing in vars(_core).items() if callable(thing)}
    return {name: text for name, text in documented.items() if ">>>" in text}


@pytest.mark.parametrize("name", _examples_of_the_compiled_module())
def test_examples_in_docstrings_of_the_compiled_module_run(name, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    given = {"np": np, "octafield": octafield, "generate": generate}
    examples = doctest.DocTestParser().get_doctest(_examples_of_the_compiled_module()[name], given, name, None, 0)
    assert doctest.DocTestRunner().run(examples).failed == 0


def test_what_a_script_uses_first_has_an_example():
    first = {"TriangleMesh", "TetMesh", "read_surface", "write_surface", "require_valid", "repair", "detect_features",
             "remesh",
             "tetrahedralize", "boundary_surface", "direction_field", "surface_singularities", "boundary_constraints",
             "initial_frames",
             "diffuse", "smooth", "frame_field", "singular_graph", "dirichlet_energy", "stiffness", "mass",
             "write_field", "random_rotations",
             "distance", "matching", "slerp", "sh4_embed", "sh4_project", "frame_streamlines", "tet_sampling",
             "Sampling"}  # fmt: skip
    assert first - set(_examples_of_the_compiled_module()) == set()
    written_here = {"compute_field", "compute_surface_field", "compare", "prepare_field", "prepare_mesh", "run_field",
                    "FieldOptions", "to_pyvista",
                    "from_pyvista", "to_meshio", "from_meshio", "to_scipy", "to_pandas", "from_pandas"}  # fmt: skip
    assert [name for name in written_here if ">>> " not in (getattr(octafield, name).__doc__ or "")] == []
    for name in ("load", "parse", "plan", "run", "status", "rows", "write_report"):
        assert ">>> " in (getattr(octafield.study, name).__doc__ or "") or name in octafield.study.__doc__, name


NAMESPACES = {name: getattr(octafield, name) for name in ("frames", "surface", "volume")}
PUBLIC = {name: getattr(octafield, name) for name in octafield.__all__ if name != "__version__"} | {
    f"{space}.{name}": getattr(module, name)
    for space, module in NAMESPACES.items()
    for name in module.__all__
    if name not in octafield.__all__
}


@pytest.mark.parametrize("name", sorted(set(PUBLIC) - {"volume.no_number"}))
def test_every_public_name_explains_itself(name):
    thing = PUBLIC[name]
    words = [] if isinstance(thing, (Mapping, tuple, float)) else (thing.__doc__ or "").split()
    assert isinstance(thing, (Mapping, tuple, float)) or len(words) > 4


def test_every_public_name_is_on_one_page_of_the_api():
    pages = (DOCS / "api" / "python").glob("*.md")
    shown = [
        name
        for page in pages
        for name in re.findall(
            r"^::: octafield\.((?:frames\.|surface\.|volume\.)?\w+)$", page.read_text(), flags=re.MULTILINE
        )
    ]
    public = set(PUBLIC) - set(NAMESPACES) - {"surface.dirichlet_energy", "surface.scaled_jacobians"}  # shown once
    assert {"missing": public - set(shown), "unknown": set(shown) - public} == {"missing": set(), "unknown": set()}
    assert len(shown) == len(set(shown))


def test_the_citation_names_this_version():
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    assert citation["version"] == octafield.__version__
    assert citation["license"] in (ROOT / "pyproject.toml").read_text()
    assert f"version = {{{octafield.__version__}}}" in (DOCS / "cite.md").read_text()


def test_numbers_of_the_paper_are_those_of_the_pages_that_studies_write():
    paper = (DOCS / "paper" / "paper.md").read_text(encoding="utf-8")
    sources = re.findall(r"<!-- (docs/[\w/]+\.md): (.+?) -->", paper)
    told = re.sub(r"<!--.*?-->", "", paper, flags=re.DOTALL)
    assert len(sources) > 4
    for page, numbers in sources:
        there = (ROOT / page).read_text(encoding="utf-8")
        assert [n for n in numbers.split() if not re.search(rf"(?<![\d.]){re.escape(n)}(?![\d.]*\d)", told)] == []
        assert [n for n in numbers.split() if not re.search(rf"(?<![\d.]){re.escape(n)}(?![\d.]*\d)", there)] == []


def test_the_paper_cites_what_its_bibliography_has():
    cited = set(re.findall(r"@(\w+)", (DOCS / "paper" / "paper.md").read_text(encoding="utf-8")))
    entries = set(re.findall(r"^@\w+\{(\w+),", (DOCS / "paper" / "paper.bib").read_text(), flags=re.MULTILINE))
    assert cited == entries


@pytest.fixture(scope="module")
def site(tmp_path_factory):
    folder = tmp_path_factory.mktemp("site")
    command = [sys.executable, "-m", "mkdocs", "build", "--strict", "-d", str(folder)]
    quiet = {**os.environ, "NO_MKDOCS_2_WARNING": "1"}  # a notice about the theme's future, not about these pages
    done = subprocess.run(command, cwd=ROOT, env=quiet, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    assert "WARNING" not in done.stderr and "ERROR" not in done.stderr, done.stderr
    return folder


def test_the_site_builds_without_warnings_and_needs_no_network(site):
    pages = {page.relative_to(site).as_posix(): page.read_text() for page in site.rglob("*.html")}
    assert len(pages) > 70
    loaded = (
        r'<(?:script|img|iframe|source)\b[^>]*\bsrc="(https?:)?//'
        r'|<link\b[^>]*\brel="(?:stylesheet|preconnect|preload)"[^>]*\bhref="(https?:)?//'
    )
    assert [name for name, text in pages.items() if re.search(loaded, text)] == []
    assert not re.search(r"url\((https?:)?//|@import", "".join(sheet.read_text() for sheet in site.rglob("*.css")))


def test_the_api_pages_show_docstrings_of_the_compiled_module(site):
    def words(page):
        return re.sub(r"\s+", " ", re.sub(r"<[^>]+>", "", (site / page).read_text()))

    assert "(n, 9) sh4 vectors of (n, 4) unit quaternions w x y z" in words("api/python/frames.html")
    assert "The same, (n, 15), with (n, 3) axis lengths." in words("api/python/frames.html")  # an overload
    assert "int32 vertex ids, 0-based, counter-clockwise seen from outside" in words(
        "api/python/meshes.html"
    )  # a field
    assert "max_iterations: int = 200" in words("api/python/volume_fields.html")  # a default read from C++
    assert "What every embedding of frames into R^d offers" in words("api/cpp.html")
    assert "static_assert(frames::Equivariant&lt;Sh6&gt;)" in words("add_representation.html")
