"""A row per file of a folder and edge length, each made in a process of its own, appended as it is done."""

import csv
import datetime
import json
import os
import re
import signal
import statistics
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import psutil
from study_output import markdown_table

from ..benchmarks.pages import commit, machine

ROOT = Path(__file__).resolve().parents[2]
# By size, so that an interrupted study has the more rows.
ORDER = ("s06u s02u s10u s04u s07u s01u s08u s12u s13u s17u s03u s14u s15u s11u s16u s09u s05u"
         " s02c s10c s04c s06c s13c s01c s07c s11c s03c s08c s14c s12c s05c s15c s17c s16c s09c"
         " i10c i11c i12c i01c i02c i04c i09c i06c i07c i03c i05c s08b s15b s01b s17b i10b").split()  # fmt: skip
LIMIT = 300.0  # seconds of CPU time; on the clock ten times as many
MOST_MB = 12000
COLUMNS = [
    "file", "factor", "edge", "file_tets", "tets_used", "tets", "hexahedra", "wedges", "pyramids", "hex_volume_share",
    "hex_number_share", "hex_sj_min", "hex_sj_mean", "sj_min", "volume_error", "deviation", "nonconforming",
    "inverted", "features_kept", "corners_lost", "seconds", "cpu", "MB", "faults", "error", "load", "commit",
]  # fmt: skip
HEADER = [
    "file", "edge", "working tets", "lattice cells lost", "tets", "hexahedra", "wedges", "pyramids", "hex volume %",
    "hex number %", "hex SJ min", "mean", "SJ min", "volume error %", "deviation %", "noncon-forming", "inverted",
    "features kept %", "corners lost", "s", "CPU s", "MB", "remarks",
]  # fmt: skip


def run_one(path: Path, factor: float, limit: float, length: float = 0.0, keep: Path | None = None) -> dict:
    """keep: folder that gets the mesh's files."""
    words = ["studies.hex_dominant.run", str(path), str(factor)]
    return run_words(words, limit, [str(length), *([str(keep)] if keep else [])])


