"""Laws of schemes that are functions on arrays of frames."""

from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from .. import _core
from ..domain.generators import generate
from ..domain.meshed_input import MeshedInput
from ..domain.meshing import prepare_mesh
from ..fields.frame_field import prepare_field, run_field
from ..options import FieldOptions, MeshOptions
from ..schemes import EdgeScheme, EmbeddingScheme, OwnScheme

Float64s = NDArray[np.float64]
_STEP = 1e-3  # radians


def some_frames() -> Float64s:
    """(k, 4): random ones, and those where formulas break: half turns, turns by 45 degrees, about axes, diagonals."""
    axes = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, 1, 1], [1, 2, -3]], float)
    axes /= np.linalg.norm(axes, axis=1, keepdims=True)
    angles = np.array([0, np.pi, np.pi / 2, np.pi / 3, np.pi / 4, 1e-9])
    special = _core.quaternion_exp((angles[:, None, None] * axes).reshape(-1, 3))
    return np.vstack([special, _core.random_rotations(50, 7)])


def same_frame(frames: Float64s, k: int) -> Float64s:
    """Other quaternions of the same frames: the k-th rotation of the cube, and the other sign for odd k."""
    own = _core.quaternion_log(_core.octahedral_group()[k : k + 1])[0]
    return (-1 if k % 2 else 1) * _core.frame_exp(frames, _core.rotation_matrices(frames) @ own)


def turned(frames: Float64s, w: Float64s) -> Float64s:
    """exp(w) q."""
    return _core.frame_exp(frames, w[None])


def central_differences(function: Callable[[Float64s], Float64s]) -> Float64s:
    """(k, d, 3) of function(w) by the rotation vector w (3,) at 0, fourth order."""
    columns = []
    for axis in np.eye(3) * _STEP:
        near, far = function(axis) - function(-axis), function(2 * axis) - function(-2 * axis)
        columns.append((8 * near - far) / (12 * _STEP))
    return np.stack(columns, axis=-1)


class _Laws(ABC):
    scheme: ClassVar[OwnScheme]
    tolerance: ClassVar[float] = 1e-9

    @abstractmethod
    def values(self, frames: Float64s) -> Float64s:
        """(k, d) of (k, 4) frames."""

    @abstractmethod
    def derivatives(self, frames: Float64s) -> list[tuple[str, Float64s, Float64s]]:
        """(by what, given, differences)"""

    def assert_same(self, a: Float64s, b: Float64s, what: str) -> None:
        a, b = np.asarray(a, float), np.asarray(b, float)
        assert a.shape == b.shape, f"{what}: shapes {a.shape} and {b.shape}"
        difference = np.abs(a - b).reshape(len(a), -1).max(axis=1)
        worst = int(difference.argmax())
        limit = self.tolerance * max(1.0, float(np.abs(a).max()))
        assert difference[worst] <= limit, f"{what}: row {worst} differs by {difference[worst]:.3g}"

    def test_values_are_finite_real_numbers(self) -> None:
        values = np.asarray(self.values(some_frames()))
        assert values.dtype.kind in "fiu", f"dtype {values.dtype}"
        bad = np.flatnonzero(~np.isfinite(values).all(axis=1))
        assert not len(bad), f"not finite for the quaternions {some_frames()[bad[:3]].tolist()}"

    def test_rows_do_not_depend_on_one_another(self) -> None:
        frames = some_frames()
        alone = np.vstack([self.values(frames[k : k + 1]) for k in range(len(frames))])
        self.assert_same(self.values(frames), alone, "all frames at once and one by one")

    def test_arguments_are_left_as_they_are(self) -> None:
        frames = some_frames()
        self.values(frames)
        assert np.array_equal(frames, some_frames()), "the function writes into its argument"

    def test_differential_is_the_derivative(self) -> None:
        for what, given, differences in self.derivatives(_core.random_rotations(40, 3)):
            error = np.abs(given - differences).max() / max(1.0, float(np.abs(differences).max()))
            assert error < 1e-5, f"differential {what} is off by {error:.3g} of its size"

    def test_energy_of_one_frame_everywhere_is_zero(self) -> None:
        ball = _ball()
        frames = np.tile(_core.random_rotations(1, 5), (ball.volume().vertex_count, 1))
        frames = np.vstack([same_frame(frames[k : k + 1], k % 24) for k in range(len(frames))])
        one = _core.scheme_energy(self.scheme, ball.volume(), frames)
        mixed = _core.scheme_energy(self.scheme, ball.volume(), _core.random_rotations(len(frames), 1))
        assert one <= 1e-12 * mixed, f"one frame everywhere, written by different quaternions, has energy {one:.3g}"

    def test_smoothing_lowers_what_is_minimised_and_holds_the_boundary(self) -> None:
        problem = prepare_field(_ball())
        result = run_field(problem, FieldOptions(representation=self.scheme, boundary="fixed", threads=1))
        history = result.record["objective_history"]
        assert history[-1] <= history[0] * (1 + 1e-12), f"objective from {history[0]:.6g} to {history[-1]:.6g}"
        energy = _core.scheme_energy(self.scheme, problem.meshed.volume(), result.frames)
        assert abs(energy - result.record["objective"]) <= 1e-9 * energy, "the objective is not that of the frames"
        held = np.asarray(result.constraints.on_boundary, bool)
        angles = _core.distance(result.frames[held], np.asarray(result.constraints.frames)[held])
        assert np.median(angles) < 1e-6, "frames at the surface are not held"

    def test_threads_change_no_bit(self) -> None:
        problem = prepare_field(_ball())
        one, two = (
            run_field(problem, FieldOptions(representation=self.scheme, threads=threads, max_iterations=3)).frames
            for threads in (1, 2)
        )
        assert np.array_equal(one, two), "results depend on the number of threads"


