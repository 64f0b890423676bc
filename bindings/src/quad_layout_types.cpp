// Structs of quad layouts as Python classes.
#include <map>

#include "bind.hpp"
#include "bound_layout.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/surface/layout_quads.hpp"
#include "octafield/surface/patch_polygons.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;

void check(const LayoutCurveOptions& options) {
    finite(options.end_tolerance, "end_tolerance");
    finite(options.max_length, "max_length");
}

void check(const LayoutQuadsOptions& options) { finite(options.edge_length, "edge_length"); }

namespace {

void bind_layout_options(py::module_& m) {
    Record<LayoutCurveOptions>(m, "LayoutCurveOptions",
                               "Options of layout_curves, turned_for_layout and quad_layout: keyword arguments of "
                               "these, with their defaults.")
        .field(
            "end_tolerance", &LayoutCurveOptions::end_tolerance,
            "How far from a point, across the curve and in quad coordinates, a separatrix is joined with one of that "
            "point; 0: a hundredth of the root of the surface's area in quad coordinates.")
        .field("max_length", &LayoutCurveOptions::max_length, "Of a curve, in quad coordinates; 0: 40 times that root.")
        .field("cut_vertices", &LayoutCurveOptions::cut_vertices,
               "int32 vertices of the boundary, with two quads, from which a curve starts at right angles as well.")
        .finish([](const LayoutCurveOptions& o) {
            return "end_tolerance=" + number(o.end_tolerance) + ", max_length=" + number(o.max_length);
        });
    Record<LayoutQuadsOptions>(m, "LayoutQuadsOptions",
                               "Options of layout_quads: its keyword arguments. One of the two is to be given.")
        .field("edge_length", &LayoutQuadsOptions::edge_length,
               "Of the quads, input unit, where exp(H) is 1: they are about area / edge_length^2.")
        .field("quad_count", &LayoutQuadsOptions::quad_count,
               "Wanted; made is the nearest number that comes from one size for all chords.")
        .finish([](const LayoutQuadsOptions& o) {
            return "edge_length=" + number(o.edge_length) + ", quad_count=" + std::to_string(o.quad_count);
        });
}

// A member of each of a curve's points, as an array.
template <class Array, class Member>
auto column(Member LayoutCurvePoint::*member) {
    return [member](const LayoutCurve& curve) {
        Array values(curve.points.size());
        for (std::size_t i = 0; i < curve.points.size(); ++i)
            values[static_cast<std::ptrdiff_t>(i)] = curve.points[i].*member;
        return own(std::move(values));
    };
}

template <class Array, class Member>
auto set_column(const char* name, Member LayoutCurvePoint::*member) {
    return [name, member](LayoutCurve& curve, const py::handle& value) {
        const auto values = from_python<Array>(value, name);
        curve.points.resize(static_cast<std::size_t>(values.size()));
        for (std::size_t i = 0; i < curve.points.size(); ++i)
            curve.points[i].*member = values[static_cast<std::ptrdiff_t>(i)];
    };
}

void bind_curve_types(py::module_& m) {
    using Ids = std::vector<Index>;
    using Numbers = Eigen::VectorXd;
    Record<LayoutCurve>(m, "LayoutCurve", "A separatrix of an imposed field, or two of them joined.")
        .field("vertices", column<Ids>(&LayoutCurvePoint::vertex),
               set_column<Ids>("vertices", &LayoutCurvePoint::vertex),
               "(n + 1,) int32, for each point the vertex of LayoutCurves.domain it is at; -1: it is on an edge.")
        .field("edges", column<Ids>(&LayoutCurvePoint::edge), set_column<Ids>("edges", &LayoutCurvePoint::edge),
               "(n + 1,) int32, the edge; -1 for points at vertices.")
        .field("fractions", column<Numbers>(&LayoutCurvePoint::fraction),
               set_column<Numbers>("fractions", &LayoutCurvePoint::fraction),
               "(n + 1,) float64, of the edge, from lower to higher vertex id.")
        .field("lengths", column<Numbers>(&LayoutCurvePoint::length),
               set_column<Numbers>("lengths", &LayoutCurvePoint::length),
               "(n + 1,) float64, from the start, in quad coordinates.")
        .field("triangles", &LayoutCurve::triangles, "(n,) int32, that hold the parts between the points.")
        .field("first_vertex", &LayoutCurve::first_vertex, "Singular point or corner, a vertex of the field's surface.")
        .field("last_vertex", &LayoutCurve::last_vertex, "The same; -1: the curve ends at the boundary.")
        .field("offset", &LayoutCurve::offset,
               "By which the exact separatrix misses last_vertex, quad coordinates, signed.")
        .finish([](const LayoutCurve& c) {
            return count(static_cast<std::ptrdiff_t>(c.points.size()), "point") + ", from vertex " +
                   std::to_string(c.first_vertex) +
                   (c.last_vertex < 0 ? " to the boundary" : " to vertex " + std::to_string(c.last_vertex));
        });
    Record<LayoutCurves>(m, "LayoutCurves", "The separatrices of an imposed field, as the curves of a layout.")
        .field("curves", &LayoutCurves::curves, "List of LayoutCurve, each joined pair once.")
        .field("traced", &LayoutCurves::traced, "Separatrices, before any were joined.")
        .field("end_tolerance", &LayoutCurves::end_tolerance, "As used, quad coordinates.")
        .field("parameter_area", &LayoutCurves::parameter_area,
               "Of the surface in quad coordinates, the integral of exp(-2 H).")
        .field("domain", &LayoutCurves::domain,
               "SurfaceDomain that edges and triangles belong to: the field's, with edges between two singular points "
               "halved, if there are any; vertices keep their numbers.")
        .finish([](const LayoutCurves& c) {
            return count(static_cast<std::ptrdiff_t>(c.curves.size()), "curve") + " of " +
                   count(c.traced, "separatrix", "separatrices");
        });
}

py::list loops_of(const LayoutPatch& patch) {
    py::list result;
    for (const auto& loop : patch.loops) {
        Rows<Index, 2> rows(static_cast<Eigen::Index>(loop.size()), 2);
        for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) << loop[i].side, loop[i].reversed;
        result.append(own(std::move(rows)));
    }
    return result;
}

