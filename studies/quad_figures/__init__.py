"""The figures of Jezdimirovic et al. (2021) on quad layouts, and the domains of Dermine (2024), laid out and meshed.

python -m studies.quad_figures -o DIR [--only NAME,...] [--edge 0.05] [--blocks fine]

Neither source gives its geometries: valences, numbers of points and angles are theirs, all else is chosen here. DIR
gets one PNG per sheet and summary.md.
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
