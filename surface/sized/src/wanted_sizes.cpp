#include "octafield/surface/wanted_sizes.hpp"

#include <cmath>
#include <string>

#include "octafield/error.hpp"
#include "size_checks.hpp"

namespace octafield::surface {

namespace detail {

void require_in_space(const SurfaceDomain& domain) {
    if (domain.has_own_lengths())
        throw InvalidInput("sizes are lengths on the surface in space, without edge lengths of its own", "own_lengths");
}

void require_lengths(const Eigen::VectorXd& lengths, Eigen::Index count, const char* what) {
    if (lengths.size() != count)
        throw InvalidInput("sizes must hold one length above 0 per " + std::string(what) + ", " +
                               std::to_string(count) + "; they have " + std::to_string(lengths.size()) + " entries",
                           "wrong_size");
    std::vector<Index> bad;
    for (Index i = 0; i < lengths.size(); ++i)
        if (!(lengths[i] > 0 && std::isfinite(lengths[i]))) bad.push_back(i);
    if (!bad.empty())
        throw InvalidInput("sizes must be lengths above 0; they are not at " + std::to_string(bad.size()) + " " +
                               (std::string(what) == "edge" ? "edges" : "vertices") + " (" + first_few(bad) + ")",
                           "bad_size", bad);
}

}  // namespace detail

namespace {

// With U linear in the triangle, the integral over its side k of the derivative towards the inside.
double inward_flux(const SurfaceDomain& domain, Index t, int k, const Eigen::VectorXd& u) {
    const auto corners = domain.mesh().triangles.row(t);
    const int end = (k + 1) % 3, top = (k + 2) % 3;
    return domain.cotangents()(t, end) * (u[corners[top]] - u[corners[k]]) +
           domain.cotangents()(t, k) * (u[corners[top]] - u[corners[end]]);
}

// What `bubbles`, (E) U at midpoints of edges beyond linear, add to that.
double flux_of_bubbles(const SurfaceDomain& domain, Index t, int k, const Eigen::VectorXd& bubbles) {
    const auto bubble = [&](int side) { return bubbles[domain.topology().triangle_edges(t, side % 3)]; };
    return 2 * (domain.cotangents()(t, k) + domain.cotangents()(t, (k + 1) % 3)) *
           (bubble(k + 1) + bubble(k + 2) - bubble(k));
}

// A direction turns by minus the derivative to its left.
WantedSizes turned(const SurfaceDomain& domain, const Eigen::VectorXd& lengths, const Eigen::VectorXd& bubbles) {
    const Eigen::VectorXd u = lengths.array().log();
    WantedSizes result{lengths, Eigen::VectorXd::Zero(domain.edge_count())};
    const EdgeTopology& topology = domain.topology();
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index e = topology.triangle_edges(t, k);
            const double parts = topology.edge_triangles.row(e).minCoeff() < 0 ? 1 : 2;
            const double sign = topology.edge_triangles(e, 0) == t ? 1 : -1;
            double flux = inward_flux(domain, t, k, u);
            if (bubbles.size() > 0) flux += flux_of_bubbles(domain, t, k, bubbles);
            result.turns[e] -= sign * flux / parts;
        }
    return result;
}

}  // namespace

WantedSizes wanted_sizes(const SurfaceDomain& domain, const Eigen::VectorXd& lengths) {
    detail::require_in_space(domain);
    detail::require_lengths(lengths, domain.vertex_count(), "vertex");
    return turned(domain, lengths, {});
}

WantedSizes wanted_sizes(const SurfaceDomain& domain, const Eigen::VectorXd& lengths, const Eigen::VectorXd& middles) {
    detail::require_in_space(domain);
    detail::require_lengths(lengths, domain.vertex_count(), "vertex");
    detail::require_lengths(middles, domain.edge_count(), "edge");
    Eigen::VectorXd bubbles(domain.edge_count());
    const Edges& edges = domain.topology().edges;
    for (Index e = 0; e < bubbles.size(); ++e)
        bubbles[e] = std::log(middles[e]) - (std::log(lengths[edges(e, 0)]) + std::log(lengths[edges(e, 1)])) / 2;
    return turned(domain, lengths, bubbles);
}

Points edge_midpoints(const SurfaceDomain& domain) {
    const Edges& edges = domain.topology().edges;
    Points middles(edges.rows(), 3);
    for (Index e = 0; e < middles.rows(); ++e)
        middles.row(e) = (domain.mesh().vertices.row(edges(e, 0)) + domain.mesh().vertices.row(edges(e, 1))) / 2;
    return middles;
}

SurfaceDomain sized_domain(const SurfaceDomain& domain, const Eigen::VectorXd& lengths) {
    detail::require_in_space(domain);
    detail::require_lengths(lengths, domain.vertex_count(), "vertex");
    const Edges& edges = domain.topology().edges;
    const Eigen::VectorXd roots = (lengths / lengths.maxCoeff()).cwiseSqrt();
    Eigen::VectorXd measured(edges.rows());
    for (Index e = 0; e < measured.size(); ++e)
        measured[e] = domain.edge_lengths()[e] / (roots[edges(e, 0)] * roots[edges(e, 1)]);
    const double grown = domain.with_edge_lengths(measured).areas().sum() / domain.areas().sum();
    return domain.with_edge_lengths(measured / std::sqrt(grown));
}

}  // namespace octafield::surface
