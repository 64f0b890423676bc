"""Does any part become a field? Many surfaces through the command line, each judged against what is known of it.

    python studies/any_part.py -o out/any_part [--data FOLDER] [--extra FILE_OR_FOLDER ...] [--only a,b] [--limit S]
    [--page docs/any_part.md]

Inputs: any_part_inputs.py (generated surfaces, the data folder, what pyvista, trimesh and meshio ship; --extra: others,
outside the shares). For each file `octafield info` and `octafield field` run in processes of their own by default
options; where the field is refused, the options that the message names (--repair LEVEL, --edge-length X ...) are added
and it is tried again, three times at most. Nothing is chosen by hand.

A result is wrong where, of the file's body: the volume differs by more than 1 %, the Euler characteristic differs, the
surface lies further than 1 % of the size away (either way), or one axis is more than 10 degrees from the input's
normal on more than 5 % of the surface away from features. A wrong result whose record says so (its verdict
is not fine, or a note tells of a loss, a filled hole or a coarse place) is "told"; without a word it is "SILENT".

Writes table.csv, summary.md (--page: a page of the documentation with it), pictures in contact.png. Exit code 1 where a
result is silently wrong.
"""

import argparse
import json
import re
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import octafield
from any_part_inputs import Case, collect, unpacked
from any_part_judge import contact_sheet, judge, words_of
from study_output import markdown_table, write_csv

HEADER = ["input", "source", "triangles", "info", "default", "kind", "steps", "result", "wrong", "told", "tets",
          "energy", "singular", "volume %",
          "euler", "far %", "angle 95 %", "seconds", "message"]  # fmt: skip
MOST_STEPS = 3
LEVELS = "merge|safe|fill|resolve|wrap"
# A level that the message recommends, not one that it says has been applied or did not help.
_LEVEL = re.compile(rf"(?<!after )(?<!level of )--repair ({LEVELS})\b(?!(?:,| and) (?:{LEVELS}))")
_VALUE = re.compile(r"(--edge-length|--feature-angle|--cells|--max-hole-edges) ([0-9][0-9.e+-]*[0-9]|[0-9])")


def named_options(message: str, before: dict[str, str]) -> dict[str, str]:
    """The options a message names, without those that were given with the same value already."""
    found = dict(_VALUE.findall(message))
    if level := _LEVEL.search(message):
        found["--repair"] = level.group(1)
    elif "option --repair does this" in message:  # versions without levels
        found["--repair"] = ""
    return {name: value for name, value in found.items() if before.get(name) != value}


def call(words: list[str], limit: float) -> tuple[int | None, str, float]:
    """Exit code (None: the limit was reached), stderr and seconds on the clock."""
    begin = time.monotonic()
    try:
        done = subprocess.run(
            [sys.executable, "-m", "octafield", *words], capture_output=True, text=True, timeout=limit
        )
        return done.returncode, done.stderr, time.monotonic() - begin
    except subprocess.TimeoutExpired:
        return None, f"not done after {limit:.0f} s", limit


def error_of(stderr: str) -> str:
    lines = [line for line in stderr.splitlines() if re.search(r"error:|defect:|stopped by signal|not done", line)]
    return (lines or stderr.splitlines() or [""])[-1].strip()


def state_of(code: int | None) -> str:
    return {0: "field", 2: "refused", None: "time limit"}.get(code, f"DEFECT {code}")


def run_case(case: Case, folder: Path, limit: float) -> dict[str, Any]:
    row: dict[str, Any] = dict.fromkeys(HEADER, "") | {"input": case.name, "source": case.source}
    info_json = folder / "info.json"
    code, _, _ = call(["info", str(case.path), "-q", "--json", str(info_json)], limit)
    about = json.loads(info_json.read_text()) if info_json.exists() else {}
    warned = sum(r["state"] == "warn" for r in about.get("requirements", []))
    row |= {
        "triangles": about.get("triangles", ""),
        "info": {0: f"{warned} warnings" if warned else "pass", 2: "fail"}.get(code, state_of(code)),
    }
    given: dict[str, str] = {}
    steps: list[str] = []
    for step in range(MOST_STEPS + 1):
        output = folder / f"try{step}"
        options = [word for pair in given.items() for word in pair if word]
        code, stderr, seconds = call(
            ["field", str(case.path), "-o", str(output), "-q", "--json", str(folder / f"try{step}.json"), *options],
            limit,
        )
        message = "" if code == 0 else error_of(stderr)
        if step == 0:
            told = (
                json.loads((folder / "try0.json").read_text()).get("error", {})
                if code and (folder / "try0.json").exists()
                else {}
            )
            row |= {
                "default": state_of(code),
                "kind": told.get("kind", ""),
                "message": message.replace(str(case.path.parent), ""),
            }
        row |= {"result": state_of(code), "seconds": round(seconds, 1)}
        more = named_options(message, given) if code == 2 else {}
        if not more:
            break
        given |= more
        steps.append(" ".join(f"{name} {value}".strip() for name, value in more.items()))
    row["steps"] = "; ".join(steps)
    if code == 0:
        record = json.loads((output / "result.json").read_text())
        row |= judge(case, unpacked(case.path, folder), output, record)
        row["told"] = words_of(record, row["wrong"]) if row["wrong"] else ""
    return row


