"""One cross field of surface_fields.py, in a process of its own: METHOD MESH.npz RESULT.npz. Needs only numpy and the
package of the method."""

import json
import os
import sys
import threading
import time

import numpy as np


def megabytes() -> int:
    """Peak of this process; getrusage starts with its parent's."""
    with open("/proc/self/status") as file:
        return int(next(line for line in file if line.startswith("VmHWM")).split()[1]) // 1024


def octafield_field(method: str, data) -> tuple[dict, np.ndarray]:
    import octafield

    mesh = octafield.TriangleMesh(data["vertices"], data["triangles"])
    features = octafield.FeatureGraph(data["features"], data["corners"])
    held = None
    if method == "mbo held":
        edge = data["triangles"][0, :2]
        held = octafield.surface.DirectionConstraints([edge], [data["vertices"][edge[1]] - data["vertices"][edge[0]]])
    epsilon = octafield.surface.mean_edge_length(mesh) / 2 if method.endswith("fine") else 0
    start = time.process_time()
    field = octafield.surface.direction_field(
        octafield.surface.SurfaceDomain(mesh, features), method=method.split()[0], epsilon=epsilon, constraints=held
    )
    seconds, memory = time.process_time() - start, megabytes()
    singular = octafield.surface.surface_singularities(field)
    record = {"seconds": f"{seconds:.2f}", "megabytes": memory, "points": len(singular.points)}
    if not singular.agree:
        record["note"] = f"index sum {singular.index_sum:g} instead of {singular.euler_characteristic}"
    return record, np.array(octafield.surface.triangle_directions(field))


def mean_direction(corners: np.ndarray, directions: np.ndarray) -> np.ndarray:
    """Of three crosses per triangle, (F, 3, 3) both: their mean in its plane."""
    x = corners[:, 1] - corners[:, 0]
    normal = np.cross(x, corners[:, 2] - corners[:, 0])
    y = np.cross(normal, x)
    x, y = (v / np.linalg.norm(v, axis=1, keepdims=True) for v in (x, y))
    angle = np.arctan2(np.einsum("fkc,fc->fk", directions, y), np.einsum("fkc,fc->fk", directions, x))
    mean = np.angle(np.exp(4j * angle).sum(axis=1)) / 4
    return np.cos(mean)[:, None] * x + np.sin(mean)[:, None] * y


def mouette_field(data) -> tuple[dict, np.ndarray]:
    """Vertex field; without its correction near sharp corners, which only adds time on smooth surfaces."""
    import mouette

    raw = mouette.mesh.RawMeshData()
    raw.vertices += list(data["vertices"])
    raw.faces += data["triangles"].tolist()
    mesh = mouette.mesh.SurfaceMesh(raw)
    sharp = len(data["features"]) > np.sum(edge_uses(data["triangles"]) == 1)
    start = time.process_time()
    field = mouette.framefield.SurfaceFrameField(mesh, "vertices", order=4, features=bool(sharp), cad_correction=False)
    field.run()
    seconds, memory = time.process_time() - start, megabytes()
    field.flag_singularities()
    flags = mesh.faces.get_attribute("singuls")
    x, y = (np.array([field.conn.base(v)[k] for v in mesh.id_vertices]) for k in (0, 1))
    angle = np.angle(field.var)[:, None] / 4
    directions = np.cos(angle) * x + np.sin(angle) * y
    record = {"seconds": f"{seconds:.2f}", "megabytes": memory, "points": sum(1 for f in flags if flags[f] != 0)}
    return record, mean_direction(data["vertices"][data["triangles"]], directions[data["triangles"]])


def edge_uses(triangles: np.ndarray) -> np.ndarray:
    edges = np.sort(np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1)
    return np.unique(edges, axis=0, return_counts=True)[1]


class GmshLog:
    """Reads Gmsh's own messages to tell when its cross field starts and ends: it has no function for that alone."""

    def __init__(self):
        self.start = self.end = self.memory = None
        reading, writing = os.pipe()
        self.output = os.dup(1)
        os.dup2(writing, 1)
        os.close(writing)
        self.thread = threading.Thread(target=self.read, args=(os.fdopen(reading),))
        self.thread.start()

    def read(self, lines) -> None:
        for line in lines:
            if "compute cross field" in line and self.start is None:
                self.start = time.process_time()
            if "Size map statistics" in line:
                self.end, self.memory = time.process_time(), megabytes()

    def close(self) -> None:
        os.dup2(self.output, 1)
        self.thread.join()


