"""Fields from elsewhere are analysed as our own are, and polished from where they stand."""

import json

import meshio
import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from pipeline_fixtures import octafield

SAME = ("energy", "singular_edges", "singular_length", "complex_edges", "alignment_deg", "feature_alignment_deg",
        "non_meshable_vertices",
        "integrability", "singular_edges_by_turns", "mesh_sha256", "feature_edges")  # fmt: skip


@pytest.fixture(scope="module")
def ball():
    return of.compute_field(generate("ball"), of.FieldOptions(features="none", edge_length=0.3))


@pytest.fixture(scope="module")
def in_tets(ball):
    return of.compute_field(ball.tets, of.FieldOptions(features="none", sampling="tets"))


def test_the_analysis_of_our_own_field_is_that_of_its_run(ball, in_tets):
    options = of.FieldOptions(features="none")
    again = of.analyse(ball.tets, ball.frames, options=options)
    assert {key: again.record[key] for key in SAME} == {key: ball.record[key] for key in SAME}
    assert again.meshability.non_meshable_vertices == ball.meshability.non_meshable_vertices
    assert "AnalysedField" in repr(again)
    again = of.analyse(ball.tets, in_tets.tet_frames, "tets", options)
    assert [again.record[k] for k in SAME[:6]] == [in_tets.record[k] for k in SAME[:6]]
    assert again.meshability.non_meshable_vertices == in_tets.meshability.non_meshable_vertices and np.array_equal(
        again.frames, in_tets.frames
    )


@pytest.mark.parametrize("name", ["field.vtu", "field.txt", "field.npz"])
def test_a_file_gives_the_figures_of_the_field_in_it(ball, tmp_path, name):
    of.write_frames(tmp_path / name, ball.tets, ball.frames)
    meshio.Mesh(ball.tets.vertices, [("tetra", ball.tets.tets)]).write(tmp_path / "ball.mesh")
    more = ["--mesh", tmp_path / "ball.mesh"] if name.endswith("txt") else []
    done = octafield(
        "analyse", tmp_path / name, *more, "--features", "none", "-o", tmp_path / "out", "--json", "-", check=0
    )
    record = json.loads(done.stdout)
    assert record["energy"] == pytest.approx(ball.record["energy"], rel=1e-12)
    assert record["singular_edges"] == ball.record["singular_edges"] and record["deviation_deg"] == 0
    assert record["files"] == [
        "field.vtu",
        "singular.vtp",
        "features.vtp",
        "streamlines.vtp",
        "surface.vtp",
        "result.json",
    ]
    assert json.loads((tmp_path / "out" / "result.json").read_text())["energy"] == record["energy"]
    octafield("view", tmp_path / "out", "-o", tmp_path / "view.png", check=0)


def test_fields_in_tets_are_analysed_there(in_tets, tmp_path):
    of.write_frames(tmp_path / "a.ovmb", in_tets.tets, in_tets.tet_frames, "tets")
    record = json.loads(octafield("analyse", tmp_path / "a.ovmb", "--features", "none", "--json", "-", check=0).stdout)
    assert record["sampling"] == "tets" and record["singular_edges"] == in_tets.record["singular_edges"]


def test_a_start_at_the_minimum_stays_there_and_a_worse_one_is_polished(ball, tmp_path):
    options = of.FieldOptions(features="none", boundary="fixed")
    best = of.compute_field(ball.tets, options)
    again = of.compute_field(ball.tets, options, start=best.frames)
    assert again.record["energy"] == pytest.approx(best.record["energy"], rel=1e-5)
    assert again.record["diffusion_steps"] == 0 and again.record["start"] == "given"
    rng = np.random.default_rng(1)
    rough = of.frames.frame_exp(best.frames, 0.2 * rng.normal(size=(len(best.frames), 3)))
    before = of.analyse(ball.tets, rough, options=options).record["energy"]
    of.write_frames(tmp_path / "rough.txt", None, rough)
    meshio.Mesh(ball.tets.vertices, [("tetra", ball.tets.tets)]).write(tmp_path / "ball.mesh")
    done = octafield("field", tmp_path / "ball.mesh", "-o", tmp_path / "out", "--start", tmp_path / "rough.txt",
                     "--boundary", "fixed",
                     "--features", "none", "--json", "-", check=0)  # fmt: skip
    record = json.loads(done.stdout)
    assert record["energy"] < 0.8 * before and record["energy"] == pytest.approx(best.record["energy"], rel=0.05)
    assert record["start"].endswith("rough.txt")


def test_a_start_elsewhere_is_taken_to_the_sampling(ball, in_tets, tmp_path):
    of.write_frames(tmp_path / "a.frame", ball.tets, in_tets.tet_frames, "tets")
    meshio.Mesh(ball.tets.vertices, [("tetra", ball.tets.tets)]).write(tmp_path / "ball.mesh")
    done = octafield(
        "field",
        tmp_path / "ball.mesh",
        "-o",
        tmp_path / "out",
        "--start",
        tmp_path / "a.frame",
        "--features",
        "none",
        "--json",
        "-",
        check=0,
    )
    assert any("frames were taken to the vertices" in note for note in json.loads(done.stdout)["notes"])


def test_what_does_not_fit_is_refused(ball, tmp_path, box_surface):
    with pytest.raises(of.InvalidInput, match="one per vertex"):
        of.analyse(ball.tets, ball.frames[1:])
    with pytest.raises(of.InvalidInput, match="one per tet"):
        of.analyse(ball.tets, ball.frames, "tets")
    with pytest.raises(of.InvalidInput, match="where must be"):
        of.analyse(ball.tets, ball.frames, "edges")
    with pytest.raises(of.InvalidInput, match="splitting makes another mesh"):
        of.analyse(ball.tets, ball.frames, options=of.FieldOptions(split=True))
    with pytest.raises(of.InvalidInput, match="is a surface"):
        of.analyse(box_surface, ball.frames)
    with pytest.raises(of.InvalidInput, match="was prepared with volume=False"):
        of.analyse(of.prepare_mesh(box_surface, volume=False), ball.frames)
    with pytest.raises(of.InvalidInput, match="a start belongs to a tet mesh"):
        of.compute_field(box_surface, start=ball.frames)
    of.write_frames(tmp_path / "a.qtn", None, ball.frames, "tets")
    assert "give it with --mesh" in octafield("analyse", tmp_path / "a.qtn", check=2).stderr
