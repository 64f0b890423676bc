"""One registry says what kinds of mesh files there are; a kind from outside is read and written as our own."""

import importlib.util
import itertools
import pickle
import re
from pathlib import Path

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from docs_blocks import ROOT
from octafield.command_line.options import InputFile
from octafield.domain.generators import generate
from octafield.domain.inputs import from_mesh, read_input
from octafield.domain.mesh_writers import write_mesh
from octafield.meshes import registry
from octafield.meshes.mesh_format import HELD

EXAMPLE = ROOT / "studies/examples/new_mesh_format/tet_text.py"


@pytest.fixture
def tet():
    """The example of docs/extend.md, registered for a test."""
    spec = importlib.util.spec_from_file_location("tet_text", EXAMPLE)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    of.register_mesh_format(module.TET)
    yield module.TET
    del registry.MESH_FORMATS["tet"]


def test_names_and_suffixes_are_unique_and_every_format_can_be_used():
    forms = of.mesh_formats.values()
    suffixes = [suffix for form in forms for suffix in form.suffixes]
    assert len(suffixes) == len(set(suffixes)) and [form.name for form in forms] == list(of.mesh_formats)
    for form in forms:
        assert form.read or form.write or form.mesh, form
        assert set(form.holds) <= set(HELD) and {"triangles", "tets"} & set(form.holds)
        assert pickle.loads(pickle.dumps(form)) is form


def test_the_page_the_readme_and_the_help_name_every_suffix():
    suffixes = {suffix for form in of.mesh_formats.values() for suffix in form.suffixes}
    page = (ROOT / "docs/formats.md").read_text(encoding="utf-8")
    table = page[page.index("| file | surface | tets |") :].partition("\n\n")[0]
    named = {word for line in table.strip().splitlines()[2:] for word in re.findall(r"\.\w+", line.split("|")[1])}
    assert named == suffixes | {".face", ".edge"}  # which lie beside .node and .ele
    told = InputFile.__metadata__[0].help
    assert all(re.search(rf"\{suffix}\b", told) for suffix in suffixes)
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    assert set(re.findall(r"\.\w+", readme[readme.index("MESH is a") : readme.index("also gzipped")])) <= suffixes


WRITTEN = [name for name, form in of.mesh_formats.items() if form.write is not None]


@pytest.fixture(scope="module")
def whole():
    """Tets with feature edges, in two regions; a surface with the same edges."""
    box = of.prepare_mesh(generate("box"), of.MeshOptions(edge_length=0.5)).tets
    halves = np.asarray(box.vertices)[np.asarray(box.tets)].mean(axis=1)[:, 0] < 0.5
    return {
        "features": from_mesh(box),
        "regions": from_mesh(of.TetDomain(box.mesh, regions=halves.astype(np.int32) + 1)),
    }


@pytest.mark.parametrize("part", ["features", "regions"])
@pytest.mark.parametrize("name", WRITTEN)
def test_what_a_format_says_it_holds_comes_back_and_the_rest_is_told(whole, tmp_path, name, part):
    form = of.mesh_formats[name]
    path = tmp_path / f"a{form.suffixes[0]}"
    told = [note for note in write_mesh(path, whole[part]) if "hold no" in note]
    found = read_input(path)
    assert (found.tets is not None) == ("tets" in form.holds)
    if part == "features":
        count = len(found.lines) if found.lines is not None and found.lines_are_features() else 0
        back = count == len(whole[part].lines)
    else:
        back = found.regions is not None and np.array_equal(found.regions, whole[part].regions)
    assert back == (part in form.holds) and (told == []) == back


def test_unknown_kinds_are_told_all_known_ones(tmp_path):
    (tmp_path / "a.doc").touch()
    with pytest.raises(
        of.IoError, match=r"surfaces \(\.stl .*\.vtp\), tet meshes \(\.vtk .*\) and CAD models \(\.step"
    ):
        read_input(tmp_path / "a.doc")
    with pytest.raises(of.IoError, match=r"known are \.stl .*\.ovmb.*, also \.gz"):
        write_mesh(tmp_path / "a.step", from_mesh(box_tets(2)))


