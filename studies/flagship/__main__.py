"""The flagship study: every representation and metric, solver, start and boundary mode, on generated bodies and on
HexMe.

    python -m studies.flagship -o DIR [--part generators] [--jobs N]

DIR gets a folder per part, with its report, pictures/ (the first figure of each) and flagship.md: conclusions whose
numbers are filled in from the runs. Killed at any moment, it goes on when called again. HexMe is taken from
../shared/data/hexme; without it that part, and the page, are left out.
"""

import argparse
import shutil
import sys
from pathlib import Path

from octafield import InvalidInput, study

from ..benchmarks.pages import when
from . import conclusions

HERE = Path(__file__).parent
PARTS = ("generators", "hexme")


def run_part(part: str, folder: Path, jobs: int) -> bool:
    """False where the inputs are absent."""
    described = study.load(HERE / f"{part}.yaml")
    try:
        study.plan(described)
    except InvalidInput as error:
        print(f"{part}: {error}", file=sys.stderr)
        return False
    outcome = study.run(described, folder / part, jobs=jobs)
    print(study.write_report(folder / part), vars(outcome.status))
    (folder / "pictures").mkdir(exist_ok=True)
    shutil.copyfile(folder / part / "figures" / "figure-1.svg", folder / "pictures" / f"flagship_{part}.svg")
    return True


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--part", choices=PARTS, action="append")
    parser.add_argument("--jobs", type=int, default=0, help="processes at once; 0: one per core")
    a = parser.parse_args()
    present = [part for part in a.part or PARTS if run_part(part, a.output, a.jobs)]
    if set(present) == set(PARTS):
        text = conclusions.page(*(study.rows(a.output / part) for part in PARTS), made=when().strip())
        (a.output / "flagship.md").write_text(text, encoding="utf-8")
        print(a.output / "flagship.md")


if __name__ == "__main__":
    main()
