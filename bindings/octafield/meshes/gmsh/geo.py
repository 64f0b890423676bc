"""Plane models in Gmsh's own language (.geo): the segments that Gmsh divides their curves into."""

import json
from pathlib import Path

import numpy as np

from ...errors import InvalidInput, IoError
from ...progress.phases import Progress
from .working import ending, run_worker, scratch_for

_WORKER = Path(__file__).with_name("geo_worker.py")


def read_geo_curves(
    path: Path, edge_length: float, progress: Progress | None = None
) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """(P, 2) points, (S, 2) segments and (S,) how many surfaces the curve of each is at. edge_length: of the segments;
    0: as the file says. Gmsh runs the file, which is a program: read no file that you would not run."""
    if not path.is_file():
        raise IoError(f"{path}: no such file")
    with scratch_for(path) as folder:
        job: dict[str, object] = {"model": str(path.absolute()), "edge_length": edge_length, "folder": str(folder)}
        code = run_worker(_WORKER, path, job, folder, progress)
        try:
            answer = json.loads((folder / "answer.json").read_bytes()) if code == 0 else None
        except (OSError, ValueError):
            answer = None
        if answer is None:
            raise IoError(f"{path}: {ending(code, (folder / 'printed').read_text(errors='replace'))}", "reader_stopped")
        if "error" in answer:
            kind = IoError if answer["error"] == "unreadable" else InvalidInput
            raise kind(f"{path}: {answer['message']}", answer["error"])
        with np.load(folder / "curves.npz") as arrays:
            return arrays["points"], arrays["segments"], arrays["surfaces"]
