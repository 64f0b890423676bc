"""Pages whose tables benchmarks write: where and when they were measured, and templates."""

import datetime
import os
import platform
import subprocess
from pathlib import Path

from octafield.progress.phases import octafield_version


def when() -> str:
    """A line for the page: day, machine and how busy it was, version."""
    load = f"load average {os.getloadavg()[1]:.1f}"
    return f"{datetime.date.today()}, {machine()}, {load}, octafield {octafield_version()}, commit {commit()}.\n"


def machine() -> str:
    model = next(
        (
            line.split(":")[1].strip()
            for line in Path("/proc/cpuinfo").read_text().splitlines()
            if line.startswith("model name")
        ),
        platform.machine(),
    )
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    return f"{len(os.sched_getaffinity(0))} cores of {model}, {memory:.0f} GiB"


def commit() -> str:
    found = subprocess.run(
        ["git", "describe", "--always", "--dirty"], cwd=Path(__file__).parent, capture_output=True, text=True
    )
    return found.stdout.strip() or "unknown"


def page(template: str, folder: Path) -> str:
    """The text with every line "<< PATH" replaced by that file of the folder."""
    lines = []
    for line in template.splitlines():
        path = folder / line.removeprefix("<< ")
        lines.append(
            line if not line.startswith("<< ") else path.read_text().rstrip("\n") if path.is_file() else "(not run)"
        )
    return "\n".join(lines) + "\n"
