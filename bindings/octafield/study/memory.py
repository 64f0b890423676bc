"""Peak memory to expect of the process of a group: fitted to the measurements of docs/scaling.md, with a margin."""

from .plan import Run

_PROCESS_MB = 250.0  # Python, its libraries, small arrays
_MB_PER_TET = {"least": 5e-4, "ceres": 3.5e-3}


def needed_mb(tets: float, runs: list[Run]) -> float:
    """Megabytes (1e6 bytes) of a process that carries out `runs` on so many tets."""
    by_ceres = any(run.options.solver in ("levenberg_marquardt", "lbfgs") or _is_metric(run) for run in runs)
    return _PROCESS_MB + tets * _MB_PER_TET["ceres" if by_ceres else "least"]


def _is_metric(run: Run) -> bool:
    from .. import _core

    return run.options.representation not in _core.representations
