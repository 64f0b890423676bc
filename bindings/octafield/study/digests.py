"""SHA-256 of input files, of those unchanged since the last time without reading them again."""

import hashlib
import itertools
import os
import time
from pathlib import Path

from ..meshes.registry import MESH_FORMATS

# A file changed so shortly before it was read could be changed again within one tick of the file system's clock.
_TICKS_NS = 2 * 10**9


class Digests:
    """known: {path: (stamp, digest)} of earlier times. Afterwards `fresh` holds what was read now and may be kept."""

    def __init__(self, known: dict[str, tuple[str, str]] | None = None):
        self._known = known or {}
        self.fresh: dict[str, tuple[str, str]] = {}

    def of(self, path: Path) -> str:
        """Of the content, with that of the other file of TetGen's pairs. Raises OSError."""
        stamp, newest = _stamp([path, *_twins(path)])
        kept = self._known.get(str(path))
        if kept and kept[0] == stamp:
            return kept[1]
        digest = digest_of(path)
        if newest + _TICKS_NS < time.time_ns():
            self.fresh[str(path)] = (stamp, digest)
        return digest


def digest_of(path: Path) -> str:
    """Reads the file, whatever is known of it."""
    with path.open("rb") as file:
        sha = hashlib.file_digest(file, "sha256")
    for twin in _twins(path):
        sha.update(twin.read_bytes())
    return sha.hexdigest()


def _twins(path: Path) -> list[Path]:
    names = [
        path.name.replace(one, other)
        for form in MESH_FORMATS.values()
        if form.together
        for one, other in itertools.permutations(form.suffixes, 2)
        if one in path.suffixes
    ]
    return [twin for name in names if (twin := path.with_name(name)).is_file()]


def _stamp(paths: list[Path]) -> tuple[str, int]:
    """What changes when a file is written, and the last time that one was."""
    found = [os.stat(path) for path in paths]
    words = [f"{s.st_size} {s.st_mtime_ns} {s.st_ctime_ns} {s.st_ino} {s.st_dev}" for s in found]
    return "; ".join(words), max(max(s.st_mtime_ns, s.st_ctime_ns) for s in found)
