// Examples in the docstrings of the module, apart from the functions so that either can be read. They run as tests
// (tests/python/test_docs.py) after: import numpy as np; import octafield; from octafield.domain.generators import
// generate
#include <pybind11/pybind11.h>

#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>

#include "bind.hpp"

namespace py = pybind11;

namespace octafield::bindings {

namespace {

using Example = std::pair<const char*, const char*>;

constexpr Example of_meshes[] = {
    {"TriangleMesh", R"(
    >>> mesh = octafield.TriangleMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0]], [[0, 1, 2]])
    >>> mesh
    TriangleMesh(3 vertices, 1 triangle, box [0, 1] x [0, 1] x [0, 0])
    >>> mesh.vertices[2, 1] = 5  # a view of the mesh's memory
    >>> float(octafield.surface.triangle_areas(mesh)[0])
    2.5)"},
    {"TetMesh", R"(
    >>> octafield.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    TetMesh(4 vertices, 1 tet, box [0, 1] x [0, 1] x [0, 1]))"},
    {"FeatureGraph", R"(
    >>> octafield.surface.detect_features(generate("box"))
    FeatureGraph(12 edges, 8 corners))"},
    {"read_surface", R"(
    >>> octafield.write_surface(generate("box"), "box.stl")
    >>> octafield.read_surface("box.stl")
    TriangleMesh(8 vertices, 12 triangles, box [0, 1] x [0, 1] x [0, 1]))"},
    {"write_surface", R"(
    >>> octafield.write_surface(generate("box"), "box.ply"))"},
    {"find_defects", R"(
    >>> box = generate("box")
    >>> octafield.surface.find_defects(box)
    []
    >>> box.triangles = box.triangles[1:]  # a hole
    >>> [defect.kind for defect in octafield.surface.find_defects(box)]
    ['not_closed'])"},
    {"require_valid", R"(
    >>> octafield.require_valid(generate("torus"))  # says nothing where all is well)"},
    {"repair", R"(
    >>> box = generate("box")
    >>> box.triangles = box.triangles[1:]
    >>> octafield.surface.repair(box)
    RepairResult(8 vertices, 12 triangles, box [0, 1] x [0, 1] x [0, 1], 1 action))"},
    {"advise_repair", R"(
    >>> box = generate("box")
    >>> box.triangles = box.triangles[1:]
    >>> octafield.surface.advise_repair(box)
    RepairAdvice(safe, 1 action))"},
    {"coordinate_precision", R"(
    >>> float(octafield.surface.coordinate_precision([[0, 0, 1], [0.1, 0, 0.123456789]]))  # nine digits
    1e-08)"},
    {"detect_features", R"(
    >>> features = octafield.surface.detect_features(generate("box"), angle=np.radians(40))
    >>> len(features.edges), len(features.corners)
    (12, 8))"},
    {"feature_graph", R"(
    >>> box = generate("box")
    >>> octafield.surface.feature_graph(box, [box.triangles[0, :2]])  # one edge, its ends are corners
    FeatureGraph(1 edge, 2 corners))"},
    {"remesh", R"(
    >>> box = generate("box")
    >>> finer = octafield.surface.remesh(box, octafield.surface.detect_features(box), edge_length=0.25)
    >>> bool(octafield.surface.mean_edge_length(finer.mesh) < 0.3), len(finer.features.corners)
    (True, 8))"},
    {"size_field", R"(
    >>> cylinder = generate("cylinder", radius=0.05, height=3.0)
    >>> sizes = octafield.surface.size_field(cylinder, octafield.surface.detect_features(cylinder))
    >>> bool(sizes.lengths.min() < 0.02 < 0.1 < sizes.longest)
    True)"},
    {"tetrahedralize", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> round(float(octafield.volume.tet_volumes(tets).sum()), 12)
    1.0)"},
    {"boundary_surface", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> boundary = octafield.volume.boundary_surface(tets)
    >>> bool((tets.vertices[boundary.vertex_map] == boundary.mesh.vertices).all())
    True)"},
    {"features_on_sheets", R"(
    >>> tets = octafield.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 1]], [[0, 1, 2, 3], [1, 4, 2, 3]])
    >>> domain = octafield.TetDomain(tets, regions=[1, 2])
    >>> features = octafield.surface.feature_graph(domain.surface.mesh, domain.sheets.cuts)  # the rim of the interface
    >>> octafield.volume.features_on_sheets(features, domain.sheets)
    FeatureGraph(9 edges, 9 corners))"},
    {"find_locking", R"(
    >>> tets = octafield.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    >>> octafield.volume.find_locking(tets)  # a tet with all four vertices on the surface
    LockingElements(1 tet, 0 edges, 0 triangles))"},
    {"split_locking", R"(
    >>> tets = octafield.TetMesh([[0, 0, 0], [1, 0, 0], [0, 1, 0], [0, 0, 1]], [[0, 1, 2, 3]])
    >>> split = octafield.volume.split_locking(tets)
    >>> octafield.volume.find_locking(split.mesh)
    LockingElements(0 tets, 0 edges, 0 triangles))"},
    {"signed_volume", R"(
    >>> round(octafield.surface.signed_volume(generate("box")), 12)
    1.0)"},
    {"euler_characteristic", R"(
    >>> octafield.surface.euler_characteristic(generate("torus"))
    0)"},
    {"mean_edge_length", R"(
    >>> round(octafield.surface.mean_edge_length(generate("box")), 3)  # 12 edges and 6 diagonals
    1.138)"},
    {"shape_size", R"(
    >>> round(octafield.surface.shape_size(generate("box")) / 3**0.5, 2)  # of the diagonal
    1.12)"},
    {"default_edge_length", R"(
    >>> round(octafield.surface.shape_size(generate("box")) / octafield.surface.default_edge_length(generate("box")), 12)
    25.0)"},
    {"bounding_box_diagonal", R"(
    >>> octafield.surface.bounding_box_diagonal([[0, 0, 0], [1, 2, 2]])
    3.0)"},
    {"principal_directions", R"(
    >>> cylinder = generate("cylinder")
    >>> domain = octafield.surface.SurfaceDomain(cylinder, octafield.surface.detect_features(cylinder))
    >>> found = octafield.surface.principal_directions(domain)
    >>> found.curvatures.shape == (len(cylinder.triangles), 2)
    True)"},
};

