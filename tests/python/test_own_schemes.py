"""Schemes of Python: laws, the same fields as the compiled ones, records, comparisons, studies, and what goes wrong."""

import html
import json
import pickle
import sys
from pathlib import Path

import numpy as np
import octafield
import pytest
from docs_blocks import ROOT
from octafield import study
from octafield.domain.generators import generate
from octafield.laws import EdgeLaws, EmbeddingLaws
from octafield.laws.schemes import same_frame, some_frames
from octafield.volume import EdgeScheme, EmbeddingScheme
from octafield.volume import scheme_energy as energy_of

IDEAS = ROOT / "studies" / "examples" / "own_scheme" / "ideas.py"
sys.path.insert(0, str(IDEAS.parent))
import ideas  # noqa: E402

SH4 = octafield.frames.representations["sh4"]
own_sh4 = EmbeddingScheme("own_sh4", SH4.embed)
COARSE = octafield.MeshOptions(edge_length=0.5)
by_lbfgs = octafield.FieldOptions(representation=own_sh4, solver="lbfgs", edge_length=0.5)


class TestBumps(EmbeddingLaws):
    scheme = ideas.bump_scheme


class TestOwnSh4WithDifferential(EmbeddingLaws):
    scheme = EmbeddingScheme("derived", SH4.embed, SH4.differential)


class TestCapped(EdgeLaws):
    scheme = ideas.capped_scheme


