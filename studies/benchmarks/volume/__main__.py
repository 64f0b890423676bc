"""All benchmarks of frame fields in volumes, and the page of their tables.

    python -m studies.benchmarks.volume -o DIR [--data ../shared/data] [--balls 12,20,32,44] [--seeds 10] [--part
    energies] ...

DIR gets benchmarks.md, hexme.md (every file in every representation) and a folder per part. Without --part:
all of energies, growth, parts, large, split; a part that was not run keeps the tables it left in DIR.
"""

import argparse
from pathlib import Path

from octafield.options import COMPARED

from ..pages import page, when
from . import energies, growth, parts

MESHES = ("sphere_r0.17", "sphere_r0.10", "78322_gear.2", "genus3", "sphere_r0.06")
TEXTS = Path(__file__).with_name("texts")


def run_part(part: str, a) -> None:
    folder = a.output / part
    folder.mkdir(parents=True, exist_ok=True)
    hexme = a.data / "hexme"
    if part == "energies":
        energies.main(
            [*(str(a.data / "arff" / f"{m}.mesh.gz") for m in MESHES), "-o", str(folder), "--seeds", str(a.seeds)]
        )
    elif part == "growth":
        growth.main([str(hexme / "i16c.vtk.gz"), "-o", str(folder), "--balls", a.balls])
    elif part == "parts":
        parts.main([str(hexme), "-o", str(folder), "--representations", "all", "--skip", "i16c"])
    elif part == "large":
        # su2_midpoint had not ended after ten minutes there.
        quick = ",".join(name for name in COMPARED if name != "su2_midpoint")
        parts.main([str(hexme), "-o", str(folder), "--representations", quick, "--recipe-only", "--only", "i16c"])
    else:
        parts.main([str(hexme), "-o", str(folder), "--split", "--skip", "i16c"])
    (folder / "when.md").write_text(when())


def main() -> None:
    known = ("energies", "growth", "parts", "large", "split")
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, default=Path(__file__).resolve().parents[4] / "shared" / "data")
    parser.add_argument("--balls", default="12,20,32,44")
    parser.add_argument("--seeds", type=int, default=10)
    parser.add_argument("--part", choices=known, action="append")
    a = parser.parse_args()
    for part in a.part or known:
        run_part(part, a)
    for text in sorted(TEXTS.glob("*.md")):
        (a.output / text.name).write_text(page(text.read_text(), a.output))
        print(a.output / text.name)


if __name__ == "__main__":
    main()
