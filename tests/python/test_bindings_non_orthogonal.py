"""Non-orthogonal cross fields from Python."""

import numpy as np
import octafield as of
import pytest

SURFACE = of.surface


def sheared(angle: float, n: int = 8) -> of.TriangleMesh:
    """A rhombus of side 1, n x n rhombi of two triangles; vertex i (n + 1) + j at i/n along x, j/n along the slant."""
    i, j = (x.ravel() for x in np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij"))
    points = np.column_stack([i + j * np.cos(angle), j * np.sin(angle), 0 * i]) / n
    a = np.flatnonzero((i < n) & (j < n))
    b = a + n + 1
    return of.TriangleMesh(points, np.concatenate([np.column_stack([a, b, b + 1]), np.column_stack([a, b + 1, a + 1])]))


def between(vectors, direction) -> float:
    """The largest angle between lines and a direction."""
    return np.arccos(np.clip(abs(np.array(vectors) @ direction), 0, 1)).max()


@pytest.mark.parametrize("method", SURFACE.non_orthogonal_field_methods)
@pytest.mark.parametrize("second_line", SURFACE.NonOrthogonalFieldOptions.words["second_line"])
def test_a_rhombus_has_lines_along_its_sides(method, second_line):
    angle = np.radians(60)
    mesh = sheared(angle)
    if method == "poly_vector" and second_line == "free":
        with pytest.raises(of.InvalidInput, match="poly_vector"):
            SURFACE.non_orthogonal_field(mesh, method=method, second_line=second_line)
        return
    field = SURFACE.non_orthogonal_field(mesh, method=method, second_line=second_line)
    assert field.energy < 1e-7 and field.converged and len(field.inverted) == 0
    assert field.smallest_angle == pytest.approx(angle, abs=1e-6)
    sides = np.array([[1, 0, 0], [np.cos(angle), np.sin(angle), 0]])
    lines = np.stack([field.first, field.second], axis=1)
    cosines = abs(np.einsum("vkx,sx->vks", lines, sides))
    assert np.allclose(np.maximum(cosines[:, 0], cosines[:, 1]), 1, atol=1e-9)  # each side is one of the two lines
    found = SURFACE.surface_singularities(field)
    assert found.agree and [p.index for p in found.points] == [0.25] * 4
    assert sorted(np.flatnonzero(np.array(field.quads) == 1)) == [0, 8, 72, 80]


def test_corners_take_the_place_of_the_rule_of_angles():
    mesh = sheared(np.radians(30))
    by_angle = SURFACE.non_orthogonal_field(mesh)
    points = SURFACE.surface_singularities(by_angle).points
    assert sum(p.index for p in points if not p.boundary) == 0.5  # two corners of one quad, two of two
    told = SURFACE.non_orthogonal_field(mesh, corners=[[0, 1], [8, 1], [72, 1], [80, 1]])
    assert told.energy < 1e-7 and all(p.boundary for p in SURFACE.surface_singularities(told).points)
    quads = [SURFACE.CornerQuads(vertex=v, quads=1) for v in (0, 8, 72, 80)]
    assert SURFACE.non_orthogonal_field(mesh, corners=quads).energy == told.energy
    assert SURFACE.non_orthogonal_field(mesh, corners=None).energy == by_angle.energy
    options = SURFACE.NonOrthogonalFieldOptions(corners=[[3, 2]])
    assert options.corners.tolist() == [[3, 2]]


@pytest.mark.parametrize(
    ("given", "kind", "elements"),
    [
        ({"corners": [[40, 1]]}, "not_on_boundary", [40]),
        ({"corners": [[4, 1]]}, "bad_corner", [4]),
        ({"corners": [[0, 1], [0, 2]]}, "given_twice", [0]),
        ({"method": "newton"}, "bad_option", []),
        ({"lambda_": 0.0}, "bad_option", []),
        ({"weights": "none"}, "unknown_word", []),
    ],
)
def test_what_cannot_be_is_refused(given, kind, elements):
    with pytest.raises(of.InvalidInput) as refused:
        SURFACE.non_orthogonal_field(sheared(1.0), **given)
    assert refused.value.kind == kind and list(refused.value.elements) == elements


def test_features_inside_are_refused_and_not_ignored():
    mesh = sheared(1.0)
    creased = SURFACE.SurfaceDomain(mesh, SURFACE.feature_graph(mesh, [[40, 41]]))
    with pytest.raises(of.InvalidInput, match="features"):
        SURFACE.non_orthogonal_field(creased)


def test_curves_follow_the_lines():
    angle = np.radians(50)
    field = SURFACE.non_orthogonal_field(sheared(angle))
    slant = [np.cos(angle), np.sin(angle), 0]
    along, up = SURFACE.streamlines(field, SURFACE.SurfaceSingularities(), [60, 60], [[1, 0, 0], slant])
    for line, direction in ((along, [1, 0, 0]), (up, slant)):
        way = line.points[-1] - line.points[0]
        assert between([way / np.linalg.norm(way)], direction) < 1e-4 and line.length == pytest.approx(1, abs=1e-4)
        assert line.first_end == line.last_end == "boundary"
    assert SURFACE.separatrices(field, SURFACE.surface_singularities(field)) == []  # corners of one quad have none


def test_fields_with_wrong_arrays_are_refused():
    field = SURFACE.non_orthogonal_field(sheared(1.0))
    for name, value in (("angles", np.zeros((3, 2))), ("angles", np.full((81, 2), np.nan)), ("quads", np.full(81, -2))):
        wrong = SURFACE.NonOrthogonalField(field.domain, field.angles, quads=field.quads)
        setattr(wrong, name, value)
        for use in (
            SURFACE.surface_singularities,
            lambda f: SURFACE.separatrices(f, SURFACE.SurfaceSingularities()),
            lambda f: SURFACE.streamlines(f, SURFACE.SurfaceSingularities(), [0], [[1, 0, 0]]),
        ):
            with pytest.raises(of.InvalidInput):
                use(wrong)


def test_progress_can_cancel():
    field = SURFACE.non_orthogonal_field(sheared(np.radians(30)), progress=lambda *_: False)
    assert not field.converged and field.energy <= field.start_energy
