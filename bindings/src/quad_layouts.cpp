// Quad layouts of imposed fields and block-structured quads. Structs: quad_layout_types.cpp.
#include "arrays.hpp"
#include "bind.hpp"
#include "bound_layout.hpp"
#include "checks.hpp"
#include "interruptible.hpp"
#include "octafield/surface/layout_quads.hpp"
#include "octafield/surface/patch_polygons.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

template <class Make>
void bind_of_field(py::module_& m, const char* name, Make make, const char* doc) {
    m.def(
        name,
        [name, make](const ImposedField& field, const std::optional<ProgressCallable>& progress,
                     const py::kwargs& given) {
            const auto [options] = options_of<LayoutCurveOptions>(name, given);
            return run_interruptible(
                [make, field, options = options](Job& job) { return make(field, options, job.progress()); }, progress);
        },
        "field"_a, py::kw_only(), "progress"_a = py::none(), doc);
    list_options<LayoutCurveOptions>(m, name);
}

void bind_curves(py::module_& m) {
    bind_of_field(
        m, "layout_curves",
        [](const ImposedField& field, const LayoutCurveOptions& options, const Progress& progress) {
            return layout_curves(field, options, progress);
        },
        "The separatrices of an ImposedField, from singular points and corners to one another or to the boundary, as "
        "LayoutCurves (Jezdimirovic et al. 2021, section 5): exact for the field in each triangle, with no step size. "
        "One that misses a point by less than end_tolerance (quad coordinates, across the curve; 0: a hundredth of the "
        "root of the area) is joined with that point's own. Raises InvalidInput (kinds \"bad_field\", "
        "\"infinite_corner\", \"rotated_field\"), GeometryError (\"long_separatrix\": longer than max_length), "
        "SolverError, Cancelled.");
    bind_of_field(
        m, "turned_for_layout",
        [](const ImposedField& field, const LayoutCurveOptions& options, const Progress& progress) {
            return turned_for_layout(field, options, progress);
        },
        "The ImposedField with each closed part of the surface turned by one angle, which nothing fixes there, such "
        "that "
        "its separatrices join and are short in all. Parts with a boundary stay. Raises as layout_curves, and "
        "GeometryError (kind \"no_short_turn\") where no angle tried gives separatrices that end.");
}

void bind_layout(py::module_& m) {
    m.def(
        "quad_layout",
        [](const ImposedField& field, bool cut_annuli, const std::optional<ProgressCallable>& progress,
           const py::kwargs& given) {
            const auto [options] = options_of<LayoutCurveOptions>("quad_layout", given);
            return run_interruptible(
                [field, options = options, cut_annuli](Job& job) {
                    return bound_layout(field, options, cut_annuli, false, job.progress());
                },
                progress);
        },
        "field"_a, py::kw_only(), "cut_annuli"_a = true, "progress"_a = py::none(),
        "The surface of an ImposedField cut by its layout_curves into patches, as a QuadLayout. Turn fields on closed "
        "surfaces first (turned_for_layout). cut_annuli: a closed curve of the boundary that no separatrix meets gets "
        "a "
        "cut at right angles. V - E + F is checked; patches that have no four corners are there, by their kind. Raises "
        "as layout_curves, and GeometryError (kind \"bad_subdivision\").");
    list_options<LayoutCurveOptions>(m, "quad_layout");
    m.def(
        "patch_polygons",
        [](const BoundLayout& layout) {
            return run_interruptible([made = layout.layout](Job&) { return patch_polygons(*made); });
        },
        "layout"_a, "The patches of a QuadLayout as regions of the surface, as PatchPolygons.");
}

void bind_quads(py::module_& m) {
    m.def(
        "layout_quads",
        [](const BoundLayout& layout, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            const auto [options] = options_of<LayoutQuadsOptions>("layout_quads", given);
            return run_interruptible([made = layout.layout, options = options](
                                         Job& job) { return layout_quads(*made, options, job.progress()); },
                                     progress);
        },
        "layout"_a, py::kw_only(), "progress"_a = py::none(),
        "Block-structured quads of a QuadLayout, as LayoutQuads: each chord gets its length over the size, rounded; "
        "each "
        "patch is mapped to a rectangle one to one, and a grid is taken back, so that vertices lie on the surface. "
        "Give "
        "edge_length (input unit) or quad_count. Raises InvalidInput; GeometryError (kind \"no_quad_layout\": patches "
        "without four corners); SolverError (\"folded_map\", \"inverted_quads\"), Cancelled.");
    list_options<LayoutQuadsOptions>(m, "layout_quads");
    m.def(
        "quad_angle_quality",
        [](const QuadMesh& mesh) {
            return own(run_interruptible([mesh = mesh](Job&) {
                scaled_jacobians(mesh);  // refuses ids out of range
                return quad_angle_quality(mesh);
            }));
        },
        "mesh"_a,
        "(Q,) float64, of each quad of a QuadMesh max(0, 1 - 2/pi max |pi/2 - angle|), 1 for right angles (Remacle et "
        "al. 2012). Raises GeometryError for ids out of range.");
}

}  // namespace

void bind_quad_layouts(py::module_& m) {
    bind_curves(m);
    bind_layout(m);
    bind_quads(m);
}

}  // namespace octafield::bindings
