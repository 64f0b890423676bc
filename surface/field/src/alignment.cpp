#include "alignment.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

bool on_boundary(const EdgeTopology& topology, Index e) { return topology.edge_triangles.row(e).minCoeff() < 0; }

// How each edge is to be followed as part of the boundary or of a feature.
std::vector<Alignment> wanted(const SurfaceDomain& domain, const DirectionFieldOptions& options) {
    const EdgeTopology& topology = domain.topology();
    const Points& normals = domain.normals();
    std::vector<Alignment> result(topology.edges.rows(), Alignment::none);
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        if (!domain.is_feature()[e] || on_boundary(topology, e) || options.feature_alignment == Alignment::none)
            continue;
        const Eigen::Vector3d left = normals.row(topology.edge_triangles(e, 0)),
                              right = normals.row(topology.edge_triangles(e, 1));
        if (std::atan2(left.cross(right).norm(), left.dot(right)) < options.least_feature_angle) continue;
        const Index low = topology.edges(e, 0), high = topology.edges(e, 1);
        if (options.symmetry % 2 == 1)
            throw InvalidInput("edge " + std::to_string(low) + "-" + std::to_string(high) +
                                   " is a feature inside the surface: it has no sense to run in, so the symmetry must "
                                   "be even, or alignment with features none",
                               "odd_symmetry", {low, high});
        result[e] = options.feature_alignment;
    }
    for (Index e = 0; e < topology.edges.rows(); ++e)
        if (on_boundary(topology, e)) result[e] = options.boundary_alignment;
    return result;
}

}  // namespace

Index find_edge(const EdgeTopology& topology, Index a, Index b) {
    const auto [low, high] = std::minmax(a, b);
    Index first = 0, last = static_cast<Index>(topology.edges.rows());
    while (first < last) {
        const Index middle = first + (last - first) / 2;
        const bool below = std::pair(topology.edges(middle, 0), topology.edges(middle, 1)) < std::pair(low, high);
        (below ? first : last) = below ? middle + 1 : middle;
    }
    const bool found =
        first < topology.edges.rows() && topology.edges(first, 0) == low && topology.edges(first, 1) == high;
    return found ? first : -1;
}

std::vector<bool> contradicting_edges(const SurfaceDomain& domain, const std::vector<CornerLink>& links, int symmetry,
                                      const std::vector<bool>& follows, const Eigen::VectorXcd& values,
                                      double tolerance) {
    std::vector<bool> result(follows.size(), false);
    const VertexFans& fans = domain.fans();
    for (const auto& fan : fans.fans) {
        const Index count = fan.last - fan.first;
        const auto corner = [&](Index i) -> const CornerLink& { return links[fans.corners[fan.first + i % count]]; };
        Index start = 0;  // a corner whose first edge is followed
        while (start < count && !follows[corner(start).first]) ++start;
        if (start == count) continue;
        // Along the sector from `side`: the first side's value, from the direction of the edge reached.
        const Index end = fan.closed ? start + count : count;
        Index side = corner(start).first;
        Complex carried = corner(start).first_sign * values[side];
        for (Index i = start; i < end; ++i) {
            const CornerLink& link = corner(i);
            carried *= std::polar(1.0, -symmetry * link.angle);
            if (!follows[link.second]) continue;
            const double sign = (link.second_turn * std::polar(1.0, -symmetry * link.angle)).real();
            const Complex here = std::round(sign) * values[link.second];
            const bool alone = link.second == side && i + 1 == end;
            if (!alone && std::abs(std::arg(carried * std::conj(here))) > tolerance * std::numbers::pi)
                result[side] = result[link.second] = true;
            side = link.second;
            carried = here;
        }
    }
    return result;
}

AlignedEdges aligned_edges(const SurfaceDomain& domain, const std::vector<CornerLink>& links,
                           const DirectionFieldOptions& options) {
    const EdgeTopology& topology = domain.topology();
    const Eigen::Index edges = topology.edges.rows();
    const std::vector<Alignment> how = wanted(domain, options);
    std::vector<bool> follows(edges);
    Eigen::VectorXcd values = Eigen::VectorXcd::Zero(edges);
    for (Eigen::Index e = 0; e < edges; ++e) {
        follows[e] = how[e] != Alignment::none;
        // With odd N an edge's two senses differ: the boundary is run with the surface on its left.
        if (follows[e]) values[e] = options.symmetry % 2 == 1 && topology.edge_triangles(e, 0) < 0 ? -1 : 1;
    }
    AlignedEdges result{std::vector<bool>(edges, false), Eigen::VectorXcd::Zero(edges), {}, Pull(edges)};
    add_constraints(domain, links, options.symmetry, options.constraints, follows, result);
    const std::vector<bool> contradicting =
        contradicting_edges(domain, links, options.symmetry, follows, values, options.corner_tolerance);
    for (Index e = 0; e < edges; ++e) {
        // An edge with a constraint of its own, hard or weighted, follows that alone.
        if (!follows[e] || result.is_held[e] || result.pull.weights[e] > 0) continue;
        if (how[e] == Alignment::strong && !contradicting[e]) {
            result.is_held[e] = true;
            result.held[e] = values[e];
        } else {
            result.weak.push_back({e, domain.edge_lengths()[e], values[e]});
        }
    }
    add_guide(domain, options.symmetry, options.guide, result);
    return result;
}

void add_weak_edges(AlignedEdges& edges, double alignment_length, const Eigen::VectorXd& epsilon) {
    for (const WeakEdge& weak : edges.weak) {
        const double eps = epsilon[weak.edge], length = alignment_length > 0 ? alignment_length : eps;
        edges.pull.add(weak.edge, length * weak.length / eps / eps, weak.value);
    }
}

}  // namespace octafield::surface::detail
