"""Exceptions and progress callbacks."""

import pickle
import threading

import numpy as np
import octafield as of
import pytest

SUBCLASSES = [of.InvalidInput, of.GeometryError, of.SolverError, of.IoError, of.Cancelled]


@pytest.mark.parametrize("cls", [of.Error, *SUBCLASSES])
def test_errors_carry_kind_and_elements(cls):
    error = cls("what was wrong", "some_kind", [3, 4])
    assert isinstance(error, of.Error) and str(error) == "what was wrong"
    assert error.kind == "some_kind" and error.elements == [3, 4]
    assert cls("no more").kind == "" and cls("no more").elements == []
    again = pickle.loads(pickle.dumps(error))
    assert type(again) is cls and (str(again), again.kind, again.elements) == (str(error), error.kind, error.elements)
    assert cls.__module__ == "octafield" and cls.__doc__


def test_errors_are_also_the_usual_python_ones():
    assert issubclass(of.InvalidInput, ValueError) and issubclass(of.IoError, OSError)


def test_a_callback_that_says_nothing_goes_on(box, box_problem):
    _, _, constraints, start = box_problem
    assert of.volume.smooth(box, constraints, start, progress=lambda *_: None).frames.shape == start.shape


def test_an_exception_in_a_callback_comes_out_as_it_is(box, box_surface, box_features, box_problem):
    class Unlike(Exception):
        pass

    def fail(phase, fraction, merit):
        raise Unlike(phase)

    _, _, constraints, start = box_problem
    for call in (
        lambda: of.volume.smooth(box, constraints, start, progress=fail),
        lambda: of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features), progress=fail),
        lambda: of.surface.remesh(box_surface, box_features, progress=fail),
    ):
        with pytest.raises(Unlike) as caught:
            call()
        assert caught.value.args[0]


def test_a_callback_of_the_wrong_kind_is_refused(box_surface, box_features):
    with pytest.raises(TypeError):
        of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features), progress=3)
    with pytest.raises(TypeError):
        of.surface.direction_field(of.surface.SurfaceDomain(box_surface, box_features), progress=lambda: None)


def test_where_there_is_no_best_state_stopping_raises(box_surface, box_features):
    with pytest.raises(of.Cancelled):
        of.surface.remesh(box_surface, box_features, progress=lambda *_: False)


def test_calls_work_from_other_threads_at_the_same_time():
    frames = of.frames.random_rotations(200000, 1)
    expected = of.frames.sh4_embed(frames)
    results = [None] * 4

    def work(i):
        results[i] = of.frames.sh4_embed(frames, threads=1)

    threads = [threading.Thread(target=work, args=(i,)) for i in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert all(np.array_equal(result, expected) for result in results)


def test_other_threads_run_during_a_call():
    counts = []
    stop = threading.Event()

    def tick():
        while not stop.wait(0.001):
            counts.append(1)

    vectors = of.frames.su2_embed(of.frames.random_rotations(5000, 1))
    ticker = threading.Thread(target=tick)
    ticker.start()
    before = len(counts)
    of.frames.su2_project(vectors)
    during = len(counts) - before
    stop.set()
    ticker.join()
    assert during > 10
