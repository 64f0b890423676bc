"""The time left is told of phases and of whole works, and costs logs few lines."""

import math
import re

import octafield
import pytest
from octafield.command_line.console import PlainLines
from octafield.domain.generators import generate


@pytest.mark.parametrize("whole", [True, False])
def test_a_whole_work_is_judged_by_all_that_is_done_and_a_phase_by_its_pace_of_late(whole):
    """Five runs of 100 s each, then five of 300 s; as one phase at the same pace."""
    said, now = [], [0.0]
    report = PlainLines(lambda line: said.append((now[0], line)), whole, clock=lambda: now[0])
    for now[0] in range(1, 2000):
        share = now[0] / 1000 if now[0] <= 500 else 0.5 + (now[0] - 500) / 3000
        report("ball", math.floor(10 * share + 1e-9) / 10 if whole else share, math.nan)
    told = {at: re.search(r" (about|at most) (\d+):(\d+):(\d+) left$", line) for at, line in said}
    assert bool(told[10]) != whole, "nothing is known before two runs are done"
    for at, found in told.items():
        if 550 < at < 1800:
            assert found and found[1] == ("about" if whole else "at most")
            left = sum(60**k * int(found[4 - k]) for k in range(3))
            assert left == pytest.approx(2000 - at, rel=0.7 if whole else 0.01)


def test_a_phase_of_unknown_length_and_the_end_tell_nothing():
    lines, now = [], [0.0]
    report = PlainLines(lines.append, whole=False, clock=lambda: now[0])
    for phase, fraction in [("read", -1.0)] * 40 + [("smooth", 1.0)] * 40:
        now[0] += 10
        report(phase, fraction, math.nan)
    assert lines and not any("left" in line for line in lines)


def test_logs_get_a_line_now_and_then():
    lines, now = [], [0.0]
    report = PlainLines(lines.append, whole=False, clock=lambda: now[0])
    for now[0] in range(1, 3601):
        assert report("smooth", now[0] / 4000, 1.0)
    assert 5 < len(lines) < 25
    assert lines[0] == "smooth, 0% of the most steps, at most 1:06:30 left"
    assert lines[-1].startswith("smooth, 8") and lines[-1].endswith(" left")
    short = []
    report = PlainLines(short.append, whole=False, clock=lambda: 0.0)
    report("read", -1.0, math.nan)
    assert short == []


def test_a_comparison_counts_its_runs_and_tells_what_is_left_of_all(tmp_path):
    told: list[tuple[str, float]] = []
    octafield.compare(
        generate("cylinder"), tmp_path / "out", representations=["sh4", "su2"], boundaries=["aligned"], seeds=2,
        options=octafield.FieldOptions(edge_length=0.5), progress=lambda what, fraction,
        merit: told.append((what, fraction)),
    )  # fmt: skip
    counted = [(what, fraction) for what, fraction in told if " of 4" in what]
    assert [fraction for _, fraction in counted] == sorted(fraction for _, fraction in counted)
    assert {fraction for _, fraction in counted} == {0, 0.25, 0.5, 0.75}
    assert all(what.startswith(f"{4 * fraction:.0f} of 4: ") for what, fraction in counted)


def test_a_comparison_that_is_told_to_stop_leaves_nothing(tmp_path):
    with pytest.raises(octafield.Cancelled):
        octafield.compare(
            generate("box"),
            tmp_path / "out",
            representations=["sh4"],
            progress=lambda what, fraction, merit: " of 2" not in what,
        )
    assert not (tmp_path / "out").exists()
