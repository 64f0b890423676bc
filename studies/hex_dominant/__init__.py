"""Hex-dominant meshes of HexMe's models: what they are like, judged by code of the study's own.

python -m studies.hex_dominant rows -o DIR [--files u] ...      a row per file and edge length
python -m studies.hex_dominant ways -o DIR                      a step left out or changed
python -m studies.hex_dominant extremes -o DIR                  extreme and damaged inputs
python -m studies.hex_dominant gmsh -o DIR                      beside Gmsh
python -m studies.hex_dominant poisson -o DIR                   errors of a finite element solution
python -m studies.hex_dominant page -o DIR                      their tables as one text
"""

import os
import sys
from pathlib import Path

os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