void set_loops(LayoutPatch& patch, const py::handle& value) {
    patch.loops.clear();
    for (const py::handle each : py::reinterpret_borrow<py::iterable>(value)) {
        const auto rows = from_python<Rows<Index, 2>>(each, "loops");
        patch.loops.emplace_back();
        for (Eigen::Index i = 0; i < rows.rows(); ++i) patch.loops.back().push_back({rows(i, 0), rows(i, 1) != 0});
    }
}

void bind_part_types(py::module_& m) {
    Record<LayoutVertex>(m, "LayoutVertex", "A vertex of a quad layout.")
        .field("kind", &LayoutVertex::kind,
               "\"singular\" (inside, of index other than 0), \"corner\" (of the boundary, with other than 2 quads), "
               "\"crossing\" (of two curves) or \"boundary\" (where a curve ends).")
        .field("vertex", &LayoutVertex::vertex, "Of the field's surface; -1: none.")
        .field("index_times_four", &LayoutVertex::index_times_four, "t, as of ImposedPoint.")
        .field("position", &LayoutVertex::position, "(3,) float64, input unit.")
        .finish([](const LayoutVertex& v) {
            return to_word(v.kind) + ", index " + std::to_string(v.index_times_four) + "/4";
        });
    Record<LayoutSide>(m, "LayoutSide", "Part of a curve or of the boundary between two vertices of a layout.")
        .field("first", &LayoutSide::first,
               "Vertex of the layout; -1: a closed curve of the boundary that no other curve meets.")
        .field("last", &LayoutSide::last, "The same, of the other end.")
        .field("curve", &LayoutSide::curve,
               "Place in LayoutCurves.curves; -1: part of the boundary, which has the surface on its left.")
        .field("chord", &LayoutSide::chord, "Place in QuadLayout.chords.")
        .field("points", &LayoutSide::points, "(n, 3) float64, the polyline on the surface, input unit.")
        .field("parameters", &LayoutSide::parameters, "(n,) float64, length up to each point in quad coordinates.")
        .finish([](const LayoutSide& s) {
            return "vertices " + std::to_string(s.first) + " to " + std::to_string(s.last) + ", length " +
                   number(s.parameters.size() ? s.length() : 0);
        });
    Record<LayoutPatch>(m, "LayoutPatch", "A patch of a quad layout.")
        .field(
            "kind", &LayoutPatch::kind,
            "\"quad\" (a disk with four corners), \"polygon\" (a disk with another number), \"annulus\" or \"other\".")
        .field("euler_characteristic", &LayoutPatch::euler_characteristic, "1 for a disk, 0 for an annulus.")
        .field("corners", &LayoutPatch::corners, "How many vertices of the layout are on its boundary curves.")
        .field(
            "loops", loops_of, set_loops,
            "Of each boundary curve, with the patch on its left, (k, 2) int32: sides of the layout, and 1 where a side "
            "is run from its last to its first vertex.")
        .field(
            "corner_sides", &LayoutPatch::corner_sides,
            "int32, of each loop in turn, places of the sides that start at a corner; the others start at a T-joint.")
        .finish([](const LayoutPatch& p) { return to_word(p.kind) + ", " + count(p.corners, "corner"); });
    Record<LayoutChord>(m, "LayoutChord", "Sides of a layout that get the same number of quads.")
        .field("sides", &LayoutChord::sides, "int32, ascending.")
        .field("length", &LayoutChord::length, "Mean of the sides, in quad coordinates.")
        .finish([](const LayoutChord& c) {
            return count(static_cast<std::ptrdiff_t>(c.sides.size()), "side") + ", length " + number(c.length);
        });
    Record<PatchPolygons>(m, "PatchPolygons",
                          "The triangles of a surface cut along the curves of a layout: convex polygons that tile it.")
        .field("points", &PatchPolygons::points, "(n, 3) float64, input unit.")
        .field("first", &PatchPolygons::first,
               "(p + 1,) int32: polygon i has the corners from first[i] to first[i + 1], exclusive.")
        .field("corners", &PatchPolygons::corners, "int32 ids of points, counter-clockwise.")
        .field("patches", &PatchPolygons::patches, "(p,) int32: patch of each polygon.")
        .finish([](const PatchPolygons& p) { return count(static_cast<std::ptrdiff_t>(p.patches.size()), "polygon"); });
}

