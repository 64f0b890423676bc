"""Benchmarks of frame fields in volumes; `python -m studies.benchmarks.volume` runs all of them."""

import os
import sys
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"  # idle threads of vector sums would be counted
sys.path.insert(0, str(Path(__file__).resolve().parents[2]))
