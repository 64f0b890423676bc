"""The tables of a folder as one text, for docs/hex_dominant.md."""

import re
from pathlib import Path

from ..benchmarks.pages import page
from . import gmsh_beside, poisson, rows

TEXT = Path(__file__).with_name("results.md")
MARK = "## Results\n"


def write(output: Path) -> None:
    """results.md in the folder."""
    if (output / "rows.jsonl").exists():
        rows.write_tables(output)
    if (output / "gmsh.jsonl").exists():
        gmsh_beside.write_table(output)
    if (output / "poisson.jsonl").exists():
        poisson.write_tables(output)
    (output / "results.md").write_text(page(TEXT.read_text(), output))
    print(output / "results.md")


def into(document: Path, text: str) -> None:
    """In place of what the document has under its heading Results, up to the next heading of that level."""
    before, after = document.read_text().split(MARK, 1)
    rest = re.search(r"^## ", after, re.MULTILINE)
    document.write_text(before + MARK + "\n" + text.strip() + "\n" + ("\n" + after[rest.start() :] if rest else ""))
