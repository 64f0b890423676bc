// Structs of the analysis of frame fields in volumes as Python classes; its functions are in analysis.cpp.
#include "bind.hpp"
#include "octafield/volume/boundary_meshability.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/meshability.hpp"
#include "octafield/volume/smoothed_curves.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace volume;

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
        .field("valence2", &SingularVertex::valence2, "Ends here of curves of +2 quarter turns, which no hex mesh has.")
        .field("valence3", &SingularVertex::valence3, "Ends here of curves of +1 quarter turn.")
        .field("valence5", &SingularVertex::valence5, "Ends here of curves of -1 quarter turn.")
        .field("valence6", &SingularVertex::valence6, "Ends here of curves of -2 quarter turns.")
        .field("complex", &SingularVertex::complex, "Ends here of complex curves, which no hex mesh has.")
        .field("about_normal", &SingularVertex::about_normal,
               "At a boundary end: whether the frames turn about their axis nearest to the normal, so that the surface "
               "cross field is singular there.")
        .field(
            "one_axis", &SingularVertex::one_axis,
            "At a node: whether all its curves turn about one axis of the frame; then they can only pass each other.")
        .field("meshable", &SingularVertex::meshable,
               "Whether the necessary conditions hold: a hex mesh has a vertex with these edges.")
        .field("junction", &SingularVertex::junction, "Place in Meshability.junctions.")
        .field("valence1", &SingularVertex::valence1, "Ends here of curves of +3 quarter turns, which no hex mesh has.")
        .field("valence7", &SingularVertex::valence7, "Ends here of curves of -3 quarter turns; of frames in tets.")
        .field("valence8", &SingularVertex::valence8, "Ends here of curves of -4 quarter turns; of frames in tets.")
        .finish([](const SingularVertex& v) {
            return to_word(v.kind) + (v.meshable ? ", meshable" : ", not meshable") + ", valence3 " +
                   std::to_string(v.valence3) + ", valence5 " + std::to_string(v.valence5) + ", valence6 " +
                   std::to_string(v.valence6) + ", complex " + std::to_string(v.complex);
        });

    Record<SingularEnd>(m, "SingularEnd", "One end of a curve of a singular graph.")
        .field("vertex", &SingularEnd::vertex, "Place in Meshability.vertices.")
        .field("curve", &SingularEnd::curve, "Place in SingularGraph.curves.")
        .field("quarter_turns", &SingularEnd::quarter_turns, "Of the curve: 4 - its valence; 0 complex.")
        .field("axis", &SingularEnd::axis,
               "(3,) float64: unit axis of the frames about which they turn, away from the vertex; 0 where complex.")
        .field("angle", &SingularEnd::angle,
               "Radians between that axis and the smoothed curve: small where a hex mesh could follow.")
        .finish([](const SingularEnd& e) {
            return "curve " + std::to_string(e.curve) + " at vertex " + std::to_string(e.vertex) + ", " +
                   count(e.quarter_turns, "quarter turn");
        });

    Record<SingularJunction>(m, "SingularJunction",
                             "Singular vertices that complex curves join, as if these were shrunk to a point.")
        .field("vertices", &SingularJunction::vertices, "Number of singular vertices in it.")
        .field("valence2", &SingularJunction::valence2, "Ends of curves of +2 quarter turns that leave it.")
        .field("valence3", &SingularJunction::valence3, "Ends of curves of +1 quarter turn that leave it.")
        .field("valence5", &SingularJunction::valence5, "Ends of curves of -1 quarter turn that leave it.")
        .field("valence6", &SingularJunction::valence6, "Ends of curves of -2 quarter turns that leave it.")
        .field("complex", &SingularJunction::complex, "Complex curves inside it; none leaves it.")
        .field("meshable", &SingularJunction::meshable,
               "Whether a hex mesh has a vertex with these edges, once the complex curves are shrunk.")
        .field("valence1", &SingularJunction::valence1, "Ends there of curves of +3 quarter turns, which no hex mesh has.")
        .field("valence7", &SingularJunction::valence7, "Ends there of curves of -3 quarter turns; of frames in tets.")
        .field("valence8", &SingularJunction::valence8, "Ends there of curves of -4 quarter turns; of frames in tets.")
        .finish([](const SingularJunction& j) {
            return count(j.vertices, "vertex", "vertices") + (j.meshable ? ", meshable" : ", not meshable");
        });

    Record<Meshability>(m, "Meshability", "Necessary conditions for a hex mesh round the singular graph of a field.")
        .field("vertices", &Meshability::vertices, "List of SingularVertex, ascending points.")
        .field("junctions", &Meshability::junctions, "List of SingularJunction.")
        .field("ends", &Meshability::ends, "List of SingularEnd, by vertex, then by curve.")
        .field("curve_ends", &Meshability::curve_ends,
               "(curves, 2) int32: vertices at the first and last point of each curve; -1, -1: closed without one.")
        .field("non_meshable_vertices", &Meshability::non_meshable_vertices, "Vertices that no hex mesh has.")
        .field("non_meshable_junctions", &Meshability::non_meshable_junctions, "Junctions that no hex mesh has.")
        .field("non_meshable_curves", &Meshability::non_meshable_curves, "Curves that are complex or of valence 2 or 1.")
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

