// Non-orthogonal cross fields: their structs, the solver and their singular points. Curves: streamlines.cpp.
#include <algorithm>

#include "bind.hpp"
#include "checks.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "octafield/surface/lines_metric.hpp"
#include "octafield/surface/non_orthogonal_field.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

void check(const NonOrthogonalFieldOptions& options) {
    finite(options.lambda, "lambda_");
    finite(options.corner_angle, "corner_angle");
    finite(options.least_angle, "least_angle");
    finite(options.inertia, "inertia");
    finite(options.penalty, "penalty");
    finite(options.tolerance, "tolerance");
}

namespace {

py::object corners_of(const NonOrthogonalFieldOptions& options) {
    Rows<Index, 2> rows(static_cast<Eigen::Index>(options.corners.size()), 2);
    for (Eigen::Index i = 0; i < rows.rows(); ++i) rows.row(i) << options.corners[i].vertex, options.corners[i].quads;
    return own(std::move(rows));
}

void set_corners(NonOrthogonalFieldOptions& options, const py::handle& value) {
    options.corners.clear();
    if (value.is_none()) return;
    if (py::isinstance<py::list>(value)) {
        const auto list = py::reinterpret_borrow<py::list>(value);
        if (std::all_of(list.begin(), list.end(), [](const auto& each) { return py::isinstance<CornerQuads>(each); })) {
            for (const py::handle each : list) options.corners.push_back(each.cast<CornerQuads>());
            return;
        }
    }
    const auto rows = from_python<Rows<Index, 2>>(value, "corners");
    for (Eigen::Index i = 0; i < rows.rows(); ++i) options.corners.push_back({rows(i, 0), rows(i, 1)});
}

void bind_line_options(py::module_& m) {
    Record<NonOrthogonalFieldOptions>(m, "NonOrthogonalFieldOptions",
                                      "Options of non_orthogonal_field: its keyword arguments, with their defaults.")
        .field("method", &NonOrthogonalFieldOptions::method, "A key of non_orthogonal_field_methods.")
        .field("lambda_", &NonOrthogonalFieldOptions::lambda,
               "Above 0: what a change of the angle between the lines costs.")
        .field("weights", &NonOrthogonalFieldOptions::weights, "Of edges: \"cotangent\" or \"unit\".")
        .field("second_line", &NonOrthogonalFieldOptions::second_line,
               "On the boundary, where no corner gives it: \"fixed\" (linear along the side) or \"free\".")
        .field("corner_angle", &NonOrthogonalFieldOptions::corner_angle,
               "Radians in (0, pi/2): by which a corner differs from straight to have 1 or 3 quads.")
        .field("corners", corners_of, set_corners,
               "(n, 2) int32: boundary vertex, number of quads there; or a list of CornerQuads.")
        .field("least_angle", &NonOrthogonalFieldOptions::least_angle,
               "Radians in (0, pi/4), from free lines to the boundary.")
        .field("max_iterations", &NonOrthogonalFieldOptions::max_iterations, "Steps of the descent, or rounds.")
        .field("seed", &NonOrthogonalFieldOptions::seed, "Of disturbances, and of starts where nothing is aligned.")
        .field("inertia", &NonOrthogonalFieldOptions::inertia, "Of \"projected\": weight of the change in a round.")
        .field("penalty", &NonOrthogonalFieldOptions::penalty, "Of \"projected\": weight of the lengths of free lines.")
        .field("tolerance", &NonOrthogonalFieldOptions::tolerance, "Of \"projected\": change at which rounds stop.")
        .finish([](const NonOrthogonalFieldOptions& o) {
            return "method='" + o.method + "', lambda_=" + number(o.lambda);
        });
}

void bind_line_field(py::module_& m) {
    Record<NonOrthogonalField>(m, "NonOrthogonalField", "Two lines per vertex of a surface, at any angle.")
        .field("domain", &NonOrthogonalField::domain, "SurfaceDomain the field lives on.")
        .field(
            "angles", &NonOrthogonalField::angles,
            "(V, 2) float64, radians: the lines from the first edge round each vertex, at the boundary the edge that "
            "leaves it with the surface on its left; inside, angles are scaled to 2 pi round the vertex.")
        .field("first", &NonOrthogonalField::first,
               "(V, 3) float64 unit vectors along the one line, orthogonal to vertex_normals.")
        .field("second", &NonOrthogonalField::second, "(V, 3) float64 unit vectors along the other one.")
        .field("quads", &NonOrthogonalField::quads, "(V,) int32: quads at vertices of the boundary; 0 inside.")
        .field("energy", &NonOrthogonalField::energy, "int lambda |grad c2|^2 + |grad c4|^2, or the sum over edges.")
        .field("start_energy", &NonOrthogonalField::start_energy, "Of the linear start.")
        .field("iterations", &NonOrthogonalField::iterations, "Steps of the descent, or rounds, done.")
        .field("converged", &NonOrthogonalField::converged, "Whether it came to rest.")
        .field("smallest_angle", &NonOrthogonalField::smallest_angle, "Radians, between the lines of a vertex.")
        .field("freedom", &NonOrthogonalField::freedom,
               "Of free lines: 1, or the part of their range of angles that keeps them from passing through the "
               "boundary; 0: they are fixed.")
        .field("inverted", &NonOrthogonalField::inverted,
               "int32 boundary vertices where a line has passed through the boundary's direction.")
        .finish([](const NonOrthogonalField& f) {
            return count(f.angles.rows(), "vertex", "vertices") + ", energy " + number(f.energy) + ", " +
                   (f.converged ? "converged" : "not converged");
        });
}

void bind_solver(py::module_& m) {
    m.def(
        "non_orthogonal_field",
        [](const SurfaceOrMesh& surface, const std::optional<ProgressCallable>& progress, const py::kwargs& given) {
            auto [options] = options_of<NonOrthogonalFieldOptions>("non_orthogonal_field", given);
            return run_interruptible(
                [surface, options = std::move(options)](Job& job) {
                    return non_orthogonal_field(domain_of(surface), options, job.progress());
                },
                progress);
        },
        "surface"_a, py::kw_only(), "progress"_a = py::none(),
        "Two lines per vertex that follow both sides of corners of any angle (Desobry et al. 2021; Dermine 2024), as a "
        "NonOrthogonalField. One line follows the boundary of the surface; at corners of 1 or 3 quads both follow its "
        "edges. Features inside are not followed and refused.\n\n"
        "method: \"angles\", descent by the angles to a local minimum from a linear start; \"projected\", the loop of "
        "Dermine 2024; \"poly_vector\", linear (Diamanti et al. 2014). lambda_: what a change of the angle between the "
        "lines costs; weights: \"cotangent\", or \"unit\" as in Dermine 2024. second_line: on the boundary, where no "
        "corner gives it, \"fixed\", its angle linear from corner to corner, or \"free\", with at least least_angle "
        "(radians) from the boundary.\n\n"
        "corner_angle: g, radians; a boundary vertex of interior angle phi has 1 quad up to pi - g, 2 up to pi + g, 3 "
        "up "
        "to 2 pi - g, 4 beyond. corners: (n, 2) vertices and their numbers of quads, or a list of CornerQuads, where "
        "that is not wanted. "
        "max_iterations: steps, or rounds; seed: of disturbances; inertia, penalty, tolerance: of projected.\n\n"
        "Cancelled by progress, the best state is returned with converged False. Raises InvalidInput, GeometryError, "
        "SolverError.");
    py::dict methods;
    for (const auto& [name, meaning] : non_orthogonal_field_methods()) methods[py::str(name)] = meaning;
    m.attr("non_orthogonal_field_methods") = methods;
    list_options<NonOrthogonalFieldOptions>(m, "non_orthogonal_field");
    m.def(
        "surface_singularities",
        [](const NonOrthogonalField& field) {
            return run_interruptible([field](Job&) { return surface_singularities(field); });
        },
        "field"_a,
        "Of a non-orthogonal field: triangles round which its lines do not come back to themselves, with N = 4, and "
        "boundary vertices with other than 2 quads (index (2 - quads) / 4).");
}

void bind_metric_type(py::module_& m) {
    Record<LinesMetric>(m, "LinesMetric", "A surface measured so that the lines of a field are orthonormal.")
        .field("domain", &LinesMetric::domain, "SurfaceDomain with its own edge lengths.")
        .field("damped", &LinesMetric::damped,
               "int32 ids of the vertices whose metric was drawn towards that of space, where lines turn too fast for "
               "the triangles.")
        .field("least_part", &LinesMetric::least_part, "What is left of it at the worst, in [0, 1].")
        .finish([](const LinesMetric& metric) {
            return count(metric.domain.triangle_count(), "triangle") + ", " + std::to_string(metric.damped.size()) +
                   " damped";
        });
}

void bind_metric(py::module_& m) {
    m.def(
        "lines_metric",
        [](const NonOrthogonalField& field) {
            return run_interruptible([field](Job&) { return lines_metric(field); });
        },
        "field"_a,
        "The surface of a non-orthogonal field measured by edge lengths in which its lines are orthonormal (Panozzo et "
        "al. 2014), as a LinesMetric. With its domain, impose_singular_points, motorcycle_graph and quantized_quads "
        "make quads along the lines: the quad at a corner of 30 degrees that both lines follow has a right angle "
        "there, and 30 degrees in space. Raises GeometryError where two lines are next to parallel.");
}

}  // namespace

void bind_non_orthogonal_types(py::module_& m) {
    bind_line_field(m);
    bind_metric_type(m);
}

void bind_non_orthogonal(py::module_& m) {
    bind_line_options(m);
    bind_solver(m);
    bind_metric(m);
}

}  // namespace octafield::bindings