constexpr Example of_surface_fields[] = {
    {"direction_field", R"(
    >>> ball = generate("ball")
    >>> field = octafield.surface.direction_field(ball)
    >>> field.symmetry, field.converged, len(octafield.surface.surface_singularities(field).points)
    (4, True, 8))"},
    {"surface_singularities", R"(
    >>> ball = generate("ball")
    >>> field = octafield.surface.direction_field(ball, symmetry=6)
    >>> octafield.surface.surface_singularities(field)  # 12 points of index 1/6
    SurfaceSingularities(12 points, index sum 2, Euler characteristic 2))"},
    {"separatrices", R"(
    >>> ball = generate("ball")
    >>> field = octafield.surface.direction_field(ball)
    >>> len(octafield.surface.separatrices(field, octafield.surface.surface_singularities(field)))
    24)"},
    {"impose_singular_points", R"(
    >>> ball = generate("ball")  # any 8 points of valence 3 will do on a sphere
    >>> pattern = octafield.surface.SingularPattern(
    ...     [octafield.surface.imposed_at_vertex(ball, v, 1) for v in range(0, 320, 40)])
    >>> octafield.surface.surface_singularities(octafield.surface.impose_singular_points(ball, pattern).field)
    SurfaceSingularities(8 points, index sum 2, Euler characteristic 2))"},
    {"quad_layout", R"(
    >>> corners = [[0, 0, 0], [4, 0, 0], [4, 4, 0], [0, 4, 0]]
    >>> plate = octafield.TriangleMesh([*corners, [2, 2, 0]], [[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]])
    >>> point = octafield.surface.imposed_point
    >>> pattern = octafield.surface.SingularPattern([point(plate, [1, 2, 0], 1), point(plate, [3, 2, 0], -1)])
    >>> octafield.surface.quad_layout(octafield.surface.impose_singular_points(plate, pattern))
    QuadLayout(16 vertices, 24 sides, 9 patches, 6 chords))"},
    {"layout_quads", R"(
    >>> corners = [[0, 0, 0], [3, 0, 0], [3, 1, 0], [0, 1, 0]]
    >>> plate = octafield.TriangleMesh(corners, [[0, 1, 2], [0, 2, 3]])
    >>> field = octafield.surface.impose_singular_points(plate, octafield.surface.SingularPattern())
    >>> quads = octafield.surface.layout_quads(octafield.surface.quad_layout(field), edge_length=0.5)
    >>> len(quads.mesh.quads), quads.patch_sizes.tolist()
    (12, [[2, 6]]))"},
    {"vertex_directions", R"(
    >>> torus = generate("torus")
    >>> directions = octafield.surface.vertex_directions(octafield.surface.direction_field(torus))
    >>> bool(np.allclose(np.linalg.norm(directions, axis=1), 1))
    True)"},
};