def gmsh_field(data) -> tuple[dict, np.ndarray]:
    """Its quad mesher's cross field (Mesh.Algorithm 11), computed on the given triangles as a discrete surface. A
    closed one without features gets one edge to follow, without which that solver fails."""
    import gmsh

    points, triangles = data["vertices"], data["triangles"]
    log = GmshLog()
    gmsh.initialize(interruptible=False)
    for option, value in (
        ("General.Terminal", 1),
        ("General.Verbosity", 5),
        ("General.NumThreads", 1),
        ("Mesh.Algorithm", 11),
        ("Mesh.QuadqsTopologyOptimizationMethods", 1000),
    ):  # 1000: none of them
        gmsh.option.setNumber(option, value)
    held = [] if len(data["features"]) else [int(v) for v in triangles[0, :2] + 1]
    curves = [gmsh_edge(held, points)] if held else []
    face = gmsh.model.addDiscreteEntity(2, 1, curves)
    free = np.setdiff1d(np.arange(1, len(points) + 1), held)
    gmsh.model.mesh.addNodes(2, face, free.tolist(), points[free - 1].ravel())
    gmsh.model.mesh.addElementsByType(face, 2, [], (triangles + 1).ravel())
    if not held:
        gmsh.model.mesh.classifySurfaces(40 * np.pi / 180, True, False, np.pi)
    gmsh.option.setNumber(
        "Mesh.MeshSizeMin", float(np.linalg.norm(points[triangles[:, 0]] - points[triangles[:, 1]], axis=1).mean())
    )
    gmsh.model.mesh.generate(2)
    kinds, _, values = gmsh.view.getListData(gmsh.view.getTags()[0])
    found = dict(zip(kinds, values))
    gmsh.finalize()
    log.close()
    record = {"seconds": f"{log.end - log.start:.2f}", "megabytes": log.memory, "points": len(found.get("VP", [])) // 6}
    return record, in_our_order(np.reshape(found["VT"], (-1, 6, 3)), points[triangles])


def gmsh_edge(held: list[int], points: np.ndarray) -> int:
    import gmsh

    for node in held:
        end = gmsh.model.addDiscreteEntity(0)
        gmsh.model.mesh.addNodes(0, end, [node], points[node - 1])
        gmsh.model.mesh.addElementsByType(end, 15, [], [node])
    curve = gmsh.model.addDiscreteEntity(1, 1, [1, 2])
    gmsh.model.mesh.addElementsByType(curve, 1, [], held)
    return curve


def in_our_order(view: np.ndarray, corners: np.ndarray) -> np.ndarray:
    """One direction per triangle from rows of x, y, z of three corners and three vectors; the view has its own
    order."""
    theirs, directions = view[:, :3].transpose(0, 2, 1), view[:, 3:].reshape(-1, 3, 3)
    scale = np.ptp(corners.reshape(-1, 3), axis=0).max()
    order = lambda c: np.lexsort(np.round(c.mean(axis=1) / scale, 9).T)
    matched = np.empty(len(corners), dtype=int)
    matched[order(corners)] = order(theirs)
    if len(theirs) != len(corners) or abs(theirs[matched].mean(axis=1) - corners.mean(axis=1)).max() > 1e-6 * scale:
        raise SystemExit("Gmsh's cross field is on other triangles")
    return mean_direction(theirs[matched], directions[matched])


def main() -> None:
    method, mesh_file, result = sys.argv[1:]
    with np.load(mesh_file) as file:
        data = {name: file[name] for name in file.files}
    peers = {"gmsh": gmsh_field, "mouette": mouette_field}
    record, directions = peers[method](data) if method in peers else octafield_field(method, data)
    np.savez(result, record=json.dumps(record), directions=directions)


if __name__ == "__main__":
    main()
