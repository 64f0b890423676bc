"""Laws of all readers, of meshes and of frames: a cut file is refused or reads as the whole one, an altered one is
refused or read, a foreign one is refused; what editors do to text changes nothing. Errors are octafield's and name the
file."""

import gzip
import resource
import signal

import meshio
import numpy as np
import octafield as of
import pytest
import vtk
from conftest import box_tets
from format_table import frames_at
from octafield import frame_formats, read_frames, write_frames
from octafield.domain.inputs import read_input
from octafield.meshes.registry import written_suffixes
from octafield.runs.conversion import convert_file
from test_tet_input import cube_edges, halves, write_msh4, write_tetgen_boundary

MESHES = written_suffixes()
DIALECTS = (
    "msh2 text",
    "msh4 text",
    "vtk 5.1 binary",
    "vtk 4.2 binary",
    "vtu text",
    "vtu raw",
    "vtu packed",
    "tetgen .node",
    "tetgen .face",
    "tetgen .edge",
)
FRAMES = tuple(f"frames {name}" for name, form in frame_formats.items() if form.read and form.write)
NAMES = (*MESHES, *DIALECTS, *FRAMES)
BESIDE = (".node", ".ele", ".face", ".edge")
# Of these, whatever is cut off at the end of a line cannot be missed: nothing tells how much there should be.
NO_COUNT = {".obj", "frames geogram-centres"}


class Samples:
    """A small sound file of every kind, and its reader: arrays by name."""

    def __init__(self, folder):
        self.mesh, self.folder, self.files = box_tets(1), folder, {}
        points, tets = np.asarray(self.mesh.vertices), np.asarray(self.mesh.tets)
        cells, ids = [("line", cube_edges(self.mesh)), ("tetra", tets)], [np.ones(12, int), halves(self.mesh)]
        grid = meshio.Mesh(points, cells, cell_data={"CellEntityIds": ids})
        of_gmsh = meshio.Mesh(points, cells, cell_data={"gmsh:physical": ids, "gmsh:geometrical": ids})
        meshio.vtk.write(folder / "source.vtk", grid, binary=True)
        for suffix in MESHES:
            self.files[suffix] = folder / f"mesh{suffix}"
            convert_file(folder / "source.vtk", self.files[suffix])
        meshio.gmsh.write(self._file("msh2 text", ".msh"), of_gmsh, "2.2", binary=False)
        write_msh4(self._file("msh4 text", ".msh"), self.mesh)
        meshio.vtk.write(self._file("vtk 5.1 binary", ".vtk"), grid, fmt_version="5.1", binary=True)
        meshio.vtk.write(self._file("vtk 4.2 binary", ".vtk"), grid, fmt_version="4.2", binary=True)
        for name, mode in (("vtu text", "Ascii"), ("vtu raw", "Appended"), ("vtu packed", "Binary")):
            writer = vtk.vtkXMLUnstructuredGridWriter()
            writer.SetInputData(of.to_pyvista(self.mesh))
            writer.SetFileName(str(self._file(name, ".vtu")))
            getattr(writer, f"SetDataModeTo{mode}")()
            writer.SetEncodeAppendedData(False)
            if mode != "Binary":
                writer.SetCompressorTypeToNone()
            writer.Write()
        write_tetgen_boundary(folder / "tetgen", self.mesh, 1)
        self.files |= {f"tetgen {suffix}": folder / f"tetgen{suffix}" for suffix in (".node", ".face", ".edge")}
        for name in FRAMES:
            form = frame_formats[name.split()[1]]
            path = self._file(name, {"geogram": ".txt", "geogram-centres": ".txt"}.get(form.name) or form.extensions[0])
            frames = frames_at(self.mesh, form.where[0])
            write_frames(
                path,
                self.mesh,
                frames,
                form.where[0],
                form.name,
                features=cube_edges(self.mesh),
                regions=halves(self.mesh),
            )

    def _file(self, name, suffix):
        self.files[name] = self.folder / f"{name.replace(' ', '_')}{suffix}"
        return self.files[name]

    def place(self, name, folder):
        """An empty place for a file of this kind, with what must lie beside it; and the sound content."""
        path = self.files[name]
        folder.mkdir(exist_ok=True)
        for suffix in BESIDE if path.suffix in BESIDE else ():
            if path.with_suffix(suffix).exists():
                (folder / f"a{suffix}").write_bytes(path.with_suffix(suffix).read_bytes())
        return folder / f"a{path.suffix}", path.read_bytes()

    def read(self, name, path):
        if name.startswith("frames "):
            form = frame_formats[name.split()[1]]
            found = read_frames(path, None if form.holds_mesh else self.mesh, form.name)
            return {key: getattr(found, key) for key in ("frames", "features", "regions")}
        found = read_input(path.with_suffix(".node") if path.suffix in (".face", ".edge") else path)
        tets = (
            {}
            if found.tets is None
            else {"points": np.asarray(found.tets.vertices), "tets": np.asarray(found.tets.tets)}
        )
        surface = {"vertices": np.asarray(found.surface.vertices), "triangles": np.asarray(found.surface.triangles)}
        return {**tets, **surface, "lines": found.lines, "regions": found.regions}


