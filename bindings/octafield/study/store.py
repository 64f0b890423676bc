"""The folder of a study: one table, one folder per run.

A run is finished when runs/KEY exists: it is written elsewhere, to the disk, and renamed. The table runs.sqlite has one
line per finished run and is written by the process that leads the study only; what a killed leader had not entered is
entered by the next, which makes the whole table anew from the runs where it is broken.
"""

import contextlib
import json
import os
import shutil
import sqlite3
import tempfile
from collections.abc import Iterable, Iterator
from pathlib import Path
from typing import Any

from ..errors import InvalidInput, IoError
from ..files.writing import require_utf8, write_json
from ..records.field import FieldRecord, RunWithField, RunWithoutField
from ..records.record_file import RECORD_FILE, any_record, record_of, write_record
from .description import Study, parse
from .digests import Digests
from .plan import Run

STUDY_FILE, TABLE_FILE, RUNS, LOG_FILE = "study.json", "runs.sqlite", "runs", "log.txt"
LOCK_FILE = "lock"  # not the table: on network file systems closing that would give the lock up
_PARTIAL, _REMOVED = ".partial-", ".removed-"
RunRecord = RunWithField | RunWithoutField
_SCHEMA = (
    """CREATE TABLE IF NOT EXISTS runs (
    key TEXT PRIMARY KEY, input TEXT NOT NULL, state TEXT NOT NULL, message TEXT NOT NULL, record TEXT NOT NULL)""",
    "CREATE TABLE IF NOT EXISTS digests (path TEXT PRIMARY KEY, stamp TEXT NOT NULL, digest TEXT NOT NULL)",
)


