"""Quads with a fixed boundary: failures over many turns of the squares inside, and figures beside Gmsh's."""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
