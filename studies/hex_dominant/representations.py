"""Which representation and boundary treatment lead to the best meshes: the study hexme.yaml, and a table of it."""

from pathlib import Path

import pandas
from octafield import study
from study_output import markdown_table

from ..benchmarks.pages import when

DESCRIPTION = Path(__file__).with_name("hexme.yaml")
BEST_WITHIN = 0.001  # of the volume
HEADER = [
    "boundary", "representation", "meshes", "hex volume %, mean", "median", "worst", "best on", "hex number %, mean",
    "hex SJ, mean", "volume %, against sh4 aligned", "better, worse than it", "field, CPU s",
]  # fmt: skip


def work(output: Path, jobs: int) -> None:
    """representations.md, representations_when.md and the study in the folder. Goes on where it was stopped."""
    folder = output / "hexme"
    study.run(study.load(DESCRIPTION), folder, jobs=jobs)
    (output / "representations.md").write_text(markdown_table(HEADER, summary(table(folder))))
    (output / "representations_when.md").write_text(when())


def table(folder: Path) -> pandas.DataFrame:
    """A line per run; shares are nan where there is no mesh."""
    found = []
    for row in study.rows(folder):
        line = {
            "input": row.input,
            "boundary": row.options["boundary"],
            "representation": row.options["representation"],
        }
        mesh = row.mesh if row.state == "done" else None
        if mesh is not None and mesh.error is None:
            line |= {"volume": mesh.hex_volume_share, "number": mesh.hex_number_share}
            line |= {"quality": mesh.scaled_jacobian["hexahedra"].mean} if "hexahedra" in mesh.scaled_jacobian else {}
        if row.state == "done":
            line["CPU s"] = row.cpu_seconds.smooth
        found.append(line)
    return pandas.DataFrame(found)


def summary(runs: pandas.DataFrame) -> list[list[str]]:
    """Best mean share of the volume first."""
    share = runs.pivot(index="input", columns=["boundary", "representation"], values="volume")
    best = share.ge(share.max(axis=1) - BEST_WITHIN, axis=0).sum()
    gain = share.sub(share["aligned", "sh4"], axis=0)
    lines = []
    for way, of in runs.groupby(["boundary", "representation"]):
        more, less = (gain[way] > BEST_WITHIN).sum(), (gain[way] < -BEST_WITHIN).sum()
        percent = [f"{100 * x:.1f}" for x in (of.volume.mean(), of.volume.median(), of.volume.min())]
        line = [*way, f"{of.volume.notna().sum()} of {len(of)}", *percent, str(best[way])]
        line += [f"{100 * of.number.mean():.1f}", f"{of.quality.mean():.3f}", f"{100 * gain[way].mean():+.2f}"]
        lines.append((of.volume.mean(), [*line, f"{more}, {less}", f"{of['CPU s'].sum():.1f}"]))
    return [line for _, line in sorted(lines, key=lambda each: -each[0])]