class Store:
    def __init__(self, folder: str | Path):
        require_utf8(folder)
        self.folder = Path(folder).resolve()

    @contextlib.contextmanager
    def led(self, study: Study) -> Iterator[None]:
        """For the one process that leads the study: makes the folder, or goes on with it; its description is now
        `study`."""
        import fcntl

        self._make()
        with self._writing():
            lock = (self.folder / LOCK_FILE).open("a")
        with lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except OSError as error:
                raise InvalidInput(f"{self.folder}: another process runs this study", "study_is_running") from error
            with self._writing():
                self._describe(study)
                self._remove_partial()
                self._open_table()
            try:
                yield
            finally:
                self._remove_partial()

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

    def record(self, key: str) -> RunRecord | None:
        """Of a finished run; None where it is not there or not whole."""
        try:
            record = any_record(self.run_folder(key) / RECORD_FILE)
        except IoError:
            return None
        return record if isinstance(record, RunWithField | RunWithoutField) and record.key == key else None

    def is_finished(self, key: str) -> bool:
        return self.record(key) is not None

    def folders(self) -> set[str]:
        """Keys of all runs that have one."""
        with self._writing(), os.scandir(self.folder / RUNS) as entries:
            return {entry.name for entry in entries if not entry.name.startswith(".")}

    @contextlib.contextmanager
    def new_run(self, run: Run) -> Iterator[Path]:
        """A folder to write a run's files into; at runs/KEY after the block unless another process was first."""
        with self._writing():
            partial = Path(tempfile.mkdtemp(prefix=f"{_PARTIAL}{run.key}-", dir=self.folder / RUNS))
            partial.chmod(0o755)
            try:
                yield partial
                _to_disk(partial)
                with contextlib.suppress(FileExistsError):  # the same run on two machines: equal results
                    _rename_new(partial, self.run_folder(run.key))
            finally:
                shutil.rmtree(partial, ignore_errors=True)

    def enter(self, keys: Iterable[str]) -> list[str]:
        """Puts finished runs into the table, in one transaction. Returns their keys without those whose record is not
        whole: their folders are removed."""
        records = [(key, self.record(key)) for key in keys]
        lines = [(key, r.input, r.state, r.message, json.dumps(r.to_dict())) for key, r in records if r is not None]
        with self._table() as table:
            table.executemany("INSERT OR REPLACE INTO runs VALUES (?, ?, ?, ?, ?)", lines)
        for key, record in records:
            if record is None:
                shutil.rmtree(self.run_folder(key), ignore_errors=True)
        return [line[0] for line in lines]

    def forget(self, keys: list[str]) -> None:
        """Removes runs, so that they run again."""
        with self._table() as table:
            table.executemany("DELETE FROM runs WHERE key = ?", [(key,) for key in keys])
        for key in keys:
            shutil.rmtree(self.run_folder(key), ignore_errors=True)

    def entered(self) -> dict[str, RunRecord]:
        """Records in the table by key."""
        name = f"{self.folder / TABLE_FILE}, run"
        found = self._rows("SELECT key, record FROM runs")
        records = {key: record_of(json.loads(text), f"{name} {key}") for key, text in found}
        return {key: r for key, r in records.items() if isinstance(r, RunWithField | RunWithoutField)}

    def states(self) -> dict[str, str]:
        """done, failed or crashed, by key."""
        return dict(self._rows("SELECT key, state FROM runs"))

    def tets(self) -> dict[str, int]:
        """Of the runs that are done."""
        found = self._rows("SELECT key, json_extract(record, '$.tets') FROM runs WHERE state = 'done'")
        return {key: tets for key, tets in found if tets is not None}

    def digests(self) -> Digests:
        """Kept from earlier times; none where the table is broken."""
        try:
            found = self._rows("SELECT path, stamp, digest FROM digests")
        except IoError:
            found = []
        return Digests({path: (stamp, digest) for path, stamp, digest in found})

    def keep(self, digests: Digests) -> None:
        if digests.fresh:
            with self._table() as table:
                table.executemany(
                    "INSERT OR REPLACE INTO digests VALUES (?, ?, ?)", [(p, *kept) for p, kept in digests.fresh.items()]
                )

    def _rows(self, query: str) -> list[tuple[Any, ...]]:
        """None where there is no table, or a file without one."""
        path = self.folder / TABLE_FILE
        if not path.is_file() or not path.stat().st_size:
            return []
        with self._table() as table:
            name = query.split(" FROM ")[1].split()[0]
            if table.execute("SELECT 1 FROM sqlite_master WHERE name = ?", (name,)).fetchone() is None:
                return []
            return table.execute(query).fetchall()

    @contextlib.contextmanager
    def _table(self) -> Iterator[sqlite3.Connection]:
        try:
            with contextlib.closing(sqlite3.connect(self.folder / TABLE_FILE, timeout=60)) as table, table:
                yield table
        except sqlite3.Error as error:
            raise IoError(
                f"{self.folder / TABLE_FILE}: {error}; octafield study resume makes a broken table anew"
            ) from error

    def _open_table(self) -> None:
        """Makes the table; a broken one is emptied first, its lines are entered again from the runs."""
        path = self.folder / TABLE_FILE
        try:
            with contextlib.closing(sqlite3.connect(path, timeout=60)) as table:
                sound = table.execute("PRAGMA quick_check").fetchone() == ("ok",)
                table.execute("SELECT * FROM sqlite_master").fetchall()
        except sqlite3.OperationalError as error:  # locked, no access, disk full: not broken
            raise IoError(f"{path}: {error}") from error
        except sqlite3.DatabaseError:
            sound = False
        if not sound:
            path.write_bytes(b"")
            path.with_name(path.name + "-journal").unlink(missing_ok=True)
        with self._table() as table:
            for statement in _SCHEMA:
                table.execute(statement)

    def _make(self) -> None:
        """Refuses a folder that is not empty unless a study was begun in it: its table is made first."""
        with self._writing():
            filled = self.folder.is_dir() and any(self.folder.iterdir())
            # Asked after: another leader that fills the folder now has made the table by the time anything is seen.
            ours = any((self.folder / name).exists() for name in (TABLE_FILE, STUDY_FILE))
            if filled and not ours:
                raise InvalidInput(
                    f"{self.folder}: not empty and not the folder of a study; choose another", "foreign_folder"
                )
            self.folder.mkdir(parents=True, exist_ok=True)
            (self.folder / TABLE_FILE).touch()
            (self.folder / RUNS).mkdir(exist_ok=True)

    def _describe(self, study: Study) -> None:
        partial = self.folder / f".{STUDY_FILE}.partial"
        write_json(partial, {"description": study.text, "folder": str(study.folder.resolve())})
        os.replace(partial, self.folder / STUDY_FILE)

    def _remove_partial(self) -> None:
        """A worker on another machine may finish one at this moment: the rename lets either have it whole."""
        runs = self.folder / RUNS
        for left in runs.glob(f"{_PARTIAL}*"):
            with contextlib.suppress(OSError):
                left.rename(left.with_name(left.name.replace(_PARTIAL, _REMOVED, 1)))
        for left in runs.glob(f"{_REMOVED}*"):
            shutil.rmtree(left, ignore_errors=True)

    @contextlib.contextmanager
    def _writing(self) -> Iterator[None]:
        """What the system refuses, disk full for one, as an IoError."""
        try:
            yield
        except IoError:
            raise
        except OSError as error:
            raise IoError(
                f"{error.filename or self.folder}: cannot write there ({error.strerror or error})", "cannot_write"
            ) from error


def write_field(folder: Path, run: Run, field: FieldRecord, **about: object) -> None:
    """result.json of a run that is done: the record of its field, with what makes it this run."""
    write_record(folder / RECORD_FILE, RunWithField(**{**field, **about, **_identity(run, "done")}))


def write_failure(folder: Path, run: Run, state: str, message: str, **about: object) -> None:
    """result.json of a run that failed or crashed."""
    told = {"options": run.options.recorded(), **about, **_identity(run, state, message)}
    write_record(folder / RECORD_FILE, RunWithoutField(**told))


def _identity(run: Run, state: str, message: str = "") -> dict[str, Any]:
    return {"key": run.key, "input": run.name, "repeat": run.repeat, "state": state, "message": message}


def _to_disk(folder: Path) -> None:
    """So that a power cut after the rename finds the files whole."""
    for path in [*folder.iterdir(), folder]:
        number = os.open(path, os.O_RDONLY)
        try:
            os.fsync(number)
        finally:
            os.close(number)


def _rename_new(source: Path, target: Path) -> None:
    try:
        os.rename(source, target)  # fails where target holds files
    except OSError as error:
        if target.is_dir():
            raise FileExistsError(str(target)) from error
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error
