"""Every surface of the shared test data has fields whose indices add up to its Euler characteristic."""

import octafield as of
import pytest
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
