#include "chart_mesh.hpp"

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

void find_neighbours(const SurfaceDomain& domain, const std::function<bool(Index)>& is_cut, ChartMesh& chart) {
    const EdgeTopology& topology = domain.topology();
    const auto place_of = [&](Index t) -> Index {
        const auto found = std::lower_bound(chart.parents.begin(), chart.parents.end(), t);
        return found != chart.parents.end() && *found == t ? static_cast<Index>(found - chart.parents.begin()) : -1;
    };
    chart.neighbours = Triangles::Constant(static_cast<Eigen::Index>(chart.parents.size()), 3, -1);
    for (std::size_t i = 0; i < chart.parents.size(); ++i)
        for (int k = 0; k < 3; ++k) {
            const Index edge = topology.triangle_edges(chart.parents[i], k);
            const auto beside = topology.edge_triangles.row(edge);
            const Index other = beside[0] == chart.parents[i] ? beside[1] : beside[0];
            if (other >= 0 && !is_cut(edge)) chart.neighbours(static_cast<Index>(i), k) = place_of(other);
        }
}

// The corner of `t` at the given vertex of the surface.
int corner_at(const Triangles& triangles, Index t, Index vertex) {
    int k = 0;
    while (triangles(t, k) != vertex) ++k;
    return k;
}

void join_corners(const SurfaceDomain& domain, ChartMesh& chart) {
    const Triangles& whole = domain.mesh().triangles;
    const Index count = static_cast<Index>(chart.parents.size());
    DisjointSets corners(3 * static_cast<std::size_t>(count)), pieces(count);
    for (Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            const Index other = chart.neighbours(i, k);
            if (other < i) continue;
            pieces.join(i, other);
            for (const int end : {k, (k + 1) % 3})
                corners.join(3 * i + end,
                             3 * other + corner_at(whole, chart.parents[other], whole(chart.parents[i], end)));
        }
    Index vertices = 0, components = 0;
    const std::vector<Index> vertex_of = std::move(corners).numbers(vertices);
    std::move(pieces).numbers(components);
    chart.components = components;
    chart.origins.resize(vertices);
    chart.triangles.resize(count, 3);
    for (Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            chart.triangles(i, k) = vertex_of[3 * i + k];
            chart.origins[vertex_of[3 * i + k]] = whole(chart.parents[i], k);
        }
}

// Every boundary vertex is that of one sector, so one side of the boundary starts there.
void find_loops(ChartMesh& chart) {
    std::vector<Index> next(chart.vertex_count(), -1);
    std::vector<double> length(chart.vertex_count(), 0);
    for (Index t = 0; t < chart.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            if (chart.neighbours(t, k) < 0) {
                next[chart.triangles(t, k)] = chart.triangles(t, (k + 1) % 3);
                length[chart.triangles(t, k)] = chart.lengths(t, k);
            }
    std::vector<std::pair<double, std::vector<Index>>> found;
    std::vector<bool> done(chart.vertex_count(), false);
    for (Index v = 0; v < chart.vertex_count(); ++v) {
        if (next[v] < 0 || done[v]) continue;
        auto& [total, loop] = found.emplace_back();
        for (Index at = v; !done[at]; at = next[at]) {
            done[at] = true;
            total += length[at];
            loop.push_back(at);
        }
    }
    std::stable_sort(found.begin(), found.end(), [](const auto& a, const auto& b) { return a.first > b.first; });
    for (auto& [total, loop] : found) chart.loops.push_back(std::move(loop));
}

}  // namespace

int ChartMesh::genus() const {
    Index sides = 0;  // on the boundary
    for (const auto& loop : loops) sides += static_cast<Index>(loop.size());
    const Index edges = (3 * triangle_count() + sides) / 2;
    const Index euler = vertex_count() - edges + triangle_count();
    return static_cast<int>((2 * components - static_cast<Index>(loops.size()) - euler) / 2);
}

double ChartMesh::twice_area(Index t) const {
    const double h = half_tangents(t, 0);
    return lengths(t, 0) * lengths(t, 2) * 2 * h / (1 + h * h);
}

double ChartMesh::area() const {
    double sum = 0;
    for (Index t = 0; t < triangle_count(); ++t) sum += twice_area(t) / 2;
    return sum;
}

ChartMesh chart_mesh(const SurfaceDomain& domain, const std::vector<Index>& parents,
                     const std::function<bool(Index)>& is_cut) {
    ChartMesh chart;
    chart.parents = parents;
    const auto count = static_cast<Eigen::Index>(parents.size());
    find_neighbours(domain, is_cut, chart);
    join_corners(domain, chart);
    chart.lengths.resize(count, 3);
    chart.half_tangents.resize(count, 3);
    for (Eigen::Index i = 0; i < count; ++i)
        for (int k = 0; k < 3; ++k) {
            chart.lengths(i, k) = domain.edge_lengths()[domain.topology().triangle_edges(parents[i], k)];
            chart.half_tangents(i, k) = std::tan(domain.corner_angles()(parents[i], k) / 2);
        }
    find_loops(chart);
    return chart;
}

}  // namespace octafield::surface::detail
