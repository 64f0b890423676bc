"""Peak memory to expect of the process of a group: fitted to measurements (docs/scaling.md), and at least a quarter
more."""

from .. import _core
from ..options import FieldOptions
from ..schemes import EmbeddingScheme, OwnScheme, minimised
from .plan import Run

_PROCESS_MB = 270.0  # Python, its libraries, small arrays
_TET_SAMPLING = 3.5  # over frames at vertices: there are five to six times as many tets, but fewer neighbours


def needed_mb(tets: float, runs: list[Run]) -> float:
    """Megabytes (1e6 bytes) of a process that carries out `runs` on so many tets, its mesher included."""
    return _PROCESS_MB + tets * max((_mb_per_tet(run.options) for run in runs), default=0.0)


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
