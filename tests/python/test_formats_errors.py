"""Damaged and foreign files: a typed error with the place, never another exception, never more memory than the file
deserves."""

import gzip
import struct
import warnings
import zipfile

import numpy as np
import octafield
import pytest
from conftest import box_tets
from format_table import frames_at
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from octafield import frame_formats, read_frames, write_frames
from octafield.domain.inputs import read_input
from octafield.files.reading import numbers_of, parsed_numbers

READ = [name for name, form in frame_formats.items() if form.read and form.write]
SUFFIX = {"geogram": ".txt", "geogram-centres": ".txt"}


@pytest.fixture(scope="module")
def samples(tmp_path_factory):
    """A small sound file of every format."""
    mesh, folder, found = box_tets(1), tmp_path_factory.mktemp("samples"), {}
    for name in READ:
        form = frame_formats[name]
        path = folder / f"{name}{SUFFIX.get(name) or form.extensions[0]}"
        write_frames(path, mesh, frames_at(mesh, form.where[0]), form.where[0], name)
        found[name] = path.read_bytes()
    return mesh, found


@pytest.mark.parametrize("name", READ)
@settings(max_examples=60, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(data=st.data())
def test_cut_and_altered_files_are_refused_or_read_and_nothing_else(samples, tmp_path, name, data):
    mesh, files = samples
    content = files[name]
    cut = data.draw(st.integers(0, len(content)))
    content = content[:cut] if data.draw(st.booleans()) else content
    altered = bytearray(content)
    for _ in range(data.draw(st.integers(0, 4))):
        if altered:
            altered[data.draw(st.integers(0, len(altered) - 1))] = data.draw(st.integers(0, 255))
    path = tmp_path / f"a{SUFFIX.get(name) or frame_formats[name].extensions[0]}"
    path.write_bytes(bytes(altered))
    given_mesh = None if frame_formats[name].holds_mesh else mesh
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            found = read_frames(path, given_mesh, name)
        except octafield.Error as error:
            assert path.name in str(error)
        else:
            assert np.allclose(np.linalg.norm(found.frames, axis=1), 1)


@pytest.mark.parametrize("suffix", sorted({e for f in frame_formats.values() if f.read for e in f.extensions}))
@settings(max_examples=40, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(content=st.binary(max_size=300))
def test_noise_is_refused(tmp_path, suffix, content):
    path = tmp_path / f"a{suffix}"
    path.write_bytes(content)
    try:
        assert len(read_frames(path).frames) < 100
    except octafield.Error as error:
        assert path.name in str(error)


CASES = {
    "a.txt": [
        ("1 0 0 0 1 0 0 0\n", "line 1: 8 numbers; 9 are needed"),
        ("1 0 0 0 1 0 0 0 1\n1 0 0 0 x 0 0 0 1\n", "line 2: no number: 'x'"),
        ("1 0 0\n0 1 0\n", "line 2: ends after 2 axes"),
    ],
    "a.frame": [
        ("FRAMES\n", "line 1: FRAME is needed"),
        ("FRAME\nmany\n", "line 2: the number of frames is needed, not 'many'"),
        ("FRAME\n2\n1 0 0 0 1 0 0 0 1\nEND\n", "holds 1 frames, but its head says 2"),
        ("FRAME\n1\n1 0 0 0 1 0 0 0\nEND\n", "line 3: 8 numbers"),
    ],
    "a.fra": [
        ("FRA 3\n", "line 1: 'FRA 1' is needed"),
        ("FRA 1\n1 3\n", "line 2: the number of tets"),
        ("FRA 1\n1 2 4\n1 0 0\n0 1 0\n", "2 vectors per tet; a frame has 3"),
        ("FRA 1\n1 3 4\n1 0 0\n0 1 0\n", "holds 2 vectors, but its head says 3"),
    ],
    "a.qtn": [("1 0 0 0 1", "line 1: holds 5 numbers"), ("1 0 0 0\n0 0 0 0\n", "line 2: quaternion 1")],
    "a.ff3": [
        ("9\n", "line 1: '9 N' is needed"),
        ("6 1\n1 2 3 4 5 6\n", "'9 N' is needed"),
        ("9 2\n1 0 0 0 1 0 0 0 1\n", "head says 2"),
    ],
    "a.ovm": [
        ("OVM BINARY\n", "begins with 'OVM ASCII'"),
        ("OVM ASCII\nVertices\n1\n0 0\n", "line 4: 2 numbers; 3 are needed"),
        ("OVM ASCII\nVertices\n2\n0 0 0\n", "Vertices has 1 rows, not 2|vertices has 1 rows, not 2"),
        ("OVM ASCII\nVertices\n1\n0 0 0\nEdges\n1\n0 7\nFaces\n0\nPolyhedra\n0\n", "edge 0 .* outside 0 .. 0"),
        ("OVM ASCII\nNonsense\n", "line 2: unknown section"),
    ],
    "a.npy": [(b"\x93NUMPY", "byte 0: no .npy"), (b"text", "no .npy")],
    "a.npz": [(b"PK", "no .npz file")],
    "a.ovmb": [(b"OVMB", "byte 0: 48 bytes are needed, 4 are left"), (bytes(60), "byte 0: not an OpenVolumeMesh")],
    "a.bfra": [(b"FRA 2\0" + struct.pack("<3i", 10**9, 9, 3), "byte 18: 0 bytes of numbers"), (b"FRA", "byte 0")],
    "a.vtu": [("<VTKFile", "line 1: no XML")],
    "a.msh": [("$MeshFormat\n", r"line 1: ends before \$EndMeshFormat")],
    "a.vtk": [("# vtk", "line 1: a legacy VTK file begins")],
}


@pytest.mark.parametrize(("name", "content", "message"), [(n, c, m) for n, cases in CASES.items() for c, m in cases])
def test_defects_are_told_with_their_place(tmp_path, name, content, message):
    path = tmp_path / name
    path.write_bytes(content if isinstance(content, bytes) else content.encode())
    with pytest.raises(octafield.Error, match=message) as caught:
        read_frames(path)
    assert str(path) in str(caught.value)


def test_huge_announcements_take_no_memory(tmp_path):
    np.save(tmp_path / "a.npy", np.zeros((1, 4)))
    data = (tmp_path / "a.npy").read_bytes().replace(b"(1, 4)", b"(10000000000, 4)")
    (tmp_path / "a.npy").write_bytes(data)
    with pytest.raises(octafield.IoError, match="announced|no .npy"):
        read_frames(tmp_path / "a.npy")
    head = b"OVMB\n\r\n\xff" + bytes([1, 1, 3, 1, 0, 0, 0, 0]) + struct.pack("<4Q", 10**15, 0, 0, 0)
    (tmp_path / "a.ovmb").write_bytes(head)
    with pytest.raises(octafield.IoError, match="10{15} elements of kind vertex in 48 bytes"):
        read_frames(tmp_path / "a.ovmb")


def test_pickles_are_not_opened(tmp_path):
    np.save(tmp_path / "a.npy", np.array([{"a": 1}], dtype=object), allow_pickle=True)
    with pytest.raises(octafield.IoError, match="a.npy"):
        read_frames(tmp_path / "a.npy")
    with zipfile.ZipFile(tmp_path / "a.npz", "w") as folder:
        folder.write(tmp_path / "a.npy", "frames.npy")
    with pytest.raises(octafield.IoError, match="frames.npy"):
        read_frames(tmp_path / "a.npz")


def test_damaged_gzip_absent_files_folders_and_binary_text(tmp_path):
    (tmp_path / "a.qtn.gz").write_bytes(gzip.compress(b"1 0 0 0")[:-5])
    with pytest.raises(octafield.IoError, match="damaged gzip"):
        read_frames(tmp_path / "a.qtn.gz")
    with pytest.raises(octafield.IoError, match="no such file"):
        read_frames(tmp_path / "b.qtn")
    (tmp_path / "c.qtn").mkdir()
    with pytest.raises(octafield.IoError, match="is a folder"):
        read_frames(tmp_path / "c.qtn")
    (tmp_path / "d.frame").write_bytes(b"FRAME\n1\n\xff\xfe")
    with pytest.raises(octafield.IoError, match=r"line 3: no text \(byte 8\)"):
        read_frames(tmp_path / "d.frame")
    with pytest.raises(octafield.IoError, match="unknown kind of file with frames"):
        read_frames(tmp_path / "e.doc")


def test_a_surface_is_no_mesh_of_frames(tmp_path, box_surface):
    octafield.write_surface(box_surface, tmp_path / "a.off")
    np.save(tmp_path / "a.npy", np.eye(4))
    with pytest.raises(octafield.InvalidInput, match="holds triangles"):
        read_frames(tmp_path / "a.npy", tmp_path / "a.off")
    with pytest.raises(octafield.InvalidInput, match="a TetMesh or its file"):
        read_frames(tmp_path / "a.npy", box_surface)


def test_damaged_vtp_surfaces_are_refused(tmp_path, box_surface):
    octafield.to_pyvista(box_surface).save(tmp_path / "a.vtp")
    assert len(read_input(tmp_path / "a.vtp").surface.triangles) == len(box_surface.triangles)
    data = (tmp_path / "a.vtp").read_bytes()
    for cut in (0, 20, len(data) // 3):
        (tmp_path / "b.vtp").write_bytes(data[:cut])
        with pytest.raises(octafield.Error, match="b.vtp"):
            read_input(tmp_path / "b.vtp")


def test_numbers_after_a_bad_word_are_not_lost_where_numpy_only_warns(monkeypatch):
    """As NumPy before 2.3 does."""

    def warns(text, sep):
        warnings.warn(
            "string or file could not be read to its end due to unmatched data", DeprecationWarning, stacklevel=1
        )
        return np.array([1.0])

    monkeypatch.setattr(np, "fromstring", warns)
    with pytest.raises(ValueError, match="read to its end"):
        parsed_numbers("1 x 3")
    with pytest.raises(octafield.IoError, match="a.qtn, line 2: no number: 'x'"):
        numbers_of("1\nx 3", "a.qtn")
