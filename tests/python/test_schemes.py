"""What can be minimised stands in one table of the compiled module; words, costs, memory, colours and the page follow
it.

PYTHONPATH=tests/python python tests/python/test_schemes.py      # brings the table of docs/frame_fields.md up to date
"""

from pathlib import Path

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from octafield.inspect.estimates import field_seconds
from octafield.options import COMPARED, REPRESENTATIONS, SOLVERS, FieldOptions
from octafield.report.page.figures import COLOURS
from octafield.study.memory import needed_mb
from octafield.study.plan import Run

PAGE = Path(__file__).parents[2] / "docs" / "frame_fields.md"
BEGIN, END = "<!-- table of schemes -->\n", "<!-- end of the table -->\n"


def table() -> str:
    lines = [
        "| name | minimised | what it is | consistent | solvers, default first (kB per tet) | CPU s per million tets |",
        "|---|---|---|---|---|---|",
    ]
    for name, scheme in of.volume.schemes.items():
        solvers = ", ".join(f"{solver} ({mb / 1000:g})" for solver, mb in scheme.bytes_per_tet.items())
        seconds = f"{scheme.seconds_per_million_tets:g}" if scheme.seconds_per_million_tets else ""
        consistent = "yes" if scheme.consistent else "no"
        lines.append(f"| `{name}` | {scheme.equation} | {scheme.meaning} | {consistent} | {solvers} | {seconds} |")
    return "\n".join(lines) + "\n"


def test_the_page_has_the_table_as_it_is():
    text = PAGE.read_text(encoding="utf-8")
    assert text.partition(BEGIN)[2].partition(END)[0] == table(), f"run python {Path(__file__).name}"


def test_every_representation_of_a_frame_is_a_scheme_and_others_follow():
    assert list(of.volume.schemes)[: len(of.frames.representations)] == list(of.frames.representations)
    sorts = [scheme.sort for scheme in of.volume.schemes.values()]
    assert sorts.count("embedding") == len(of.frames.representations)
    assert {"embedding_with_lengths", "metric"} == set(sorts[len(of.frames.representations) :])
    assert all(scheme.name == name for name, scheme in of.volume.schemes.items())


@pytest.mark.parametrize("name", of.volume.schemes)
def test_every_scheme_is_an_option_with_each_of_its_solvers(name):
    scheme = of.volume.schemes[name]
    assert name in REPRESENTATIONS and (name in COMPARED) == scheme.compared
    assert scheme.equation and scheme.meaning and "\n" not in scheme.equation
    tets = of.volume.tetrahedralize(generate("box"), edge_length=0.5)
    frames = of.frames.random_rotations(len(tets.vertices), seed=1)
    boundary = of.volume.boundary_surface(tets).vertex_map
    free = of.volume.BoundaryConstraints(
        np.zeros(len(frames), np.uint8), np.zeros((len(frames), 3)), frames, np.zeros(len(frames), np.uint8)
    )
    held = of.volume.with_constraints(
        free, of.volume.VertexConstraints(boundary, ["fixed"] * len(boundary), frames=frames[np.asarray(boundary)])
    )
    for solver in scheme.bytes_per_tet:
        assert FieldOptions(representation=name, solver=solver).solver == solver and solver in SOLVERS
        result = of.volume.smooth(tets, held, frames, representation=name, solver=solver, max_iterations=3)
        assert np.isfinite(result.objective)
    for solver in set(SOLVERS[1:]) - set(scheme.bytes_per_tet):
        with pytest.raises(of.InvalidInput, match=name):
            of.volume.smooth(tets, held, frames, representation=name, solver=solver)


@pytest.mark.parametrize("name", of.volume.schemes)
def test_studies_expect_its_time_and_memory(name):
    scheme = of.volume.schemes[name]
    first = next(iter(scheme.bytes_per_tet.values()))

    def mb(**options):
        return needed_mb(1e6, [Run("", "", "", FieldOptions(representation=name, **options), 0)]) - needed_mb(1e6, [])

    assert mb() == pytest.approx(first)
    for solver, bytes_per_tet in scheme.bytes_per_tet.items():
        assert mb(solver=solver) == pytest.approx(bytes_per_tet)
    assert mb(sampling="tets") == pytest.approx(3.5 * first)
    expected = scheme.seconds_per_million_tets or 100
    assert field_seconds(name, 1e6) - field_seconds(name, 0) == pytest.approx(10 + expected)


def test_colours_differ():
    known = [scheme.colour for scheme in of.volume.schemes.values() if scheme.colour]
    assert len(set(known)) == len(known) == len(COLOURS)


if __name__ == "__main__":
    page = PAGE.read_text(encoding="utf-8")
    before, _, rest = page.partition(BEGIN)
    PAGE.write_text(before + BEGIN + table() + END + rest.partition(END)[2], encoding="utf-8")
