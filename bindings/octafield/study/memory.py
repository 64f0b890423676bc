"""Peak memory to expect of the process of a group: fitted to measurements (docs/scaling.md), and at least a quarter
more."""

from ..options import FieldOptions
from .plan import Run

_PROCESS_MB = 270.0  # Python, its libraries, small arrays
_TET_SAMPLING = 3.5  # over frames at vertices: there are five to six times as many tets, but fewer neighbours
# Megabytes per tet.
_SECOND_ORDER, _SH469, _FIRST_ORDER, _METRIC, _LEAST_SQUARES = 4.5e-4, 6.5e-4, 2e-3, 4e-3, 4.8e-3


def needed_mb(tets: float, runs: list[Run]) -> float:
    """Megabytes (1e6 bytes) of a process that carries out `runs` on so many tets, its mesher included."""
    return _PROCESS_MB + tets * max((_mb_per_tet(run.options) for run in runs), default=0.0)


def _mb_per_tet(options: FieldOptions) -> float:
    from .. import _core

    if options.solver == "lbfgs" or options.representation == "odeco_lengths":
        mb = _FIRST_ORDER
    elif options.representation not in _core.representations:
        mb = _METRIC
    elif options.solver == "levenberg_marquardt":
        mb = _LEAST_SQUARES
    else:
        mb = _SH469 if options.representation == "sh469" else _SECOND_ORDER
    return mb * (_TET_SAMPLING if options.sampling == "tets" else 1)
