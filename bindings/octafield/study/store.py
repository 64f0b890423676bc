"""The folder of a study: one table, one folder per run.

A run is finished when runs/KEY exists: it is written elsewhere and renamed. The table runs.sqlite has one line per finished
run and is written by the process that leads the study only; what a killed leader had not entered is entered by the next.
"""

import contextlib
import json
import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterator
from dataclasses import asdict
from pathlib import Path

from ..errors import InvalidInput, IoError
from ..output import require_utf8, write_json
from .description import Study, parse
from .plan import Run

STUDY_FILE, TABLE_FILE, RUNS, RECORD_FILE, LOG_FILE = "study.json", "runs.sqlite", "runs", "result.json", "log.txt"
_PARTIAL = ".partial-"
_SCHEMA = """CREATE TABLE IF NOT EXISTS runs (
    key TEXT PRIMARY KEY, input TEXT NOT NULL, state TEXT NOT NULL, message TEXT NOT NULL, record TEXT NOT NULL)"""


class Store:
    def __init__(self, folder: str | Path):
        require_utf8(folder)
        self.folder = Path(folder).resolve()

    @contextlib.contextmanager
    def led(self, study: Study) -> Iterator[None]:
        """For the one process that leads the study: makes the folder, or goes on with it; its description is now `study`."""
        import fcntl

        self._make()
        with (self.folder / TABLE_FILE).open("a") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                raise InvalidInput(f"{self.folder}: another process runs this study", "study_is_running") from error
            self._describe(study)
            for left in (self.folder / RUNS).glob(f"{_PARTIAL}*"):
                shutil.rmtree(left, ignore_errors=True)
            with self._table() as table:
                table.execute(_SCHEMA)
            yield

    def study(self) -> Study:
        """What was run last in this folder."""
        try:
            content = json.loads((self.folder / STUDY_FILE).read_text(encoding="utf-8"))
            return parse(content["description"], folder=content["folder"], name=f"{self.folder / STUDY_FILE}")
        except (OSError, ValueError, KeyError, TypeError) as error:
            message = f"{self.folder}: not the folder of a study ({STUDY_FILE} is missing or not ours)"
            raise InvalidInput(message, "foreign_folder") from error

    def run_folder(self, key: str) -> Path:
        return self.folder / RUNS / key

    def is_finished(self, key: str) -> bool:
        return (self.run_folder(key) / RECORD_FILE).is_file()

    @contextlib.contextmanager
    def new_run(self, run: Run) -> Iterator[Path]:
        """A folder to write a run's files into; at runs/KEY after the block unless another process was first."""
        parent = self.folder / RUNS
        partial = Path(tempfile.mkdtemp(prefix=f"{_PARTIAL}{run.key}-", dir=parent))
        partial.chmod(0o755)
        try:
            yield partial
            with contextlib.suppress(FileExistsError):  # the same run on two machines: equal results
                _rename_new(partial, self.run_folder(run.key))
        finally:
            shutil.rmtree(partial, ignore_errors=True)

    def enter(self, keys: list[str]) -> list[dict]:
        """Puts finished runs into the table, in one transaction; their records."""
        records = [json.loads((self.run_folder(key) / RECORD_FILE).read_text()) for key in keys]
        lines = [(r["key"], r["input"], r["state"], r["message"], json.dumps(r)) for r in records]
        with self._table() as table:
            table.executemany("INSERT OR REPLACE INTO runs VALUES (?, ?, ?, ?, ?)", lines)
        return records

    def forget(self, keys: list[str]) -> None:
        """Removes runs, so that they run again."""
        with self._table() as table:
            table.executemany("DELETE FROM runs WHERE key = ?", [(key,) for key in keys])
        for key in keys:
            shutil.rmtree(self.run_folder(key), ignore_errors=True)

    def entered(self) -> dict[str, dict]:
        """Records in the table by key."""
        if not (self.folder / TABLE_FILE).is_file():
            return {}
        with self._table() as table:
            return {key: json.loads(text) for key, text in table.execute("SELECT key, record FROM runs")}

    @contextlib.contextmanager
    def _table(self) -> Iterator[sqlite3.Connection]:
        try:
            with contextlib.closing(sqlite3.connect(self.folder / TABLE_FILE, timeout=60)) as table, table:
                yield table
        except sqlite3.Error as error:
            raise IoError(f"{self.folder / TABLE_FILE}: {error}") from error

    def _make(self) -> None:
        """Refuses a folder that is not empty unless a study was begun in it: its table is made first."""
        try:
            if self.folder.is_dir() and any(self.folder.iterdir()) and not (self.folder / TABLE_FILE).exists():
                raise InvalidInput(f"{self.folder}: not empty and not the folder of a study; choose another", "foreign_folder")
            self.folder.mkdir(parents=True, exist_ok=True)
            (self.folder / TABLE_FILE).touch()
            (self.folder / RUNS).mkdir(exist_ok=True)
        except OSError as error:
            raise IoError(f"{self.folder}: cannot write there ({error.strerror})") from error

    def _describe(self, study: Study) -> None:
        partial = self.folder / f".{STUDY_FILE}.partial"
        try:
            write_json(partial, {"description": study.text, "folder": str(study.folder.resolve())})
            os.replace(partial, self.folder / STUDY_FILE)
        except OSError as error:
            raise IoError(f"{self.folder}: cannot write there ({error.strerror})") from error


def write_record(folder: Path, run: Run, record: dict, state: str, message: str = "") -> None:
    """result.json: the record of `octafield field`, or the options alone, with what makes it this run."""
    identity = {"key": run.key, "input": run.name, "repeat": run.repeat, "state": state, "message": message}
    write_json(folder / RECORD_FILE, {"options": asdict(run.options), **record, **identity})


def _rename_new(source: Path, target: Path) -> None:
    try:
        os.rename(source, target)  # fails where target holds files
    except OSError as error:
        if target.is_dir():
            raise FileExistsError(str(target)) from error
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error
