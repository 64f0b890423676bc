"""Fields of other programs: beside our own in a comparison, and as constraint of a new field."""

import json
import re

import numpy as np
import octafield
import pytest
from octafield.domain.generators import generate
from pipeline_fixtures import octafield as command


@pytest.fixture(scope="module")
def solved():
    """A mesh with frames that no solver gave: those of a cylinder, disturbed."""
    result = octafield.compute_field(generate("cylinder"), octafield.FieldOptions(edge_length=0.5))
    noisy = result.frames + np.random.default_rng(0).normal(scale=0.1, size=result.frames.shape)
    return result.tets, noisy / np.linalg.norm(noisy, axis=1)[:, None]


@pytest.fixture(scope="module")
def files(solved, tmp_path_factory):
    folder = tmp_path_factory.mktemp("given")
    tets, frames = solved
    octafield.write_frames(folder / "theirs.vtu", tets, frames)
    octafield.write_frames(folder / "theirs.frame", tets, frames, at="tets")
    octafield.convert_file(folder / "theirs.vtu", folder / "mesh.mesh")
    return folder


@pytest.mark.parametrize(("sampling", "file"), [("vertices", "theirs.vtu"), ("tets", "theirs.frame")])
def test_a_given_field_has_a_row_as_it_is_and_one_smoothed_per_boundary_treatment(
    files, solved, tmp_path, sampling, file
):
    tets, frames = solved
    options = octafield.FieldOptions(sampling=sampling, streamlines=0)
    found = octafield.compare(
        files / "mesh.mesh",
        tmp_path / "out",
        representations=["sh4"],
        boundaries=["aligned", "none"],
        options=options,
        fields={"theirs": files / file},
    )
    rows = {(row["label"].split(",")[0], row["boundary"]): row for row in found.rows}
    assert set(rows) == {
        (name, boundary) for name in ("sh4", "theirs", "sh4 from theirs") for boundary in ("aligned", "none")
    }
    analysed = octafield.read_frames(files / file, tets)
    energy = octafield.analyse(tets, analysed.frames, analysed.where).record["energy"]
    for boundary in ("aligned", "none"):
        assert rows["theirs", boundary]["energy"] == pytest.approx(energy, rel=1e-9)
        assert rows["sh4 from theirs", boundary]["energy"] < 0.9 * energy
        assert rows["sh4 from theirs", boundary]["start"] == "theirs"
    assert (tmp_path / "out" / rows["theirs", "none"]["folder"] / "field.vtu").is_file()


def test_the_report_names_given_fields_and_gives_them_no_times(files, tmp_path):
    octafield.compare(
        files / "mesh.mesh", tmp_path / "out", representations=["sh4"], boundaries=["aligned"],
        fields={"theirs": files / "theirs.vtu"},
        options=octafield.FieldOptions(streamlines=0),
    )  # fmt: skip
    text = re.sub(r"<[^>]+>", "", (tmp_path / "out" / "report.html").read_text())
    assert "1 field read from files (theirs)" in text
    assert "sh4 from theirs" in text
    assert "Read from files, without times: theirs." in text
    lines = (tmp_path / "out" / "tables" / "summary.csv").read_text().splitlines()
    row = dict(zip(lines[0].split(","), next(line for line in lines if ",theirs," in line).split(","), strict=True))
    assert row["CPU seconds sum"] == "" and float(row["energy over lowest"]) > 1


def test_arrays_are_taken_as_they_are(solved, tmp_path):
    tets, frames = solved
    found = octafield.compare(
        tets, tmp_path / "out", representations=["sh4"], boundaries=["none"], fields={"mine": frames}, seeds=2
    )
    assert [row["energy"] for row in found.rows if row["label"] == "mine"] == pytest.approx(
        [octafield.volume.dirichlet_energy(tets, frames)] * 2
    )


@pytest.mark.parametrize(
    ("fields", "kind"),
    [
        ({"sh4": "theirs.vtu"}, "bad_name"),
        ({"a/b": "theirs.vtu"}, "bad_name"),
        ({" ": "theirs.vtu"}, "bad_name"),
        ({"short": np.tile([1.0, 0, 0, 0], (3, 1))}, "bad_count"),
    ],
)
def test_unfit_fields_are_refused_before_any_run(files, tmp_path, fields, kind):
    fields = {name: files / given if isinstance(given, str) else given for name, given in fields.items()}
    with pytest.raises(octafield.InvalidInput) as caught:
        octafield.compare(files / "mesh.mesh", tmp_path / "out", fields=fields)
    assert caught.value.kind == kind and not (tmp_path / "out").exists()


def test_fields_need_one_tet_mesh(files, tmp_path):
    for inputs in (generate("cylinder"), [files / "mesh.mesh"] * 2):
        with pytest.raises(octafield.InvalidInput, match="one tet mesh"):
            octafield.compare(inputs, tmp_path / "out", fields={"theirs": files / "theirs.vtu"})


def test_the_command_takes_named_files(files, tmp_path):
    out = tmp_path / "out"
    done = command("compare", files / "mesh.mesh", "-o", out, "-q", "--representations", "sh4", "--boundaries",
                   "aligned", "--sampling", "tets",
                   "--field", f"theirs={files / 'theirs.frame'}")  # fmt: skip
    assert done.returncode == 0, done.stderr
    assert [row["label"] for row in json.loads((out / "results.json").read_text())] == [
        "sh4, aligned",
        "sh4 from theirs, aligned",
        "theirs",
    ]
    for wrong, word in ((["theirs.frame"], "NAME=FILE"), (["a=x", "a=y"], "already")):
        failed = command(
            "compare", files / "mesh.mesh", "-o", tmp_path / "no", *(part for one in wrong for part in ("--field", one))
        )
        assert failed.returncode == 2 and word in failed.stderr and not (tmp_path / "no").exists()


@pytest.mark.parametrize("sampling", octafield.options.SAMPLINGS)
def test_boundary_start_keeps_the_surface_of_the_start_and_smooths_inside(solved, sampling):
    tets, frames = solved
    given = frames if sampling == "vertices" else np.asarray(octafield.volume.tet_frames(tets, frames))
    options = octafield.FieldOptions(sampling=sampling, boundary="start", streamlines=0)
    result = octafield.compute_field(tets, options, start=given)
    made = result.frames if sampling == "vertices" else result.tet_frames
    surface = np.asarray(result.constraints.on_boundary, bool)
    moved = np.asarray(octafield.frames.distance(made, given))
    assert 0 < surface.sum() < len(surface)
    assert moved[surface].max() < 1e-7
    assert moved[~surface].max() > 0.01
    before = octafield.analyse(tets, given, sampling).record["energy"]
    assert result.record["energy"] < before
    with pytest.raises(octafield.InvalidInput, match="of a start"):
        octafield.compute_field(tets, options)
