#include "definiteness.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "short_number.hpp"

namespace octafield::surface::detail {
namespace {

// Factorizations have failed with angles (radians) below this, never above.
constexpr double thin = 1e-6;

// Sum of the weights at a component: stiffness entries are about 1.
constexpr double negligible = 1e-12;

}  // namespace

void release_negligible(Components& components, AlignedEdges& aligned) {
    std::vector<double> total(components.size(), 0);
    const auto edges = static_cast<Index>(aligned.is_held.size());
    for (Index e = 0; e < edges; ++e) total[components.of_edge[e]] += aligned.is_held[e] ? 1 : aligned.pull.weights[e];
    for (Index e = 0; e < edges; ++e) {
        const Index c = components.of_edge[e];
        if (!(total[c] < negligible)) continue;
        components.anchored[c] = false;
        aligned.pull.weights[e] = 0;
        aligned.pull.targets[e] = 0;
    }
}

void explaining_failure(const SurfaceDomain& domain, const std::function<void()>& solve) {
    try {
        solve();
    } catch (const SolverError& error) {
        if (error.kind() != not_definite) throw;
        std::vector<Index> triangles;
        double least = std::numbers::pi;
        for (Index t = 0; t < domain.triangle_count(); ++t) {
            const double angle = domain.corner_angles().row(t).minCoeff();
            if (angle < thin) triangles.push_back(t);
            least = std::min(least, angle);
        }
        if (triangles.empty())
            throw SolverError(
                std::string(error.what()) +
                    ": weights of weak alignment, constraints or the guide are too small or too different; "
                    "leave such weights out, or choose them between 1e-9 and 1e9",
                "bad_weights");
        throw SolverError(std::string(error.what()) + ": " + std::to_string(triangles.size()) + " triangles (" +
                              first_few(triangles) + ") are too thin, with angles down to " + short_number(least) +
                              " radians; remesh the surface",
                          "thin_triangles", triangles);
    }
}

}  // namespace octafield::surface::detail
