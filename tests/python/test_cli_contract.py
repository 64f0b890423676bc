"""What scripts rely on: JSON from every command, errors as JSON, nearest names, completion in the shell."""

import json
import os
import re
import subprocess
import sys

import command_server
import pytest
from octafield.command_line import fields as cli
from octafield.command_line.shell_completion import lists, words
from pipeline_fixtures import octafield, write_cube
from typer.testing import CliRunner

COMMANDS = (["field"], ["surface-field"], ["compare"], ["info"], ["view"], ["representations"], ["doctor"],
            ["study", "run"], ["study", "resume"], ["study", "status"], ["study", "report"])  # fmt: skip


def all_commands():
    """As typer knows them: ones that are added later too."""
    found = []
    for name, command in typer_group().commands.items():
        inner = getattr(command, "commands", None)
        found += [[name, sub] for sub in inner] if inner else [[name]]
    return found


def typer_group():
    import typer.main

    return typer.main.get_command(cli.app)


def test_every_command_is_known_here():
    assert [command for command in COMMANDS if command not in all_commands()] == []


@pytest.mark.parametrize("command", all_commands(), ids=" ".join)
def test_every_command_takes_json_quiet_and_verbose(command):
    found = typer_group()
    for name in command:
        found = found.commands[name]
    options = {option for parameter in found.params for option in parameter.opts}
    assert {"--json", "-q", "-v"} <= options


@pytest.mark.parametrize("command", [[], ["study"], *all_commands()], ids=" ".join)
def test_help_fits_80_columns_and_nothing_is_cut(command):
    found = typer_group()
    for name in command:
        found = found.commands[name]
    text = CliRunner().invoke(cli.app, [*command, "--help"], env={"COLUMNS": "80"}).stdout
    assert max(map(len, text.splitlines())) <= 80
    assert not re.search(r"\u2026|\w\.\.\.", text)
    flat = " ".join(text.split())
    shown = [*getattr(found, "commands", {})]
    for parameter in found.params:
        assert not parameter.opts[0].startswith("-") or parameter.help or parameter.name == "help", parameter.name
        shown += [
            *(o for o in (*parameter.opts, *parameter.secondary_opts) if o.startswith("-")),
            *([parameter.metavar] if parameter.metavar else []),
        ]
        shown += [" ".join((getattr(parameter, "help", None) or "").split())]
    assert [word for word in shown if word not in flat] == []


def test_help_tells_odeco_from_odeco_lengths():
    text = " ".join(CliRunner().invoke(cli.app, ["field", "--help"], env={"COLUMNS": "80"}).stdout.split())
    assert "odeco: fourth-order tensors whose axes have length 1; odeco_lengths: their lengths are unknown" in text


@pytest.fixture(scope="module")
def results(tmp_path_factory):
    folder = tmp_path_factory.mktemp("results")
    cube = write_cube(folder)
    octafield("field", cube, "-o", folder / "field", "--edge-length", "0.5", "-q", check=0)
    (folder / "s.yaml").write_text("{name: one, inputs: [{generator: box}], mesh: {edge_length: 0.5}}\n")
    octafield("study", "run", folder / "s.yaml", "-o", folder / "study", "--json", folder / "run.json", "-q", check=0)
    return folder


def test_view_and_the_commands_of_studies_write_json(results, tmp_path):
    record = json.loads(octafield("view", results / "field", "-o", tmp_path / "c.png", "--json", "-", check=0).stdout)
    assert record == {
        "folder": str(results / "field"),
        "files": ["surface.vtp", "singular.vtp"],
        "picture": str(tmp_path / "c.png"),
    }
    status = json.loads(octafield("study", "status", results / "study", "--json", "-", check=0).stdout)
    report = json.loads(octafield("study", "report", results / "study", "--json", "-", check=0).stdout)
    run = json.loads((results / "run.json").read_text())
    assert status == {key: value for key, value in report.items() if key != "report"} and status["done"] == 1
    assert (results / "study" / "report.html").samefile(report["report"]) and run["runs"] == status["runs"]


