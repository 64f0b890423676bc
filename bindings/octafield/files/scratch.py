"""Writers that take the path of a plain file, for places of any kind."""

from collections.abc import Callable
from pathlib import Path

from ..errors import IoError
from .reading import write_whole
from .writing import scratch_folder


def through_file(path: Path, suffix: str, write: Callable[[Path], None]) -> None:
    """For writers that take a path: writes to a scratch file, then to the place wanted, packed where its name says
    so."""
    with scratch_folder() as folder:
        plain = folder / f"output{suffix}"
        try:
            write(plain)
        except OSError as error:  # IoError, too
            reason = error.strerror or str(error).partition(f"{plain}: ")[2].partition(";")[0]
            raise IoError(
                f"{path}: cannot be written to a scratch file first ({reason}); is {folder.parent} full?"
            ) from error
        write_whole(path, [plain.read_bytes()])
