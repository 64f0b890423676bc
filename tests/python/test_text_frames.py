"""Frames in text without a mesh: what each layout is read as, what is written, and the line of each defect."""

import re

import numpy as np
import octafield as of
import pytest
from octafield.errors import Error
from octafield.frame_files import text
from octafield.frame_files.base import Field
from scipy.spatial.transform import Rotation

FRAMES = np.asarray(of.frames.random_rotations(3, 5))
AXES = Rotation.from_quat(FRAMES, scalar_first=True).as_matrix()
ROWS = np.swapaxes(AXES, 1, 2).reshape(3, 9)  # first, second, third axis
CENTRES = np.arange(9.0).reshape(3, 3)
LENGTHS = np.array([[1.0, 2, 3], [1, 1, 1], [4, 5, 6]])


def lines(table: np.ndarray) -> str:
    return "".join(" ".join(map(repr, row)) + "\n" for row in np.asarray(table).tolist())


def same(found, where: str, name: str) -> None:
    assert (found.where, found.format) == (where, name) and found.path.endswith("a")
    np.testing.assert_allclose(np.abs(np.sum(found.frames * FRAMES, axis=1)), 1, atol=1e-14)


LAYOUTS = {
    "arff": ("vertices", lines(ROWS)),
    "mouette": ("tets", "FRAME\n3\n" + lines(ROWS) + "END\n"),
    "geogram": ("tets", lines(ROWS.reshape(9, 3))),
    "geogram-centres": ("tets", lines(np.hstack([CENTRES, ROWS]))),
    "qtn": ("tets", lines(FRAMES)),
    "ff3": ("tets", "9 3\n" + lines(ROWS)),
}
READ = {"arff": text.read_arff, "mouette": text.read_mouette, "geogram": text.read_geogram,
        "geogram-centres": text.read_geogram_centres,
        "qtn": text.read_qtn, "ff3": text.read_ff3}  # fmt: skip
WRITE = {
    "arff": text.write_arff,
    "mouette": text.write_mouette,
    "geogram": text.write_geogram,
    "qtn": text.write_qtn,
    "ff3": text.write_ff3,
}


@pytest.mark.parametrize("name", LAYOUTS)
def test_every_layout_gives_its_frames_where_its_program_has_them(tmp_path, name):
    where, content = LAYOUTS[name]
    (tmp_path / "a").write_text(content)
    found = READ[name](tmp_path / "a")
    same(found, where, name)
    assert found.notes == [] and found.lengths is None
    assert (found.centres is not None) == (name == "geogram-centres")
    if found.centres is not None:
        np.testing.assert_array_equal(found.centres, CENTRES)


@pytest.mark.parametrize("name", ["arff", "geogram", "geogram-centres"])
def test_txt_is_told_by_the_numbers_of_its_first_line(tmp_path, name):
    where, content = LAYOUTS[name]
    (tmp_path / "a").write_text("\n  \n" + content)
    same(text.read_txt(tmp_path / "a"), where, name)


@pytest.mark.parametrize("name", WRITE)
def test_what_is_written_is_the_layout(tmp_path, name):
    WRITE[name](tmp_path / "a", Field(None, FRAMES, "tets"))
    written, expected = (tmp_path / "a").read_text().splitlines(), LAYOUTS[name][1].splitlines()
    assert len(written) == len(expected)
    for have, want in zip(written, expected, strict=True):
        if want[0].isalpha():
            assert have == want
        else:
            np.testing.assert_allclose(np.array(have.split(), float), np.array(want.split(), float), atol=1e-15)
            assert want.split()[0] != "9" or have == want


@pytest.mark.parametrize(("name", "kept"), [("arff", True), ("ff3", True), ("mouette", False), ("geogram", False)])
def test_lengths_of_axes_are_written_where_the_layout_has_them(tmp_path, name, kept):
    WRITE[name](tmp_path / "a", Field(None, FRAMES, "tets", LENGTHS))
    found = READ[name](tmp_path / "a")
    assert (found.lengths is not None) == kept
    if kept:
        np.testing.assert_allclose(found.lengths, LENGTHS, rtol=1e-14)


def test_centres_are_written_before_their_axes(tmp_path):
    mesh = of.TetMesh(np.vstack([np.zeros(3), np.eye(3)]), np.array([[0, 1, 2, 3]], np.int32))
    for where, sites in (("tets", [[0.25, 0.25, 0.25]]), ("vertices", np.vstack([np.zeros(3), np.eye(3)]))):
        frames = np.asarray(of.frames.random_rotations(len(sites), 1))
        text.write_geogram_centres(tmp_path / "a", Field(mesh, frames, where))
        found = text.read_geogram_centres(tmp_path / "a")
        np.testing.assert_array_equal(found.centres, sites)
        np.testing.assert_allclose(np.abs(np.sum(found.frames * frames, axis=1)), 1, atol=1e-14)


