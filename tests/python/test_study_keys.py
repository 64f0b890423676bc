"""Which runs a description stands for, and the keys by which they are known again."""

import hashlib
import importlib
import json
import math
from dataclasses import FrozenInstanceError, replace

import pytest
from octafield import study
from octafield.errors import InvalidInput
from octafield.study.plan import Run, has_promised_content

PLAN = importlib.import_module("octafield.study.plan")  # the package has a function of that name

# What a key is the hash of: options as they were when studies began. A new option goes to plan._LATER with the value
# that leaves old runs as they were.
BEGAN = {
    "boundary": "aligned", "edge_length": 0.0, "feature_angle": math.radians(40),
    "feature_tolerance": math.radians(20), "features": "default",
    "interfaces": True, "max_iterations": 200, "remesh": True, "repair": False, "representation": "sh4", "rounds": 2,
    "sampling": "vertices", "seed": 0,
    "solver": "default", "split": False, "streamlines": 30, "tolerance": 1e-06,
}  # fmt: skip
KEYS = {
    "{}": "29cc8387ceaf8d4f4414",
    "{runs: {representation: [su2]}}": "bca2c44fe05ac37b64b7",
    "{runs: {solver: [lbfgs], boundary: [fixed]}, seeds: [3]}": "59a22a2ef6a8f8bb2b3d",
    "{mesh: {edge_length: 0.25, feature_angle: 30}}": "4c3686d517302a60365f",
    "{runs: {sampling: [tets]}, mesh: {split: true}}": "12f4fba20886913d4439",
    "{runs: {sizes: [axes]}}": "3020c8e6db627320116c",
}
WORDS = {"default": False, "safe": True, "resolve": "resolve"}  # of repair, as keys have had them


@pytest.mark.parametrize("text", KEYS)
def test_keys_of_runs_are_what_they_were(monkeypatch, text):
    """Frozen: another key computes again what a study has, and loses it from its tables."""
    monkeypatch.setattr(PLAN, "octafield_version", lambda: "0.2.0")
    (run,) = study.plan(study.parse("{name: k, inputs: [{generator: box}], " + text[1:]))
    assert run.key == KEYS[text]


def test_a_key_is_the_hash_of_content_options_repeat_and_version(monkeypatch):
    monkeypatch.setattr(PLAN, "octafield_version", lambda: "0.2.0")
    first, second = study.plan(study.parse("{name: k, inputs: [{generator: box}], repeats: 2}"))
    content = json.dumps({"generator": "box", "with": {}})
    for repeat, run in enumerate((first, second)):
        hashed = hashlib.sha256(json.dumps([content, BEGAN, repeat, "0.2.0"], sort_keys=True).encode())
        assert run.key == hashed.hexdigest()[:20]
    assert has_promised_content(second)
    for word, value in WORDS.items():
        (run,) = study.plan(study.parse(f"{{name: k, inputs: [{{generator: box}}], mesh: {{repair: {word}}}}}"))
        text = json.dumps([content, BEGAN | {"repair": value}, 0, "0.2.0"], sort_keys=True)
        assert run.options.repair == word and run.key == hashlib.sha256(text.encode()).hexdigest()[:20]
    monkeypatch.setattr(PLAN, "octafield_version", lambda: "0.2.1")
    assert not has_promised_content(second)


def test_runs_are_values_that_take_one_thread_each():
    (run,) = study.plan(study.parse("{name: k, inputs: [{generator: box}]}"))
    assert run.options.threads == 1 and replace(run) == run != replace(run, repeat=1)
    (other,) = study.plan(study.parse("{name: k, inputs: [{generator: box}]}"), threads=3)
    assert other.options.threads == 3 and other.key == run.key
    with pytest.raises(FrozenInstanceError):
        run.repeat = 2


@pytest.mark.parametrize("count", [10, 11])
def test_a_rule_for_no_input_names_the_first_ten_there_are(count):
    boxes = ", ".join(["{generator: box}"] * count)
    names = sorted(["box", *(f"box {k}" for k in range(2, count + 1))])
    with pytest.raises(InvalidInput) as error:
        study.plan(study.parse(f"{{name: k, inputs: [{boxes}], skip: [{{input: ball}}]}}"))
    assert str(error.value).endswith("there are: " + ", ".join(names[:10]) + (" ..." if count > 10 else ""))


def test_runs_are_grouped_by_mesh_and_cross_field_and_come_back_from_json():
    text = (
        "{name: k, inputs: [{generator: box}, {generator: ball}], runs: {representation: [sh4, su2], sampling:"
        " [vertices, tets]}, seeds: 2}"
    )
    runs = study.plan(study.parse(text))
    assert [Run.from_json(json.loads(json.dumps(run.to_json()))) for run in runs] == runs
    groups = PLAN.groups(runs)
    assert sum(groups, []) == runs and [{(run.name, run.options.seed) for run in group} for group in groups] == [
        {(name, seed)} for name in ("box", "ball") for seed in (0, 1)
    ]
    assert len({PLAN.mesh_of(run) for run in runs}) == 2
    (finer,) = study.plan(study.parse("{name: k, inputs: [{generator: box}], mesh: {edge_length: 0.2}}"))
    assert PLAN.mesh_of(finer) != PLAN.mesh_of(runs[0]) and finer.group != runs[0].group
    assert has_promised_content(replace(runs[0], source="no such file")) is False
    skipping = text[:-1] + ", skip: [{input: INPUT, representation: su2}]}"
    assert len(study.plan(study.parse(skipping.replace("INPUT", "b*x")))) == len(runs) - 4
    with pytest.raises(InvalidInput, match="no input is called 'cube'; there are: ball, box"):
        study.plan(study.parse(skipping.replace("INPUT", "cube")))


def write_text(path, text):
    path.write_text(text)
    return path


def test_files_of_a_glob_are_runs_in_their_order_named_by_their_stems(tmp_path):
    for name in ("b.tet.stl", "a.stl.gz", "deep/er/a.stl", "deep/c.stl"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text(name)
    (tmp_path / "folder.stl").mkdir()
    described = lambda text: study.load(write_text(tmp_path / "k.yaml", text))
    runs = study.plan(described("{name: k, inputs: ['**/*.stl*', {file: b.tet.stl}]}"))
    assert [(run.name, run.source) for run in runs] == [
        (name, str(tmp_path / path))
        for name, path in (("a", "a.stl.gz"), ("b.tet", "b.tet.stl"), ("c", "deep/c.stl"), ("a 2", "deep/er/a.stl"))
    ]
    assert all(has_promised_content(run) for run in runs)
    (tmp_path / "b.tet.stl").write_text("other")
    assert not has_promised_content(runs[1])
    with pytest.raises(InvalidInput, match=f"no.stl: no such file under {tmp_path}"):
        study.plan(described("{name: k, inputs: [no.stl]}"))
