"""Records: one model per kind, written in its order, read back checked, the page made from it."""

import json
import subprocess
import sys

import octafield as of
import pydantic
import pytest
import record_table
from octafield.domain.generators import generate
from octafield.records.base import Record
from octafield.records.field import FieldFigures, FieldRecord, GivenFieldRecord, RunWithField
from octafield.records.record_file import any_record, record_of, write_record
from octafield.runs.run_folder import write_field_result, write_surface_result

OF_TETS = {"energy_at_vertices", "tied_triangles"}
OF_VERTICES = {"singular_length_smoothed", "unserved_vertices", "integrability", "streamlines"}
ON_REQUEST = {"axes", "sizes", "lengths", "split_singular", "energies", "mesh"}
OF_FILES = {"field", "field_format", "deviation_deg", "label", "folder"}
# What the first version of studies wrote of a field.
EARLIEST = """
input version input_kind mesh_sha256 edge_length feature_source feature_edges feature_corners notes wall_seconds
cpu_seconds peak_mb versions vertices tets boundary_triangles regions interface_triangles locking representation
solver boundary seed threads energy energy_unit_speed singular_edges singular_length singular_curves singular_nodes
complex_edges singular_edges_by_turns alignment_deg feature_alignment_deg objective iterations diffusion_steps
converged stop_reason energy_history surface_field constraints released_corners released_corner_vertices options
""".split()


@pytest.fixture(scope="module", params=["vertices", "tets"])
def folder(request, tmp_path_factory):
    """Of a run, by where its frames are."""
    folder = tmp_path_factory.mktemp(request.param)
    options = of.FieldOptions(edge_length=0.45, sampling=request.param)
    write_field_result(of.compute_field(generate("ball"), options), folder)
    return folder


@pytest.fixture
def content(folder):
    return json.loads((folder / "result.json").read_text())


def test_a_file_has_the_names_of_the_model_in_its_order_and_lacks_what_its_kind_of_run_has_not(content):
    absent = OF_TETS if content["sampling"] == "vertices" else OF_VERTICES
    expected = [name for name in FieldRecord.order() if name not in absent | ON_REQUEST | OF_FILES]
    assert list(content) == expected
    for name, kind in FieldRecord.model_fields.items():
        if (
            isinstance(content.get(name), dict)
            and (model := getattr(record_of(content, ""), name)).__class__ is not dict
        ):
            assert list(content[name]) == [inner for inner in type(model).order() if inner in content[name]], kind


def test_a_surface_field_has_all_names_in_the_order_of_the_model(tmp_path):
    result = of.compute_surface_field(generate("box"), of.SurfaceFieldOptions(edge_length=0.45))
    write_surface_result(result, tmp_path)
    ours = ("imposed", "non_orthogonal")  # of points that are given, of lines
    names = [name for name in type(result.record).order() if name not in ours]
    assert list(json.loads((tmp_path / "result.json").read_text())) == names
    assert of.read_surface_record(tmp_path / "result.json") == result.record
    with pytest.raises(of.IoError, match="no record of a frame field, but of a surface field"):
        of.read_record(tmp_path / "result.json")


def test_reading_and_writing_again_gives_the_same_bytes(folder, tmp_path):
    write_record(tmp_path / "again.json", of.read_record(folder / "result.json"))
    assert (tmp_path / "again.json").read_bytes() == (folder / "result.json").read_bytes()


@pytest.mark.parametrize("model", [*record_table.KINDS, *record_table.PARTS], ids=lambda model: model.__name__)
def test_the_page_is_that_of_the_models_and_says_what_each_name_means(model):
    assert record_table.on_page(model) == record_table.table_of(model), (
        "PYTHONPATH=tests/python python tests/python/record_table.py"
    )
    assert all(info.description for info in model.model_fields.values())


def test_runs_of_studies_begin_with_options_and_given_fields_end_with_their_names(content):
    run = record_of({**content, "key": "k", "state": "done"}, "a study")
    assert isinstance(run, RunWithField) and next(iter(run)) == "options"
    given = GivenFieldRecord(**{**content, "label": "mine"})
    assert list(given)[-4:] == ["label", "representation", "files", "boundary"]
    assert set(given) == {*content, "label"}


def test_records_of_the_first_studies_open_and_unknown_names_survive(content, tmp_path):
    old = {name: content[name] for name in EARLIEST} | {"of_tomorrow": [1, {"a": None}]}
    old["alignment_deg"] = {"median": 0.1, "max": 2.0, "mean": 0.5}
    (tmp_path / "old.json").write_text(json.dumps(old))
    record = of.read_record(tmp_path / "old.json")
    assert record["of_tomorrow"] == [1, {"a": None}] and record.alignment_deg["mean"] == 0.5
    assert record.verdict is None and "verdict" not in record and record.alignment_deg.held_max is None
    write_record(tmp_path / "new.json", record.changed(label="again"))
    assert json.loads((tmp_path / "new.json").read_text()) == {**old, "label": "again"}
    assert {name for name, always in FieldRecord.order().items() if always} <= set(EARLIEST)


@pytest.mark.parametrize(
    ("damage", "words"),
    [
        (lambda text: text[:200], "no whole JSON"),
        (lambda text: "[" * 100_000, "no whole JSON"),
        (lambda text: "[1, 2]", "no JSON object"),
        (lambda text: '{"name": "of another program"}', "input: field required"),
        (lambda text: text.replace('"energy":', '"energie":'), "energy: field required"),
        (
            lambda text: text.replace('"singular_edges":', '"singular_edges": "many", "x":'),
            "singular_edges: input should",
        ),
    ],
)
def test_damaged_and_foreign_files_are_refused_by_name_and_with_a_remedy(folder, tmp_path, damage, words):
    path = tmp_path / "damaged.json"
    path.write_text(damage((folder / "result.json").read_text()))
    with pytest.raises(of.IoError, match=words) as caught:
        of.read_record(path)
    assert str(caught.value).startswith(f"{path}: not a record") and "write it again" in str(caught.value)
    assert caught.value.kind == "bad_record"


def test_an_absent_file_is_named(tmp_path):
    with pytest.raises(of.IoError, match="nowhere.json"):
        any_record(tmp_path / "nowhere.json")


def test_a_record_is_a_mapping_of_what_it_has_and_does_not_change(content):
    record = record_of(content, "")
    assert dict(record) == record == content and len(record) == len(content) and record.to_dict() == content
    assert record["energy"] == record.energy and record.get("label") is record.label is None and "label" not in record
    with pytest.raises(KeyError, match="label"):
        record["label"]
    with pytest.raises(pydantic.ValidationError, match="frozen"):
        record.energy = 0.0
    assert record.changed(energy=0.0).energy == 0 != record.energy
    with pytest.raises(pydantic.ValidationError, match="energy"):
        record.changed(energy="low")


def test_figures_are_one_part_of_the_record_of_a_field():
    names = list(FieldFigures.model_fields)
    at = list(FieldRecord.model_fields).index(names[0])
    assert list(FieldRecord.model_fields)[at : at + len(names)] == names
    assert issubclass(FieldFigures, Record)


def test_importing_octafield_does_not_import_the_models():
    late = "('pydantic', 'octafield.records.field')"
    script = f"import octafield, sys; print([name for name in sys.modules if name.startswith({late})])"
    assert subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout == "[]\n"
