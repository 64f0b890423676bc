// Analysis of frame fields in volumes: local meshability, alignment with features, integrability.
#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/meshability.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;
using surface::FeatureGraph;
using surface::TriangleMesh;

template <>
struct Words<SingularVertexKind> {
    using E = SingularVertexKind;
    static constexpr std::array<std::pair<const char*, E>, 3> list{
        {{"node", E::node}, {"change", E::change}, {"boundary_end", E::boundary_end}}};
};

namespace {

void bind_meshability_types(py::module_& m) {
    Record<SingularVertex>(m, "SingularVertex", "A place where curves of a singular graph end.")
        .field("point", &SingularVertex::point, "Place in SingularGraph.points.")
        .field("kind", &SingularVertex::kind,
               "\"node\" (in a tet), \"change\" (the curve goes on with another type) or \"boundary_end\".")
        .field("valence3", &SingularVertex::valence3, "Ends here of curves of +1 quarter turn.")
        .field("valence5", &SingularVertex::valence5, "Ends here of curves of -1 quarter turn.")
        .field("valence6", &SingularVertex::valence6, "Ends here of curves of a half turn.")
        .field("complex", &SingularVertex::complex, "Ends here of complex curves, which no hex mesh has.")
        .field("about_normal", &SingularVertex::about_normal,
               "At a boundary end: whether the frames turn about their axis nearest to the normal, so that the surface "
               "cross field is singular there.")
        .field("meshable", &SingularVertex::meshable,
               "Whether the necessary conditions hold: a hex mesh has a vertex with these edges.")
        .field("junction", &SingularVertex::junction, "Place in Meshability.junctions.")
        .finish([](const SingularVertex& v) {
            return to_word(v.kind) + (v.meshable ? ", meshable" : ", not meshable") + ", valence3 " +
                   std::to_string(v.valence3) + ", valence5 " + std::to_string(v.valence5) + ", valence6 " +
                   std::to_string(v.valence6) + ", complex " + std::to_string(v.complex);
        });

    Record<SingularJunction>(m, "SingularJunction",
                             "Singular vertices that complex curves join, as if these were shrunk to a point.")
        .field("vertices", &SingularJunction::vertices, "Number of singular vertices in it.")
        .field("valence3", &SingularJunction::valence3, "Ends of curves of +1 quarter turn that leave it.")
        .field("valence5", &SingularJunction::valence5, "Ends of curves of -1 quarter turn that leave it.")
        .field("valence6", &SingularJunction::valence6, "Ends of curves of a half turn that leave it.")
        .field("complex", &SingularJunction::complex, "Complex curves inside it; none leaves it.")
        .field("meshable", &SingularJunction::meshable,
               "Whether a hex mesh has a vertex with these edges, once the complex curves are shrunk.")
        .finish([](const SingularJunction& j) {
            return count(j.vertices, "vertex", "vertices") + (j.meshable ? ", meshable" : ", not meshable");
        });

    Record<Meshability>(m, "Meshability", "Necessary conditions for a hex mesh round the singular graph of a field.")
        .field("vertices", &Meshability::vertices, "List of SingularVertex, ascending points.")
        .field("junctions", &Meshability::junctions, "List of SingularJunction.")
        .field("curve_ends", &Meshability::curve_ends,
               "(curves, 2) int32: vertices at the first and last point of each curve; -1, -1: closed without one.")
        .field("non_meshable_vertices", &Meshability::non_meshable_vertices, "Vertices that no hex mesh has.")
        .field("non_meshable_junctions", &Meshability::non_meshable_junctions, "Junctions that no hex mesh has.")
        .field("closed_curves", &Meshability::closed_curves, "Closed curves without a vertex.")
        .field("boundary_ends", &Meshability::boundary_ends, "Ends of curves on the boundary.")
        .field("boundary_ends_about_normal", &Meshability::boundary_ends_about_normal,
               "Those at singular points of the surface cross field.")
        .finish([](const Meshability& found) {
            return count(static_cast<std::ptrdiff_t>(found.vertices.size()), "vertex", "vertices") + ", " +
                   std::to_string(found.non_meshable_vertices) + " not meshable, " +
                   count(static_cast<std::ptrdiff_t>(found.junctions.size()), "junction") + ", " +
                   std::to_string(found.non_meshable_junctions) + " not meshable";
        });
}

void bind_measure_types(py::module_& m) {
    Record<Integrability>(m, "Integrability", "How far a frame field is from the gradients of a map.")
        .field("jump_rms", &Integrability::jump_rms,
               "Tangential jump of the axes of neighbouring tets' frames over their face, root of the sum over the "
               "axes; root mean square weighted by area. Of the order of the mesh width on smooth fields.")
        .field("jump_max", &Integrability::jump_max, "The largest.")
        .field("twist_rms", &Integrability::twist_rms,
               "Of n_i . curl n_i, root of the sum over the axes; root mean square weighted by volume, 1 / input unit. "
               "0 where surfaces orthogonal to each axis exist (Frobenius).")
        .field("twist_max", &Integrability::twist_max, "The largest.")
        .field("twist", &Integrability::twist, "(m,) float64, per tet.")
        .finish([](const Integrability& found) {
            const auto text = [](double x) { return py::str(py::float_(x)).cast<std::string>(); };
            return "jump " + text(found.jump_rms) + ", at most " + text(found.jump_max) + "; twist " +
                   text(found.twist_rms) + ", at most " + text(found.twist_max);
        });

    Record<FeatureTangents>(m, "FeatureTangents", "Directions of feature curves at their vertices.")
        .field("vertex", &FeatureTangents::vertex,
               "(k,) int32 boundary-mesh vertex ids, ascending: once on a curve, once per edge at corners and ends.")
        .field("tangent", &FeatureTangents::tangent, "(k, 3) float64 unit vectors, sign arbitrary.")
        .finish([](const FeatureTangents& t) { return count(t.tangent.rows(), "tangent"); });
}

void bind_meshability(py::module_& m) {
    m.def("hex_vertex_exists", &hex_vertex_exists, "valence3"_a, "valence5"_a, "valence6"_a = 0,
          "Whether a hex mesh has an interior vertex with so many edges of valence 3, 5 and 6, the others regular: a "
          "triangulation of the sphere with corners of these degrees. Exact up to 12 edges in all; beyond, which takes "
          "valence 6, true means that no count forbids it.");
    m.def(
        "local_meshability",
        [](const TetMesh& mesh, const ArrayLike& frames, const SingularGraph& graph) {
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                check(mesh, false);
                check(graph);
                check_unit(rows, mesh.vertices.rows(), "frames");
                return local_meshability(mesh, rows, graph);
            });
        },
        "mesh"_a, "frames"_a, "graph"_a,
        "Necessary conditions for a hex mesh where the curves of singular_graph(mesh, frames) end (Liu et al. 2018; "
        "Liu, Bommes 2023), as a Meshability. A field that meets them all may still have no hex mesh.");
}

