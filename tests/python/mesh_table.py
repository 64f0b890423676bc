"""Every format of meshes, written and read back by others, and written by others and read by octafield: the second
table of docs/formats.md."""

from collections.abc import Callable
from pathlib import Path

import meshio
import numpy as np
import octafield
import other_readers as readers
import other_writers as writers
import pyvista
from conftest import box_tets
from octafield.domain.inputs import Input, domain_of, from_mesh, read_input
from octafield.domain.mesh_writers import write_mesh
from scipy.spatial import cKDTree
from test_tet_input import cube_edges, halves

BEGIN = "<!-- table of mesh round trips -->\n"
Parts = dict[str, np.ndarray]  # points, cells; of tets: regions (m,), features (k, 2)


def box() -> tuple[Input, Parts]:
    """A cube in two regions with its twelve edges as features."""
    tets = box_tets(3)
    found = from_mesh(domain_of(tets, halves(tets)))
    lines = cube_edges(tets)
    to_surface = np.full(len(tets.vertices), -1)
    to_surface[np.asarray(found.volume().surface.vertex_map)] = np.arange(len(found.surface.vertices))
    found.lines, found.creases = to_surface[lines].astype(np.int32), True
    return found, {
        "points": np.asarray(tets.vertices),
        "cells": np.asarray(tets.tets),
        "regions": halves(tets),
        "features": lines,
    }


def skin() -> Parts:
    boundary = octafield.volume.boundary_surface(box_tets(3)).mesh
    return {"points": np.asarray(boundary.vertices), "cells": np.asarray(boundary.triangles)}


def verdict(expected: Parts, found: Parts) -> str:
    """What is the same, in words. Points and cells have to be; formats without shared vertices are compared corner by
    corner."""
    here, there = (np.asarray(part["points"], float)[part["cells"]] for part in (expected, found))
    assert np.array_equal(_sorted(here), _sorted(there))
    far = cKDTree(expected["points"]).query(found["points"])[0].max()
    exact = far == 0 and found["points"].dtype == float
    same = [
        "same points" if exact else f"points within 1e{np.ceil(np.log10(far)):.0f}",
        "tets" if here.shape[1] == 4 else "triangles",
    ]
    if "regions" in found:
        assert np.array_equal(found["regions"], expected["regions"])
        same.append("regions")
    if len(found.get("features", ())):
        assert np.array_equal(np.unique(np.sort(found["features"], axis=1), axis=0), expected["features"])
        same.append("features")
    return ", ".join(same)


def _sorted(corners: np.ndarray) -> np.ndarray:
    """Cells as sets of corners, in their order; the corners of the box's grid are far more than 1e-5 apart."""
    return np.array([sorted(map(tuple, cell)) for cell in np.round(corners, 5) + 0.0])


def rows(folder: Path) -> list[tuple[str, str, str, str]]:
    found, tets = box()
    surface, triangles = Input("box", octafield.TriangleMesh(**_named(skin()))), skin()
    result = []

    def written(suffix: str, what: Input, expected: Parts, **others: Callable[[Path], Parts]) -> None:
        for other, reader in others.items():
            path = folder / f"ours{suffix}"
            write_mesh(path, what)
            result.append((suffix, "written", _NAMES[other], verdict(expected, reader(path))))

    def read(suffix: str, expected: Parts, **others: Callable[[Path, Parts], None]) -> None:
        for other, writer in others.items():
            path = folder / f"{other}{suffix}"
            writer(path, expected)
            ours = _ours(read_input(path))
            result.append(
                (suffix, "read", _NAMES[other], verdict(expected, _reordered(ours) if other == "gmsh" else ours))
            )

    for suffix in (".vtk", ".vtu"):
        written(suffix, found, tets, meshio=by_meshio, vtk=by_vtk)
    written(".msh", found, tets, gmsh=by_gmsh, meshio=by_meshio)
    written(".mesh", found, tets, gmsh=by_gmsh, meshio=by_meshio)
    for suffix in (".meshb", ".node"):
        written(suffix, found, tets, meshio=by_meshio)
    for suffix in (".ovm", ".ovmb"):
        written(suffix, found, tets, parser=by_parser)
    for suffix in (".stl", ".obj", ".off", ".ply"):
        written(suffix, surface, triangles, trimesh=by_trimesh, meshio=surface_by_meshio)
    written(".vtp", surface, triangles, vtk=surface_by_vtk)
    for suffix in (".vtk", ".vtu", ".msh", ".mesh", ".meshb"):
        read(suffix, tets, meshio=from_meshio)
    for suffix in (".vtk", ".vtu"):
        read(suffix, tets, vtk=from_vtk)
    read(".msh", tets, gmsh=from_gmsh)
    read(".node", tets, parser=from_parser)
    for suffix in (".ovm", ".ovmb"):
        read(suffix, tets, parser=from_parser)
    for suffix in (".stl", ".obj", ".off", ".ply"):
        read(suffix, triangles, trimesh=surface_from_trimesh, meshio=surface_from_meshio)
    read(".vtp", triangles, vtk=surface_from_vtk)
    return result


