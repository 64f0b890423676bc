"""What a description of a study may say, and where an error in one is."""

import octafield
import pytest
from octafield import study

SOUND = """name: cubes
inputs:
  - generator: box
    with: {x: 2}
  - {generator: ball, mesh: {edge_length: 0.4}}
mesh:
  feature_angle: 30
runs:
  representation: [sh4, geodesic]
  boundary: [aligned, fixed]
  rounds: 1
skip:
  - {representation: geodesic, boundary: fixed}
seeds: [0, 3]
repeats: 2
"""


def test_every_combination_runs_but_those_skipped():
    runs = study.plan(study.parse(SOUND))
    assert len(runs) == 2 * 3 * 2 * 2 == len({run.key for run in runs})
    chosen = {(run.options.representation, run.options.boundary) for run in runs}
    assert chosen == {("sh4", "aligned"), ("sh4", "fixed"), ("geodesic", "aligned")}
    assert {run.options.seed for run in runs} == {0, 3} and {run.repeat for run in runs} == {0, 1}
    assert [name for name in dict.fromkeys(run.name for run in runs)] == ["box x 2", "ball"]
    assert all(run.options.feature_angle == pytest.approx(0.5235987755982988) for run in runs)
    assert {run.options.edge_length for run in runs if run.name == "ball"} == {0.4}


def test_a_key_tells_content_and_options_but_not_names_or_threads(tmp_path, box_surface):
    octafield.write_surface(box_surface, tmp_path / "a.stl")
    octafield.write_surface(box_surface, tmp_path / "b.stl")
    keys = lambda text, **options: [run.key for run in study.plan(study.parse(text, folder=tmp_path), **options)]
    (a,) = keys("{name: x, inputs: [a.stl]}")
    assert keys("{name: y, inputs: [b.stl]}", threads=3) == [a]
    assert keys("{name: y, inputs: ['?.stl']}") == [a], "one content runs once"
    assert keys("{name: x, inputs: [a.stl], mesh: {edge_length: 0.3}}") != [a]
    assert keys("{name: x, inputs: [a.stl], seeds: [1]}") != [a]
    with (tmp_path / "a.stl").open("ab") as file:
        file.write(b"\n")
    assert keys("{name: x, inputs: [a.stl]}") != [a]


def test_skip_names_inputs_and_the_limit_is_not_part_of_keys():
    chosen = lambda text: {(run.name, run.options.representation) for run in study.plan(study.parse(text))}
    text = SOUND.replace(
        "skip:\n", "skip:\n  - {input: ball, representation: sh4}\n  - {input: 'box*', boundary: fixed}\n"
    )
    assert chosen(text) == {("box x 2", "sh4"), ("box x 2", "geodesic"), ("ball", "geodesic")}
    assert chosen(SOUND + "limit: 3\n") == chosen(SOUND)
    assert chosen(SOUND.replace("skip:\n", "skip:\n  - {input: ball}\n")) == {
        ("box x 2", "sh4"),
        ("box x 2", "geodesic"),
    }
    limited, free = (study.plan(study.parse(SOUND + line)) for line in ("limit: 2.5\n", ""))
    assert [run.key for run in limited] == [run.key for run in free]
    line = SOUND.splitlines().index("skip:") + 2
    with pytest.raises(
        octafield.InvalidInput, match=f"^s.yaml:{line}: no input is called 'bal'; there are: ball, box x 2"
    ):
        study.plan(study.parse(SOUND.replace("skip:\n", "skip:\n  - {input: bal}\n"), name="s.yaml"))


def test_files_are_read_again_only_when_they_changed(tmp_path, monkeypatch):
    import os

    from octafield.study import digests

    part = tmp_path / "a.node"
    part.write_text("nodes")
    (tmp_path / "a.ele").write_text("tets")
    read = []
    monkeypatch.setattr(digests, "digest_of", lambda path, real=digests.digest_of: read.append(path) or real(path))
    young = digests.Digests()
    assert young.of(part) == young.of(part) and len(read) == 2 and young.fresh == {}, (
        "it may change again within a tick"
    )
    monkeypatch.setattr(digests, "_TICKS_NS", -(10**12))
    known = digests.Digests()
    first = known.of(part)
    again = digests.Digests(known.fresh)
    assert again.of(part) == first and len(read) == 3 and again.fresh == {}
    was = (tmp_path / "a.ele").stat()
    (tmp_path / "a.ele").write_text("TETS")
    os.utime(tmp_path / "a.ele", ns=(was.st_atime_ns, was.st_mtime_ns))
    assert again.of(part) != first, "a change of the twin of equal length and time of writing"


