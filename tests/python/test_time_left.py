"""Estimates of the time left are near the truth early, do not jump, and cost logs few lines."""

import math
import random

import octafield
import pytest
from octafield.command_line.console import PlainLines
from octafield.domain.generators import generate
from octafield.progress import time_left
from octafield.progress.costs import PREPARE, Costs, Forecast


@pytest.mark.parametrize(
    ("seconds", "told"),
    [
        (0, "a few seconds left"), (9, "a few seconds left"), (34, "about 30 s left"), (58, "about 1 min left"),
        (185, "about 3 min left"),
        (23 * 60, "about 25 min left"), (100 * 60, "about 1.5 h left"), (7.4 * 3600, "about 7 h left"),
        (71 * 3600, "about 3 days left"),
    ],
)  # fmt: skip
def test_words_are_as_coarse_as_the_estimate(seconds, told):
    assert time_left.words(seconds) == told
    if seconds > 9:
        assert time_left.words(seconds, most=True) == told.replace("about", "at most")


def test_a_steady_value_counts_down_and_moves_towards_estimates_without_jumps():
    steady = time_left.SteadyTimeLeft()
    assert steady.follow(100, 0) == 100
    assert steady.follow(90, 10) == pytest.approx(90), "an estimate that comes true is followed exactly"
    before = steady.follow(90, 10)
    assert 85 < steady.follow(9000, 10.5) < 160 and before == pytest.approx(90)
    values = [steady.follow(9000, 11 + k) for k in range(60)]
    assert values == sorted(values) and values[-1] == pytest.approx(9000, rel=0.01)
    assert steady.follow(0, 1000) == pytest.approx(0, abs=1e-6)


def test_a_phase_tells_nothing_early_and_follows_its_speed_of_late():
    phase = time_left.PhaseTimeLeft()
    assert phase.at(-1, 0) is None and phase.at(0.0, 0) is None and phase.at(0.5, 0.1) is None
    steps = [(t, 0.02 * t) for t in range(1, 21)] + [
        (20 + t, 0.4 + 0.004 * t) for t in range(1, 60)
    ]  # five times slower after 20 s
    for now, fraction in steps:
        left = phase.at(fraction, now)
        if now == 20:
            assert left == pytest.approx(30, rel=0.1)
    assert left == pytest.approx((1 - steps[-1][1]) / 0.004, rel=0.15)
    assert phase.at(0.0, 80) is None, "a fraction that falls is another pass"


def finished_in_turn(jobs, forecast: Forecast, seconds_of) -> list[tuple[float, float | None, float]]:
    """(now, estimate, truth) after each group, one at a time."""
    now, seen, total = 0.0, [], sum(seconds_of(m, mesh) for mesh, methods in jobs for m in (PREPARE, *methods))
    for number, (mesh, methods) in enumerate(jobs):
        forecast.add(number, mesh, methods)
    for number, (mesh, methods) in enumerate(jobs):
        forecast.begins(number, now)
        for method in (PREPARE, *methods):
            seconds = seconds_of(method, mesh)
            now += seconds
            if method == PREPARE:
                forecast.costs.saw_tets(mesh, int(1000 * mesh))
            forecast.step_done(number, seconds, now)
        seen.append((now, forecast.left(now), total - now))
    return seen


def test_where_cost_grows_with_tets_the_estimate_after_a_third_is_within_a_third():
    choose = random.Random(1)
    meshes = [math.exp(choose.uniform(0, 6)) for _ in range(40)]  # thousands of tets, over a range of 400
    rate = {
        PREPARE: 0.02,
        "sh4": 0.05,
        "geodesic": 0.9,
        "odd_one": 3.0,
    }  # seconds per thousand tets, not those built in
    for known_by in ("size of file", "tets"):
        forecast = Forecast(Costs())
        for mesh in meshes:
            if known_by == "tets":
                forecast.costs.saw_tets(mesh, int(1000 * mesh))
            forecast.costs.saw_file(mesh, int(75_000 * mesh))
        seen = finished_in_turn(
            [(mesh, ["sh4", "geodesic", "odd_one"]) for mesh in meshes],
            forecast,
            lambda method, mesh: rate[method] * mesh,
        )
        total = seen[-1][0]
        later = [(estimate, truth) for now, estimate, truth in seen if total / 3 <= now < 0.97 * total]
        assert len(later) > 5 and all(estimate == pytest.approx(truth, rel=0.3) for estimate, truth in later), known_by
    assert seen[-1][1] == 0


def test_machines_share_the_work_and_the_longest_group_counts():
    forecast = Forecast(Costs(), slots=4)
    assert forecast.left(0) is None
    for mesh in range(9):
        forecast.costs.saw_tets(mesh, 1_000_000)
    forecast.costs.finished("sh4", 0, 100.0)
    forecast.costs.finished(PREPARE, 0, 20.0)
    for number in range(8):
        forecast.add(number, number, ["sh4"])
    assert forecast.left(0) == pytest.approx(240, rel=0.1)
    forecast.slots = 100
    assert forecast.left(0) == pytest.approx(120, rel=0.1)
    forecast.begins(3, 0)
    assert forecast.left(15) == pytest.approx(120, rel=0.1)


def test_failed_runs_and_clocks_that_go_backwards_do_not_spoil_rates_and_limits_bound_them():
    costs = Costs(limit=50)
    costs.saw_tets("m", 1_000_000)
    costs.finished("sh4", "m", 30.0)
    before = costs.expected("sh4", "m")
    costs.finished("sh4", "m", -5.0)
    costs.finished("sh4", "m", math.nan)
    assert costs.expected("sh4", "m") == before == pytest.approx(30, rel=0.2)
    assert costs.expected("su2_midpoint", "m") == 50


def test_logs_get_a_line_now_and_then():
    lines, now = [], [0.0]
    report = PlainLines(lines.append, whole=False, clock=lambda: now[0])
    for now[0] in range(1, 3601):
        assert report("smooth", now[0] / 4000, 1.0)
    assert 5 < len(lines) < 25
    assert lines[0] == "smooth, 0% of the most steps"
    assert lines[-1].startswith("smooth, 8") and "min left" in lines[-1]
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
    assert all(what.startswith(f"{4 * fraction:.0f} of 4") for what, fraction in counted)
    assert all(" left: " in what for what, fraction in counted if fraction > 0)


def test_a_comparison_that_is_told_to_stop_leaves_nothing(tmp_path):
    with pytest.raises(octafield.Cancelled):
        octafield.compare(
            generate("box"),
            tmp_path / "out",
            representations=["sh4"],
            progress=lambda what, fraction, merit: " of 2" not in what,
        )
    assert not (tmp_path / "out").exists()
