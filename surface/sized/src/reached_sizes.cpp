#include "octafield/surface/reached_sizes.hpp"

#include <algorithm>
#include <cmath>

#include "crouzeix_raviart.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/library_threads.hpp"
#include "size_checks.hpp"
#include "size_potential.hpp"
#include "vertex_laplacian.hpp"

namespace octafield::surface {
namespace {

// (3F) by how much the direction turns between the midpoints of each corner's edges; what a triangle turns all round
// is taken off in equal parts.
std::vector<double> corner_turns(const DirectionField& field, const std::vector<detail::CornerLink>& links,
                                 std::vector<bool>& is_singular) {
    const Eigen::VectorXcd values = detail::unit_values(field.values);
    std::vector<double> turns(links.size());
    is_singular.resize(field.domain.triangle_count());
    for (std::size_t t = 0; t < is_singular.size(); ++t) {
        double sum = 0;
        for (int k = 0; k < 3; ++k) {
            turns[3 * t + k] = detail::turn(links[3 * t + k], values) / field.symmetry;
            sum += turns[3 * t + k];
        }
        is_singular[t] = std::abs(sum) * field.symmetry > 1;
        for (int k = 0; k < 3; ++k) turns[3 * t + k] -= sum / 3;
    }
    return turns;
}

// The lowest vertex of the connected part of each; -1: in no triangle.
std::vector<Index> parts_of(const SurfaceDomain& domain) {
    DisjointSets sets(domain.vertex_count());
    const Edges& edges = domain.topology().edges;
    for (Index e = 0; e < domain.edge_count(); ++e) sets.join(edges(e, 0), edges(e, 1));
    std::vector<Index> part(domain.vertex_count(), -1);
    for (const auto& fan : domain.fans().fans) part[fan.vertex] = sets.lowest(fan.vertex);
    return part;
}

// Takes the mean over its part off each value.
void centre(const SurfaceDomain& domain, const std::vector<Index>& part, Eigen::VectorXd& values) {
    const Eigen::VectorXd areas = domain.areas();
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(values.size()), weights = sums;
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (const Index v : domain.mesh().triangles.row(t)) {
            sums[part[v]] += areas[t] * values[v];
            weights[part[v]] += areas[t];
        }
    for (Index v = 0; v < values.size(); ++v)
        values[v] = part[v] < 0 ? 0 : values[v] - sums[part[v]] / weights[part[v]];
}

}  // namespace

ReachedSizes reached_sizes(const DirectionField& field) {
    calm_library_threads();
    const SurfaceDomain& domain = field.domain;
    if (field.values.size() != domain.edge_count())
        throw InvalidInput("the direction field has " + std::to_string(field.values.size()) +
                               " values; give one per edge, " + std::to_string(domain.edge_count()),
                           "wrong_size");
    const auto links = detail::corner_links(domain, field.symmetry);
    std::vector<bool> is_singular;
    const std::vector<double> turns = corner_turns(field, links, is_singular);
    // int grad phi . J^T grad alpha over a triangle is minus the turn at the corner of phi.
    Eigen::VectorXd right = Eigen::VectorXd::Zero(domain.vertex_count());
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) right[domain.mesh().triangles(t, k)] -= turns[3 * t + k];
    const std::vector<Index> part = parts_of(domain);
    std::vector<bool> held(domain.vertex_count());
    for (Index v = 0; v < domain.vertex_count(); ++v) held[v] = part[v] < 0 || part[v] == v;
    ReachedSizes result;
    result.log_sizes = detail::VertexLaplacian(domain, held).solve(right, Eigen::VectorXd::Zero(domain.vertex_count()));
    const std::vector<double> explained = detail::conjugate_turns(domain, result.log_sizes);
    double left = 0, all = 0;
    for (std::size_t c = 0; c < turns.size(); ++c) {
        if (is_singular[c / 3]) continue;
        left += links[c].weight * (turns[c] - explained[c]) * (turns[c] - explained[c]);
        all += links[c].weight * turns[c] * turns[c];
    }
    result.misfit = all > 0 ? std::sqrt(std::max(left, 0.0) / all) : 0;
    centre(domain, part, result.log_sizes);
    return result;
}

Eigen::VectorXd size_ratios(const SurfaceDomain& domain, const ReachedSizes& reached, const Eigen::VectorXd& wanted) {
    detail::require_lengths(wanted, domain.vertex_count(), "vertex");
    if (reached.log_sizes.size() != domain.vertex_count())
        throw InvalidInput("log_sizes must hold one number per vertex, " + std::to_string(domain.vertex_count()),
                           "wrong_size");
    Eigen::VectorXd logs = reached.log_sizes.array() - wanted.array().log();
    centre(domain, parts_of(domain), logs);
    return logs.array().exp();
}

}  // namespace octafield::surface