_NAMES = {"meshio": "meshio", "vtk": "VTK", "gmsh": "Gmsh", "trimesh": "trimesh", "parser": "independent parser"}


def _named(parts: Parts) -> dict[str, np.ndarray]:
    return {"vertices": parts["points"], "triangles": parts["cells"]}


def _ours(found: Input) -> Parts:
    if found.tets is None:
        return {"points": np.asarray(found.surface.vertices), "cells": np.asarray(found.surface.triangles)}
    parts = {"points": np.asarray(found.tets.vertices), "cells": np.asarray(found.tets.tets)}
    if found.regions is not None:
        parts["regions"] = np.asarray(found.regions)
    if found.lines is not None and found.lines_are_features():
        parts["features"] = np.asarray(found.volume().surface.vertex_map)[found.lines]
    return parts


def by_meshio(path: Path) -> Parts:
    mesh = meshio.read(path)
    parts = {"points": mesh.points, "cells": mesh.cells_dict["tetra"]}
    for name in ("CellEntityIds", "region", "gmsh:physical", "medit:ref"):
        if name in mesh.cell_data_dict and "tetra" in mesh.cell_data_dict[name]:
            parts["regions"] = mesh.cell_data_dict[name]["tetra"].ravel()
    return parts | ({"features": mesh.cells_dict["line"]} if "line" in mesh.cells_dict else {})


def by_vtk(path: Path) -> Parts:
    grid = pyvista.read(path)
    kind = pyvista.CellType
    ids = np.asarray(grid.cell_data["CellEntityIds"])[grid.celltypes == kind.TETRA]
    return {
        "points": np.asarray(grid.points),
        "cells": grid.cells_dict[kind.TETRA],
        "regions": ids,
        "features": grid.cells_dict[kind.LINE],
    }


def by_gmsh(path: Path) -> Parts:
    with _gmsh() as gmsh:
        gmsh.open(str(path))
        tags, points, _ = gmsh.model.mesh.getNodes()
        assert np.array_equal(np.sort(tags), np.arange(1, len(tags) + 1))
        points = points.reshape(-1, 3)[np.argsort(tags)]
        cells, regions = [], []
        for _, solid in gmsh.model.getEntities(3):
            _, nodes = gmsh.model.mesh.getElementsByType(4, solid)
            group = gmsh.model.getPhysicalGroupsForEntity(3, solid)
            cells.append(nodes.reshape(-1, 4).astype(int) - 1)
            regions += [int(group[0]) if len(group) else solid] * len(cells[-1])
        lines = gmsh.model.mesh.getElementsByType(1)[1].reshape(-1, 2).astype(int) - 1
    order = np.argsort(np.array(regions), kind="stable")
    return _reordered(
        {
            "points": points,
            "cells": np.concatenate(cells)[order],
            "regions": np.array(regions)[order],
            "features": lines,
        }
    )


def _reordered(parts: Parts) -> Parts:
    """Gmsh lists tets solid by solid: in our order again."""
    key = lambda cells: {tuple(sorted(cell)): k for k, cell in enumerate(cells.tolist())}  # noqa: E731
    place = key(parts["cells"])
    order = [place[cell] for cell in key(np.asarray(box_tets(3).tets))]
    return {**parts, "cells": parts["cells"][order], "regions": parts["regions"][order]}


