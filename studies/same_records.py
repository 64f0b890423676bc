"""Do two installations of octafield give the same records? For reorganisations, which must not change a bit.

    python studies/same_records.py make OUT.json --octafield /path/to/other/.venv/bin/octafield
    python studies/same_records.py make NEW.json
    python studies/same_records.py compare OUT.json NEW.json

`make` runs field (frames at vertices and in tets), surface-field, compare and study on twenty small inputs: meshes of
../shared/data where it is there, and generated bodies. `compare` lists every key whose value differs, but for times,
memory, versions, paths, and options that only the second knows. Floating-point numbers are compared bit by bit.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path
from typing import Any

DATA = Path(__file__).resolve().parents[1] / "../shared/data"
TETS = ("s01c", "s03c", "s04c", "s05c", "s07c", "s10c", "s12c", "s14c", "s15c", "s17c", "i10c", "i11c")
SURFACES = (
    "s01_surface.stl",
    "s04_surface.obj",
    "i10_surface.stl",
    "s15_surface.stl",
    "s16_surface.stl",
    "s17_surface.obj",
)
NOT_COMPARED = {
    "version", "wall_seconds", "cpu_seconds", "peak_mb", "seconds", "input", "files", "commit", "machine",
    "created", "began", "ended",
}  # fmt: skip
STUDY = """name: same
inputs:
  - {generator: ball}
  - {generator: box}
mesh: {edge_length: 0.35}
runs:
  representation: [sh4, su2_midpoint]
  boundary: [aligned, fixed]
"""


def run(command: str, *arguments: str | Path) -> None:
    done = subprocess.run([command, *map(str, arguments), "-q"], capture_output=True, text=True)
    if done.returncode:
        raise SystemExit(f"{' '.join(map(str, arguments))}: {done.stderr.strip()}")


def records(command: str) -> dict[str, Any]:
    found: dict[str, Any] = {}
    with tempfile.TemporaryDirectory() as scratch:
        folder = Path(scratch)

        def one(name: str, what: str, path: Path, *options: str) -> None:
            record = folder / "record.json"
            run(command, what, path, "-o", folder / "out", "--json", record, *options)
            found[name] = json.loads(record.read_text())
            print(name, found[name].get("energy"), file=sys.stderr)

        for name in TETS:
            one(f"field {name}", "field", DATA / f"hexme/{name}.vtk.gz", "--sizes", "axes")
        for name in TETS[:4]:
            one(f"field in tets {name}", "field", DATA / f"hexme/{name}.vtk.gz", "--sampling", "tets")
        for name in SURFACES:
            one(f"field {name}", "field", DATA / f"surfaces/{name}")
            one(f"surface field {name}", "surface-field", DATA / f"surfaces/{name}")
        for name in TETS[:2]:
            run(command, "compare", DATA / f"hexme/{name}.vtk.gz", "-o", folder / f"compare-{name}")
            found[f"compare {name}"] = json.loads((folder / f"compare-{name}/results.json").read_text())
        (folder / "study.yaml").write_text(STUDY)
        run(command, "study", "run", folder / "study.yaml", "-o", folder / "study")
        runs = [json.loads(path.read_text()) for path in (folder / "study").rglob("result.json")]
        found["study"] = sorted(
            runs, key=lambda r: str([r.get(key) for key in ("input", "representation", "boundary")])
        )
    return found


def differences(a: Any, b: Any, path: str = "") -> list[str]:
    if isinstance(a, dict) and isinstance(b, dict):
        keys = [key for key in sorted({*a, *b}) if key not in NOT_COMPARED]
        if path.endswith("/options"):  # new options are no difference
            keys = [key for key in keys if key in a]
        return [d for key in keys for d in differences(a.get(key), b.get(key), f"{path}/{key}")]
    if isinstance(a, list) and isinstance(b, list) and len(a) == len(b):
        return [d for i, (x, y) in enumerate(zip(a, b)) for d in differences(x, y, f"{path}[{i}]")]
    return [] if a == b else [f"{path}: {str(a)[:80]} | {str(b)[:80]}"]


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("what", choices=("make", "compare"))
    parser.add_argument("files", nargs="+", type=Path)
    parser.add_argument("--octafield", default=str(Path(sys.executable).parent / "octafield"))
    given = parser.parse_args()
    if given.what == "make":
        given.files[0].write_text(json.dumps(records(given.octafield)))
        return
    old, new = (json.loads(path.read_text()) for path in given.files)
    found = differences(old, new)
    print("\n".join(found[:100]) or f"the same: {len(old)} sets of records")
    raise SystemExit(bool(found))


if __name__ == "__main__":
    main()
