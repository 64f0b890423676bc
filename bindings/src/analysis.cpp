// Analysis of frame fields in volumes: local meshability, alignment with features, integrability.
#include "arrays.hpp"
#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/volume/boundary_meshability.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/meshability.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "octafield/volume/tet_meshability.hpp"
#include "stretch.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

namespace {

void bind_meshability(py::module_& m) {
    m.def("hex_vertex_exists", &hex_vertex_exists, "valence3"_a, "valence5"_a, "valence6"_a = 0, "valence7"_a = 0,
          "valence8"_a = 0,
          "Whether a hex mesh has an interior vertex with so many edges of valence 3, 5, 6, 7 and 8, the others "
          "regular: a "
          "triangulation of the sphere with corners of these degrees. Exact up to 12 edges in all; beyond, which takes "
          "valence 6, and with valence 7 or 8, true means that no count forbids it.");
    m.def(
        "local_meshability",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const SingularGraph& graph,
           const std::optional<ArrayLike>& stretch) {
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                      stretched = stretch_rows(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check(graph);
                check_unit(rows, domain.vertex_count(), "frames");
                return local_meshability(domain, rows, graph, stretched);
            });
        },
        "domain"_a, "frames"_a, "graph"_a, py::kw_only(), "stretch"_a = py::none(),
        "Necessary conditions for a hex mesh where the curves of singular_graph(domain, frames) end (Liu et al. 2018; "
        "Liu, Bommes 2023), as a Meshability. A field that meets them all may still have no hex mesh. stretch: (n, 6) "
        "as "
        "AxesStretch has it, of axes S Q.");
    m.def(
        "tet_meshability",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, const SingularEdges& singular) {
            return run_interruptible([=, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "of_tets");
                check(singular.graph);
                return tet_meshability(domain, rows, singular);
            });
        },
        "domain"_a, "of_tets"_a, "singular"_a,
        "The same for (m, 4) frames in the tets and their singular_edges(domain, of_tets).");
}

void bind_boundary_meshability(py::module_& m) {
    m.attr("no_number") = no_number;
    m.def(
        "tet_boundary_meshability",
        [](const DomainOrMesh& mesh, const ArrayLike& of_tets, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(of_tets, "of_tets")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.tet_count(), "of_tets");
                return tet_boundary_meshability(domain, rows, threads);
            });
        },
        "domain"_a, "of_tets"_a, py::kw_only(), "threads"_a = 0,
        "boundary_meshability for (m, 4) frames in the tets, carried through the tets between two triangles of the "
        "surface: one number of hexahedra per wedge.");
    m.def(
        "boundary_meshability",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ArrayLike>& stretch, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                      stretched = stretch_rows(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return boundary_meshability(domain, rows, threads, stretched);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "stretch"_a = py::none(), "threads"_a = 0,
        "Necessary conditions for a hex mesh at feature edges and corners (after Liu et al. 2018; Liu, Bommes 2023), "
        "as "
        "a BoundaryMeshability: how many hexahedra the turn of the field leaves at each, 1 or more; edges of the "
        "surface on which the field is singular. stretch: (n, 6) as AxesStretch has it, of axes S Q; angles are "
        "counted "
        "after S^-1.");
    m.def(
        "wedge_alignment",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ArrayLike>& stretch, int threads) {
            threads_option(threads);
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                          stretched = stretch_rows(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return wedge_alignment(domain, rows, threads, stretched);
            }));
        },
        "domain"_a, "frames"_a, py::kw_only(), "stretch"_a = py::none(), "threads"_a = 0,
        "(k, 2) radians per wedge of boundary_meshability, the larger of its two ends: the largest angle between the "
        "normal of one of its two triangles and the nearest normal of a pair of axes, and that between the edge and "
        "the nearest axis. stretch: (n, 6) as AxesStretch has it, of axes S Q.");
    m.def(
        "smoothed_curves",
        [](const SingularGraph& graph, int steps) {
            return run_interruptible([graph = graph, steps](Job&) {
                check(graph);
                return smoothed_curves(graph, steps);
            });
        },
        "graph"_a, py::kw_only(), "steps"_a = 20,
        "The curves of a singular graph with their zigzag damped by `steps` pairs of averaging steps (Taubin 1995), "
        "ends held, as SmoothedCurves: for pictures and lengths.");
}

void bind_integrability(py::module_& m) {
    m.def(
        "integrability",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return integrability(domain, rows, threads);
            });
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "Jumps and twist of (n, 4) frames at the vertices, as an Integrability. The same bits at any thread count.");
    m.def(
        "tet_frames",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return tet_frames(domain, rows, threads);
            }));
        },
        "domain"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "(m, 4) quaternions w x y z: the frame nearest to the mean sh4 vector of each tet's vertices.");
}

void bind_feature_alignment(py::module_& m) {
    m.def(
        "feature_tangents",
        [](const DomainOrMesh& mesh) {
            return run_interruptible([=](Job&) { return feature_tangents(domain_of(mesh)); });
        },
        "domain"_a, "Directions of a domain's feature curves at the vertices of its surface, as FeatureTangents.");
    m.def(
        "feature_alignment_angles",
        [](const DomainOrMesh& mesh, const ArrayLike& frames, const std::optional<ArrayLike>& stretch) {
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames"),
                                          stretches = stretches_of(stretch)](Job&) mutable {
                const TetDomain domain = domain_of(mesh);
                check_unit(rows, domain.vertex_count(), "frames");
                return stretches ? feature_alignment_angles(domain, rows, *stretches)
                                 : feature_alignment_angles(domain, rows);
            }));
        },
        "domain"_a, "frames"_a, py::kw_only(), "stretch"_a = py::none(),
        "(k,) angles (radians) between each feature tangent and the nearest axis of its vertex's frame, in the order "
        "of feature_tangents. frames: (n, 4), one per vertex of the mesh. stretch: (n, 6) as AxesStretch has it.");
}

}  // namespace

void bind_field_analysis(py::module_& m) {
    bind_meshability(m);
    bind_boundary_meshability(m);
    bind_integrability(m);
    bind_feature_alignment(m);
}

}  // namespace octafield::bindings
