"""Notebooks of the documentation are what their source gives, cell by cell."""

import json
import sys

import pytest
from docs_blocks import ROOT

sys.path.insert(0, str(ROOT / "scripts" / "docs"))
from notebook import made  # noqa: E402

NOTEBOOKS = sorted((ROOT / "docs" / "notebooks").glob("*.ipynb"))


def told(notebook: dict) -> list[tuple[str, str]]:
    """Source and printed text of each cell."""
    return [
        (
            "".join(cell["source"]),
            "".join("".join(out["text"]) for out in cell.get("outputs", ()) if out["output_type"] == "stream"),
        )
        for cell in notebook["cells"]
    ]


def number(word: str) -> float | str:
    try:
        return float(word)
    except ValueError:
        return word


def like(word: str) -> object:
    value = number(word)
    return value if isinstance(value, str) else pytest.approx(value, rel=0.2, abs=0.1)


def test_there_are_notebooks():
    assert NOTEBOOKS


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_a_notebook_prints_what_it_shows(path, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    kept = json.loads(path.read_text(encoding="utf-8"))
    again = told(made(path.with_suffix(".py").read_text(encoding="utf-8")))
    assert [source for source, _ in again] == [source for source, _ in told(kept)]
    for (source, text), (_, shown) in zip(again, told(kept), strict=True):
        # numpy's functions may round otherwise on another processor, and descents then end a little elsewhere
        assert [number(word) for word in text.split()] == [like(word) for word in shown.split()], source
    assert path.stat().st_size < 500_000
    assert any("image/png" in out.get("data", {}) for cell in kept["cells"] for out in cell.get("outputs", ()))