def run_words(words: list[str], limit: float, after: list[str] | None = None) -> dict:
    """What a module writes into the JSON file whose name is put between `words` and `after`."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "row.json"
        command = [sys.executable, "-m", *words, str(out), *(after or [])]
        begun = time.monotonic()
        with (Path(folder) / "stderr").open("w+") as stderr:
            child = subprocess.Popen(command, cwd=ROOT, stdout=subprocess.DEVNULL, stderr=stderr)
            peak, why = wait(child, limit)
            stderr.seek(0)
            told = stderr.read().strip().splitlines()
        measured = {"seconds": time.monotonic() - begun, "MB": peak}
        if out.exists():
            return measured | json.loads(out.read_text())
        return measured | {"error": ending(child.returncode, why, told)}


def ending(code: int, why: str, told: list[str]) -> str:
    if code == -signal.SIGKILL and why:
        return f"stopped at {why}"
    what = f"signal {signal.Signals(-code).name}" if code < 0 else f"exit code {code}"
    return f"{what} {told[-1][:300] if told else ''}".strip()


def wait(child: subprocess.Popen, limit: float) -> tuple[float, str]:
    """Largest resident memory that was seen, MB. Kills the child at the limit of time or memory, and says which."""
    begun, peak, used, why = time.monotonic(), 0.0, 0.0, ""
    while child.poll() is None:
        try:
            told = psutil.Process(child.pid)
            peak, used = max(peak, told.memory_info().rss / 2**20), sum(told.cpu_times()[:4])
            used += sum(sum(part.cpu_times()[:2]) for part in told.children(recursive=True))  # TetGen's
        except psutil.Error:
            pass
        limits = {
            f"{limit:.0f} s of CPU time": used > limit,
            f"{10 * limit:.0f} s by the clock, of which it got little": time.monotonic() - begun > 10 * limit,
            f"{MOST_MB} MB": peak > MOST_MB,
        }
        if any(limits.values()):
            why = next(name for name, passed in limits.items() if passed)
            child.kill()
        time.sleep(0.05)
    return peak, why


def key(row: dict) -> tuple[str, float]:
    return row["file"], float(row["factor"])


def read_rows(folder: Path) -> list[dict]:
    path = folder / "rows.jsonl"
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def work(data: Path, output: Path, kinds: str, factors: list[float], limit: float, only: tuple[str, ...]) -> None:
    """Rows that are there already are kept."""
    output.mkdir(parents=True, exist_ok=True)
    for name in ORDER:
        if name[-1] not in kinds or (only and name not in only):
            continue
        for factor in factors:
            path = data / "hexme" / f"{name}.vtk.gz"
            if (name, factor) in {key(row) for row in read_rows(output)} or not path.exists():
                continue
            row = {"file": name, "factor": factor} | run_one(path, factor, limit)
            row |= {"load": round(os.getloadavg()[0], 1), "commit": commit()}
            row["date"] = datetime.date.today().isoformat()
            with (output / "rows.jsonl").open("a") as file:
                file.write(json.dumps(row) + "\n")
            print(*(row.get(c, "") for c in COLUMNS[:2]), short(row), flush=True)
            write_tables(output)


def short(row: dict) -> str:
    if "error" in row:
        return f"{row['seconds']:.0f} s, {row['error']}"
    return (
        f"{row['hex_volume_share']:.1%} {row['hex_number_share']:.1%}"
        f" SJ {row['hex_sj_min']:.2f}/{row['hex_sj_mean']:.3f}"
        f" all {row['sj_min']:.3f}, deviation {row['deviation']:.2%}, {row['seconds']:.0f} s {row['faults']}"
    )


def write_tables(output: Path) -> None:
    rows = read_rows(output)
    with (output / "rows.csv").open("w", newline="") as file:
        out = csv.DictWriter(file, COLUMNS, extrasaction="ignore", lineterminator="\n")
        out.writeheader()
        out.writerows(rows)
    text = ""
    for kind, title in (("u", "Uniform"), ("c", "Coarse"), ("b", "Boundary-refined")):
        of = [row for row in rows if row["file"].endswith(kind)]
        if of:
            of.sort(key=lambda row: (row["file"], -float(row["factor"])))
            text += f"### {title} meshes (`{kind}`)\n\n{summary(of)}\n\n"
            text += markdown_table(HEADER, [cells(row) for row in of]) + "\n"
    (output / "rows.md").write_text(text)
    (output / "when.md").write_text(when(rows))


def cells(row: dict) -> list[str]:
    name = row["file"] if float(row["factor"]) == 1 else f"{row['file']}, {row['factor']:g} of it"
    if "error" in row:
        edge = f"{row['edge']:.3g}" if "edge" in row else ""
        return [name, edge, *[""] * 17, f"{row['seconds']:.0f}", "", f"{row.get('MB', 0):.0f}", clean(row["error"])]
    percent = lambda name, digits: f"{100 * row[name]:.{digits}f}"  # noqa: E731
    counts = [f"{row['tets_used']:,}", "front" if row.get("points") == "frontal" else lost(row["steps"])]
    counts += [f"{row[name]:,}" for name in ("tets", "hexahedra", "wedges", "pyramids")]
    shares = [percent("hex_volume_share", 1), percent("hex_number_share", 1)]
    quality = [f"{row[name]:.{digits}f}" for name, digits in (("hex_sj_min", 2), ("hex_sj_mean", 3), ("sj_min", 3))]
    rest = [percent("volume_error", 3), percent("deviation", 2), str(row["nonconforming"]), str(row["inverted"])]
    kept = [percent("features_kept", 1), f"{row['corners_lost']} of {row['corners']}"]
    time_and_space = [f"{row['seconds']:.0f}", f"{row['cpu']:.0f}", f"{row['MB']:.0f}"]
    return [name, f"{row['edge']:.3g}", *counts, *shares, *quality, *rest, *kept, *time_and_space, clean(row["faults"])]


def lost(steps: dict[str, int]) -> str:
    """Those that became no hexahedra, of all."""
    refused = sum(steps[name] for name in ("outside", "unusable", "degenerate", "poor"))
    return f"{refused + steps['crossing']:,} of {refused + steps['lattice_hexahedra']:,}"


def clean(text: str) -> str:
    """For a cell of a table; of paths the names alone."""
    return re.sub(r"(?:/[\w.-]+)+/", "", text.replace("|", "\\|").replace("\n", " "))


def summary(rows: list[dict]) -> str:
    made = [row for row in rows if "error" not in row]
    if not made:
        return f"{len(rows)} runs, no mesh."
    sound = sum(not row["nonconforming"] and not row["inverted"] for row in made)
    lines = []
    for factor in sorted({float(row["factor"]) for row in made}, reverse=True):
        of = [row for row in made if float(row["factor"]) == factor]
        middle = lambda name: statistics.median(row[name] for row in of)  # noqa: B023, E731
        worst = min(of, key=lambda row: row["hex_volume_share"])
        lines.append(
            f"- Cells of {factor:g} mean edges, {len(of)} meshes: median hex share {middle('hex_volume_share'):.1%} by"
            f" volume, {middle('hex_number_share'):.1%} by number, worst {worst['hex_volume_share']:.1%}"
            f" ({worst['file']});"
            f" mean scaled Jacobian of hexahedra {middle('hex_sj_mean'):.3f} in the median; largest volume error"
            f" {max(row['volume_error'] for row in of):.2%}, largest deviation"
            f" {max(row['deviation'] for row in of):.2%}."
        )
    head = f"{len(rows)} runs, {len(made)} meshes, {sound} of them conforming and without an inverted cell."
    return "\n".join([head, "", *lines])


def when(rows: list[dict]) -> str:
    loads = [row["load"] for row in rows]
    return (
        f"{', '.join(sorted({row['date'] for row in rows}))}, {machine()}, 2 threads, load average"
        f" {min(loads):.1f} to {max(loads):.1f}, commits"
        f" {', '.join(dict.fromkeys(row['commit'] for row in rows))}.\n"
    )
