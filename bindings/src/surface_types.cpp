// Structs of surface/ as Python classes; those of direction fields are in direction_field_types.cpp.
#include "bind.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/repair.hpp"
#include "octafield/surface/validate.hpp"
#include "record.hpp"

namespace octafield::bindings {

using namespace surface;

namespace {

std::string repr_mesh(const TriangleMesh& mesh) {
    return count(mesh.vertices.rows(), "vertex", "vertices") + ", " + count(mesh.triangles.rows(), "triangle") +
           box(mesh.vertices);
}

std::string repr_features(const FeatureGraph& features) {
    return count(features.edges.rows(), "edge") + ", " +
           count(static_cast<std::ptrdiff_t>(features.corners.size()), "corner");
}

void bind_surface_meshes(py::module_& m) {
    Record<TriangleMesh>(m, "TriangleMesh",
                         "A triangle mesh: arrays of positions and of vertex ids. Nothing is checked until it is used.")
        .field("vertices", &TriangleMesh::vertices, "(V, 3) float64 positions, the input's length unit.")
        .field("triangles", &TriangleMesh::triangles,
               "(F, 3) int32 vertex ids, 0-based, counter-clockwise seen from outside.")
        .finish(repr_mesh);

    Record<EdgeTopology>(m, "EdgeTopology", "The edges of an edge-manifold, consistently oriented triangle mesh.")
        .field("edges", &EdgeTopology::edges, "(E, 2) int32 vertex ids, lower first, in lexicographic order.")
        .field("triangle_edges", &EdgeTopology::triangle_edges,
               "(F, 3) int32 edge ids; column k is the edge from corner k to corner k+1 (mod 3).")
        .field("edge_triangles", &EdgeTopology::edge_triangles,
               "(E, 2) int32: the triangle that runs the edge low to high, then the other; -1: none.")
        .finish([](const EdgeTopology& t) {
            return count(t.edges.rows(), "edge") + ", " + count(t.triangle_edges.rows(), "triangle");
        });

    Record<FeatureGraph>(m, "FeatureGraph", "Feature curves and corners of a triangle mesh.")
        .field("edges", &FeatureGraph::edges, "(n, 2) int32 vertex ids, lower first, in lexicographic order.")
        .field("corners", &FeatureGraph::corners,
               "(c,) int32 ascending ids of vertices where feature curves meet, end or turn sharply.")
        .finish(repr_features);
}

void bind_surface_results(py::module_& m) {
    Record<Defect>(m, "Defect", "One thing wrong with a triangle mesh.")
        .field("kind", &Defect::kind, "Stable word, for example \"not_closed\"; find_defects lists them.")
        .field("element", &Defect::element, "What the ids number: \"triangle\", \"vertex\" or \"edge\".")
        .field("elements", &Defect::elements,
               "int32 ids of all elements concerned; for edges the two vertex ids of each, flattened.")
        .field("message", &Defect::message, "One sentence: what, where (the first few), and the remedy.")
        .finish([](const Defect& d) { return d.kind + ": " + d.message; });

    Record<RepairResult>(m, "RepairResult", "A repaired mesh and what was done to it.")
        .field("mesh", &RepairResult::mesh, "The repaired TriangleMesh.")
        .field("actions", &RepairResult::actions, "One sentence per action; an empty list: nothing was needed.")
        .field("largest_move", &RepairResult::largest_move,
               "Input unit: no point of one surface is farther from the other, holes filled apart; 0: no vertex moved.")
        .finish([](const RepairResult& r) {
            return repr_mesh(r.mesh) + ", " + count(static_cast<std::ptrdiff_t>(r.actions.size()), "action");
        });

    Record<RepairAdvice>(m, "RepairAdvice", "Which level of repair makes a mesh sound.")
        .field("level", &RepairAdvice::level, "Word of the level; \"none\": no level does, or none is needed.")
        .field("actions", &RepairAdvice::actions, "What it and the levels before it do, one sentence each.")
        .field("left", &RepairAdvice::left, "Defects that are left where no level does.")
        .field("not_tried", &RepairAdvice::not_tried, "Why levels were left out; empty: all were tried.")
        .finish([](const RepairAdvice& a) {
            return a.level + ", " + count(static_cast<std::ptrdiff_t>(a.actions.size()), "action");
        });

    Record<SizeField>(m, "SizeField", "Edge lengths that fit a surface, and the cells to be expected with them.")
        .field("lengths", &SizeField::lengths, "(V,) float64, input unit.")
        .field("shortest", &SizeField::shortest, "The shortest, also inside large triangles, input unit.")
        .field("longest", &SizeField::longest, "The largest possible length, of edges far inside too, input unit.")
        .field("triangles", &SizeField::triangles, "Triangles to be expected.")
        .field("tets", &SizeField::tets, "Tets to be expected; 0 in an open surface.")
        .field("scale", &SizeField::scale, "Above 1: by which lengths were multiplied to keep max_cells.")
        .field("notes", &SizeField::notes, "That lengths are not all alike, and what max_cells costs.")
        .finish([](const SizeField& s) {
            const std::string range = s.lengths.size() == 0 ? ""
                                                            : ", " + number(s.lengths.minCoeff()) + " to " +
                                                                  number(s.lengths.maxCoeff());
            return count(s.lengths.size(), "length") + range;
        });

    Record<RemeshResult>(m, "RemeshResult", "A remeshed surface and its features.")
        .field("mesh", &RemeshResult::mesh, "The new TriangleMesh.")
        .field("features", &RemeshResult::features,
               "FeatureGraph of the new mesh: pieces of the old curves, corners at the old places.")
        .field("notes", &RemeshResult::notes,
               "Where the edges are shorter than wanted, and why, or the surface is not quite the input's.")
        .field("deviation", &RemeshResult::deviation,
               "Input unit: no vertex of the input is farther from the new surface.")
        .field("inner_length", &RemeshResult::inner_length,
               "Of edges far inside (octafield.volume.tetrahedralize, edge_length), input unit; 0: the mean of the surface's.")
        .finish([](const RemeshResult& r) { return repr_mesh(r.mesh) + ", " + repr_features(r.features); });
}

}  // namespace

void bind_surface_types(py::module_& m) {
    bind_surface_meshes(m);
    bind_surface_results(m);
    bind_surface_domain(m);
    bind_direction_field_types(m);
    bind_non_orthogonal_types(m);
    bind_imposed_field_types(m);
    bind_sized_field_types(m);
    bind_size_family_types(m);
    bind_atlas_types(m);
}

}  // namespace octafield::bindings