constexpr Example of_frames[] = {
    {"random_rotations", R"(
    >>> octafield.frames.random_rotations(3, seed=1).shape
    (3, 4))"},
    {"rotation_matrices", R"(
    >>> octafield.frames.rotation_matrices([1, 0, 0, 0])
    array([[1., 0., 0.],
           [0., 1., 0.],
           [0., 0., 1.]]))"},
    {"frame_from_axes", R"(
    >>> q = octafield.frames.frame_from_axes([1, 1, 0], [0, 0, 1])  # along a diagonal, normal z
    >>> round(float(np.degrees(octafield.frames.distance(q, [1, 0, 0, 0]))), 10)
    45.0)"},
    {"distance", R"(
    >>> quarter = [np.cos(np.pi / 4), 0, 0, np.sin(np.pi / 4)]  # a quarter turn leaves the frame as it is
    >>> round(octafield.frames.distance([1, 0, 0, 0], quarter), 12)
    0.0)"},
    {"matching", R"(
    >>> q = octafield.frames.random_rotations(5)
    >>> octafield.frames.matching(q, q)  # the identity is element 0
    array([0, 0, 0, 0, 0], dtype=int32))"},
    {"slerp", R"(
    >>> a, b = octafield.frames.random_rotations(2)
    >>> half = octafield.frames.slerp(a, b, 0.5)
    >>> bool(np.isclose(octafield.frames.distance(a, half), octafield.frames.distance(a, b) / 2))
    True)"},
    {"frame_mean", R"(
    >>> q = octafield.frames.random_rotations(1)[0]
    >>> mean, *_ = octafield.frames.frame_mean([q, q, q])
    >>> bool(octafield.frames.distance(mean, q) < 1e-7)
    True)"},
    {"sh4_embed", R"(
    >>> a = octafield.frames.sh4_embed(octafield.frames.random_rotations(10))
    >>> a.shape, bool(np.allclose(np.linalg.norm(a, axis=1), 1))
    ((10, 9), True))"},
    {"sh4_project", R"(
    >>> q = octafield.frames.random_rotations(4)
    >>> found, off = octafield.frames.sh4_project(octafield.frames.sh4_embed(q))
    >>> bool((octafield.frames.distance(found, q) < 1e-7).all()), bool((off < 1e-7).all())
    (True, True))"},
    {"convert", R"(
    >>> a = octafield.frames.sh4_embed(octafield.frames.random_rotations(4))
    >>> octafield.frames.convert(a, "sh4", "odeco").shape
    (4, 15))"},
    {"su2_embed", R"(
    >>> q = octafield.frames.random_rotations(1)[0]
    >>> found, _ = octafield.frames.su2_project(octafield.frames.su2_embed(q))
    >>> bool(octafield.frames.distance(found, q) < 1e-6)
    True)"},
    {"odeco_embed", R"(
    >>> octafield.frames.odeco_embed([1, 0, 0, 0], lengths=[1, 2, 3]).shape
    (15,))"},
    {"tensor4_embed", R"(
    >>> full = octafield.frames.tensor4_full(octafield.frames.tensor4_embed([1, 0, 0, 0]))  # sum of x^4, y^4 and z^4
    >>> full.shape, round(float(full[0, 0, 0, 0]), 12)
    ((3, 3, 3, 3), 1.0))"},
};