@pytest.fixture(scope="module")
def samples(tmp_path_factory):
    return Samples(tmp_path_factory.mktemp("samples"))


def same(one, other):
    return one.keys() == other.keys() and all(np.array_equal(one[key], other[key]) for key in one)


pytestmark = pytest.mark.filterwarnings("error::RuntimeWarning")  # which the command line would show


def read_or_refused(samples, name, path, content):
    """What was read, or None; any other exception fails the test."""
    path.write_bytes(content)
    try:
        return samples.read(name, path)
    except of.Error as error:
        assert f"{path.parent.name}/a." in str(error), str(error)
        assert len(str(error)) < 600
        return None


def is_text(content):
    return b"\0" not in content and max(content) < 128


@pytest.mark.parametrize("name", NAMES)
def test_a_cut_file_is_refused_or_reads_as_the_whole(samples, tmp_path, name):
    path, content = samples.place(name, tmp_path / "cut")
    whole = read_or_refused(samples, name, path, content)
    assert whole is not None
    rng = np.random.default_rng(1)
    last_line = content.rstrip().rfind(b"\n") if is_text(content) else len(content)
    for cut in sorted(
        {
            *range(0, len(content), max(1, len(content) // 40)),
            *rng.choice(len(content), 20).tolist(),
            *range(max(0, len(content) - 12), len(content)),
        }
    ):
        found = read_or_refused(samples, name, path, content[:cut])
        # Where a text ends within its last number, or before sections that need not be there, no reader can tell.
        undecidable = is_text(content) and (
            cut > last_line
            or content[cut - 1 : cut] not in b"\n"
            or name in NO_COUNT
            or path.suffix in (".mesh", ".ovm")
        )
        assert found is None or same(found, whole) or undecidable or _is_prefix(name, content, cut), (
            cut,
            content[:cut][-60:],
        )


def _is_prefix(name, content, cut):
    """All that a reader must have is there: what comes after is arrays or a second table."""
    return content[:cut].rstrip().endswith((b"CELL_DATA 18",))


@pytest.mark.parametrize("name", NAMES)
def test_an_altered_file_is_refused_or_read_in_little_time_and_memory(samples, tmp_path, name):
    path, content = samples.place(name, tmp_path / "altered")
    rng = np.random.default_rng([7, NAMES.index(name)])
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    old = signal.signal(signal.SIGALRM, lambda *_: pytest.fail(f"{name}: reading does not end"))
    try:
        for _ in range(60):
            signal.alarm(10)
            found = read_or_refused(samples, name, path, altered(content, rng))
            assert found is None or all(np.isfinite(found[key]).all() for key in ("points", "frames") if key in found)
    finally:
        signal.alarm(0)
        signal.signal(signal.SIGALRM, old)
    assert resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before < 300_000  # kB


WORDS = (
    b"nan",
    b"inf",
    b"-1",
    b"0",
    b"1e300",
    b"1e400",
    b"99999999999999999999",
    b"1000000000000000000",
    b"1.5",
    b"x",
    b"1D+00",
    b"-5",
    b"",
    b"4294967295",
    b"\xff",
)


def altered(content, rng):
    data = bytearray(content)
    for _ in range(rng.integers(1, 4)):
        at, how = int(rng.integers(0, max(len(data), 1))), int(rng.integers(0, 6))
        if how == 0:
            data[at : at + 1] = bytes([int(rng.integers(0, 256))])
        elif how == 1:
            del data[at : at + int(rng.integers(1, 40))]
        elif how == 2:
            data[at : at + 8] = int(rng.choice([0, 1, -1, 2**63 - 1, -(2**63), 10**18])).to_bytes(
                8, "little", signed=True
            )
        elif how == 3:
            data[at : at + 4] = int(rng.choice([0, -1, 2**31 - 1, -(2**31), 10**9, 8])).to_bytes(
                4, "little", signed=True
            )
        else:
            words = bytes(data).split(b" ")
            words[int(rng.integers(0, len(words)))] = WORDS[int(rng.integers(0, len(WORDS)))]
            data = bytearray(b" ".join(words))
    return bytes(data)


EDITED = {
    "lines of Windows": lambda text: text.replace(b"\n", b"\r\n"),
    "blanks at the ends": lambda text: text.replace(b"\n", b"  \n") + b"\n  \n",
    "no last line end": lambda text: text.rstrip(b"\n"),
    "mark of Windows": lambda text: b"\xef\xbb\xbf" + text,
    "tabs": lambda text: text.replace(b" ", b"\t"),
    "empty lines": lambda text: text.replace(b"\n", b"\n\n"),
    "packed": gzip.compress,
}
# Heads that are fixed: the first line and the place of the third in legacy VTK, tags of XML.
FIXED = {("vtk", "tabs"), ("vtk", "empty lines"), ("vtu", "tabs"), ("vtp", "tabs")}


@pytest.mark.parametrize("edit", EDITED)
@pytest.mark.parametrize("name", NAMES)
def test_what_editors_do_to_text_changes_nothing(samples, tmp_path, name, edit):
    path, content = samples.place(name, tmp_path / "edited")
    if (path.suffix[1:], edit) in FIXED or (edit != "packed" and not is_text(content)):
        return
    whole = read_or_refused(samples, name, path, content)
    found = read_or_refused(samples, name, path, EDITED[edit](content))
    assert found is not None and same(found, whole)


FOREIGN = {
    "picture": b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR" + bytes(range(256)),
    "page": b"<!DOCTYPE html>\n<html><head><title>404</title></head><body>Not found</body></html>\n",
    "nothing": b"",
    "blanks": b"\n \n",
    "zeros": bytes(300),
    "wide characters": "MeshVersionFormatted 2\nDimension 3\n".encode("utf-16"),
    "json": b'{"a": [1, 2, 3]}\n',
    "long line": b"1 " * 100_000,
}


@pytest.mark.parametrize("name", [name for name in NAMES if name not in ("tetgen .face", "tetgen .edge")])
def test_foreign_files_are_refused(samples, tmp_path, name):
    path, content = samples.place(name, tmp_path / "foreign")
    for kind, foreign in FOREIGN.items():
        assert read_or_refused(samples, name, path, foreign) is None, kind
    for other in NAMES:
        if samples.files[other].suffix != path.suffix and not other.startswith("frames "):
            found = read_or_refused(samples, name, path, samples.files[other].read_bytes())
            assert found is None or path.suffix in (".ele", ".node"), other


CASES = [  # name, what is replaced, by what, what the message says
    (
        ".vtk",
        b"POINTS 8",
        b"POINTS 9",
        "line 5: POINTS has 24 numbers up to line 13, not 27|line 6: POINTS has 24 numbers",
    ),
    (".vtk", b"CELL_TYPES", b"CELL_TIPES", "unknown section 'CELL_TIPES'"),
    (".vtk", b"POINTS 8", b"POINTS -8", "line 5: POINTS is not followed by the number of points"),
    (".vtk", b"4 0 4 6 7", b"4 0 4 6 x", "line 29: no number: 'x'"),
    (".vtk", b"4 0 4 6 7", b"3 0 4 6 7", "line 14: cell 14 .from 0. of type 10 has 3 vertices, not 4"),
    (
        ".vtk",
        b"DATASET UNSTRUCTURED_GRID",
        b"DATASET POLYDATA",
        "line 4: DATASET POLYDATA; UNSTRUCTURED_GRID is needed: save surfaces",
    ),
    ("msh2 text", b"$EndNodes", b"$EndNodez", "begins before|closes"),
    ("msh2 text", b"2.2 0 8", b"4 0 8", "line 2: version 4 .* write it with Gmsh"),
    ("msh2 text", b"$Nodes\n8", b"$Nodes\n9", r"\$Nodes ends early"),
    (
        "vtu text",
        b'NumberOfPoints="8"',
        b'NumberOfPoints="9"',
        "line 9: array Points of Points has 8 rows; the Piece has 9|rows; the Piece has 9",
    ),
    ("vtu text", b'Name="offsets"', b'Name="offset"', "Cells have no array offsets"),
    (
        "vtu packed",
        b"vtkZLibDataCompressor",
        b"vtkLZ4DataCompressor",
        "packed by vtkLZ4DataCompressor, which is not read; save it",
    ),
    ("vtu raw", b"</VTKFile>", b"", "ends within AppendedData"),
    (".mesh", b"Tetrahedra\n6", b"Tetrahedra\nnan", "Tetrahedra is not followed by a count"),
    (".mesh", b"Vertices\n8", b"Vertices\n1000000000000000000", "Vertices ends after 8 of 1000000000000000000 rows"),
    ("tetgen .node", b"8 3 0 0", b"-8 3 0 0", "line 2: the number of points is -8"),
    ("tetgen .node", b"8 3 0 0", b"8 3 -1 0", "tells of -1 attributes"),
    (".ovm", b"Polyhedra\n6\n4 ", b"Polyhedra\n6\n6 1 1 ", "line 55: 6 sides; meshes of tets have 4"),
    (".ovm", b"Faces\n18\n3 ", b"Faces\n18\n4 1 ", "4 sides; meshes of tets have 3"),
]


@pytest.mark.parametrize(("name", "old", "new", "message"), CASES)
def test_the_message_says_what_is_wrong_and_where(samples, tmp_path, name, old, new, message):
    path, content = samples.place(name, tmp_path / "defect")
    assert content.count(old) >= 1
    path.write_bytes(content.replace(old, new, 1))
    with pytest.raises(of.Error, match=message):
        samples.read(name, path)
