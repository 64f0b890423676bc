"""Meshes that Gmsh itself has partitioned: partitions stand for their parents."""

import gmsh
import numpy as np
import pytest
from octafield.domain.inputs import read_input
from test_cad import opened_gmsh


@pytest.fixture(scope="module")
def gmsh_files(tmp_path_factory):
    """Two boxes side by side: whole, and in three partitions, with and without groups, topology of partitions and ghost
    cells, in either version."""
    folder = tmp_path_factory.mktemp("gmsh")
    with opened_gmsh() as occ:
        for groups in (False, True):
            for created in ((), ("Topology",), ("GhostCells",), ("Topology", "GhostCells", "Physicals")):
                gmsh.clear()
                occ.fragment([(3, occ.addBox(0, 0, 0, 1, 1, 1))], [(3, occ.addBox(1, 0, 0, 1, 1, 1))])
                occ.synchronize()
                for region in (1, 2) if groups else ():
                    gmsh.model.addPhysicalGroup(3, [region], 10 + region)
                gmsh.option.setNumber("Mesh.MeshSizeMin", 0.5)
                gmsh.option.setNumber("Mesh.MeshSizeMax", 0.5)
                gmsh.model.mesh.generate(3)
                for what in ("Topology", "GhostCells", "Physicals"):
                    gmsh.option.setNumber(f"Mesh.PartitionCreate{what}", what in created)
                for parts in (0, 3) if not created else (3,):
                    if parts:
                        gmsh.model.mesh.partition(parts)
                    for version in (2.2, 4.1):
                        for binary in (0, 1):
                            gmsh.option.setNumber("Mesh.MshFileVersion", version)
                            gmsh.option.setNumber("Mesh.Binary", binary)
                            kind = f"{'groups' if groups else 'none'}_{'_'.join(created) or 'plain'}"
                            gmsh.write(str(folder / f"{kind}_{parts}_{version}_{binary}.msh"))
    return folder


def as_sets(found):
    points = np.asarray(found.tets.vertices)
    corners = {
        tuple(sorted(map(tuple, points[tet].round(9).tolist()))): region
        for tet, region in zip(np.asarray(found.tets.tets), found.regions, strict=True)
    }
    lines = (
        None
        if found.lines is None
        else {frozenset(map(tuple, np.asarray(found.surface.vertices)[line].round(9).tolist())) for line in found.lines}
    )
    return corners, lines, found.interface_triangles, found.notes


@pytest.mark.parametrize("groups", ["none", "groups"])
def test_what_gmsh_partitions_reads_as_the_whole_in_either_version(gmsh_files, groups):
    whole = read_input(gmsh_files / f"{groups}_plain_0_4.1_0.msh")
    assert (
        np.unique(whole.regions).tolist() == ([11, 12] if groups == "groups" else [1, 2])
        and whole.interface_triangles > 0
    )
    assert (whole.lines is None) == (groups == "groups")
    files = sorted(gmsh_files.glob(f"{groups}_*.msh"))
    assert len(files) == 20
    for path in files:
        assert as_sets(read_input(path)) == as_sets(whole), path.name