@pytest.mark.parametrize("packed", ["", ".gz"])
def test_a_format_from_outside_is_read_and_written(tet, tmp_path, packed):
    mesh, path = box_tets(3), tmp_path / f"a.tet{packed}"
    assert write_mesh(path, from_mesh(mesh)) == []
    again = read_input(path).tets
    assert np.array_equal(again.vertices, mesh.vertices) and np.array_equal(again.tets, mesh.tets)
    done = of.convert_file(path, tmp_path / "b.vtu")
    assert (done.kind, done.cells) == ("tets", len(mesh.tets))
    assert of.convert_file(tmp_path / "b.vtu", tmp_path / "c.tet").kind == "tets"
    assert of.compute_field(path).record.tets == len(mesh.tets)


def test_what_the_format_cannot_hold_is_told_and_surfaces_are_refused(tet, tmp_path):
    mesh = of.TetDomain(box_tets(3), regions=np.repeat([1, 2], len(box_tets(3).tets) // 2).astype(np.int32))
    assert write_mesh(tmp_path / "a.tet", from_mesh(mesh)) == [".tet files hold no regions: left out"]
    with pytest.raises(of.InvalidInput, match=r"\.tet files hold tets, and mesh in memory is a surface; write one of"):
        write_mesh(tmp_path / "a.tet", from_mesh(generate("box")))


def test_messages_name_the_format_from_outside(tet, tmp_path):
    (tmp_path / "a.doc").touch()
    with pytest.raises(of.IoError, match=r"tet meshes \(.*\.tet\)"):
        read_input(tmp_path / "a.doc")


def test_damaged_files_of_a_format_from_outside_are_refused_by_name(tet, tmp_path):
    path = tmp_path / "a.tet"
    write_mesh(path, from_mesh(box_tets(2)))
    whole = path.read_text()
    lines = whole.splitlines(keepends=True)
    for cut in itertools.chain(range(0, len(whole) - 2, 7), [len("".join(lines[:5]))]):
        path.write_text(whole[:cut])
        with pytest.raises((of.IoError, of.InvalidInput), match="a.tet"):
            read_input(path)
    path.write_text(whole.replace(lines[3], "0 zero 0\n", 1))
    with pytest.raises(of.IoError, match=r"a\.tet, line 4: no number: 'zero'"):
        read_input(path)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"name": "stl"}, "there already"),
        ({"suffixes": (".x", ".vtu")}, "are VTK XML files already"),
        ({"suffixes": ("tet",)}, "begins with a dot"),
        ({"suffixes": (".TET",)}, "small letters"),
        ({"suffixes": ()}, "has suffixes"),
        ({"holds": ("hexahedra",)}, "holds triangles or tets"),
        ({"holds": ("regions",)}, "holds triangles or tets"),
        ({"read": None, "write": None}, "a function that reads"),
        ({"read": 3}, "a function that reads"),
        ({"suffixes": (".x", ".x")}, "suffixes that differ"),
    ],
)
def test_a_format_that_would_hide_another_or_holds_nothing_is_refused(changes, words):
    before = dict(of.mesh_formats)
    form = of.MeshFormat(**{"name": "tet", "suffixes": (".tet",), "title": "tet text", "holds": ("tets",)} | changes)
    with pytest.raises(of.InvalidInput, match=words):
        of.register_mesh_format(form)
    assert dict(of.mesh_formats) == before


def test_the_longest_suffix_decides(tet, monkeypatch):
    monkeypatch.setitem(registry.MESH_FORMATS, "long", of.MeshFormat("long", (".my.vtk",), "long", ("tets",)))
    assert registry.find_mesh_format("a.my.vtk.gz").name == "long"
    assert registry.find_mesh_format(Path("a.mesh")).name == "mesh"
    assert registry.find_mesh_format(Path("a.MESHB.gz")).name == "meshb"
    assert registry.find_mesh_format("x/b.tet").suffix_of("x/b.tet") == ".tet"


def test_a_reader_that_gives_no_mesh_is_told_with_its_file(tmp_path, monkeypatch):
    form = of.MeshFormat("nothing", (".nothing",), "Nothing", ("tets",), read=lambda path: None)
    monkeypatch.setitem(registry.MESH_FORMATS, form.name, form)
    path = tmp_path / "a.nothing"
    path.write_text("x")
    with pytest.raises(of.IoError, match=r"a\.nothing: .*the reader of nothing gave None, not a Grid"):
        registry.read_mesh_file(path, 0.0, None)
