"""Two schemes of one's own, as docs/own_schemes.md shows them: frames as bumps on the sphere, and a distance between
frames that stops to grow."""

# --8<-- [start:bumps]
import numpy as np
from octafield import AnalysedField
from octafield.frames import frame_log, rotation_matrices
from octafield.volume import EdgeScheme, EmbeddingScheme

# A hundred directions, evenly over half the sphere (the other half says the same): a golden spiral.
TURN, HEIGHT = np.pi * (3 - 5**0.5) * np.arange(100), (np.arange(100) + 0.5) / 100
RADIUS = np.sqrt(1 - HEIGHT**2)
DIRECTIONS = np.column_stack([RADIUS * np.cos(TURN), RADIUS * np.sin(TURN), HEIGHT])


def bumps(frames: np.ndarray) -> np.ndarray:
    """(k, 4) quaternions -> (k, 100): a bump round every axis, seen in each direction."""
    cosines = np.einsum("di,kia->kda", DIRECTIONS, rotation_matrices(frames))
    return np.exp(4 * (cosines**2 - 1)).sum(axis=2) / 10


bump_scheme = EmbeddingScheme(
    "bumps", bumps, equation="1/2 sum_c a_c^T L a_c, a(x) = sum_k exp(4 ((x . axis_k)^2 - 1))", colour="#117733"
)
# --8<-- [end:bumps]


# --8<-- [start:capped]
REACH = np.radians(15)


def capped(first: np.ndarray, second: np.ndarray) -> np.ndarray:
    """(k, 4), (k, 4) -> (k, 3): the smallest rotation vector, beyond the reach as long as its square root."""
    w = frame_log(first, second)
    squared = (w**2).sum(axis=1, keepdims=True) / REACH**2
    return w * np.sqrt(2 / (1 + np.sqrt(1 + squared)))  # |.|^2 = 2 REACH^2 (sqrt(1 + |w|^2 / REACH^2) - 1)


capped_scheme = EdgeScheme(
    "capped", capped, equation="sum_ij w_ij 2 s^2 (sqrt(1 + angle_ij^2 / s^2) - 1), s = 15 degrees", colour="#882255"
)
# --8<-- [end:capped]


# --8<-- [start:energy]
def singular_length(result: AnalysedField) -> float:
    """An energy of one's own need not be one that is minimised: the length of the singular curves."""
    return float(result.singular_graph.length)


# --8<-- [end:energy]
