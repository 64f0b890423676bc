"""Sizes along the axes, part by part: records, arrays of files, which axis is which, and what conversions take."""

import numpy as np
import octafield as of
import pytest
from conftest import box_tets
from octafield import FieldOptions, frame_formats
from octafield.errors import InvalidInput
from octafield.fields import sizes
from octafield.fields.record import of_sizes
from octafield.frame_files.base import FrameFile
from octafield.progress.phases import PhaseClock
from octafield.runs import conversion
from scipy.spatial.transform import Rotation


@pytest.fixture(scope="module")
def mesh():
    return box_tets(2)


@pytest.fixture(scope="module")
def turned(mesh):
    """Frames that turn through the box, at its vertices."""
    x, y, z = np.asarray(mesh.vertices).T
    return np.asarray(of.frames.quaternion_exp(np.column_stack([0.3 * z, 0.4 * x, 0.5 * y])))


@pytest.fixture(scope="module")
def found(mesh, turned):
    return {kind: sizes.find_sizes(mesh, turned, kind) for kind in ("isotropic", "axes")}


def test_kinds_are_the_functions_of_that_name(mesh, turned, found):
    np.testing.assert_array_equal(found["isotropic"].log_scale, of.volume.isotropic_scale(mesh, turned).log_scale)
    np.testing.assert_array_equal(found["axes"].values, of.volume.axis_scales(mesh, turned).values)


@pytest.mark.parametrize("kind", ["isotropic", "axes"])
def test_the_record_tells_what_was_found(found, kind):
    one = found[kind]
    logs = np.asarray(one.log_scale if kind == "isotropic" else one.values)
    assert of_sizes(one) == {
        "kind": kind, "curl_rms_before": one.before.curl_rms, "curl_rms_after": one.after.curl_rms,
        "jump_rms_before": one.before.jump_rms,
        "jump_rms_after": one.after.jump_rms, "size_ratio": pytest.approx(np.exp(logs.max() - logs.min())),
        "iterations": one.iterations,
    }  # fmt: skip
    assert one.before.curl_rms > one.after.curl_rms


def test_a_run_finds_sizes_where_they_are_asked_for_and_says_so(mesh, turned, found):
    told = []
    clock = PhaseClock()
    assert sizes.sizes_of_run(mesh, turned, FieldOptions(), clock, None) is None
    assert "sizes" not in clock.wall
    for kind in ("isotropic", "axes"):
        one = sizes.sizes_of_run(
            mesh, turned, FieldOptions(sizes=kind), clock, lambda phase, *_: told.append(phase) or True
        )
        assert type(one) is type(found[kind]) and of_sizes(one) == of_sizes(found[kind])
    assert told == ["sizes", "sizes"] and "sizes" in clock.wall


def test_arrays_of_files_are_logarithms_curl_and_scaled_axes(mesh, found):
    assert sizes.sizes_arrays(None, None) == ({}, {})
    points, cells = sizes.sizes_arrays(found["isotropic"], None)
    assert list(points) == ["log_scale"] and list(cells) == ["curl"]
    np.testing.assert_array_equal(points["log_scale"], found["isotropic"].log_scale)
    np.testing.assert_array_equal(cells["curl"], found["isotropic"].after.curl)
    axes = found["axes"]
    of_tets = np.asarray(axes.of_tets)
    for frames in (None, of_tets):
        points, cells = sizes.sizes_arrays(axes, frames)
        assert points == {} and set(cells) == {"curl", "log_scales", "scaled_frame"}
        np.testing.assert_array_equal(cells["log_scales"], axes.log_scales)
        matrices = (
            Rotation.from_quat(of_tets, scalar_first=True).as_matrix() * np.exp(np.asarray(axes.log_scales))[:, None, :]
        )
        np.testing.assert_allclose(cells["scaled_frame"], np.swapaxes(matrices, 1, 2).reshape(-1, 9), atol=1e-12)
    assert np.ptp(np.asarray(axes.log_scales), axis=1).max() > 1e-3