@pytest.mark.parametrize("arguments, kind, told", [
    (["info", "absent.stl"], "", "absent.stl"),
    (["field", "absent.stl", "-o", "x"], "missing", "absent.stl"),
    (["field", "CUBE", "-o", "x", "--representation", "sh5"], "unknown_option_value", "did you mean 'sh4'?"),
    (["compare", "CUBE", "-o", "x", "--boundaries", "fix"], "unknown_option_value", "did you mean 'fixed'?"),
    (["surface-field", "CUBE", "-o", "x", "--method", "mbi"], "unknown_option_value", "did you mean 'mbo'?"),
    (["study", "status", "nowhere"], "foreign_folder", "not the folder of a study"),
    (["study", "report", "nowhere"], "foreign_folder", "not the folder of a study"),
    (["view", "nowhere"], "", "no such file"),
    (["field", "CUBE", "-o", "x", "--seed", "two"], "usage", "--seed"),
    (["field", "CUBE"], "usage", "--output"),
    (["info"], "usage", "INPUT"),
    (["fild", "CUBE"], "usage", "Did you mean 'field'?"),
])  # fmt: skip
def test_errors_are_one_line_on_stderr_and_one_document(arguments, kind, told, tmp_path):
    arguments = [str(write_cube(tmp_path)) if word == "CUBE" else word for word in arguments]
    target = tmp_path / "error.json"
    done = octafield(*arguments, "--json", target, check=2)
    assert done.stdout == "" and len(done.stderr.splitlines()) == 1 and told in done.stderr
    document = json.loads(target.read_text())
    if arguments[0] == "info" and len(arguments) > 1:  # whose document it is
        assert not document["ok"] and told in document["requirements"][0]["message"]
        return
    error = document["error"]
    assert list(document) == ["error"] and set(error) == {"type", "kind", "message", "elements", "exit_code"}
    assert (
        error["exit_code"] == 2
        and error["kind"] == kind
        and " ".join(error["message"].split()) in done.stderr
        or kind == "usage"
    )
    on_stdout = octafield(*arguments, "--json", "-", check=2)
    assert json.loads(on_stdout.stdout) == document
    assert octafield(*arguments, "--json=-", check=2).stdout == on_stdout.stdout


def test_ids_of_broken_elements_are_in_the_document(tmp_path):
    cube = write_cube(tmp_path)
    cube.write_text("\n".join(cube.read_text().splitlines()[:-1]) + "\n")
    error = json.loads(octafield("field", cube, "-o", tmp_path / "x", "--json", "-", check=2).stdout)["error"]
    assert (error["type"], error["kind"]) == ("GeometryError", "not_closed") and len(error["elements"]) == 8


def test_an_unknown_option_names_the_nearest(tmp_path):
    done = octafield("field", write_cube(tmp_path), "-o", tmp_path / "x", "--representaton", "sh4", check=2)
    assert "Did you mean --representation?" in done.stderr and "octafield field --help" in done.stderr


def test_a_generator_that_is_not_there_names_the_nearest():
    from octafield import InvalidInput
    from octafield.domain.generators import generate

    with pytest.raises(InvalidInput, match="did you mean 'torus'"):
        generate("taurus")
    with pytest.raises(InvalidInput, match="did you mean 'radius'"):
        generate("ball", radios=2)


def test_words_for_completion():
    assert words(("sh4", "su2", "odeco"))("s") == ["sh4", "su2"]
    several = lists(("sh4", "su2", "odeco"), "all")
    assert several("") == ["sh4", "su2", "odeco", "all"]
    assert several("sh4,") == ["sh4,su2", "sh4,odeco"] and several("sh4,o") == ["sh4,odeco"] and several("a") == ["all"]


def completed(*typed: str) -> list[str]:
    """What bash is offered for the last word, by the protocol of its completion function."""
    environment = {
        "_OCTAFIELD_COMPLETE": "complete_bash",
        "COMP_WORDS": " ".join(["octafield", *typed]),
        "COMP_CWORD": str(len(typed)),
    }
    return command_server.run([], 60, environment).stdout.split()


@pytest.mark.parametrize("typed, offered", [
    (["surf"], ["surface-field"]),
    (["study", "r"], ["run", "resume", "report"]),
    (["field", "--repres"], ["--representation"]),
    (
        ["field", "--representation", "su"],
        ["su2", "su2_midpoint", "su2_geodesic", "su2_symmetric", "su2_surface", "su2_frozen"],
    ),
    (["field", "--boundary", ""], ["aligned", "fixed", "none", "start"]),
    (["surface-field", "--method", ""], ["gl", "mbo", "eigen"]),
    (["compare", "--representations", "sh4,te"], ["sh4,tensor4"]),
    (["info", "--features", "f"], ["file"]),
])  # fmt: skip
def test_bash_completes_commands_options_and_values(typed, offered):
    assert sorted(completed(*typed)) == sorted(offered)


def test_the_completion_script_of_bash_loads_and_completes(tmp_path):
    environment = {**os.environ, "_OCTAFIELD_COMPLETE": "source_bash"}
    script = subprocess.run(
        [sys.executable, "-m", "octafield"], env=environment, capture_output=True, text=True, timeout=60
    ).stdout
    function = re.search(r"(_\w+)\(\)", script)[1]
    (tmp_path / "octafield").write_text(f'#!/bin/sh\nexec "{sys.executable}" -m octafield "$@"\n')
    (tmp_path / "octafield").chmod(0o755)
    typed = (
        f"{script}\nCOMP_WORDS=(octafield field --solver t); COMP_CWORD=3; {function} octafield; echo"
        ' "${COMPREPLY[@]}"'
    )
    path = f"{tmp_path}:{os.environ['PATH']}"
    done = subprocess.run(
        ["bash", "-c", typed], env={**os.environ, "PATH": path}, capture_output=True, text=True, timeout=60
    )
    assert done.stdout.split() == ["trust_region"], done.stderr