void bind_boundary_types(py::module_& m) {
    Record<FeatureWedge>(m, "FeatureWedge", "A wedge of tets at a feature edge, between two triangles of the surface.")
        .field("a", &FeatureWedge::a, "Tet-mesh vertex id, a < b.")
        .field("b", &FeatureWedge::b, "Tet-mesh vertex id.")
        .field("angle", &FeatureWedge::angle, "Of the wedge, radians.")
        .field(
            "hexahedra_a", &FeatureWedge::hexahedra_a,
            "Hexahedra that fill it by the frame of a; below 1 no hex mesh; octafield.volume.no_number where the frame does "
            "not follow the edge.")
        .field("hexahedra_b", &FeatureWedge::hexahedra_b, "The same by the frame of b.")
        .field(
            "around", &FeatureWedge::around,
            "By the frame of a carried through the tets of the wedge and back: another number where a singular curve "
            "runs through them; octafield.volume.no_number where the frames come back turned about another axis.")
        .field("meshable", &FeatureWedge::meshable, "Whether there is a number and none below 1, at the ends.")
        .finish([](const FeatureWedge& w) {
            return std::to_string(w.a) + ", " + std::to_string(w.b) + ", hexahedra " + std::to_string(w.hexahedra_a) +
                   ", " + std::to_string(w.hexahedra_b) + (w.meshable ? ", meshable" : ", not meshable");
        });

    Record<SurfaceCrossing>(m, "SurfaceCrossing",
                            "An edge of the surface, no feature, that a singular edge on the surface crosses: another "
                            "axis takes the place of the normal along it.")
        .field("a", &SurfaceCrossing::a, "Tet-mesh vertex id, a < b.")
        .field("b", &SurfaceCrossing::b, "Tet-mesh vertex id.")
        .field("hexahedra", &SurfaceCrossing::hexahedra, "At the singular edge, instead of 2.")
        .finish([](const SurfaceCrossing& c) {
            return std::to_string(c.a) + ", " + std::to_string(c.b) + ", hexahedra " + std::to_string(c.hexahedra);
        });

    Record<SurfaceCorner>(m, "SurfaceCorner", "A corner of the surface and the edges of a hex mesh there.")
        .field("vertex", &SurfaceCorner::vertex, "Tet-mesh vertex id.")
        .field("feature_edges", &SurfaceCorner::feature_edges, "Feature edges there.")
        .field("sectors", &SurfaceCorner::sectors, "Parts of the surface between them.")
        .field(
            "inside", &SurfaceCorner::inside,
            "6 - sum over edges (3 - hexahedra) - sum over sectors (quadrilaterals - 1): what is left for edges that "
            "go inside; below 0 no hex mesh.")
        .field("empty_sectors", &SurfaceCorner::empty_sectors, "Sectors with fewer than one quadrilateral.")
        .field("unclear_sectors", &SurfaceCorner::unclear_sectors,
               "Sectors that a singular edge on the surface crosses: without a number, and left out of the sum.")
        .field("non_meshable_edges", &SurfaceCorner::non_meshable_edges, "Feature edges without a hexahedron.")
        .field("meshable", &SurfaceCorner::meshable, "Whether none of these forbids a hex mesh.")
        .finish([](const SurfaceCorner& c) {
            return "vertex " + std::to_string(c.vertex) + ", " + count(c.feature_edges, "feature edge") +
                   (c.meshable ? ", meshable" : ", not meshable");
        });

    Record<BoundaryMeshability>(m, "BoundaryMeshability",
                                "Necessary conditions for a hex mesh at the features and corners of a field's surface.")
        .field("wedges", &BoundaryMeshability::wedges, "List of FeatureWedge, in the order of the edges.")
        .field("crossings", &BoundaryMeshability::crossings, "List of SurfaceCrossing, in the order of the edges.")
        .field("corners", &BoundaryMeshability::corners,
               "List of SurfaceCorner, ascending; not those that interfaces or several sheets meet in.")
        .field("non_meshable_wedges", &BoundaryMeshability::non_meshable_wedges, "Wedges that no hex mesh fills.")
        .field("non_meshable_crossings", &BoundaryMeshability::non_meshable_crossings,
               "Crossings with fewer than one hexahedron.")
        .field("non_meshable_corners", &BoundaryMeshability::non_meshable_corners, "Corners that no hex mesh has.")
        .finish([](const BoundaryMeshability& found) {
            return count(static_cast<std::ptrdiff_t>(found.wedges.size()), "wedge") + ", " +
                   std::to_string(found.non_meshable_wedges) + " not meshable, " +
                   count(static_cast<std::ptrdiff_t>(found.corners.size()), "corner") + ", " +
                   std::to_string(found.non_meshable_corners) + " not meshable, " +
                   count(static_cast<std::ptrdiff_t>(found.crossings.size()), "crossing");
        });
}

void bind_measure_types(py::module_& m) {
    Record<SmoothedCurves>(m, "SmoothedCurves", "Singular curves without the zigzag of the triangles they cross.")
        .field("points", &SmoothedCurves::points, "(p, 3) float64, in the place of SingularGraph.points.")
        .field("lengths", &SmoothedCurves::lengths, "float64 per curve, input unit.")
        .field("length", &SmoothedCurves::length, "Their sum.")
        .finish(
            [](const SmoothedCurves& c) { return count(c.lengths.size(), "curve") + ", length " + number(c.length); });

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
            return "jump " + number(found.jump_rms) + ", at most " + number(found.jump_max) + "; twist " +
                   number(found.twist_rms) + ", at most " + number(found.twist_max);
        });

    Record<FeatureTangents>(m, "FeatureTangents", "Directions of feature curves at their vertices.")
        .field("vertex", &FeatureTangents::vertex,
               "(k,) int32 boundary-mesh vertex ids, ascending: once on a curve, once per edge at corners and ends.")
        .field("tangent", &FeatureTangents::tangent, "(k, 3) float64 unit vectors, sign arbitrary.")
        .finish([](const FeatureTangents& t) { return count(t.tangent.rows(), "tangent"); });
}

}  // namespace

void bind_field_analysis_types(py::module_& m) {
    bind_meshability_types(m);
    bind_boundary_types(m);
    bind_measure_types(m);
}

}  // namespace octafield::bindings