def test_sizes_go_with_their_axes_whatever_these_are_called(found):
    axes = found["axes"]
    of_tets, group = np.asarray(axes.of_tets), np.asarray(of.frames.octahedral_group())
    for number in range(24):
        renamed = Rotation.from_quat(of_tets, scalar_first=True) * Rotation.from_quat(group[number], scalar_first=True)
        logs = sizes.log_scales_of(axes, renamed.as_quat(scalar_first=True))
        new, old = renamed.as_matrix(), Rotation.from_quat(of_tets, scalar_first=True).as_matrix()
        for j in range(3):
            same = np.abs(np.einsum("nij,ni->nj", old, new[:, :, j])).argmax(axis=1)  # the old axis along the new j
            np.testing.assert_array_equal(logs[:, j], np.asarray(axes.log_scales)[np.arange(len(logs)), same])
        assert (
            sizes.axis_order(np.array([number]))[0]
            == np.abs(np.rint(Rotation.from_quat(group[number], scalar_first=True).as_matrix())).argmax(axis=0)
        ).all()


def file_of(mesh, frames, where, **more) -> FrameFile:
    return FrameFile("a", "npz", np.asarray(frames), where, mesh=mesh, notes=["before"], **more)


def test_lengths_are_densities_of_isotropic_sizes_at_vertices_and_their_mean_in_tets(mesh, turned, found):
    logs = np.asarray(found["isotropic"].log_scale)
    got, record = conversion.with_sizes(file_of(mesh, turned, "vertices"), frame_formats["npz"], None, "isotropic")
    np.testing.assert_allclose(got.lengths, np.repeat(np.exp(logs)[:, None], 3, axis=1), rtol=1e-12)
    assert (got.where, got.notes) == ("vertices", ["before"]) and record == of_sizes(found["isotropic"])
    np.testing.assert_array_equal(got.frames, turned)
    for name, sign in (("npz", 1), ("ff3", -1)):
        moved, _ = conversion.with_sizes(file_of(mesh, turned, "vertices"), frame_formats[name], "tets", "isotropic")
        mean = logs[np.asarray(mesh.tets)].mean(axis=1)
        np.testing.assert_allclose(moved.lengths, np.repeat(np.exp(sign * mean)[:, None], 3, axis=1), rtol=1e-12)
        assert moved.where == "tets" and moved.notes == [
            "before",
            "the frames were taken to the tets: the nearest to the mean sh4 vector of those around",
        ]
        np.testing.assert_array_equal(moved.frames, of.volume.tet_frames(mesh, turned))


def test_frames_in_tets_keep_theirs_and_go_where_the_format_has_its_own(mesh, turned):
    of_tets = np.asarray(of.volume.tet_frames(mesh, turned))
    ones = np.ones((len(of_tets), 3))
    kept, _ = conversion.with_sizes(file_of(mesh, of_tets, "tets", lengths=ones), frame_formats["npz"], None, "axes")
    at_vertices = np.asarray(of.volume.vertex_frames(mesh, of_tets))
    again = of.volume.axis_scales(mesh, at_vertices)
    np.testing.assert_array_equal(kept.frames, of_tets)
    np.testing.assert_allclose(kept.lengths, np.exp(sizes.log_scales_of(again, of_tets)), rtol=1e-12)
    assert kept.notes == ["before", "the lengths of the axes in the file were replaced by sizes"]
    moved, _ = conversion.with_sizes(file_of(mesh, of_tets, "tets"), frame_formats["arff"], "vertices", "isotropic")
    assert moved.where == "vertices" and "taken to the vertices" in moved.notes[-1]
    np.testing.assert_array_equal(moved.frames, at_vertices)
    usual, _ = conversion.with_sizes(file_of(mesh, turned, "vertices"), frame_formats["ff3"], None, "axes")
    assert usual.where == frame_formats["ff3"].where[0] == "tets"


def test_what_sizes_cannot_be_is_said(mesh, turned):
    with pytest.raises(InvalidInput, match="on the mesh of the frames") as error:
        conversion.with_sizes(file_of(None, turned, "vertices"), frame_formats["npz"], None, "isotropic")
    assert error.value.kind == "no_mesh"
    with pytest.raises(InvalidInput, match="sizes per axis are those of frames in the tets") as error:
        conversion.with_sizes(file_of(mesh, turned, "vertices"), frame_formats["npz"], None, "axes")
    assert error.value.kind == "wrong_sampling"
    none, record = conversion.with_sizes(file_of(mesh, turned, "vertices"), frame_formats["qtn"], None, "isotropic")
    assert (
        record == {} and none.lengths is None and none.notes[0] == "before" and "sizes were left out" in none.notes[1]
    )
