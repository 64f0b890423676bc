// Quads with a fixed boundary, and their templates.
#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/surface/fixed_boundary_quads.hpp"
#include "octafield/surface/quad_templates.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const FixedBoundaryOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.rotation, "rotation");
    finite(options.offset_x, "offset_x");
    finite(options.offset_y, "offset_y");
    finite(options.clearance, "clearance");
}

namespace {

void bind_types(py::module_& m) {
    Record<PlanarOutline>(m, "PlanarOutline",
                          "A plane region: what an odd number of loops goes round. Loops, with holes and islands in "
                          "them, and lines inside, as segments between points.")
        .field("points", &PlanarOutline::points, "(P, 2) float64, the input's length unit.")
        .field("loops", &PlanarOutline::loops,
               "(L, 2) int32 ids of points; each point is in two of these segments or in none.")
        .field("lines", &PlanarOutline::lines,
               "(M, 2) int32 ids of points: segments inside that become edges; they may end anywhere.")
        .finish([](const PlanarOutline& o) {
            return count(o.points.rows(), "point") + ", " + count(o.loops.rows(), "segment") + " of loops, " +
                   std::to_string(o.lines.rows()) + " of lines" + box(o.points);
        });
    Record<FixedBoundaryOptions>(m, "FixedBoundaryOptions", "Options of fixed_boundary_quads: its keyword arguments.")
        .field("edge_length", &FixedBoundaryOptions::edge_length,
               "Of the squares inside, input unit; 0: the mean segment of the loops.")
        .field("rotation", &FixedBoundaryOptions::rotation, "Of the squares, radians counter-clockwise.")
        .field("offset_x", &FixedBoundaryOptions::offset_x,
               "Of a vertex of the squares from the origin, in edge lengths along their first axis.")
        .field("offset_y", &FixedBoundaryOptions::offset_y, "The same, along their second axis.")
        .field("clearance", &FixedBoundaryOptions::clearance,
               "Of vertices inside from segments, in edge lengths (local ones of a mesh given); above 0.8.")
        .field("odd_loops", &FixedBoundaryOptions::odd_loops,
               "What is done where the number of segments is odd: \"refuse\", \"split_one\" (the longest that puts it "
               "right) or \"split_all\" (every segment at its middle).")
        .field("rounds", &FixedBoundaryOptions::rounds,
               "In which groups of quads are formed anew and vertices are moved; 0: as first covered.")
        .finish([](const FixedBoundaryOptions& o) {
            return "edge_length=" + number(o.edge_length) + ", rotation=" + number(o.rotation) +
                   ", clearance=" + number(o.clearance);
        });
    Record<FixedBoundaryQuads>(m, "FixedBoundaryQuads", "Quads of a PlanarOutline, as fixed_boundary_quads makes them.")
        .field("mesh", &FixedBoundaryQuads::mesh, "QuadMesh in the plane z = 0; the outline's points come first.")
        .field("boundary", &FixedBoundaryQuads::boundary,
               "(L', 2) int32: the segments of the loops, two for one that was split.")
        .field("lines", &FixedBoundaryQuads::lines, "(M', 2) int32: those of the lines.")
        .field("interior", &FixedBoundaryQuads::interior, "int32: quads that are of the mesh inside, ascending.")
        .field("split", &FixedBoundaryQuads::split,
               "int32: segments that were split, ascending: loops first, then lines from L on.")
        .field("reformed", &FixedBoundaryQuads::reformed, "Groups of quads that were formed anew.")
        .finish([](const FixedBoundaryQuads& q) {
            return count(q.mesh.quads.rows(), "quad") + ", " + std::to_string(q.interior.size()) +
                   " of them of the mesh inside, " + count(q.boundary.rows(), "segment") + " of the boundary";
        });
}

std::vector<py::array_t<Index>> templates(int sides, int interior) {
    std::vector<py::array_t<Index>> result;
    for (const QuadTemplate& each : quad_templates(sides, interior)) {
        Quads rows(static_cast<Eigen::Index>(each.quads.size()), 4);
        for (Eigen::Index q = 0; q < rows.rows(); ++q)
            for (int k = 0; k < 4; ++k) rows(q, k) = each.quads[q][k];
        result.push_back(own(std::move(rows)));
    }
    return result;
}

}  // namespace

