"""Every surface of the shared test data has fields whose indices add up to its Euler characteristic."""

import numpy as np
import octafield as of
import pytest
from octafield.domain.generators import generate
from octafield.domain.meshing import prepare_mesh
from octafield.options import MeshOptions
from pipeline_fixtures import SHARED_SURFACES, SHARED_TETS, shared

LARGE = 400_000  # bytes, of a packed tet mesh: those take seconds
SOUND = [SHARED_SURFACES / f"{name}_surface{end}" for name in ("i10", "s01", "s04", "s15", "s16", "s17")
         for end in (".obj", ".stl", "_binary.stl.gz")]  # fmt: skip
TETS = sorted(path for path in SHARED_TETS.glob("*.vtk.gz") if path.stat().st_size < LARGE) or [
    SHARED_TETS / "s01c.vtk.gz"
]
# What makes them unfit for a field on a surface. A hole does not; equal points are merged on reading STL.
BAD = {"degenerate_s17": "degenerate_triangle", "fin_s01": "non_manifold_edge",
       "flipped_s01": "inconsistent_orientation",
       "insideout_s16": "inside_out", "selfcross_s15": "self_intersection", "soup_s04": "soup"}  # fmt: skip


@pytest.mark.parametrize("path", SOUND + TETS, ids=lambda path: path.name)
def test_indices_add_up_to_the_euler_characteristic(path):
    meshed = prepare_mesh(shared(path), MeshOptions(remesh=False), volume=False)
    for method in ("gl", "mbo", "eigen"):
        for symmetry in (4,) if method == "gl" else (1, 2, 4, 6):
            features = meshed.features if symmetry % 2 == 0 else of.FeatureGraph()
            field = of.surface.direction_field(
                of.surface.SurfaceDomain(meshed.surface, features), symmetry=symmetry, method=method
            )
            found = of.surface.surface_singularities(field)
            assert found.agree and found.index_sum == of.surface.euler_characteristic(meshed.surface), (
                method,
                symmetry,
            )
            assert field.converged


@pytest.mark.parametrize("name, kind", BAD.items())
def test_unsound_surfaces_are_refused_by_kind(name, kind):
    path = shared(SHARED_SURFACES / f"bad_{name}.obj")
    with pytest.raises(of.GeometryError) as caught:
        prepare_mesh(path, MeshOptions(remesh=False), volume=False)
    assert caught.value.kind == kind and path.name in str(caught.value)


def test_a_hole_is_a_boundary_of_the_surface():
    meshed = prepare_mesh(shared(SHARED_SURFACES / "bad_hole_s17.obj"), MeshOptions(remesh=False), volume=False)
    found = of.surface.surface_singularities(
        of.surface.direction_field(of.surface.SurfaceDomain(meshed.surface, meshed.features))
    )
    assert found.agree and found.euler_characteristic == 1


def test_stl_files_are_refused_where_single_precision_flattens_triangles(tmp_path):
    box = generate("box")
    far = of.TriangleMesh(np.asarray(box.vertices) + 1e8, box.triangles)
    with pytest.raises(of.IoError, match="no area") as error:
        of.write_surface(far, tmp_path / "far.stl")
    assert error.value.kind == "single_precision" and not (tmp_path / "far.stl").exists()
    of.write_surface(far, tmp_path / "far.ply")
    of.write_surface(box, tmp_path / "near.stl")


def test_one_sided_surfaces_are_named_as_such():
    turns = np.linspace(0, 2 * np.pi, 40, endpoint=False)
    ways = [np.stack([(2 + s * np.cos(turns / 2)) * np.cos(turns), (2 + s * np.cos(turns / 2)) * np.sin(turns),
                      s * np.sin(turns / 2)], axis=1) for s in (-0.5, 0.5)]  # fmt: skip
    points = np.concatenate(ways)
    following = [(i + 1) % 40 for i in range(40)]
    other = [40 * (i == 39) for i in range(40)]  # the ends meet turned over
    rows = [[(i, following[i] + o, 40 + i), (40 + i, following[i] + o, (40 + following[i]) - o)]
            for i, o in enumerate(other)]  # fmt: skip
    strip = of.TriangleMesh(points, np.array(rows).reshape(-1, 3).astype(np.int32))
    with pytest.raises(of.GeometryError, match="one-sided"):
        of.compute_atlas(strip, of.MeshOptions(remesh=False, features="none"))
