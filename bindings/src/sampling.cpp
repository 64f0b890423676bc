// Fields that live elsewhere than at the vertices of a tet mesh.
#include "sampling.hpp"

#include <pybind11/eigen.h>

#include "arrays.hpp"
#include "bind.hpp"
#include "interruptible.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/tet_singularities.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

std::shared_ptr<Sampling> made(const TetMesh& mesh, Sampling (*make)(const TetMesh&)) {
    return std::make_shared<Sampling>(run_interruptible([mesh = mesh, make](Job&) {
        check(mesh);
        return make(mesh);
    }));
}

void bind_samplings(py::module_& m) {
    m.def(
        "vertex_sampling", [](const TetMesh& mesh) { return made(mesh, vertex_sampling); }, "mesh"_a,
        "One frame per vertex, linear elements: the Sampling that functions take a TetMesh for.");
    m.def(
        "tet_sampling", [](const TetMesh& mesh) { return made(mesh, tet_sampling); }, "mesh"_a,
        "One frame per tet, coupled across triangles by their area over the distance between the tets' centroids, as "
        "a Sampling. Energies of such two-point fluxes do not tend to those at the vertices (docs/tet_meshes.md).");
    m.def(
        "vertex_frames",
        [](const TetMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return own(run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                    check(mesh, false);
                    check_unit(rows, mesh.tets.rows(), "of_tets");
                    return vertex_frames(mesh, rows, threads);
                }));
        },
        "mesh"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "(n, 4) quaternions w x y z: the frame nearest to the mean sh4 vector, weighted by volume, of the tets round "
        "each vertex. of_tets: (m, 4). tet_frames goes the other way.");
}

void bind_boundary(py::module_& m) {
    const BoundaryOptions defaults;
    m.def(
        "tet_boundary_constraints",
        [](const TetMesh& mesh, const BoundarySurface& surface, const ArrayLike& directions, const std::string& mode,
           double feature_tolerance) {
            const BoundaryOptions options{.mode = from_word<BoundaryMode>(mode, "mode"),
                                          .feature_tolerance = finite(feature_tolerance, "feature_tolerance")};
            return run_interruptible([=, rows = from_python<Points>(directions, "directions")](Job&) mutable {
                check(mesh);
                check(surface, static_cast<Index>(mesh.vertices.rows()));
                check_vectors(rows, surface.mesh.triangles.rows(), "directions", "triangle");
                return tet_boundary_constraints(mesh, surface, rows, options);
            });
        },
        "mesh"_a, "surface"_a, "directions"_a, py::kw_only(), "mode"_a = to_word(defaults.mode),
        "feature_tolerance"_a = defaults.feature_tolerance,
        "Constraints of frames in the tets, as BoundaryConstraints with one row per tet. A tet with one triangle of "
        "the surface has an axis on its normal; with several, on their mean normal where feature_tolerance (radians) "
        "allows, else a whole frame that fits them so well, else it is released and listed. surface: "
        "boundary_surface(mesh) or region_surface's; directions: (F, 3) tangents in its triangles "
        "(triangle_directions). mode: as of boundary_constraints.");
    m.def(
        "tet_alignment_angles",
        [](const TetMesh& mesh, const BoundarySurface& surface, const ArrayLike& frames) {
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                check(mesh);
                check(surface, static_cast<Index>(mesh.vertices.rows()));
                check_unit(rows, mesh.tets.rows(), "frames");
                return tet_alignment_angles(mesh, surface, rows);
            }));
        },
        "mesh"_a, "surface"_a, "frames"_a,
        "Angles (radians) between the normal of each triangle of the surface and the nearest axis of the frame in the "
        "tet behind it, then of an interface's tet ahead of it. frames: (m, 4), one per tet.");
    m.def(
        "singular_edges",
        [](const TetMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible(
                [mesh = mesh, threads, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                    check(mesh, false);
                    check_unit(rows, mesh.tets.rows(), "of_tets");
                    return singular_edges(mesh, rows, threads);
                });
        },
        "mesh"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "Singular curves of (m, 4) frames in the tets, from the holonomy round every edge inside, as SingularEdges. "
        "The same result at any thread count.");
}

}  // namespace

void bind_sampling_types(py::module_& m) {
    py::class_<Sampling, std::shared_ptr<Sampling>>(
        m, "Sampling",
        "Where the frames of a field live and how they are coupled; made by vertex_sampling and tet_sampling.")
        .def_property_readonly(
            "sites", [](const Sampling& s) { return to_word(s.sites); }, "\"vertices\" or \"tets\".")
        .def_property_readonly(
            "stiffness", [](const Sampling& s) { return s.stiffness; },
            "(n, n) scipy.sparse matrix L (a copy): E = 1/2 sum_c a_c^T L a_c; symmetric, rows sum to 0.")
        .def_property_readonly(
            "mass", [](const Sampling& s) { return own(Eigen::VectorXd(s.mass)); },
            "(n,) float64 lumped mass (a copy), cubed input unit.")
        .def_property_readonly(
            "body_radius", [](const Sampling& s) { return s.body_radius; },
            "3 volume / boundary area, input unit: the unit of diffuse's first_time.")
        .def_property_readonly(
            "edge_length", [](const Sampling& s) { return s.edge_length; },
            "Mean edge of the boundary, input unit: the unit of diffuse's last_time.")
        .def("__len__", &Sampling::count)
        .def("__repr__", [](const Sampling& s) {
            return s.sites == Sites::tets ? "Sampling(" + count(s.count(), "tet") + ")"
                                          : "Sampling(" + count(s.count(), "vertex", "vertices") + ")";
        });

    Record<SingularEdge>(m, "SingularEdge",
                         "An edge inside the mesh round which the matchings of frames in the tets do not multiply to "
                         "the identity.")
        .field("a", &SingularEdge::a, "Tet-mesh vertex id, a < b.")
        .field("b", &SingularEdge::b, "Tet-mesh vertex id.")
        .field("holonomy", &SingularEdge::holonomy,
               "Element number of the octahedral group, in the frame of the lowest tet at the edge.")
        .field("quarter_turns", &SingularEdge::quarter_turns,
               "Quarter turns about the edge: +1 valence 3, -1 valence 5, 2 a half turn, 0 complex (in no hex mesh).")
        .finish([](const SingularEdge& e) {
            return std::to_string(e.a) + ", " + std::to_string(e.b) + ", " + count(e.quarter_turns, "quarter turn");
        });

    Record<SingularEdges>(m, "SingularEdges", "Singular edges of a frame field that lives in the tets.")
        .field("edges", &SingularEdges::edges, "List of SingularEdge in the order of (a, b).")
        .field("complex_edges", &SingularEdges::complex_edges, "Number of edges with a complex singularity.")
        .field(
            "graph", &SingularEdges::graph,
            "SingularGraph of their curves: no triangles, points at vertices, nodes where other than two meet inside.")
        .field("vertices", &SingularEdges::vertices, "(p,) int32 tet-mesh vertex of each point of the graph.")
        .finish([](const SingularEdges& s) {
            return count(static_cast<std::ptrdiff_t>(s.edges.size()), "edge") + ", " + std::to_string(s.complex_edges) +
                   " complex";
        });
}

void bind_sampling(py::module_& m) {
    bind_samplings(m);
    bind_boundary(m);
}

}  // namespace octafield::bindings