void bind_fixed_boundary(py::module_& m) {
    bind_types(m);
    m.def(
        "quad_templates",
        [](int sides, int interior) {
            run_interruptible([=](Job&) { return quad_templates(sides, interior).size(); });
            return templates(sides, interior);
        },
        "sides"_a, "interior"_a,
        "All ways to fill a polygon of 4, 6, 8 or 10 sides with quads and 0 to 4 vertices inside, up to rotation and "
        "reflection: a list of (sides / 2 - 1 + interior, 4) int32, ids below sides for the polygon's vertices. Edges "
        "are a simple graph, vertices inside have three quads at least, no two quads share two edges (Simons 2024). "
        "Raises InvalidInput (kind \"bad_template\").");
    m.def(
        "require_planar",
        [](const PlanarOutline& outline) { run_interruptible([=](Job&) { return require_planar(outline), 0; }); },
        "outline"_a,
        "Raises unless a PlanarOutline is a plane straight-line graph with closed loops: InvalidInput (kinds "
        "\"empty\", \"index_out_of_range\", \"non_finite_vertex\"), GeometryError (\"repeated_point\", "
        "\"no_length\", \"open_loop\", \"touching_loops\", \"crossing\").");
    m.def(
        "outline_of_graph",
        [](const ArrayLike& points, const ArrayLike& segments, const ArrayLike& holes) {
            auto places = from_python<PlanePoints>(points, "points");
            auto edges = from_python<Edges>(segments, "segments");
            auto inner = from_python<PlanePoints>(holes, "holes");
            return run_interruptible([places = std::move(places), edges = std::move(edges), inner = std::move(inner)](
                                         Job&) { return outline_of_graph(places, edges, inner); });
        },
        "points"_a, "segments"_a, "holes"_a = py::list(),
        "The PlanarOutline of (P, 2) points and (S, 2) segments that do not tell what they are: loops lie between "
        "inside and outside, lines have the inside on both sides. Outside is what can be reached from far away or from "
        "one of the holes (H, 2) without crossing a segment. Raises as require_planar.");
    m.def(
        "outline_triangles",
        [](const PlanarOutline& outline) { return run_interruptible([=](Job&) { return outline_triangles(outline); }); },
        "outline"_a,
        "Triangles of what is inside a PlanarOutline, in the plane z = 0: constrained Delaunay, its points' ids kept, "
        "loops and lines as edges. Raises as require_planar.");
    m.def(
        "fixed_boundary_quads",
        [](const PlanarOutline& outline, const std::optional<QuadMesh>& inside,
           const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<FixedBoundaryOptions>("fixed_boundary_quads", given);
            return run_interruptible(
                [outline, inside = inside.value_or(QuadMesh()), options = options](Job& job) {
                    return fixed_boundary_quads(outline, inside, options, job.progress());
                },
                progress);
        },
        "outline"_a, "inside"_a = py::none(), py::kw_only(), "progress"_a = py::none(),
        "Quads of a PlanarOutline with its segments as they are, as FixedBoundaryQuads: a mesh inside (squares, or the "
        "QuadMesh given, as far as it keeps the clearance) and templates between it and the boundary (after Simons "
        "2024, chapter 2). Raises InvalidInput (kinds \"bad_option\", \"bad_inside_mesh\", \"empty\", "
        "\"index_out_of_range\", \"non_finite_vertex\", \"too_many_quads\"), GeometryError (\"repeated_point\", "
        "\"no_length\", \"open_loop\", \"touching_loops\", \"crossing\", \"outside_line\", \"odd_boundary\", "
        "\"odd_interior\"), SolverError (\"inverted_quads\"), Cancelled.");
    list_options<FixedBoundaryOptions>(m, "fixed_boundary_quads");
}

}  // namespace octafield::bindings
