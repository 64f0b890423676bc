"""Memory, seconds and disk of runs against mesh size, and how long the table of a large study takes.

    python -m studies.benchmarks.scaling -o DIR [--tets 10000,50000,200000,800000] [--runs 10000] [--part memory] ...

Generated balls (and one box), remeshed and filled, each run in a process of its own, one thread. Memory: peak of all of
its processes together, the mesher's included, less that of a process which has loaded everything and computed nothing.
Representations minimised by Ceres are stopped after three steps above 300,000 tets: that is when their memory is at its
peak. DIR gets scaling.md and the tables in it.
"""

import argparse
import json
import os
import subprocess
import sys
import tempfile
import threading
import time
from dataclasses import dataclass
from pathlib import Path

os.environ["OPENBLAS_NUM_THREADS"] = "1"
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

import numpy as np
from octafield import study
from octafield.domain.generators import generate
from octafield.options import FieldOptions
from octafield.progress.phases import PeakMemory
from octafield.study.memory import needed_mb
from octafield.study.running.child import Child
from study_output import markdown_table

from .pages import page, when

REPRESENTATIONS = ("sh4", "sh469", "geodesic", "su2_midpoint")
BY_CERES = ("geodesic", "su2_midpoint")
HEADER = [
    "mesh", "representation", "vertices", "tets", "reading, meshing MB", "cross field MB", "field, files MB",
    "process, all MB", "expected by studies MB",
    "preparing CPU s", "field, files CPU s",
]  # fmt: skip
FULL_RUN = 300_000  # tets up to which those run to their end
TETS_PER_CUBED_EDGE = {"ball": 43.5, "box": 10.4}  # of these bodies, over one by the cubed edge length
TEXT = Path(__file__).with_name("texts") / "scaling.md"


# What runs in the process that is measured.


def measured_run(body: str, tets: int, representation: str) -> dict:
    """Figures of one run. "now": when a step begins, for the one who watches."""
    from octafield.fields import frame_field as pipeline
    from octafield.runs import run_folder as results

    edge = (TETS_PER_CUBED_EDGE[body] / tets) ** (1 / 3)
    steps = {"max_iterations": 3} if representation in BY_CERES and tets > FULL_RUN else {}
    warm = pipeline.compute_field(generate("box"), FieldOptions(edge_length=0.5, threads=1))
    with tempfile.TemporaryDirectory() as folder:
        results.write_field_result(warm, Path(folder))
    peaks = {}

    def step(name: str, work):
        print(json.dumps({"now": name}), flush=True)
        PeakMemory()  # from here on
        result = work()
        peaks[name] = _status_mb("/proc/self/status", "VmHWM:")
        return result

    options = FieldOptions(edge_length=edge, representation=representation, threads=1, **steps)
    step("start", lambda: time.sleep(0.1))
    meshed = step("mesh", lambda: pipeline.prepare_mesh(generate(body), options))
    problem = step("surface", lambda: pipeline.prepare_field(meshed))
    result = step("run", lambda: pipeline.run_field(problem, options))
    with tempfile.TemporaryDirectory() as folder:
        step("write", lambda: results.write_field_result(result, Path(folder)))
        sizes = {path.name: path.stat().st_size for path in Path(folder).iterdir()}
    r = result.record
    return {
        "peaks": peaks,
        "vertices": r.vertices,
        "tets": r.tets,
        "cpu": r.cpu_seconds.to_dict(),
        "whole": not steps,
        "disk": sizes,
    }


# What watches it.


class Watched:
    """Megabytes of a process and those it starts, by step: where a mesher runs, the sum of the shares of memory (Pss)
    of all."""

    def __init__(self, process: subprocess.Popen):
        self.process, self.step, self.peaks = process, "", {}

    def look(self) -> None:
        while self.process.poll() is None:
            children = Path(f"/proc/{self.process.pid}/task").glob("*/children")
            try:
                pids = [pid for path in children for pid in path.read_text().split()]
                if pids:
                    total = sum(_status_mb(f"/proc/{pid}/smaps_rollup", "Pss:") for pid in [self.process.pid, *pids])
                    self.peaks[self.step] = max(self.peaks.get(self.step, 0.0), total)
            except (OSError, StopIteration):
                pass  # just ended
            time.sleep(0.01)


def _status_mb(path: str, name: str) -> float:
    line = next(line for line in Path(path).read_text().splitlines() if line.startswith(name))
    return int(line.split()[1]) * 1024 / 1e6


def watched(body: str, tets: int, representation: str) -> dict:
    """measured_run() in a process of its own; its peaks with the mesher's."""
    command = [sys.executable, "-m", "studies.benchmarks.scaling", "--one", body, str(tets), representation]
    root = Path(__file__).resolve().parents[2]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, cwd=root)
    watch = Watched(process)
    threading.Thread(target=watch.look, daemon=True).start()
    answer = None
    for line in process.stdout:
        found = json.loads(line)
        if "now" in found:
            watch.step = found["now"]
        else:
            answer = found
    if process.wait() or answer is None:
        raise RuntimeError(f"{body} {tets} {representation}: the process ended with exit code {process.returncode}")
    for name, mb in watch.peaks.items():
        answer["peaks"][name] = max(answer["peaks"].get(name, 0.0), mb)
    return answer


