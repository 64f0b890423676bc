"""What `info` says before a field is computed is what happens: lengths and cells, and advice that works when it is
followed."""

import re

import numpy as np
import octafield as of
import pytest
import pyvista
from conftest import SHARED_DATA
from octafield.domain.generators import generate
from octafield.inspect.info import examine
from pipeline_fixtures import octafield, shared

MOST_STEPS = 4


def tube(radius: float) -> of.TriangleMesh:
    ring = (
        pyvista.ParametricTorus(ringradius=1, crosssectionradius=radius, u_res=200, v_res=16, w_res=16)
        .triangulate()
        .clean()
    )
    return of.from_pyvista(ring.compute_normals(auto_orient_normals=True, split_vertices=False))


def named(record: dict) -> dict[str, str]:
    """The options that the remedies name, those of failed requirements first."""
    found: dict[str, str] = {}
    for r in sorted(record["requirements"], key=lambda r: r["state"] != "fail"):
        if r["state"] in ("fail", "warn"):
            for option, value in re.findall(r"--(repair|edge-length) ([a-z]+|[0-9.e+-]*[0-9])", r["remedy"]):
                found.setdefault(option.replace("-", "_"), value)
    return found


def followed(path) -> tuple[of.MeshOptions, dict]:
    """Options after the advice of `info`, taken until it has none."""
    given: dict[str, object] = {}
    for _ in range(MOST_STEPS):
        record = examine(path, of.MeshOptions(**given))
        more = {k: float(v) if k == "edge_length" else v for k, v in named(record).items()}
        if not {k: v for k, v in more.items() if given.get(k) != v}:
            break
        given |= more
    return of.MeshOptions(**given), record


WILD = ["cube_split_zero.stl", "cup_open_60.stl", "fold_patch.stl", "pipe_thin.stl", "t_flap.off", "o_unref.obj"]


@pytest.mark.parametrize("name", WILD)
def test_advice_of_info_leads_to_a_field(name):
    path = shared(SHARED_DATA / "wild" / name)
    options, record = followed(path)
    assert record["ok"], record["verdict"]
    result = of.compute_field(path, of.FieldOptions(**vars(options), streamlines=0))
    assert result.record["tets"] > 0 and np.isfinite(result.record["energy"])


def test_advice_for_a_length_that_is_too_long_leads_to_one_that_fits(tmp_path):
    path = tmp_path / "tube.ply"
    of.write_surface(tube(0.1), path)
    long = examine(path, of.MeshOptions(edge_length=0.3))
    assert long["verdict"]["state"] == "coarse"
    advised = named(long)
    assert set(advised) == {"edge_length"}
    assert examine(path, of.MeshOptions(edge_length=float(advised["edge_length"])))["verdict"]["state"] == "fine"
    assert examine(path)["verdict"]["state"] == "fine"


@pytest.mark.parametrize("radius", [0.05, 0.1])
def test_info_and_field_agree_on_lengths_and_cells(tmp_path, radius):
    path = tmp_path / "tube.ply"
    of.write_surface(tube(radius), path)
    expected = examine(path)
    meshed = of.prepare_mesh(path)
    assert expected["edge_lengths"]["median"] == pytest.approx(of.surface.mean_edge_length(meshed.surface), rel=0.2)
    assert 0.6 < expected["expected"]["tets"] / len(meshed.tets.tets) < 1.6
    assert set(expected["notes"]) == set(meshed.notes)


def test_a_budget_of_cells_is_kept_and_its_price_is_told(tmp_path):
    path = tmp_path / "tube.ply"
    of.write_surface(tube(0.05), path)
    free, bound = (of.prepare_mesh(path, of.MeshOptions(max_cells=cells)) for cells in (0, 6000))
    assert len(free.tets.tets) > 15000 and max(len(bound.tets.tets), len(bound.surface.triangles)) < 9000
    assert any("times as long, for 6e+03" in note for note in bound.notes)
    assert examine(path, of.MeshOptions(max_cells=6000))["expected"]["tets"] <= 6000


def test_a_length_and_a_budget_together_are_refused(tmp_path):
    with pytest.raises(of.InvalidInput, match="leave it or max_cells out"):
        of.MeshOptions(edge_length=0.1, max_cells=1000)
    path = tmp_path / "box.ply"
    of.write_surface(generate("box"), path)
    done = octafield("info", path, "--edge-length", "0.1", "--max-cells", "1000", check=2)
    assert "max_cells" in done.stderr


def test_edges_far_inside_are_as_long_as_the_shape_lets_them_be():
    """A ball with a thin ring beside it: the ring's short edges do not fill the ball with small tets."""
    ball, ring = generate("ball"), tube(0.03)
    points = np.concatenate([np.asarray(ball.vertices), np.asarray(ring.vertices) + [0, 0, 3]])
    both = of.TriangleMesh(
        points, np.concatenate([np.asarray(ball.triangles), np.asarray(ring.triangles) + len(ball.vertices)])
    )
    meshed = of.prepare_mesh(both)
    assert meshed.inner_length == pytest.approx(of.surface.default_edge_length(both))
    centres = np.asarray(meshed.tets.vertices)[np.asarray(meshed.tets.tets)].mean(axis=1)
    inside = np.linalg.norm(centres, axis=1) < 0.5
    volume = of.volume.tet_volumes(meshed.tets)[inside].mean()
    regular = meshed.inner_length**3 / (6 * np.sqrt(2))
    assert 0.4 < volume / regular < 1.5
