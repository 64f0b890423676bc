"""Packed files that would fill the memory are refused by name before they do, however they are packed; sound ones are
read."""

import gzip
import io
import lzma
import subprocess
import sys
import zipfile
import zlib

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield.domain.inputs import read_input
from octafield.errors import IoError
from octafield.files import reading as files
from octafield.files.reading import most_unpacked, read_bytes


@pytest.fixture
def small(monkeypatch):
    """The limits as they are, with the floor at 64 kB: tests of megabytes, not of gigabytes."""
    monkeypatch.setattr(files, "_UNPACKED", 1 << 16)


def test_a_packed_file_may_become_256_mib_or_a_hundred_times_its_size():
    assert [most_unpacked(size) for size in (0, 2 << 20, 3 << 20, 1 << 30)] == [
        256 << 20,
        256 << 20,
        300 << 20,
        100 << 30,
    ]


@pytest.mark.parametrize("members", [1, 3])
def test_gzip_of_more_than_its_limit_is_refused_by_name_and_of_less_is_read(tmp_path, small, members):
    zeros = b"".join(gzip.compress(bytes(1 << 19), 9) for _ in range(members))
    path = tmp_path / "a.mesh.gz"
    path.write_bytes(zeros)
    with pytest.raises(
        IoError,
        match=(
            rf"a.mesh.gz: {len(zeros):,} packed bytes become more than {most_unpacked(len(zeros)):,}: .*without packing"
        ),
    ):
        read_bytes(path)
    for count in (1 << 16, (1 << 16) + 1):
        path.write_bytes(gzip.compress(bytes(count), 9))
        if count == 1 << 16:
            assert read_bytes(path) == bytes(count)
        else:
            with pytest.raises(IoError, match="become more than 65,536"):
                read_bytes(path)
    content = np.random.default_rng(1).bytes(3 << 19)  # more than two pieces
    path.write_bytes(gzip.compress(content[: 1 << 20]) + gzip.compress(content[1 << 20 :]))
    assert read_bytes(path) == content


def npz(path, arrays, **how):
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED, **how) as folder:
        for name, values in arrays.items():
            stream = io.BytesIO()
            np.lib.format.write_array(stream, values)
            folder.writestr(f"{name}.npy", stream.getvalue())


def test_npz_members_are_bounded_in_all(tmp_path, small):
    mesh = box_tets(2)
    frames = np.tile([1.0, 0, 0, 0], (len(mesh.vertices), 1))
    path = tmp_path / "a.npz"
    npz(path, {"frames": frames, "vertices": np.asarray(mesh.vertices), "tets": np.asarray(mesh.tets)})
    assert len(of.read_frames(path).frames) == len(frames)
    npz(path, {"frames": frames} | {f"more{k}": np.zeros(4000) for k in range(9)})
    size = path.stat().st_size
    npz(path, {"frames": frames} | {f"more{k}": np.zeros(40_000) for k in range(9)})
    with pytest.raises(IoError, match="a.npz: .* bytes announce .* unpacked, more than") as error:
        of.read_frames(path)
    assert size < path.stat().st_size and "damaged" not in str(error.value)
    packed = gzip.compress(path.read_bytes())  # packed twice: the file counts, not what it becomes
    (tmp_path / "b.npz.gz").write_bytes(packed)
    with pytest.raises(IoError, match=f"b.npz.gz: {len(packed):,} bytes announce"):
        of.read_frames(tmp_path / "b.npz.gz")


PACK = {"vtkZLibDataCompressor": lambda data: zlib.compress(data, 9), "vtkLZMADataCompressor": lzma.compress}


def vtu(compressor, block=1 << 15, lie=0, count=4, kind="UnstructuredGrid"):
    """One tet of `count` points, all but four of them at the origin; appended raw, in packed blocks. lie: added to the
    announced size of a block."""
    points = np.zeros((count, 3))
    points[1:4] = np.eye(3)
    arrays = {"Points": points, "connectivity": np.arange(4), "offsets": np.array([4]), "types": np.array([10])}
    appended, offsets = b"", {}
    for name, values in arrays.items():
        data = values.tobytes()
        blocks = [PACK[compressor](data[k : k + block]) for k in range(0, len(data), block)]
        offsets[name] = len(appended)
        head = [len(blocks), block + lie, len(data) % block and len(data) % block + lie, *map(len, blocks)]
        appended += np.array(head, "<u8").tobytes() + b"".join(blocks)
    entry = lambda name, kind: (
        f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{3 if name == "Points" else 1}" format="appended"'
        f' offset="{offsets[name]}"/>'
    )
    order = 'byte_order="LittleEndian" header_type="UInt64"'
    head = f"""<VTKFile type="{kind}" version="1.0" {order} compressor="{compressor}"><UnstructuredGrid>
<Piece NumberOfPoints="{count}" NumberOfCells="1"><Points>{entry("Points", "Float64")}</Points><Cells>
{"".join(entry(name, "Int64") for name in ("connectivity", "offsets", "types"))}</Cells></Piece></UnstructuredGrid>
<AppendedData encoding="raw">_"""
    return head.encode() + appended + b"</AppendedData></VTKFile>"


@pytest.mark.parametrize("compressor", PACK)
def test_arrays_of_vtk_files_are_bounded_in_all_and_by_the_sizes_of_their_blocks(tmp_path, small, compressor):
    path = tmp_path / "a.vtu"
    for block in (1 << 15, 96, 40):  # whole blocks and a last one that is shorter
        path.write_bytes(vtu(compressor, block))
        assert len(read_input(path).tets.tets) == 1
    for lie in (-1, 1):
        path.write_bytes(vtu(compressor, 96, lie))
        with pytest.raises(IoError, match="a.vtu, line .*damaged .a block does not end after the"):
            read_input(path)
    path.write_bytes(vtu(compressor, 1 << 14, count=100_000))
    with pytest.raises(IoError, match="a.vtu, line .* bytes announce .* unpacked, more than") as error:
        read_input(path)
    assert "damaged" not in str(error.value)
    packed = gzip.compress(path.read_bytes())
    (tmp_path / "b.vtu.gz").write_bytes(packed)
    with pytest.raises(IoError, match=f": {len(packed):,} bytes announce"):
        read_input(tmp_path / "b.vtu.gz")


BOMB = """
import resource, sys
import octafield.files.reading
import numpy, octafield, octafield.domain.inputs
space = int(open("/proc/self/statm").read().split()[0]) * resource.getpagesize()
resource.setrlimit(resource.RLIMIT_AS, (space + (700 << 20),) * 2)
try:
    octafield.domain.inputs.read_input(sys.argv[1])
except octafield.IoError as error:
    print(error)
"""


def test_a_small_file_that_would_become_gigabytes_is_refused_within_the_limit(tmp_path):
    """2 GiB of blanks in 2 MB, with 700 MiB of memory to spend."""
    path = tmp_path / "a.mesh.gz"
    path.write_bytes(64 * gzip.compress(b" " * (32 << 20)))
    assert path.stat().st_size < 3 << 20
    done = subprocess.run([sys.executable, "-c", BOMB, path], capture_output=True, text=True)
    assert "a.mesh.gz" in done.stdout and "packed bytes become more than 268,435,456" in done.stdout, done.stderr
