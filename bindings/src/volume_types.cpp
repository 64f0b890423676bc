// Structs of volume/ as Python classes.
#include "bind.hpp"
#include "constraint_kinds.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/frame_field.hpp"
#include "octafield/volume/singularities.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;

namespace {

void bind_tet_mesh_types(py::module_& m) {
    Record<TetMesh>(m, "TetMesh",
                    "A tetrahedral mesh: arrays of positions and of vertex ids. Nothing is checked until it is used.")
        .field("vertices", &TetMesh::vertices, "(n, 3) float64 positions, the input's length unit.")
        .field("tets", &TetMesh::tets, "(m, 4) int32 vertex ids, 0-based, det(p1-p0, p2-p0, p3-p0) > 0.")
        .finish([](const TetMesh& mesh) {
            return count(mesh.vertices.rows(), "vertex", "vertices") + ", " + count(mesh.tets.rows(), "tet") +
                   box(mesh.vertices);
        });

    Record<BoundarySurface>(m, "BoundarySurface",
                            "The boundary of a tet mesh as a triangle mesh with its own vertex numbers.")
        .field("mesh", &BoundarySurface::mesh, "TriangleMesh in compact numbering, triangles outward.")
        .field("vertex_map", &BoundarySurface::vertex_map,
               "(B,) int32: tet-mesh vertex of each boundary vertex, ascending.")
        .finish([](const BoundarySurface& b) {
            return count(b.mesh.vertices.rows(), "vertex", "vertices") + ", " +
                   count(b.mesh.triangles.rows(), "triangle") + box(b.mesh.vertices);
        });
}

void bind_boundary_surface_types(py::module_& m) {
    Record<BoundaryConstraints>(m, "BoundaryConstraints",
                                "What holds the frame at each vertex of a tet mesh, or in each tet.")
        .field("kind", &BoundaryConstraints::kind,
               ("(n,) uint8: " + described_kinds() + "; can be given by name.").c_str())
        .field("axis", &BoundaryConstraints::axis, "(n, 3) float64 unit axis where the kind takes one, else 0.")
        .field("frames", &BoundaryConstraints::frames,
               "(n, 4) float64 quaternions w x y z: the start on boundary vertices, the value where fixed, identity "
               "inside.")
        .field("on_boundary", &BoundaryConstraints::on_boundary, "(n,) uint8, 1 on the boundary.")
        .field("released_corners", &BoundaryConstraints::released_corners,
               "int32 ids of corners, or of tets, whose directions fit no frame.")
        .field("lengths", &BoundaryConstraints::lengths,
               "(n, 3) float64 axis lengths held by odeco_lengths, or no rows (all 1): along the axes of frames "
               "where they are fixed; along axis, column 0, where one is given.")
        .finish([](const BoundaryConstraints& c) {
            return count_kinds(c.kind) +
                   (c.released_corners.empty()
                        ? ""
                        : ", " + count(static_cast<std::ptrdiff_t>(c.released_corners.size()), "released corner"));
        });

    Record<SectorNormals>(
        m, "SectorNormals",
        "One normal per boundary vertex and smooth sector (triangles round the vertex between feature edges).")
        .field("vertex", &SectorNormals::vertex, "(k,) int32 boundary-mesh vertex ids, ascending.")
        .field("normal", &SectorNormals::normal, "(k, 3) float64 unit normals.")
        .finish([](const SectorNormals& s) { return count(s.normal.rows(), "sector"); });
}

void bind_field_results(py::module_& m) {
    Record<SmoothResult>(m, "SmoothResult", "A smoothed frame field and how it was reached.")
        .field("frames", &SmoothResult::frames, "(n, 4) float64 unit quaternions w x y z.")
        .field("energy", &SmoothResult::energy, "dirichlet_energy of the frames, input length unit.")
        .field("objective", &SmoothResult::objective,
               "What was minimised: the Dirichlet energy of the representation smoothed.")
        .field("iterations", &SmoothResult::iterations, "Iterations done.")
        .field("converged", &SmoothResult::converged,
               "Whether the last step lowered the energy by less than the tolerance.")
        .field("message", &SmoothResult::message, "Why the solver stopped.")
        .field(
            "energy_history", &SmoothResult::energy_history,
            "float64 energies (of sh4, whatever was minimised) at the start and after each accepted or rejected step.")
        .field("objective_history", &SmoothResult::objective_history,
               "float64 objectives at the same steps; of frame_field, where something else than sh4's energy is "
               "minimised, of that last part only, the last steps of energy_history.")
        .field("lengths", &SmoothResult::lengths,
               "(n, 3) float64 lengths of the frames' axes where odeco_lengths was minimised; else no rows.")
        .finish([](const SmoothResult& r) {
            return count(r.frames.rows(), "frame") + ", energy " + number(r.energy) + ", " +
                   count(r.iterations, "iteration") + ", " + (r.converged ? "converged" : "not converged");
        });

    Record<FrameFieldResult>(m, "FrameFieldResult", "A frame field by frame_field, and how it was reached.")
        .field("smooth", &FrameFieldResult::smooth,
               "SmoothResult of the field of lowest energy; iterations and energy_history are those of all rounds.")
        .field("diffusion_steps", &FrameFieldResult::diffusion_steps, "Steps of diffusion, of all rounds.")
        .finish([](const FrameFieldResult& r) {
            return count(r.smooth.frames.rows(), "frame") + ", energy " + number(r.smooth.energy) + ", " +
                   count(r.diffusion_steps, "diffusion step") + ", " + count(r.smooth.iterations, "iteration") +
                   (r.smooth.converged ? ", converged" : ", not converged");
        });

    Record<SingularTriangle>(m, "SingularTriangle",
                             "A triangle of the tet mesh round which the matchings do not multiply to the identity.")
        .field("a", &SingularTriangle::a, "Tet-mesh vertex id, a < b < c.")
        .field("b", &SingularTriangle::b, "Tet-mesh vertex id.")
        .field("c", &SingularTriangle::c, "Tet-mesh vertex id.")
        .field("holonomy", &SingularTriangle::holonomy,
               "Element number of the octahedral group, in the frame of vertex a.")
        .field("quarter_turns", &SingularTriangle::quarter_turns,
               "Quarter turns about the curve, modulo 8: +1 valence 3, -1 valence 5, +2 valence 2, -2 valence 6, 0 "
               "complex (in "
               "no hex mesh).")
        .field("boundary", &SingularTriangle::boundary, "Whether it lies on the boundary of the mesh.")
        .field("point", &SingularTriangle::point, "(3,) float64: where the linear sh4 interpolant is shortest.")
        .field("undecided", &SingularTriangle::undecided,
               "Whether chance decides: two matchings are equally near, or the axis is at right angles to the curve.")
        .finish([](const SingularTriangle& t) {
            return std::to_string(t.a) + ", " + std::to_string(t.b) + ", " + std::to_string(t.c) + ", " +
                   count(t.quarter_turns, "quarter turn");
        });

    Record<SingularGraph>(m, "SingularGraph",
                          "Singular curves of a frame field: the dual graph of its singular triangles.")
        .field("triangles", &SingularGraph::triangles, "List of SingularTriangle.")
        .field("points", &SingularGraph::points,
               "(p, 3) float64: first one per singular triangle, then the nodes inside tets.")
        .field("curves", &SingularGraph::curves,
               "List of int32 arrays (copies): polylines as point ids; closed ones repeat the first id.")
        .field("curve_quarter_turns", &SingularGraph::curve_quarter_turns,
               "int32 quarter turns, one per curve; 0 complex.")
        .field("nodes", &SingularGraph::nodes, "int32 point ids inside tets where three or four segments meet.")
        .field("length", &SingularGraph::length, "Total length of the curves, input unit.")
        .field("complex_triangles", &SingularGraph::complex_triangles,
               "Number of triangles with a complex singularity.")
        .field("undecided_triangles", &SingularGraph::undecided_triangles, "Number of triangles that are undecided.")
        .finish([](const SingularGraph& g) {
            return count(static_cast<std::ptrdiff_t>(g.triangles.size()), "triangle") + ", " +
                   count(static_cast<std::ptrdiff_t>(g.curves.size()), "curve") + ", " +
                   count(static_cast<std::ptrdiff_t>(g.nodes.size()), "node") + ", length " + number(g.length) + ", " +
                   std::to_string(g.complex_triangles) + " complex";
        });
}

}  // namespace

void bind_volume_types(py::module_& m) {
    bind_tet_mesh_types(m);
    bind_boundary_surface_types(m);
    bind_field_results(m);
}

}  // namespace octafield::bindings
