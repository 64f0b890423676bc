"""Mutation check, run by hand: changes one place of a module at a time and counts the changes that its tests notice.

    python tests/mutation/run.py                          # every module of modules.py
    python tests/mutation/run.py sizes.py study/plan.py --most 30 --seed 1
    python tests/mutation/run.py sizes.py --lines 46,102   # of these lines alone, as after a test was added
    python tests/mutation/run.py volume/analysis/src/singularities.cpp --build build/release

Python modules are changed in a copy of the package. Of C++ files the changed one is compiled and linked before the
library into a test program of its own. Neither the sources nor the build are touched. Ends with 1 where the score of a
module is below --least.
"""

import argparse
import importlib.util
import multiprocessing
import os
import re
import shlex
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

import hypothesis  # noqa: F401  loaded once, for all mutants
import meshio  # noqa: F401
import pytest
import pyvista  # noqa: F401
import scipy.spatial  # noqa: F401
from modules import CPP, PYTHON, Module
from operators import Mutant, cpp_mutants, python_mutants, sampled

ROOT = Path(__file__).resolve().parents[2]


class PythonBench:
    """A copy of the package to change."""

    def __init__(self, folder: Path, limit: float):
        self._package = folder / "octafield"
        self._limit = limit
        installed = Path(importlib.util.find_spec("octafield").origin).parent
        shutil.copytree(installed, self._package, ignore=shutil.ignore_patterns("__pycache__"))
        self._environment = {"PYTHONPATH": str(folder), "PYTHONDONTWRITEBYTECODE": "1"}
        sys.dont_write_bytecode = True

    def source(self, name: str) -> Path:
        return self._package / name

    def mutants(self, name: str) -> list[Mutant]:
        return python_mutants(self.source(name).read_text())

    def notices(self, name: str, module: Module, source: str) -> bool:
        path, before = self.source(name), self.source(name).read_text()
        path.write_text(source)
        try:
            child = multiprocessing.get_context("fork").Process(target=self._run, args=(module,))
            child.start()
            child.join(self._limit)
            if child.is_alive():  # a loop that does not end is noticed
                child.kill()
                child.join()
            return child.exitcode != 0
        finally:
            path.write_text(before)

    def _run(self, module: Module) -> None:
        """In a process that has loaded everything but octafield."""
        silence = os.open(os.devnull, os.O_WRONLY)
        os.dup2(silence, 1)
        os.dup2(silence, 2)
        os.environ |= self._environment
        sys.path.insert(0, str(self._package.parent))
        os.chdir(ROOT)
        files = [str(ROOT / "tests" / "python" / test) for test in module.tests]
        os._exit(int(pytest.main(["-x", "-q", "-p", "no:cacheprovider", *files])))


class CppBench:
    """The commands by which ninja makes a test program, with one object more."""

    def __init__(self, folder: Path, build: Path, limit: float):
        self._folder, self._build, self._limit = folder, build.resolve(), limit

    def mutants(self, name: str) -> list[Mutant]:
        return cpp_mutants((ROOT / name).read_text())

    def notices(self, name: str, module: Module, source: str) -> bool:
        commands = subprocess.run(
            ["ninja", "-C", self._build, "-t", "commands", module.target], check=True, capture_output=True, text=True
        ).stdout.splitlines()
        (compile_,) = (line for line in commands if re.search(rf" -c \S*{re.escape(name)}$", line))
        changed, made, program = (
            self._folder / Path(name).name,
            self._folder / "changed.o",
            self._folder / module.target,
        )
        changed.write_text(source)
        words = shlex.split(compile_.replace(" -O3", " -O1").replace(" -Werror", ""))
        words = words[: words.index("-MD")] + [f"-I{(ROOT / name).parent}", "-o", str(made), "-c", str(changed)]
        if subprocess.run(words, cwd=self._build, capture_output=True).returncode:
            raise NotAProgram
        link = next(line for line in reversed(commands) if f" -o tests/{name.split('/')[0]}/{module.target} " in line)
        link = link.split("&& ")[1].replace(
            f" -o tests/{name.split('/')[0]}/{module.target} ", f" {made} -o {program} "
        )
        subprocess.run(shlex.split(link.split(" && ")[0]), cwd=self._build, check=True, capture_output=True)
        return _fails([program, f"--gtest_filter={module.tests[0]}", "--gtest_fail_fast"], self._folder, self._limit)


class NotAProgram(Exception):
    """The change does not compile."""


def _fails(command: list[object], folder: Path, limit: float) -> bool:
    try:
        return (
            subprocess.run([str(word) for word in command], cwd=folder, capture_output=True, timeout=limit).returncode
            != 0
        )
    except subprocess.TimeoutExpired:
        return True


def check(name: str, module: Module, bench: PythonBench | CppBench, most: int, seed: int, lines: set[int]) -> float:
    """Prints the survivors; the score in per cent."""
    mutants = [mutant for mutant in sampled(bench.mutants(name), most, seed) if not lines or mutant.line in lines]
    original = Path(bench.source(name)).read_text() if isinstance(bench, PythonBench) else (ROOT / name).read_text()
    if bench.notices(name, module, original):
        raise SystemExit(f"{name}: its tests fail without any change")
    noticed, counted = 0, 0
    for mutant in mutants:
        change = (
            mutant.what
            if isinstance(bench, CppBench)
            else f"{mutant.what}: {original.splitlines()[mutant.line - 1].strip()}"
        )
        reason = next((reason for part, reason in module.equivalent.items() if part in change), None)
        if reason is not None:
            continue
        try:
            found = bench.notices(name, module, mutant.source)
        except NotAProgram:
            continue
        counted, noticed = counted + 1, noticed + found
        if not found:
            print(f"  survived: {name}:{mutant.line}: {change}", flush=True)
    score = 100 * noticed / counted if counted else 100.0
    print(f"{name}: {noticed} of {counted} noticed, {score:.0f} %", flush=True)
    return score


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("modules", nargs="*", default=[*PYTHON, *CPP], help="of modules.py; all by default")
    parser.add_argument("--most", type=int, default=25, help="mutants per module, drawn by the seed (25)")
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument(
        "--lines",
        type=lambda text: {int(word) for word in text.split(",")},
        default=set(),
        help="of the drawn ones those of these lines",
    )
    parser.add_argument("--least", type=float, default=90.0, help="per cent (90)")
    parser.add_argument("--limit", type=float, default=300.0, help="seconds for the tests of one mutant (300)")
    parser.add_argument(
        "--build", type=Path, default=ROOT / "build" / "release", help="of ninja, with OCTAFIELD_TESTS (build/release)"
    )
    given = parser.parse_args()
    for name in given.modules:
        if name not in {**PYTHON, **CPP}:
            parser.error(f"{name} is not in modules.py")
    with tempfile.TemporaryDirectory() as folder:
        scores = []
        for name in given.modules:
            bench = (
                PythonBench(Path(tempfile.mkdtemp(dir=folder)), given.limit)
                if name in PYTHON
                else CppBench(Path(folder), given.build, given.limit)
            )
            scores.append(check(name, {**PYTHON, **CPP}[name], bench, given.most, given.seed, given.lines))
    sys.exit(min(scores) < given.least)


if __name__ == "__main__":
    main()
