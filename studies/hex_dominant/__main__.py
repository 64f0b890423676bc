"""The parts of the study; see the package."""

import argparse
from pathlib import Path

from . import rows

DATA = Path(__file__).resolve().parents[3] / "shared" / "data"


def main() -> None:
    parser = argparse.ArgumentParser(prog="python -m studies.hex_dominant", description=__doc__)
    parser.add_argument("part", choices=("rows", "ways", "representations", "extremes", "gmsh", "poisson", "page"))
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, default=DATA)
    parser.add_argument("--files", default="u", help="rows: kinds of files, of u, c and b")
    parser.add_argument("--only", default="", help="names with commas, as s05u")
    parser.add_argument("--factors", default="1,0.5", help="rows: edge lengths over the mean edge of the boundary")
    parser.add_argument("--limit", type=float, default=rows.LIMIT, help="CPU seconds of one run")
    parser.add_argument("--jobs", type=int, default=0, help="representations: processes at once; 0: one per core")
    a = parser.parse_args()
    only = tuple(filter(None, a.only.split(",")))
    if a.part == "rows":
        factors = [float(word) for word in a.factors.split(",")]
        rows.work(a.data, a.output, a.files, factors, a.limit, only)
    elif a.part == "ways":
        from . import ways

        ways.work(a.data, a.output, only)
    elif a.part == "representations":
        from . import representations

        representations.work(a.output, a.jobs)
    elif a.part == "extremes":
        from . import extremes

        extremes.work(a.data, a.output, min(a.limit, extremes.LIMIT), only)
    elif a.part == "gmsh":
        from . import gmsh_beside

        gmsh_beside.work(a.data, a.output, a.limit, only)
    elif a.part == "poisson":
        from . import poisson

        poisson.work(a.data, a.output, a.limit, only)
    else:
        from . import tables

        tables.write(a.output)


if __name__ == "__main__":
    main()
