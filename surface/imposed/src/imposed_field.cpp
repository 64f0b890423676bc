#include "octafield/surface/imposed_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "crouzeix_raviart.hpp"
#include "moved_points.hpp"
#include "octafield/error.hpp"
#include "pattern_checks.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

using detail::BuiltField;

using std::numbers::pi;
constexpr double most_open = 1e-6;  // radians: misfits beyond are no rounding of sound triangles

// A vertex of the input at, or beside, the condition.
Index vertex_of(const SurfaceDomain& input, const BuiltField& built, const detail::Holonomy::Condition& condition) {
    const Index vertex = condition.boundary
                             ? built.structure.components[condition.component].curves[condition.curve].vertex
                             : built.domain.topology().edges(condition.edge, 0);
    if (vertex < input.vertex_count()) return vertex;
    return input.mesh().triangles(built.ringed.vertex_triangles[vertex], 0);
}

std::vector<HolonomyCondition> conditions_of(const SurfaceDomain& input, const BuiltField& built) {
    std::vector<HolonomyCondition> result;
    const auto& conditions = built.holonomy.conditions();
    if (conditions.empty()) return result;
    const Eigen::VectorXd fluxes = built.energies * built.rotations;
    for (std::size_t i = 0; i < conditions.size(); ++i) {
        const auto at = static_cast<Eigen::Index>(i);
        result.push_back({conditions[i].boundary, vertex_of(input, built, conditions[i]), built.missed[at],
                          built.rotations[at], std::exp(std::abs(fluxes[at]))});
    }
    return result;
}

void require_admissible(const std::vector<HolonomyCondition>& conditions, double tolerance) {
    std::vector<Index> vertices;
    std::string text;
    for (const HolonomyCondition& c : conditions) {
        if (std::abs(c.angle) <= tolerance) continue;
        vertices.push_back(c.vertex);
        if (vertices.size() <= 3)
            text += (vertices.size() > 1 ? "; " : "") +
                    (c.boundary ? "the boundary curve through vertex " + std::to_string(c.vertex) +
                                      " is off the longest one by "
                                : "round the generator at vertex " + std::to_string(c.vertex) +
                                      " the field comes back turned by ") +
                    short_number(c.angle * 180 / pi) + " degrees";
    }
    if (vertices.empty()) return;
    if (vertices.size() > 3) text += "; and " + std::to_string(vertices.size() - 3) + " conditions more";
    throw InvalidInput(
        "no cross field has these singular points in these places: " + text +
            ". Move the points (inadmissible: move does it, by as little as possible), or have the field "
            "rotated at the cost of sizes that disagree (inadmissible: rotate)",
        "inadmissible_pattern", vertices);
}

// As detail::built_field; corners, which are places after the points, are not called points.
BuiltField first_field(const SurfaceDomain& domain, const detail::Imposed& imposed, std::size_t points) {
    try {
        return detail::built_field(domain, imposed);
    } catch (const InvalidInput& error) {
        const auto& places = error.elements();
        if (error.kind() != "coincident_points" || places.size() != 2 || places[1] < static_cast<Index>(points)) throw;
        if (places[0] >= static_cast<Index>(points))
            throw InvalidInput("two corners of the boundary are too near to tell apart; remesh the surface there",
                               error.kind());
        throw InvalidInput("singular point " + std::to_string(places[0]) +
                               " is at a corner of the boundary, or too near to tell; give the corner its number of "
                               "quads instead",
                           error.kind(), {places[0]});
    }
}

DirectionField field_of(const BuiltField& built, double& closure) {
    const auto [angles, open] = detail::rotated(built);
    closure = open;
    if (!(open < most_open))
        throw SolverError("the angles of the cross field miss one another by " + short_number(open) +
                              " radians: triangles are too thin, or too different in size, for double precision; "
                              "remesh the surface",
                          "thin_triangles");
    DirectionField field;
    field.domain = built.domain;
    field.values.resize(angles.size());
    for (Index e = 0; e < angles.size(); ++e) {
        const bool boundary = built.domain.topology().edge_triangles.row(e).minCoeff() < 0;
        field.values[e] = boundary ? 1.0 : std::polar(1.0, 4 * angles[e]);
    }
    field.energy = field.dirichlet_energy =
        detail::dirichlet_energy(detail::corner_links(built.domain, 4), field.values);
    field.converged = true;
    field.residual = open;
    return field;
}

SingularPattern imposed_pattern(const BuiltField& built, const detail::Imposed& imposed, std::size_t points) {
    SingularPattern pattern;
    for (std::size_t i = 0; i < points; ++i) {
        const Index v = built.ringed.centres[i];
        pattern.points.push_back(
            {built.ringed.vertex_triangles[v], built.ringed.vertex_weights.row(v), imposed.indices[i]});
    }
    for (const auto& [vertex, index] : imposed.corners) {
        const auto end = built.ringed.centres.begin() + static_cast<std::ptrdiff_t>(points);
        if (index != 0 && std::find(built.ringed.centres.begin(), end, vertex) == end)
            pattern.corners.push_back({vertex, 2 - index});
    }
    return pattern;
}

}  // namespace

ImposedField impose_singular_points(const SurfaceDomain& domain, const SingularPattern& pattern,
                                    const ImposedFieldOptions& options, const Progress& progress) {
    const detail::Structure structure(domain);
    detail::Imposed imposed = detail::checked_pattern(domain, structure, pattern, options);
    const std::size_t count = pattern.points.size();
    report_or_throw(progress, "impose", 0, NAN);
    BuiltField built = first_field(domain, imposed, count);
    ImposedField result;
    const auto largest = built.missed.size() ? built.missed.cwiseAbs().maxCoeff() : 0.0;
    if (options.inadmissible == Inadmissible::fail) require_admissible(conditions_of(domain, built), options.tolerance);
    if (options.inadmissible == Inadmissible::move && largest > options.tolerance) {
        auto moved = detail::moved_points(domain, imposed, count, std::move(built), options, progress);
        built = std::move(moved.built);
        result.steps = moved.steps;
        result.largest_move = moved.largest_move;
    }
    report_or_throw(progress, "impose", 0.9, NAN);
    result.conditions = conditions_of(domain, built);
    result.field = field_of(built, result.closure);
    result.log_size = std::move(built.h);
    result.pattern = imposed_pattern(built, imposed, count);
    result.point_vertices.assign(built.ringed.centres.begin(),
                                 built.ringed.centres.begin() + static_cast<std::ptrdiff_t>(count));
    result.vertex_triangles = std::move(built.ringed.vertex_triangles);
    result.vertex_weights = std::move(built.ringed.vertex_weights);
    result.triangle_origins = std::move(built.ringed.origins);
    return result;
}

}  // namespace octafield::surface