def verdict(row: dict[str, Any]) -> str:
    if row["result"] != "field":
        return row["result"]
    how = "field" if row["default"] == "field" else "field, as the message says"
    if row["wrong"]:
        return f"{how}; told" if row["told"] else "SILENT"
    return how


def summary(rows: list[dict[str, Any]]) -> str:
    counted = [row for row in rows if row["source"] != "extra"]
    text = ""
    for title, of in (
        ("surfaces of the study", counted),
        ("further surfaces", [row for row in rows if row["source"] == "extra"]),
    ):
        if not of:
            continue
        default, end = (sum(row[key] == "field" for row in of) for key in ("default", "result"))
        silent = [row["input"] for row in of if verdict(row) == "SILENT"]
        others = [row for row in of if not row["input"].startswith("bad_")]
        whole = sum(row["default"] == "field" for row in others)
        told = sum("told" in verdict(row) for row in of)
        text += (
            f"{len(of)} {title}: a field by default from {default} ({default / len(of):.1%}; of the {len(others)} that"
            f" nobody spoilt on purpose, as the files bad_* were, from {whole}, {whole / len(others):.1%}), with what"
            f" the messages name from {end} ({end / len(of):.1%}); wrong without a word:"
            f" {len(silent)}{' (' + ', '.join(silent) + ')' if silent else ''}; off and said so: {told}.\n\n"
        )
    shown = [
        "input",
        "source",
        "triangles",
        "info",
        "default",
        "steps",
        "verdict",
        "wrong",
        "tets",
        "energy",
        "volume %",
        "far %",
        "angle 95 %",
        "seconds",
    ]
    text += markdown_table(shown, [[_cell((row | {"verdict": verdict(row)})[key]) for key in shown] for row in rows])
    refused = [row for row in rows if row["default"] != "field"]
    if refused:
        text += "\nWhat was not done by default, and the message:\n\n"
        text += markdown_table(
            ["input", "verdict", "message"], [[row["input"], verdict(row), _cell(row["message"])] for row in refused]
        )
    return text


def _cell(value: Any) -> str:
    return f"{value:.4g}" if isinstance(value, float) else str(value).replace("|", "\\|")


PAGE = """# Any part

Surfaces through `octafield field`: thirty made by rule (thin walls, needles, high genus, noise, scans with holes),
sound and spoilt files of the data folder, files that broke something once, the boundaries of all its tet meshes, and
what pyvista ships. Where a field is refused by default, the options that the message names are added, without a look
at the part. What counts as wrong, and how it is found: [studies/any_part.py](study_scripts.md), which writes this
page. Seconds are on the clock, as the machine was; the limit of one command was {limit:.0f} s. The program was
octafield {version}, commit {commit}.

"""


def commit() -> str:
    """Of the source tree, with a + where it has changes beside it."""
    words = ["git", "-C", str(Path(__file__).parent), "describe", "--always", "--dirty=+", "--abbrev=8"]
    return subprocess.run(words, capture_output=True, text=True).stdout.strip() or "unknown"


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path, required=True)
    parser.add_argument("--data", type=Path, help="folder with surfaces/ and wild/")
    parser.add_argument("--extra", type=Path, nargs="*", default=[])
    parser.add_argument("--only", default="", help="names of inputs, or their beginnings, with commas")
    parser.add_argument("--limit", type=float, default=900, help="seconds of one command")
    parser.add_argument("--page", type=Path, help="also write a page of the documentation")
    parser.add_argument("--again", action="store_true", help="run inputs anew that have a row")
    a = parser.parse_args()
    rows = []
    only = tuple(filter(None, a.only.split(",")))
    for case in collect(a.output / "inputs", a.data, a.extra):
        if only and not case.name.startswith(only):
            continue
        folder = a.output / "runs" / f"{case.source.replace('/', '_')}_{case.name}"
        kept = folder / "row.json"
        if a.again or not kept.exists():
            folder.mkdir(parents=True, exist_ok=True)
            kept.write_text(json.dumps(run_case(case, folder, a.limit)))
        row = json.loads(kept.read_text())
        rows.append(row)
        print(
            row["input"],
            "|",
            verdict(row),
            "|",
            row["wrong"],
            "|",
            row["steps"],
            "|",
            row["seconds"],
            "s |",
            row["message"][:200],
            flush=True,
        )
        write_csv(a.output / "table.csv", HEADER, [[row[key] for key in HEADER] for row in rows], quiet=True)
        (a.output / "summary.md").write_text(summary(rows))
    if a.page:
        a.page.write_text(PAGE.format(limit=a.limit, version=octafield.__version__, commit=commit()) + summary(rows))
    contact_sheet(a.output)
    print(summary(rows).split("\n\n|")[0])
    return int(any(verdict(row) == "SILENT" for row in rows))


if __name__ == "__main__":
    sys.exit(main())