def by_parser(path: Path) -> Parts:
    found = readers.ovm_text(path) if path.suffix == ".ovm" else readers.ovm_binary(path)
    cells, volumes = readers.ovm_tets(found)
    assert (volumes > 0).all()
    features = found["Edges"][found["EProp", "AlgoHex::FeatureEdges"].ravel() > 0]
    return {
        "points": found["Vertices"],
        "cells": cells,
        "regions": found["CProp", "region"].ravel(),
        "features": features,
    }


def by_trimesh(path: Path) -> Parts:
    import trimesh

    mesh = trimesh.load(path, process=False)
    return {"points": np.asarray(mesh.vertices), "cells": np.asarray(mesh.faces)}


def surface_by_meshio(path: Path) -> Parts:
    mesh = meshio.read(path)
    return {"points": mesh.points, "cells": mesh.cells_dict["triangle"]}


def surface_by_vtk(path: Path) -> Parts:
    poly = pyvista.read(path)
    return {"points": np.asarray(poly.points), "cells": poly.regular_faces}


def from_meshio(path: Path, parts: Parts) -> None:
    cells = [("line", parts["features"]), ("tetra", parts["cells"])]
    ids = [np.ones(len(parts["features"]), np.int32), parts["regions"].astype(np.int32)]
    names = {".msh": ["gmsh:physical", "gmsh:geometrical"], ".mesh": ["medit:ref"], ".meshb": ["medit:ref"]}.get(
        path.suffix, ["CellEntityIds"]
    )
    options = {"file_format": "gmsh22"} if path.suffix == ".msh" else {}
    meshio.Mesh(parts["points"], cells, cell_data={name: ids for name in names}).write(path, **options)


def from_vtk(path: Path, parts: Parts) -> None:
    kind = pyvista.CellType
    grid = pyvista.UnstructuredGrid({kind.LINE: parts["features"], kind.TETRA: parts["cells"]}, parts["points"])
    ids = np.zeros(grid.n_cells, np.int32)
    ids[grid.celltypes == kind.TETRA] = parts["regions"]
    grid.cell_data["CellEntityIds"] = ids
    grid.save(path)


def from_gmsh(path: Path, parts: Parts) -> None:
    with _gmsh() as gmsh:
        gmsh.model.add("box")
        solids = {int(region): gmsh.model.addDiscreteEntity(3) for region in np.unique(parts["regions"])}
        curve = gmsh.model.addDiscreteEntity(1)
        gmsh.model.mesh.addNodes(
            3, min(solids.values()), np.arange(1, len(parts["points"]) + 1), parts["points"].ravel()
        )
        for region, solid in solids.items():
            of = np.flatnonzero(parts["regions"] == region)
            gmsh.model.mesh.addElementsByType(solid, 4, of + 1, parts["cells"][of].ravel() + 1)
            gmsh.model.addPhysicalGroup(3, [solid], region)
        tags = np.arange(len(parts["features"])) + len(parts["cells"]) + 1
        gmsh.model.mesh.addElementsByType(curve, 1, tags, parts["features"].ravel() + 1)
        gmsh.model.addPhysicalGroup(1, [curve], 1)
        gmsh.write(str(path))


def from_parser(path: Path, parts: Parts) -> None:
    writer = {".node": writers.tetgen, ".ovm": writers.ovm_mesh, ".ovmb": writers.ovmb_mesh}[path.suffix]
    writer(path, parts["points"], parts["cells"], parts["regions"])


def surface_from_trimesh(path: Path, parts: Parts) -> None:
    import trimesh

    trimesh.Trimesh(parts["points"], parts["cells"], process=False).export(path)


def surface_from_meshio(path: Path, parts: Parts) -> None:
    meshio.Mesh(parts["points"], [("triangle", parts["cells"])]).write(path)


def surface_from_vtk(path: Path, parts: Parts) -> None:
    pyvista.PolyData.from_regular_faces(parts["points"], parts["cells"]).save(path)


class _gmsh:
    def __enter__(self):
        import gmsh

        gmsh.initialize(["test"], readConfigFiles=False, interruptible=False)
        gmsh.option.setNumber("General.Terminal", 0)
        return gmsh

    def __exit__(self, *_):
        import gmsh

        gmsh.finalize()


def table_of(found: list[tuple[str, str, str, str]]) -> str:
    head = "| file | octafield has | by | what came back |\n|---|---|---|---|\n"
    return head + "".join(f"| {' | '.join(row)} |\n" for row in found)