void bind_integrability(py::module_& m) {
    m.def(
        "integrability",
        [](const TetMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                check(mesh, false);
                check_unit(rows, mesh.vertices.rows(), "frames");
                return integrability(mesh, rows, threads);
            });
        },
        "mesh"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "Jumps and twist of (n, 4) frames at the vertices, as an Integrability. The same bits at any thread count.");
    m.def(
        "tet_frames",
        [](const TetMesh& mesh, const ArrayLike& frames, int threads) {
            threads_option(threads);
            return own(run_interruptible([=, rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                check(mesh, false);
                check_unit(rows, mesh.vertices.rows(), "frames");
                return tet_frames(mesh, rows, threads);
            }));
        },
        "mesh"_a, "frames"_a, py::kw_only(), "threads"_a = 0,
        "(m, 4) quaternions w x y z: the frame nearest to the mean sh4 vector of each tet's vertices.");
}

void bind_feature_alignment(py::module_& m) {
    m.def(
        "feature_tangents",
        [](const TriangleMesh& boundary, const FeatureGraph& features) {
            return run_interruptible([boundary = boundary, features = features](Job&) mutable {
                check(boundary, false);
                check(features, boundary);
                return feature_tangents(boundary, features);
            });
        },
        "boundary"_a, "features"_a,
        "Directions of the feature curves at the vertices of a boundary mesh, as FeatureTangents.");
    m.def(
        "feature_alignment_angles",
        [](const BoundarySurface& boundary, const FeatureGraph& features, const ArrayLike& frames) {
            return own(run_interruptible([boundary = boundary, features = features,
                                          rows = from_python<Quaternions>(frames, "frames")](Job&) mutable {
                check_unit(rows, -1, "frames");
                check(boundary, static_cast<Index>(rows.rows()));
                check(features, boundary.mesh);
                return feature_alignment_angles(boundary, features, rows);
            }));
        },
        "boundary"_a, "features"_a, "frames"_a,
        "(k,) angles (radians) between each feature tangent and the nearest axis of its vertex's frame, in the order "
        "of feature_tangents. frames: (n, 4), one per tet-mesh vertex.");
}

}  // namespace

void bind_field_analysis_types(py::module_& m) {
    bind_meshability_types(m);
    bind_measure_types(m);
}

void bind_field_analysis(py::module_& m) {
    bind_meshability(m);
    bind_integrability(m);
    bind_feature_alignment(m);
}

}  // namespace octafield::bindings