def geodesic_derivatives(first: np.ndarray, second: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Of log(q p^-1): the inverse right and left Jacobian of SO(3) (Chirikjian 2012, section 10.3)."""
    w = octafield.frames.frame_log(first, second)
    angle = np.linalg.norm(w, axis=1)[:, None, None]
    cross = np.cross(np.eye(3)[None], w[:, None, :]).transpose(0, 2, 1) * -1
    rest = (1 / angle**2 - (1 + np.cos(angle)) / (2 * angle * np.sin(angle))) * (cross @ cross)
    return -(np.eye(3) + cross / 2 + rest), np.eye(3) - cross / 2 + rest


class TestGeodesicWithDifferential(EdgeLaws):
    scheme = EdgeScheme("own_geodesic", octafield.frames.frame_log, geodesic_derivatives)


def broken(law: str, laws: type, scheme: object) -> str:
    case = type("Case", (laws,), {"scheme": scheme})()
    with pytest.raises(AssertionError) as failure:
        getattr(case, law)()
    return str(failure.value)


def test_laws_tell_what_is_broken():
    axes = octafield.frames.rotation_matrices
    first_axis = EmbeddingScheme("first_axis", lambda q: axes(q)[:, :, 0] ** 2)
    assert "rotation of the cube" in broken("test_one_frame_has_one_vector", EmbeddingLaws, first_axis)
    constant = EmbeddingScheme("constant", lambda q: np.ones((len(q), 2)))
    assert "stands still" in broken("test_turning_a_frame_moves_its_vector", EmbeddingLaws, constant)
    assert "share a vector" in broken("test_different_frames_have_different_vectors", EmbeddingLaws, constant)
    mean = EmbeddingScheme("mean", lambda q: SH4.embed(q) - SH4.embed(q).mean(axis=0))
    assert "one by one" in broken("test_rows_do_not_depend_on_one_another", EmbeddingLaws, mean)
    wrong = EmbeddingScheme("wrong", SH4.embed, lambda q: 2 * SH4.differential(q))
    assert "differential of embed" in broken("test_differential_is_the_derivative", EmbeddingLaws, wrong)
    not_matched = EdgeScheme("not_matched", lambda p, q: q - p)
    assert "itself" in broken("test_length_is_that_of_the_frames", EdgeLaws, not_matched)
    one_way = EdgeScheme("one_way", lambda p, q: octafield.frames.frame_log(p, q) * (1 + SH4.embed(p)[:, :1]))
    assert "there and back" in broken("test_length_is_the_same_both_ways", EdgeLaws, one_way)


def test_the_24_quaternions_of_the_laws_are_of_one_frame():
    frames = some_frames()
    for k in range(24):
        assert octafield.frames.distance(frames, same_frame(frames, k)).max() < 1e-7


@pytest.fixture(scope="module")
def problem():
    return octafield.prepare_field(octafield.prepare_mesh(generate("ball"), COARSE))


def test_own_sh4_reaches_the_field_of_sh4(problem):
    for boundary in ("fixed", "aligned"):
        options = dict(boundary=boundary, tolerance=1e-9)
        own = octafield.run_field(problem, octafield.FieldOptions(representation=own_sh4, **options))
        compiled = octafield.run_field(problem, octafield.FieldOptions(**options))
        assert own.record["objective"] == pytest.approx(own.record["energy"], rel=1e-9)
        assert own.record["energy"] == pytest.approx(compiled.record["energy"], rel=1e-6)
        assert own.record["representation"] == "own_sh4" == own.record["options"]["representation"]
        json.dumps(own.record.to_dict())


def test_own_geodesic_reaches_the_field_of_geodesic(problem):
    scheme = EdgeScheme("own_geodesic", octafield.frames.frame_log)
    own = octafield.run_field(problem, octafield.FieldOptions(representation=scheme, tolerance=1e-10))
    compiled = octafield.run_field(problem, octafield.FieldOptions(representation="geodesic", tolerance=1e-10))
    assert own.record["objective"] == pytest.approx(compiled.record["objective"], rel=1e-8)


def test_frames_in_tets_and_given_starts_take_schemes_too(problem):
    options = octafield.FieldOptions(representation=own_sh4, sampling="tets", boundary="fixed", max_iterations=3)
    result = octafield.run_field(problem, options)
    sampling = octafield.volume.tet_sampling(problem.meshed.volume())
    assert energy_of(own_sh4, sampling, result.tet_frames) == pytest.approx(result.record["objective"], rel=1e-9)
    start = octafield.frames.random_rotations(problem.meshed.volume().vertex_count, 3)
    again = octafield.run_field(problem, octafield.FieldOptions(representation=own_sh4), start=start)
    assert again.record["objective"] < energy_of(own_sh4, problem.meshed.volume(), start)


def test_an_exception_of_a_scheme_comes_out_of_the_call(problem):
    calls = []

    def failing(frames):
        calls.append(len(frames))
        if len(calls) > 5:
            raise ZeroDivisionError("of the scheme")
        return SH4.embed(frames)

    scheme = EmbeddingScheme("failing", failing)
    with pytest.raises(ZeroDivisionError, match="of the scheme"):
        octafield.run_field(problem, octafield.FieldOptions(representation=scheme))


def test_a_scheme_that_exits_is_no_success(problem):
    left = []

    def leaving(frames):
        left.append(len(frames))
        return SH4.embed(frames) if len(left) < 3 else sys.exit(0)

    with pytest.raises(octafield.InvalidInput, match="'leaving' calls sys.exit"):
        octafield.run_field(problem, octafield.FieldOptions(representation=EmbeddingScheme("leaving", leaving)))


def test_wrong_answers_are_told_with_the_name_of_the_scheme(problem):
    def shrinking(frames):
        return SH4.embed(frames)[: 3 if len(frames) > 3 else None]

    def not_finite(frames):
        return np.where(np.arange(len(frames))[:, None] == 5, np.nan, SH4.embed(frames))

    def too_large(frames):
        return 1e200 * SH4.embed(frames)

    for function, message in (
        (shrinking, r"'odd'.*expected an array of shape \(\d+, 9\)"),
        (not_finite, "row 5"),
        (too_large, "'odd'.*smaller numbers"),
    ):
        scheme = EmbeddingScheme("odd", function)
        with pytest.raises(octafield.InvalidInput, match=message):
            octafield.run_field(problem, octafield.FieldOptions(representation=scheme))


@pytest.mark.parametrize(
    ("make", "message"),
    [
        (lambda: EmbeddingScheme("sh4", SH4.embed), "choose another name"),
        (lambda: EmbeddingScheme("a/b", SH4.embed), "begins with a letter"),
        (lambda: EmbeddingScheme("mine", 3), "must be a function"),
        (lambda: EmbeddingScheme("mine", lambda q: q[:, 0]), r"shape \(3,\)"),
        (lambda: EdgeScheme("mine", lambda p, q: q[:1] - p[:1]), r"shape \(1, 4\)"),
        (lambda: EmbeddingScheme("mine", SH4.embed, colour="green"), "#rrggbb"),
        (lambda: EmbeddingScheme("m" * 65, SH4.embed), "64 at most"),
        (
            lambda: EmbeddingScheme("mine", lambda q: [[0] * (k + 1) for k in range(len(q))]),
            "'mine': embed gave no array",
        ),
        (lambda: EmbeddingScheme("mine", SH4.embed, differential="x"), "differential must be a function"),
        (lambda: octafield.FieldOptions(representation="mine.py"), "not FILE.py:NAME"),
        (lambda: octafield.compute_field(generate("box"), by_lbfgs), "trust region"),
        (lambda: octafield.FieldOptions(representation=lambda q: q), "is not one of"),
    ],
)
def test_unfit_schemes_are_refused(make, message):
    with pytest.raises(octafield.InvalidInput, match=message):
        make()


def test_schemes_in_files_are_named_by_file_and_name(tmp_path, capsys):
    word = f"{IDEAS}:bump_scheme"
    assert octafield.FieldOptions(representation=word).scheme_name == "bumps"
    bad = tmp_path / "bad.py"
    bad.write_text("x = 1\nraise ValueError('no luck')\n")
    (tmp_path / "ends.py").write_text("import sys\n\nsys.exit()\n")
    (tmp_path / "leans.py").write_text("import ends\n")
    for text, error, message in (
        (f"{bad}:scheme", octafield.InvalidInput, "bad.py:2: the file fails: ValueError: no luck"),
        (f"{tmp_path}/ends.py:scheme", octafield.InvalidInput, "ends.py:3: the file fails: SystemExit"),
        (f"{tmp_path}/leans.py:scheme", octafield.InvalidInput, "stands alone.*of ends.py in"),
        (f"{tmp_path}/none.py:scheme", octafield.IoError, "none.py: cannot read"),
        (f"{IDEAS}:nothing", octafield.InvalidInput, "schemes in it: bump_scheme, capped_scheme"),
        (f"{IDEAS}:bumps", octafield.InvalidInput, "no EmbeddingScheme"),
    ):
        with pytest.raises(error, match=message):
            octafield.FieldOptions(representation=text)
    own = tmp_path / "mine.py"
    own.write_text("import octafield\ns = octafield.volume.EmbeddingScheme('a', octafield.frames.sh4_embed)\n")
    assert octafield.FieldOptions(representation=f"{own}:s").scheme_name == "a"
    own.write_text("print('hello')\n" + own.read_text().replace("'a'", "'b'"))
    assert octafield.FieldOptions(representation=f"{own}:s").scheme_name == "b"
    assert capsys.readouterr().out == ""  # standard output is the document of --json


def test_schemes_of_modules_pickle():
    assert pickle.loads(pickle.dumps(ideas.bump_scheme)) == ideas.bump_scheme
    options = octafield.volume.SmoothOptions(representation=ideas.capped_scheme)
    again = pickle.loads(pickle.dumps(options))
    assert again.representation == ideas.capped_scheme and "capped" in repr(again)


def test_a_comparison_ranks_by_energies_of_ones_own(tmp_path):
    options = octafield.FieldOptions(edge_length=0.5, max_iterations=20)
    found = octafield.compare(
        generate("ball"),
        tmp_path / "out",
        representations=["sh4", ideas.bump_scheme],
        boundaries=["fixed"],
        energies=[ideas.bump_scheme, ideas.singular_length],
        options=options,
    )
    by_name = {row["representation"]: row for row in found.rows}
    assert by_name["bumps"]["energies"]["bumps"] < by_name["sh4"]["energies"]["bumps"]
    assert by_name["bumps"]["energies"]["bumps"] == pytest.approx(by_name["bumps"]["objective"], rel=1e-9)
    assert by_name["sh4"]["energies"]["singular_length"] == by_name["sh4"]["singular_length"]
    table = (tmp_path / "out" / "tables" / "energies.csv").read_text().splitlines()
    assert [line.split(",")[1] for line in table] == ["method", "bumps", "sh4"]
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "Energies of one's own" in html.unescape(page)
    for energies, message in (
        ([lambda result: 1.0, lambda result: 2.0], "two energies"),
        (["sh4"], "is no energy"),
        ([lambda result: float("nan")], "must be finite"),
    ):
        with pytest.raises(octafield.InvalidInput, match=message):
            octafield.compare(
                generate("ball"), tmp_path / "no", representations=["sh4"], energies=energies, options=options
            )


def test_names_of_energies_are_text_on_the_page_and_two_schemes_of_one_name_are_refused(tmp_path):
    def energy(result):
        return 1.0

    energy.__name__ = "<script>alert(1)</script>"
    options = octafield.FieldOptions(edge_length=0.6, max_iterations=1)
    octafield.compare(generate("box"), tmp_path / "out", representations=["sh4"], energies=[energy], options=options)
    page = (tmp_path / "out" / "report.html").read_text(encoding="utf-8")
    assert "<script>alert" not in page and html.escape(energy.__name__) in page
    twins = [EmbeddingScheme("twin", SH4.embed), EmbeddingScheme("twin", lambda q: 2 * SH4.embed(q))]
    with pytest.raises(octafield.InvalidInput, match="'twin' is there twice.*different names"):
        octafield.compare(generate("box"), tmp_path / "no", representations=twins, options=options)


def test_a_study_runs_schemes_in_files_and_knows_when_they_change(tmp_path):
    (tmp_path / "mine.py").write_text(IDEAS.read_text(encoding="utf-8"), encoding="utf-8")
    text = """
name: ideas
inputs: [{generator: ball}]
mesh: {edge_length: 0.6}
runs: {representation: [sh4, "mine.py:bump_scheme"], max_iterations: 3}
"""
    (tmp_path / "study.yaml").write_text(text)
    described = study.load(tmp_path / "study.yaml")
    before = [run.key for run in study.plan(described)]
    study.run(described, tmp_path / "out")
    rows = study.rows(tmp_path / "out")
    assert sorted(row["representation"] for row in rows) == ["bumps", "sh4"]
    (tmp_path / "mine.py").write_text(IDEAS.read_text(encoding="utf-8") + "\n# changed\n", encoding="utf-8")
    after = [run.key for run in study.plan(study.load(tmp_path / "study.yaml"))]
    assert before[0] == after[0] and before[1] != after[1]


def test_the_command_line_takes_schemes_in_files(tmp_path):
    from octafield.command_line.fields import app
    from typer.testing import CliRunner

    octafield.write_surface(generate("ball"), tmp_path / "ball.off")
    words = ["compare", str(tmp_path / "ball.off"), "-o", str(tmp_path / "out"), "--edge-length", "0.6", "--boundaries"]
    words += ["fixed", "--representations", f"sh4,{IDEAS}:capped_scheme", "--energy", f"{IDEAS}:singular_length"]
    done = CliRunner().invoke(app, words)
    assert done.exit_code == 0, done.output
    rows = json.loads((tmp_path / "out" / "results.json").read_text())
    assert [row["representation"] for row in rows] == ["sh4", "capped"]
    assert all(row["energies"]["singular_length"] == row["singular_length"] for row in rows)
    missing = CliRunner().invoke(app, ["field", str(tmp_path / "ball.off"), "-o", "x", "--representation", "no.py:x"])
    assert missing.exit_code != 0 and not Path("x").exists()