void bind_quad_types(py::module_& m) {
    Record<LayoutQuads>(m, "LayoutQuads", "Block-structured quads, as layout_quads makes them.")
        .field("mesh", &LayoutQuads::mesh, "QuadMesh, vertices of the layout first.")
        .field("patches", &LayoutQuads::patches, "(Q,) int32: patch of each quad.")
        .field("chord_counts", &LayoutQuads::chord_counts, "int32: quads across each chord of the layout.")
        .field("patch_sizes", &LayoutQuads::patch_sizes,
               "(patches, 2) int32: quads along the first and second side of each; they are numbered along the first.")
        .field("mean_value_patches", &LayoutQuads::mean_value_patches,
               "Mapped with mean value weights, as the harmonic map folded.")
        .field("least_scaled_jacobian", &LayoutQuads::least_scaled_jacobian, "Of the quads.")
        .finish([](const LayoutQuads& q) {
            return count(q.mesh.quads.rows(), "quad") + " in " +
                   count(static_cast<std::ptrdiff_t>(q.patch_sizes.rows()), "patch", "patches") +
                   ", least scaled Jacobian " + number(q.least_scaled_jacobian);
        });
}

// What made it is kept: a copy that was pickled is made again, as the surface cut into pieces is not stored.
void bind_layout_type(py::module_& m) {
    py::class_<BoundLayout> type(
        m, "QuadLayout",
        "A surface cut by separatrices of an imposed field into patches, most of them with four "
        "corners: what quad_layout and motorcycle_graph make. Cannot be changed; pickles are of the field and the "
        "options, and are made again when read.");
    type.def(py::init([](const ImposedField& field, const LayoutCurveOptions& options, bool cut_annuli, bool t_mesh) {
                 check(options);
                 return run_interruptible(
                     [=](Job& job) { return bound_layout(field, options, cut_annuli, t_mesh, job.progress()); });
             }),
             py::arg("field"), py::arg("options") = LayoutCurveOptions{}, py::arg("cut_annuli") = true,
             py::arg("t_mesh") = false, "As quad_layout, or as motorcycle_graph.");
    const auto part = [&]<class Member>(const char* name, Member QuadLayout::*member, const char* doc) {
        type.def_property_readonly(
            name, [member](const BoundLayout& l) { return (*l.layout).*member; }, doc);
    };
    part("vertices", &QuadLayout::vertices, "List of LayoutVertex.");
    part("sides", &QuadLayout::sides, "List of LayoutSide.");
    part("patches", &QuadLayout::patches, "List of LayoutPatch.");
    part("chords", &QuadLayout::chords, "List of LayoutChord.");
    part("curves", &QuadLayout::curves, "LayoutCurves.");
    part("largest_mismatch", &QuadLayout::largest_mismatch,
         "Of the lengths of opposite sides of a quad patch in quad coordinates, over their mean.");
    type.def_property_readonly(
            "field", [](const BoundLayout& l) { return l.field; }, "ImposedField it follows.")
        .def_property_readonly(
            "options", [](const BoundLayout& l) { return l.options; }, "LayoutCurveOptions it was made with.")
        .def_property_readonly(
            "cut_annuli", [](const BoundLayout& l) { return l.cut_annuli; },
            "Whether closed curves of the boundary that no separatrix meets were to get a cut.")
        .def_property_readonly(
            "t_mesh", [](const BoundLayout& l) { return l.t_mesh; },
            "Whether motorcycle_graph made it: sides may end at T-joints.")
        .def("__reduce__",
             [](const py::object& self) {
                 const auto& l = self.cast<const BoundLayout&>();
                 return py::make_tuple(py::type::of(self), py::make_tuple(l.field, l.options, l.cut_annuli, l.t_mesh));
             })
        .def("__repr__", [](const BoundLayout& l) {
            const auto size = [](const auto& list) { return static_cast<std::ptrdiff_t>(list.size()); };
            return "QuadLayout(" + count(size(l.layout->vertices), "vertex", "vertices") + ", " +
                   count(size(l.layout->sides), "side") + ", " + count(size(l.layout->patches), "patch", "patches") +
                   ", " + count(size(l.layout->chords), "chord") + ")";
        });
}

}  // namespace

void bind_quad_layout_types(py::module_& m) {
    bind_layout_options(m);
    bind_curve_types(m);
    bind_part_types(m);
    bind_quad_types(m);
    bind_layout_type(m);
}

}  // namespace octafield::bindings