def test_mouette_without_end_is_noted_and_qtn_numbers_may_be_broken_anywhere(tmp_path):
    (tmp_path / "a").write_text("FRAME\n3\n" + lines(ROWS))
    found = text.read_mouette(tmp_path / "a")
    same(found, "tets", "mouette")
    assert found.notes == ["the file does not end with END: its last number may be cut"]
    words = lines(FRAMES).split()
    (tmp_path / "a").write_text("\n".join([" ".join(words[:3]), "", " ".join(words[3:11]), words[11], ""]))
    same(text.read_qtn(tmp_path / "a"), "tets", "qtn")


ONE = "1 0 0 0 1 0 0 0 1\n"
NONE = "0 0 0 0 1 0 0 0 1\n"  # an axis without length
DEFECTS = [
    ("arff", ONE + "\n1 0 0\n", "a, line 3: 3 numbers; 9 are needed on every line"),
    ("arff", ONE + "1 0 0 0 1 0 0 0 x\n", "a, line 2: no number: 'x'"),
    ("arff", ONE + NONE, "a, line 2: an axis of frame 1 (from 0) has length 0"),
    ("mouette", "FRAMES\n1\n" + ONE + "END\n", "a, line 1: FRAME is needed, not 'FRAMES'"),
    ("mouette", "FRAME\nx\n" + ONE + "END\n", "a, line 2: the number of frames is needed, not 'x'"),
    ("mouette", "FRAME\n-1\n" + ONE + "END\n", "a, line 2: the number of frames is needed, not '-1'"),
    ("mouette", "FRAME\n1\n" + ONE + ONE + "END\n", "a, line 4: holds 2 frames, but its head says 1"),
    ("mouette", "FRAME\n3\n" + ONE + ONE + "\nEND\n", "a, line 4: holds 2 frames, but its head says 3"),
    ("mouette", "FRAME\n2\n" + ONE + NONE + "END\n", "a, line 4: an axis of frame 1"),
    ("geogram", "1 0 0\n0 1 0\n0 0 1\n1 0 0\n", "a, line 4: ends after 4 axes; a frame has 3"),
    ("geogram", "1 0 0\n0 1 0\n0 0 1\n" + "1 0 0\n0 0 0\n0 0 1\n", "a, line 4: an axis of frame 1"),
    ("geogram", "1 0 0\n0 1\n0 0 1\n", "a, line 2: 2 numbers; 3 are needed on every line"),
    ("geogram-centres", "0 0 0 " + ONE + "0 0 inf " + ONE, "a, line 2: the centre is not finite"),
    ("geogram-centres", "nan 0 0 " + ONE + "0 0 0 " + NONE, "a, line 1: the centre is not finite"),
    ("geogram-centres", "0 0 0 " + ONE + "0 0 0 " + NONE, "a, line 2: an axis of frame 1"),
    ("geogram-centres", "0 0 0 " + ONE + ONE, "a, line 2: 9 numbers; 12 are needed"),
    ("qtn", "1 0 0 0\n1 0\n\n", "a, line 2: holds 6 numbers; a quaternion has 4"),
    (
        "qtn",
        "1 0 0 0 1 0\n0 0\n" + "1 0 0 0\n" * 7 + "0 0 0 0\n1 0 0 0\n",
        "a, line 10: quaternion 9 (from 0) is zero or not finite",
    ),
    ("ff3", "8 1\n" + ONE, "a, line 1: '9 N' is needed (ASCII .ff3), not '8 1'"),
    ("ff3", "9\n" + ONE, "a, line 1: '9 N' is needed"),
    ("ff3", "9 1 1\n" + ONE, "a, line 1: '9 N' is needed"),
    ("ff3", "9 x\n" + ONE, "a, line 1: the number of frames is needed, not 'x'"),
    ("ff3", "9 2\n" + ONE, "a, line 2: holds 1 frames, but its head says 2"),
    ("ff3", "9 1\n" + ONE + "\n" + ONE + "\n", "a, line 4: holds 2 frames, but its head says 1"),
    ("ff3", "9 2\n" + ONE + NONE, "a, line 3: an axis of frame 1"),
]


@pytest.mark.parametrize(("name", "content", "message"), DEFECTS)
def test_every_defect_is_told_with_its_line(tmp_path, name, content, message):
    (tmp_path / "a").write_text(content)
    with pytest.raises(Error, match=re.escape(message)):
        READ[name](tmp_path / "a")


@pytest.mark.parametrize(
    ("name", "content"),
    [("mouette", "FRAME\n0\nEND\n"), ("ff3", "9 0\n"), ("arff", ""), ("qtn", "\n"), ("geogram", "")],
)
def test_no_frames_are_read_as_none(tmp_path, name, content):
    (tmp_path / "a").write_text(content)
    assert READ[name](tmp_path / "a").frames.shape == (0, 4)
