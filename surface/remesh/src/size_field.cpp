#include "octafield/surface/size_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "background.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/surface/validate.hpp"
#include "planned_sizes.hpp"
#include "shells.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

void require_options(const SizeFieldOptions& options) {
    const auto length = [](double x) { return std::isfinite(x) && x >= 0; };
    if (!length(options.longest) || !length(options.shortest))
        throw InvalidInput("the longest and the shortest edge must be positive, or 0 for the default", "invalid_option");
    if (options.longest > 0 && options.shortest > options.longest)
        throw InvalidInput("the shortest edge must not be longer than the longest", "invalid_option");
    if (!(options.angle > 0 && options.angle < std::numbers::pi))
        throw InvalidInput("angle is in radians, between 0 and pi", "invalid_option");
    if (!(options.growth > 0 && std::isfinite(options.growth)))
        throw InvalidInput("growth must be positive", "invalid_option");
    if (!(options.max_cells >= 1 && std::isfinite(options.max_cells)))
        throw InvalidInput("max_cells must be at least 1", "invalid_option");
}

}  // namespace

std::string range_of(const Background& ground) {
    const double least = ground.length.minCoeff(), most = ground.length.maxCoeff();
    const std::string range = most < 1.05 * least
                                  ? "edges of " + short_number(least) + " instead of " + short_number(ground.longest)
                                  : "edges from " + short_number(least) + " to " + short_number(most);
    return range + ": shorter where the surface bends, walls are thin or feature curves lie close";
}

double fitting_scale(const Background& ground, double volume, double max_cells) {
    double low = 1, high = 1;
    while (expected_cells(ground, volume, high).most() > max_cells && high < 1e6) low = std::exchange(high, 2 * high);
    for (int k = 0; k < 30 && high > 1.001 * low; ++k) {
        const double middle = std::sqrt(low * high);
        (expected_cells(ground, volume, middle).most() > max_cells ? low : high) = middle;
    }
    return high;
}

Background planned_ground(const TriangleMesh& mesh, const FeatureGraph& features, const SizeFieldOptions& options) {
    const double longest = options.longest > 0 ? options.longest : default_edge_length(mesh);
    Background ground =
        background_of(mesh, features, Eigen::VectorXd::Constant(mesh.vertices.rows(), longest), longest,
                      options.shortest > 0 ? std::min(options.shortest, longest) : longest / 16);
    bound_by_curvature(ground, options.angle);
    bound_by_curves(ground, options.angle, least_length(ground));
    bound_by_strips(ground, least_length(ground));
    bound_by_widths(ground);
    limit_growth(ground, options.growth);
    return ground;
}

SizeField size_field(const TriangleMesh& mesh, const FeatureGraph& features, const SizeFieldOptions& options,
                     const Progress& progress) {
    report_or_throw(progress, "sizes", 0, std::numeric_limits<double>::quiet_NaN());
    require_options(options);
    require_valid(mesh, {.closed = false, .self_intersection = false});
    feature_graph(mesh, features.edges);  // throws where they are no edges of the mesh
    Background ground = planned_ground(mesh, features, options);
    return fitted(ground, mesh, options.max_cells);
}

SizeField fitted(Background& ground, const TriangleMesh& mesh, double max_cells) {
    const bool closed = edge_topology(mesh).edge_triangles.minCoeff() >= 0;
    const double volume = closed ? signed_volume(mesh) : 0;
    SizeField field;
    const Cells wanted = expected_cells(ground, volume, 1);
    if (wanted.most() > max_cells) {
        field.scale = fitting_scale(ground, volume, max_cells);
        ground.length *= field.scale;
        ground.longest *= field.scale;
        ground.shortest *= field.scale;
    }
    const Cells cells = expected_cells(ground, volume, 1);
    field.triangles = cells.triangles;
    field.tets = cells.tets;
    field.shortest = ground.length.minCoeff();
    field.longest = ground.longest;
    field.lengths = ground.length.head(mesh.vertices.rows());
    if (!field.uniform()) field.notes.push_back(range_of(ground));
    if (field.scale > 1.05)
        field.notes.push_back("the shape asks for about " + short_number(wanted.most()) + " cells; edges are " +
                              short_number(field.scale) + " times as long, for " + short_number(max_cells) +
                              ": bends and walls get fewer edges than they should");
    return field;
}

}  // namespace octafield::surface