constexpr Example of_volume_fields[] = {
    {"boundary_constraints", R"(
    >>> domain = octafield.TetDomain(octafield.volume.tetrahedralize(generate("box")))
    >>> surface = domain.surface.mesh
    >>> domain = domain.with_features(octafield.surface.detect_features(surface))
    >>> field = octafield.surface.direction_field(octafield.surface.SurfaceDomain(surface, domain.features))
    >>> directions = octafield.surface.vertex_directions(field)
    >>> held = octafield.volume.boundary_constraints(domain, directions)
    >>> bool((held.kind[domain.surface.vertex_map] > 0).all())
    True)"},
    {"with_constraints", R"(
    >>> free = octafield.volume.BoundaryConstraints([0, 0], np.zeros((2, 3)), [[1, 0, 0, 0]] * 2, [0, 0])
    >>> octafield.volume.with_constraints(free, octafield.volume.VertexConstraints([1], ["axis"], [[0, 0, 1]]))
    BoundaryConstraints(1 free, 1 axis, 0 fixed))"},
    {"initial_frames", R"(
    >>> problem = octafield.prepare_field(octafield.prepare_mesh(generate("box")))
    >>> tets = problem.meshed.tets
    >>> held = octafield.volume.boundary_constraints(tets, problem.directions)
    >>> octafield.volume.initial_frames(tets, held).shape == (len(tets.vertices), 4)
    True)"},
    {"smooth", R"(
    >>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.3))
    >>> again = octafield.volume.smooth(result.tets, result.constraints, result.frames, representation="su2")
    >>> again.converged, bool(again.energy < 1e-9)  # the field of a cube is constant
    (True, True))"},
    {"diffuse", R"(
    >>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.3))
    >>> start = octafield.frames.random_rotations(len(result.frames))
    >>> bool(octafield.volume.diffuse(result.tets, result.constraints, start).energy < octafield.volume.dirichlet_energy(result.tets, start))
    True)"},
    {"frame_field", R"(
    >>> result = octafield.compute_field(generate("box"), octafield.FieldOptions(edge_length=0.3))
    >>> found = octafield.volume.frame_field(result.tets, result.constraints, seed=1)  # another, random start
    >>> bool(found.smooth.energy < 1e-9)
    True)"},
    {"tet_sampling", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> len(octafield.volume.tet_sampling(tets)) == len(tets.tets)
    True)"},
    {"Sampling", R"(
    >>> import scipy.sparse
    >>> path = scipy.sparse.csr_array([[1, -1, 0], [-1, 2, -1], [0, -1, 1.0]])  # three sites in a row
    >>> sampling = octafield.volume.Sampling(path, [1, 1, 1], body_radius=1, edge_length=1, size=2)
    >>> octafield.volume.dirichlet_energy(sampling, octafield.frames.random_rotations(1).repeat(3, axis=0))
    0.0)"},
    {"singular_graph", R"(
    >>> result = octafield.compute_field(generate("ball"), octafield.FieldOptions(edge_length=0.3))
    >>> graph = octafield.volume.singular_graph(result.tets, result.frames)
    >>> len(graph.points) == len(graph.triangles) + len(graph.nodes), graph.length > 8  # about a cube's edges
    (True, True))"},
    {"dirichlet_energy", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> same = np.tile([1.0, 0, 0, 0], (len(tets.vertices), 1))
    >>> octafield.volume.dirichlet_energy(tets, same) < 1e-20
    True)"},
    {"stiffness", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> L = octafield.volume.stiffness(tets)  # a scipy.sparse matrix
    >>> x = tets.vertices[:, 0]
    >>> round(float(x @ L @ x), 12)  # the integral of |grad x|^2 is the volume
    1.0)"},
    {"mass", R"(
    >>> round(float(octafield.volume.mass(octafield.volume.tetrahedralize(generate("box"))).sum()), 12)
    1.0)"},
    {"lumped_mass", R"(
    >>> round(float(octafield.volume.lumped_mass(octafield.volume.tetrahedralize(generate("box"))).sum()), 12)
    1.0)"},
    {"spread_points", R"(
    >>> octafield.volume.spread_points(octafield.volume.tetrahedralize(generate("box")), 5).shape
    (5, 3))"},
    {"locate_points", R"(
    >>> octafield.volume.locate_points(octafield.volume.tetrahedralize(generate("box")), [[0.5, 0.5, 0.5], [9, 9, 9]])
    LocatedPoints(2 points, 1 outside))"},
    {"interpolate_frames", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> octafield.volume.interpolate_frames(tets, octafield.frames.random_rotations(len(tets.vertices)), [[0.5, 0.5, 0.5], [9, 9, 9]])
    SampledFrames(2 frames, 1 outside))"},
    {"comb_vertices", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> mixed = octafield.frames.octahedral_group()[np.arange(len(tets.vertices)) % 24]  # one frame, all labels
    >>> int(octafield.volume.comb_vertices(tets, mixed).agree.min()), int(octafield.volume.axes_agree(tets, mixed).min())
    (1, 0))"},
    {"frame_streamlines", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> same = np.tile([1.0, 0, 0, 0], (len(tets.vertices), 1))
    >>> lines = octafield.volume.frame_streamlines(tets, same, [[0.5, 0.5, 0.4]])
    >>> [round(line.length, 9) for line in lines]  # along x, y and z
    [1.0, 1.0, 1.0])"},
    {"write_field", R"(
    >>> tets = octafield.volume.tetrahedralize(generate("box"))
    >>> octafield.volume.write_field("field.vtu", tets, octafield.frames.random_rotations(len(tets.vertices)), {"made by": "a test"}))"},
};

// What pybind11 does itself when an overload is added.
void append(py::handle function, const std::string& text) {
    PyMethodDef* const method = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
    const std::string whole = std::string(method->ml_doc) + text;
    std::free(const_cast<char*>(method->ml_doc));
    method->ml_doc = strdup(whole.c_str());
}

}  // namespace

void add_examples(py::module_& module) {
    const auto add = [&](const Example& example) {
        const py::object thing = module.attr(example.first);
        const std::string text = std::string("\n\nExample:\n") + example.second + "\n";
        if (PyCFunction_Check(thing.ptr()))
            append(thing, text);
        else
            thing.attr("__doc__") = thing.attr("__doc__").cast<std::string>() + text;
    };
    for (const Example& example : of_meshes) add(example);
    for (const Example& example : of_surface_fields) add(example);
    for (const Example& example : of_frames) add(example);
    for (const Example& example : of_volume_fields) add(example);
}

}  // namespace octafield::bindings