@dataclass
class Measured:
    body: str
    representation: str
    vertices: int
    tets: int
    start_mb: float
    mesh_mb: float  # over the start, as are the next
    surface_mb: float
    run_mb: float
    prepare_s: float  # CPU
    run_s: float | None
    disk: dict

    @property
    def peak_mb(self) -> float:
        return max(self.mesh_mb, self.surface_mb, self.run_mb)


def measure(body: str, tets: int, representation: str) -> Measured:
    a = watched(body, tets, representation)
    start, cpu = a["peaks"]["start"], a["cpu"]
    over = lambda *names: max(a["peaks"][name] - start for name in names)
    run_s = cpu["smooth"] + cpu["analyse"] + cpu["write"] if a["whole"] else None
    return Measured(body, representation, a["vertices"], a["tets"], start, over("mesh"), over("surface"),
                    over("run", "write"),
                    cpu["read"] + cpu["mesh"] + cpu["surface"], run_s, a["disk"])  # fmt: skip


def slope(x, y) -> float:
    """Of y = a + b x by least squares of relative errors: small meshes count as much as large ones."""
    x, y = np.asarray(x, float), np.asarray(y, float)
    return float(np.polyfit(x, y, 1, w=1 / np.maximum(y, 1e-9))[0])


def memory_part(folder: Path, sizes: list[int]) -> None:
    cases = [("ball", n, r) for n in sizes for r in REPRESENTATIONS] + [("box", sizes[len(sizes) // 2], "sh4")]
    found: list[Measured] = []
    for case in cases:
        found.append(measure(*case))
        print(*case, f"{found[-1].peak_mb:.0f} MB", flush=True)
        write_memory(folder, found)


def write_memory(folder: Path, found: list[Measured]) -> None:
    rows = []
    for m in found:
        (run,) = study.plan(
            study.parse(f"{{name: x, inputs: [{{generator: ball}}], runs: {{representation: {m.representation}}}}}")
        )
        megabytes = (m.mesh_mb, m.surface_mb, m.run_mb, m.start_mb + m.peak_mb, needed_mb(m.tets, [run]))
        seconds = (f"{m.prepare_s:.2f}", "-" if m.run_s is None else f"{m.run_s:.2f}")
        rows.append(
            (m.body, m.representation, f"{m.vertices:,}", f"{m.tets:,}", *(f"{mb:,.0f}" for mb in megabytes), *seconds)
        )
    (folder / "memory.md").write_text(markdown_table(HEADER, rows))
    balls = [m for m in found if m.body == "ball"]
    if len({m.tets for m in balls}) > 1:
        write_fit(folder, balls)
    write_disk(folder, [m for m in balls if m.representation == "sh4"])
    start = max(m.start_mb for m in found)
    (folder / "start.md").write_text(
        f"A process that has loaded everything and computed nothing of size: {start:.0f} MB.\n"
    )


def write_fit(folder: Path, balls: list[Measured]) -> None:
    header = ["step", "bytes per vertex", "bytes per tet", "million tets per GB", "CPU s per million tets"]
    per_tet = lambda of, value: slope([m.tets for m in of], [value(m) for m in of]) * 1e6
    rows, rates, ratio = [], {}, slope([m.vertices for m in balls], [m.tets for m in balls])

    def add(name: str, mb: float, of: list[Measured], seconds) -> None:
        timed = [m for m in of if seconds(m) is not None]
        largest = max(timed, key=lambda m: m.tets)
        rates[name] = 1e6 * seconds(largest) / largest.tets
        rows.append(
            (name, f"{mb * ratio:,.0f}", f"{mb:,.0f}", f"{1e3 / mb:.1f}", f"{rates[name]:.0f} (at {largest.tets:,})")
        )

    add(
        "reading, meshing, cross field",
        per_tet(balls, lambda m: max(m.mesh_mb, m.surface_mb)),
        balls,
        lambda m: m.prepare_s,
    )
    for name in REPRESENTATIONS:
        of = [m for m in balls if m.representation == name]
        if len(of) > 1:
            add(f"field by {name}", per_tet(of, lambda m: m.run_mb), of, lambda m: m.run_s)
    (folder / "fit.md").write_text(markdown_table(header, rows))
    write_hours(folder, rates)


def write_hours(
    folder: Path, rates: dict[str, float], meshes: int = 10_000, millions: float = 0.1, cores: int = 64
) -> None:
    """Of a sweep with one run on each mesh, and with all."""
    prepare, *fields = rates.values()
    hours = lambda *of: f"{meshes * (1 + millions * (prepare + sum(of))) / 3600 / cores:.1f}"
    rows = [(name.removeprefix("field by "), hours(rate)) for name, rate in list(rates.items())[1:]] + [
        ("all of them", hours(*fields))
    ]
    (folder / "hours.md").write_text(markdown_table(["representation", "hours"], rows))


def write_disk(folder: Path, balls: list[Measured]) -> None:
    header = ["vertices", "tets", "result.json kB", "field.vtu MB", "other files MB", "all, bytes per vertex"]
    rows = []
    for m in balls:
        rest = sum(size for name, size in m.disk.items() if name not in ("result.json", "field.vtu"))
        sizes = (f"{m.disk['result.json'] / 1e3:.1f}", f"{m.disk['field.vtu'] / 1e6:.2f}", f"{rest / 1e6:.2f}")
        rows.append((f"{m.vertices:,}", f"{m.tets:,}", *sizes, f"{sum(m.disk.values()) / m.vertices:.0f}"))
    (folder / "disk.md").write_text(markdown_table(header, rows))


def store_part(folder: Path, runs: int) -> None:
    """A study of `runs` finished runs on files of 100 kB, all with the record of one real run."""
    text = (
        "name: many\ninputs: ['*.stl']\nruns: {representation: [sh4, sh469, geodesic, su2_midpoint]}\nfields: false\n"
    )
    rows = []

    def timed(name: str, work):
        begin = time.perf_counter()
        result = work()
        rows.append((name, f"{time.perf_counter() - begin:.2f}"))
        return result

    with tempfile.TemporaryDirectory() as place:
        for k in range(runs // 4):
            (Path(place) / f"part{k:05d}.stl").write_bytes(b"%d" % k + b" " * 100_000)
        described = study.parse(text, folder=place)
        old = time.time() - 60
        for path in Path(place).iterdir():
            os.utime(path, (old, old))
        time.sleep(2.5)  # files of this moment are not kept as known
        planned = timed("plan, reading every file", lambda: study.plan(described))
        out = Path(place) / "out"
        pretend_finished(described, planned, out)
        timed("first run after a leader was killed: all runs entered", lambda: study.run(described, out))
        timed("run with nothing to do", lambda: study.run(described, out))
        timed("status", lambda: study.status(out))
        timed("rows", lambda: study.rows(out))
        size = (out / "runs.sqlite").stat().st_size
        disk = sum(path.stat().st_size for path in (out / "runs").rglob("*") if path.is_file())
        timed("rows as a pandas table", lambda: __import__("octafield").to_pandas(study.rows(out)))
        rows.append(("start of a process, until it reads its input", f"{seconds_to_start(out, planned):.2f}"))
    (folder / "store.md").write_text(markdown_table(["what", "seconds"], rows))
    told = (
        f"{len(planned):,} runs: runs.sqlite {size / 1e6:.0f} MB, the runs' folders without fields {disk / 1e6:.0f} MB"
        f" in {2 * len(planned):,} files."
    )
    (folder / "sizes.md").write_text(told + "\n")
    print(told)


def pretend_finished(described, planned, out: Path) -> None:
    from octafield.fields.frame_field import compute_field
    from octafield.study.store import LOG_FILE, RECORD_FILE, STUDY_FILE

    record = compute_field(generate("ball"), FieldOptions(edge_length=0.3, threads=1)).record.to_dict()
    (out / "runs").mkdir(parents=True)
    (out / STUDY_FILE).write_text(json.dumps({"description": described.text, "folder": str(described.folder)}))
    now = time.time()
    for run in planned:
        made = out / "runs" / run.key
        made.mkdir()
        identity = {
            "key": run.key,
            "input": run.name,
            "repeat": 0,
            "state": "done",
            "message": "",
            "began": now,
            "ended": now + 1,
        }
        (made / RECORD_FILE).write_text(json.dumps({**record, **identity}, indent=1))
        (made / LOG_FILE).write_text("converged\n")


def seconds_to_start(out: Path, planned) -> float:
    seconds = []
    for _ in range(3):
        ready, begin = threading.Event(), time.perf_counter()
        child = Child(out, planned[:1], False, 1e9, lambda _, event, ready=ready: ready.set())
        ready.wait(60)
        seconds.append(time.perf_counter() - begin)
        child.stop()
    return min(seconds)


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("-o", "--output", type=Path)
    parser.add_argument("--tets", default="10000,50000,200000,800000")
    parser.add_argument("--runs", type=int, default=10_000)
    parser.add_argument("--part", choices=("memory", "store"), action="append")
    parser.add_argument("--one", nargs=3, help=argparse.SUPPRESS)
    a = parser.parse_args()
    if a.one:
        print(json.dumps(measured_run(a.one[0], int(a.one[1]), a.one[2])))
        return
    if a.output is None:
        parser.error("-o DIR is required")
    for part in a.part or ("memory", "store"):
        folder = a.output / part
        folder.mkdir(parents=True, exist_ok=True)
        if part == "memory":
            memory_part(folder, [int(n) for n in a.tets.split(",")])
        else:
            store_part(folder, a.runs)
        (folder / "when.md").write_text(when())
    (a.output / "scaling.md").write_text(page(TEXT.read_text(), a.output))
    print(a.output / "scaling.md")


if __name__ == "__main__":
    main()
