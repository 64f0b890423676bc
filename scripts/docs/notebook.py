"""A notebook with its outputs from a Python file in cells (# %%, # %% [markdown]):

.venv/bin/python scripts/docs/notebook.py docs/notebooks/own_scheme.py
"""

import ast
import base64
import contextlib
import io
import json
import re
import sys
from pathlib import Path
from typing import Any

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

_HEAD = re.compile(r"^# %%( \[markdown\])?$", flags=re.MULTILINE)


def cells(text: str) -> list[tuple[str, str]]:
    """("markdown" or "code", source) of each cell."""
    parts = _HEAD.split(text)[1:]
    found = []
    for mark, body in zip(parts[::2], parts[1::2], strict=True):
        body = body.strip("\n")
        kind = "markdown" if mark else "code"
        found.append((kind, re.sub(r"^# ?", "", body, flags=re.MULTILINE) if mark else body))
    return found


def carried_out(source: str, names: dict[str, Any]) -> tuple[str, object]:
    """What a cell prints, and the value of its last line where that is an expression."""
    tree = ast.parse(source)
    last = ast.Expression(tree.body.pop().value) if isinstance(tree.body[-1], ast.Expr) else None
    printed, value = io.StringIO(), None
    with contextlib.redirect_stdout(printed):
        exec(compile(tree, "cell", "exec"), names)
        if last is not None:
            value = eval(compile(last, "cell", "eval"), names)
    return printed.getvalue(), value


def outputs(printed: str, value: object, count: int) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = []
    if printed:
        found.append({"output_type": "stream", "name": "stdout", "text": printed.splitlines(keepends=True)})
    if value is not None:
        data: dict[str, object] = {"text/plain": repr(value)}
        if isinstance(value, plt.Figure):
            image = io.BytesIO()
            value.savefig(image, format="png", dpi=80, bbox_inches="tight", metadata={"Software": None})
            data["image/png"] = base64.b64encode(image.getvalue()).decode()
            data["text/plain"] = "<Figure>"
        found.append({"output_type": "execute_result", "execution_count": count, "metadata": {}, "data": data})
    return found


def made(text: str) -> dict[str, Any]:
    """The notebook (nbformat 4.5), its cells carried out."""
    names: dict[str, Any] = {"__name__": "__main__"}
    result: list[dict[str, Any]] = []
    count = 0
    for number, (kind, source) in enumerate(cells(text)):
        cell: dict[str, Any] = {"cell_type": kind, "id": f"cell-{number}", "metadata": {}}
        cell["source"] = source.splitlines(keepends=True)
        if kind == "code":
            count += 1
            cell |= {"execution_count": count, "outputs": outputs(*carried_out(source, names), count)}
        result.append(cell)
    kernel = {"kernelspec": {"display_name": "Python 3", "language": "python", "name": "python3"}}
    return {"cells": result, "metadata": kernel, "nbformat": 4, "nbformat_minor": 5}


if __name__ == "__main__":
    for name in sys.argv[1:]:
        path = Path(name)
        notebook = json.dumps(made(path.read_text(encoding="utf-8")), indent=1, ensure_ascii=False)
        path.with_suffix(".ipynb").write_text(notebook + "\n", encoding="utf-8")