@pytest.mark.parametrize(
    ("line", "words", "text"),
    [
        (1, "name is missing", "inputs: [a]"),
        (1, "a study is a mapping", "- 3"),
        (2, "at least 1 item", "name: x\ninputs: []"),
        (2, "'name' is given twice", "name: x\nname: y"),
        (3, "an input is a path, or a mapping", "name: x\ninputs:\n- 5"),
        (3, "should be 'ball'", "name: x\ninputs:\n- generator: bal"),
        (3, "no parameter 'radus'", "name: x\ninputs:\n- generator: ball\n  with: {radus: 2}"),
        (3, "must be positive", "name: x\ninputs:\n- generator: ball\n  with: {radius: .nan}"),
        (3, "seedz: no such key; did you mean 'seeds'?", "name: x\ninputs: [a]\nseedz: 3"),
        (3, "mesch: no such key; did you mean 'mesh'?", "name: x\ninputs:\n- {file: a, mesch: {}}"),
        (3, "did you mean 'edge_length'?", "name: x\ninputs: [a]\nmesh: {edge_lenght: 1}"),
        (3, "did you mean 'boundary'?", "name: x\ninputs: [a]\nruns: {bondary: fixed}"),
        (3, "a seed is given twice", "name: x\ninputs: [a]\nseeds: [1, 1]"),
        (3, "1 .. 10000", "name: x\ninputs: [a]\nseeds: 99999999999"),
        (3, "greater than or equal to 1", "name: x\ninputs: [a]\nrepeats: 0"),
        (4, "between 0 and 180 degrees", "name: x\ninputs: [a]\nmesh:\n  feature_angle: 400"),
        (3, "must be true or false", "name: x\ninputs: [a]\nmesh: {split: maybe}"),
        (4, "'sh5' is not one of", "name: x\ninputs: [a]\nruns:\n  representation: [sh4, sh5]"),
        (4, "2 is given twice", "name: x\ninputs: [a]\nruns:\n  rounds: [2, 2]"),
        (4, "must be an integer", "name: x\ninputs: [a]\nruns:\n  rounds: 1.5"),
        (4, "no option 'threads'", "name: x\ninputs: [a]\nruns:\n  threads: 2"),
        (5, "not among the options of runs", "name: x\ninputs: [a]\nruns: {rounds: [1]}\nskip:\n- {solver: lbfgs}"),
        (3, "limit: ", "name: x\ninputs: [a]\nlimit: 0"),
        (3, "limit: ", "name: x\ninputs: [a]\nlimit: .inf"),
        (3, "limit: ", "name: x\ninputs: [a]\nlimit: soon"),
        (3, "folder: no such key", "name: x\ninputs: [a]\nfolder: /tmp"),
        (4, "input is a name or glob", "name: x\ninputs: [a]\nskip:\n- {input: 16}"),
        (1, "in place of an alias", "a: &a [*a]"),
        (2, "nested 21 deep", "name: x\na: " + "[" * 5000 + "]" * 5000),
        (1, "expected", "bad: ["),
        (1, "could not determine a constructor", "name: !!python/object:os.system x"),
    ],
)
def test_an_error_names_its_line(line, words, text):
    with pytest.raises(octafield.InvalidInput) as error:
        study.parse(text, name="s.yaml")
    assert str(error.value).startswith(f"s.yaml:{line}: ") and words in str(error.value), error.value


def test_a_file_that_is_not_there_is_named(tmp_path):
    with pytest.raises(octafield.InvalidInput, match="nothing.stl: no such file"):
        study.plan(study.parse("{name: x, inputs: [nothing.stl]}", folder=tmp_path))
    with pytest.raises(octafield.IoError, match="cannot read the study"):
        study.load(tmp_path / "none.yaml")
    with pytest.raises(octafield.InvalidInput, match="leaves nothing"):
        study.plan(study.parse("{name: x, inputs: [{generator: box}], runs: {rounds: [1]}, skip: [{rounds: 1}]}"))


@pytest.mark.parametrize("name", ["ball", "box", "cylinder", "torus", "nut"])
def test_generated_surfaces_are_closed_and_oriented(name):
    from octafield.domain.generators import GENERATORS, generate

    surface = generate(name)
    octafield.require_valid(surface)
    expected = {"ball": 4.18879, "box": 1, "cylinder": 6.28319, "torus": 3.15827}.get(name)
    if expected:
        assert octafield.surface.signed_volume(surface) == pytest.approx(expected, rel=0.03)
    for parameter in GENERATORS[name].parameters:
        larger = generate(name, **{parameter: 1.2 * GENERATORS[name].parameters[parameter]})
        assert octafield.surface.signed_volume(larger) > 1.1 * octafield.surface.signed_volume(surface)