class EmbeddingLaws(_Laws):
    """scheme: an EmbeddingScheme."""

    scheme: ClassVar[EmbeddingScheme]

    def values(self, frames: Float64s) -> Float64s:
        return np.asarray(self.scheme.embed(frames))

    def derivatives(self, frames: Float64s) -> list[tuple[str, Float64s, Float64s]]:
        if self.scheme.differential is None:
            return []
        differences = central_differences(lambda w: self.values(turned(frames, w)))
        return [("of embed", np.asarray(self.scheme.differential(frames)), differences)]

    def test_one_frame_has_one_vector(self) -> None:
        frames = some_frames()
        for k in range(24):
            self.assert_same(
                self.values(frames), self.values(same_frame(frames, k)), f"the {k}-th rotation of the cube"
            )

    def test_turning_a_frame_moves_its_vector(self) -> None:
        frames = _core.random_rotations(40, 3)
        singular = np.linalg.svd(central_differences(lambda w: self.values(turned(frames, w))), compute_uv=False)
        worst = int(singular[:, -1].argmin())
        assert singular[worst, -1] > 1e-3 * singular.max(), (
            f"the vector stands still when the frame {frames[worst].tolist()} turns about some axis"
        )

    def test_different_frames_have_different_vectors(self) -> None:
        frames, others = _core.random_rotations(2000, 1), _core.random_rotations(2000, 2)
        between = np.linalg.norm(self.values(frames) - self.values(others), axis=1)
        far = np.asarray(_core.distance(frames, others)) > np.radians(10)
        assert between[far].min() > 1e-3 * between.max(), "frames more than 10 degrees apart share a vector"


class EdgeLaws(_Laws):
    """scheme: an EdgeScheme."""

    scheme: ClassVar[EdgeScheme]

    def values(self, frames: Float64s) -> Float64s:
        return self.between(frames, turned(frames, np.array([0.1, -0.05, 0.08])))

    def between(self, first: Float64s, second: Float64s) -> Float64s:
        return np.asarray(self.scheme.residual(first, second))

    def lengths(self, first: Float64s, second: Float64s) -> Float64s:
        return np.asarray(np.linalg.norm(self.between(first, second), axis=1, keepdims=True))

    def derivatives(self, frames: Float64s) -> list[tuple[str, Float64s, Float64s]]:
        if self.scheme.differential is None:
            return []
        others = turned(frames, np.array([0.1, -0.05, 0.08]))
        first, second = (np.asarray(part) for part in self.scheme.differential(frames, others))
        by_first = central_differences(lambda w: self.between(turned(frames, w), others))
        by_second = central_differences(lambda w: self.between(frames, turned(others, w)))
        return [("by the first frame", first, by_first), ("by the second frame", second, by_second)]

    def test_length_is_that_of_the_frames(self) -> None:
        """And 0 between a frame and itself."""
        frames = some_frames()
        others = turned(frames, np.array([0.1, -0.05, 0.08]))
        zero = np.zeros((len(frames), 1))
        for k in range(24):
            which = f"the {k}-th rotation of the cube"
            other = same_frame(frames, k)
            self.assert_same(zero, np.asarray(self.lengths(frames, other)) ** 2, f"a frame and itself, {which}")
            self.assert_same(self.lengths(frames, others), self.lengths(other, others), which)
            self.assert_same(self.lengths(frames, others), self.lengths(frames, same_frame(others, k)), which)

    def test_length_is_the_same_both_ways(self) -> None:
        first, second = _core.random_rotations(500, 1), _core.random_rotations(500, 2)
        self.assert_same(self.lengths(first, second), self.lengths(second, first), "there and back")

    def test_different_frames_have_a_difference(self) -> None:
        first, second = _core.random_rotations(2000, 1), _core.random_rotations(2000, 2)
        lengths = self.lengths(first, second)[:, 0]
        far = np.asarray(_core.distance(first, second)) > np.radians(10)
        assert lengths[far].min() > 1e-3 * lengths.max(), "frames more than 10 degrees apart have no difference"


def _ball() -> MeshedInput:
    return prepare_mesh(generate("ball"), MeshOptions(edge_length=0.6))
