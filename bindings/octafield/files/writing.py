"""Output folders that are either complete or absent.

Everything is written to a staging folder above (new target) or inside (existing target) the final place and moved there
at the end. An existing folder is reused only if empty or holding an earlier result of octafield, whose other files
stay.
"""

import contextlib
import json
import os
import shutil
import tempfile
from collections.abc import Callable, Iterable, Iterator, Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ..errors import InvalidInput, IoError

if TYPE_CHECKING:
    import pyvista

_listeners: list[
    Callable[[Path, bool], object]
] = []  # called with (path, alive) when a staging folder appears or goes, see process.py


def on_staging(listener: Callable[[Path, bool], object]) -> None:
    """Has `listener(path, alive)` called whenever a staging folder is made or goes."""
    _listeners.append(listener)


@contextlib.contextmanager
def staged_folder(target: str | Path, marker: str) -> Iterator[Path]:
    """A folder to write into; its content is at `target` after the block, and nowhere when the block raises.

    marker: name of the JSON file that identifies a result of ours (a record or list of records with key "files").
    """
    require_utf8(target)
    target = Path(target).resolve()
    earlier = earlier_files(target, marker)
    parent = target
    while not parent.is_dir():
        parent = parent.parent
    try:
        staging = Path(tempfile.mkdtemp(prefix=f".{target.name}.partial-", dir=parent))
        staging.chmod(0o755)
    except OSError as error:
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error
    with _announced(staging):
        yield staging
        _commit(staging, target, earlier)


@contextlib.contextmanager
def scratch_folder() -> Iterator[Path]:
    """A folder for intermediate files, gone after the block and after an interrupt."""
    with _announced(Path(tempfile.mkdtemp(prefix="octafield-"))) as folder:
        yield folder


@contextlib.contextmanager
def _announced(folder: Path) -> Iterator[Path]:
    try:
        _tell(folder, True)
        yield folder
    finally:
        shutil.rmtree(folder, ignore_errors=True)
        _tell(folder, False)


def require_utf8(path: str | Path) -> None:
    """Names go into JSON and VTK files, which hold UTF-8 only."""
    try:
        str(path).encode()
    except UnicodeEncodeError as error:
        raise InvalidInput(f"{str(path)!r}: the name is not UTF-8; rename it", "name_not_utf8") from error


def earlier_files(target: Path, marker: str) -> list[Path]:
    """Relative paths of the earlier result in `target`. Raises InvalidInput when that is a file or not ours."""
    if not target.exists():
        return []
    if not target.is_dir():
        raise InvalidInput(f"{target}: exists and is not a folder; choose another output", "output_not_a_folder")
    if not any(target.iterdir()):
        return []
    try:
        content = json.loads((target / marker).read_text())
        records = content if isinstance(content, list) else [content]
        names = {name for record in records for name in record["files"]}
    except (OSError, ValueError, TypeError, KeyError) as error:
        raise InvalidInput(
            f"{target}: not empty and not an earlier result of octafield ({marker} is missing or not ours); "
            "choose another output folder",
            "foreign_folder",
        ) from error
    paths = [Path(name) for name in sorted(names | {marker})]
    return [path for path in paths if not path.is_absolute() and ".." not in path.parts]


def write_json(path: Path, value: Any) -> None:
    """JSON with numbers at full precision; not-a-number and infinities are refused, they are no JSON."""
    write_file(path, (json.dumps(value, indent=1, allow_nan=False) + "\n").encode())


def write_file(path: Path, content: bytes) -> None:
    try:
        path.write_bytes(content)
    except OSError as error:
        raise IoError(f"{path}: cannot write there ({error.strerror})") from error


def text_array(name: str, texts: Iterable[str]) -> Any:
    """Of VTK. UTF-8, as in the other files; pyvista's own field data holds ASCII only."""
    from vtkmodules.vtkCommonCore import vtkStringArray

    array = vtkStringArray()
    array.SetName(name)
    for text in texts:
        array.InsertNextValue(text)
    return array


def vtp_bytes(surface: "pyvista.PolyData", metadata: Mapping[str, str] | None = None) -> bytes:
    """A .vtp file in memory: VTK's writers of files end the process where the disk is full. metadata: field data."""
    from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

    for name, text in (metadata or {}).items():
        surface.GetFieldData().AddArray(text_array(name, [text]))
    writer = vtkXMLPolyDataWriter()
    writer.SetInputData(surface)
    writer.SetDataModeToBinary()
    writer.SetWriteToOutputString(True)
    writer.Write()
    return str(writer.GetOutputString()).encode()


def vtu_bytes(grid: "pyvista.UnstructuredGrid", metadata: dict[str, str]) -> bytes:
    """A .vtu file in memory, compressed. metadata: field data, as bytes: meshio reads no strings there."""
    import numpy as np
    from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter

    for name, text in metadata.items():
        grid.field_data[name] = np.frombuffer(text.encode(), np.uint8)
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetInputData(grid)
    writer.SetDataModeToBinary()
    writer.SetCompressorTypeToZLib()
    writer.SetWriteToOutputString(True)
    writer.Write()
    return str(writer.GetOutputString()).encode()


def _commit(staging: Path, target: Path, earlier: list[Path]) -> None:
    try:
        if not target.is_dir():
            target.parent.mkdir(parents=True, exist_ok=True)
            os.rename(staging, target)
            return
        for path in earlier:
            (target / path).unlink(missing_ok=True)
        for folder in sorted({path.parent for path in earlier} - {Path()}, reverse=True):
            with contextlib.suppress(OSError):  # something else is in there
                (target / folder).rmdir()
        for path in sorted(p for p in staging.rglob("*") if p.is_file()):
            final = target / path.relative_to(staging)
            final.parent.mkdir(parents=True, exist_ok=True)
            os.replace(path, final)
    except OSError as error:
        raise IoError(f"{target}: cannot write there ({error.strerror})") from error


def _tell(staging: Path, alive: bool) -> None:
    for listener in _listeners:
        listener(staging, alive)
