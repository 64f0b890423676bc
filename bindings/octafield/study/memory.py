"""Peak memory to expect of the process of a group: fitted to measurements (docs/scaling.md), and at least a quarter
more; and how many tets to expect of a mesh that is not made yet."""

import math
from collections.abc import Hashable

from .. import _core
from ..hexdom.options import HexMeshOptions
from ..options import FieldOptions
from ..schemes import EmbeddingScheme, OwnScheme, minimised
from .plan import Run

_PROCESS_MB = 295.0  # Python, its libraries, small arrays
_TYPICAL_TETS = 50_000.0  # of an input before any is known
_MB_PER_WORKING_TET = 0.0011  # a mesh along the field: tets are cut before, within a budget
_TET_SAMPLING = 3.5  # over frames at vertices: there are five to six times as many tets, but fewer neighbours


def needed_mb(tets: float, runs: list[Run]) -> float:
    """Megabytes (1e6 bytes) of a process that carries out `runs` on so many tets, its mesher included."""
    fields = [_mb_per_tet(run.options) for run in runs]
    meshes = [_MB_PER_WORKING_TET * _working_tets(tets, run.hex_options) for run in runs if run.hex_options]
    return _PROCESS_MB + max([*(tets * mb for mb in fields), *meshes], default=0.0)


def _working_tets(tets: float, options: HexMeshOptions) -> float:
    """The most that there can be."""
    return max(tets, min(8.0**options.refinements * tets, options.most_tets))


def _mb_per_tet(options: FieldOptions) -> float:
    scheme = minimised(options.representation)
    by_solver = _core.schemes[scheme].bytes_per_tet if isinstance(scheme, str) else _of_own_scheme(scheme)
    solver = next(iter(by_solver)) if options.solver == "default" else options.solver
    # A solver that does not go with it is refused by the run itself.
    mb = by_solver.get(solver, max(by_solver.values())) / 1e6
    return mb * (_TET_SAMPLING if options.sampling == "tets" else 1)


def _of_own_scheme(scheme: OwnScheme) -> dict[str, float]:
    """Measured on 94,000 tets: 2,620 bytes for an embedding in 100 dimensions, 1,640 for residuals in 3 (arrays over
    edges)."""
    per_number, least = (25, 300) if isinstance(scheme, EmbeddingScheme) else (500, 500)
    return {"trust_region": least + per_number * scheme.dimension}


class MeshSizes:
    """Tets of inputs: those that were seen, else by the size of the file beside those known, else their mean."""

    def __init__(self) -> None:
        self._tets: dict[Hashable, int] = {}
        self._bytes: dict[Hashable, int] = {}

    def saw_file(self, mesh: Hashable, size: int) -> None:
        self._bytes[mesh] = size

    def saw_tets(self, mesh: Hashable, tets: int) -> None:
        self._tets[mesh] = tets

    def tets(self, mesh: Hashable) -> float:
        if mesh in self._tets:
            return self._tets[mesh]
        if not self._tets:
            return _TYPICAL_TETS
        if mesh not in self._bytes:
            return sum(self._tets.values()) / len(self._tets)
        level, slope = self._fitted()
        return math.exp(level + slope * math.log1p(self._bytes[mesh]))

    def knows(self, mesh: Hashable) -> bool:
        return mesh in self._tets

    def _fitted(self) -> tuple[float, float]:
        """log tets = a + b log bytes: tet meshes grow with their files; surfaces that are remeshed do not."""
        pairs = [
            (math.log1p(self._bytes[mesh]), math.log1p(tets))
            for mesh, tets in self._tets.items()
            if mesh in self._bytes
        ]
        if not pairs:
            return math.log(sum(self._tets.values()) / len(self._tets)), 0.0
        x, y = (sum(column) / len(pairs) for column in zip(*pairs, strict=True))
        variance = sum((a - x) ** 2 for a, _ in pairs)
        slope = sum((a - x) * (b - y) for a, b in pairs) / variance if len(pairs) > 2 and variance > 0 else 0.5
        slope = min(max(slope, 0.0), 1.2)
        return y - slope * x, slope
