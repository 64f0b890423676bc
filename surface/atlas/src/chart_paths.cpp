#include "chart_paths.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <numeric>
#include <queue>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double bend = 40 * std::numbers::pi / 180;  // along edges that bend so much, a cut costs twice its length
constexpr double along_boundary = 1e-6;               // cost of what is cut already, per cost
constexpr int roots_tried = 4;

}  // namespace

std::vector<Index> without_dead_ends(const SurfaceDomain& domain, std::vector<Index> edges) {
    const Edges& ends = domain.topology().edges;
    std::vector<std::vector<Index>> at(domain.vertex_count());
    for (std::size_t i = 0; i < edges.size(); ++i)
        for (int k = 0; k < 2; ++k) at[ends(edges[i], k)].push_back(static_cast<Index>(i));
    std::vector<int> degree(at.size());
    std::vector<Index> waiting;
    for (std::size_t v = 0; v < at.size(); ++v) {
        degree[v] = static_cast<int>(at[v].size());
        if (degree[v] == 1) waiting.push_back(static_cast<Index>(v));
    }
    std::vector<bool> gone(edges.size(), false);
    while (!waiting.empty()) {
        const Index v = waiting.back();
        waiting.pop_back();
        for (const Index i : at[v]) {
            if (gone[i]) continue;
            gone[i] = true;
            for (int k = 0; k < 2; ++k)
                if (const Index w = ends(edges[i], k); --degree[w] == 1) waiting.push_back(w);
        }
    }
    std::vector<Index> kept;
    for (std::size_t i = 0; i < edges.size(); ++i)
        if (!gone[i]) kept.push_back(edges[i]);
    return kept;
}

Eigen::VectorXd cut_costs(const SurfaceDomain& domain) {
    Eigen::VectorXd costs = domain.edge_lengths();
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const auto beside = domain.topology().edge_triangles.row(e);
        if (beside.minCoeff() < 0) continue;
        const Eigen::Vector3d a = domain.normals().row(beside[0]), b = domain.normals().row(beside[1]);
        costs[e] *= 1 + std::atan2(a.cross(b).norm(), a.dot(b)) / bend;
    }
    return costs;
}

ChartPaths::ChartPaths(const SurfaceDomain& domain, const ChartMesh& chart, const Eigen::VectorXd& costs)
    : domain_(domain), chart_(chart) {
    const Index count = 3 * chart.triangle_count();
    side_costs_.resize(count);
    first_.assign(chart.vertex_count() + 1, 0);
    mates_.assign(count, -1);
    for (Index s = 0; s < count; ++s) {
        const Index other = chart.neighbours(s / 3, s % 3);
        // Two triangles may share two edges, so look for the edge.
        for (int k = 0; other >= 0 && k < 3; ++k)
            if (edge(3 * other + k) == edge(s)) mates_[s] = 3 * other + k;
    }
    const auto for_each_start = [&](const auto& visit) {
        for (Index s = 0; s < count; ++s) {
            visit(start(s), s);
            if (mate(s) < 0) visit(end(s), s);
        }
    };
    for (Index s = 0; s < count; ++s) side_costs_[s] = costs[edge(s)] * (mate(s) < 0 ? along_boundary : 1);
    for_each_start([&](Index v, Index) { ++first_[v + 1]; });
    std::partial_sum(first_.begin(), first_.end(), first_.begin());
    sides_.resize(first_.back());
    std::vector<Index> next(first_.begin(), first_.end() - 1);
    for_each_start([&](Index v, Index s) { sides_[next[v]++] = s; });
}

Index ChartPaths::edge(Index side) const {
    return domain_.topology().triangle_edges(chart_.parents[side / 3], side % 3);
}

ChartPaths::Tree ChartPaths::tree(const std::vector<Index>& sources) const {
    Tree tree{std::vector<double>(chart_.vertex_count(), std::numeric_limits<double>::infinity()),
              std::vector<Index>(chart_.vertex_count(), -1)};
    using Entry = std::pair<double, Index>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
    for (const Index v : sources) {
        tree.distance[v] = 0;
        front.emplace(0, v);
    }
    while (!front.empty()) {
        const auto [distance, v] = front.top();
        front.pop();
        if (distance > tree.distance[v]) continue;
        for (Index i = first_[v]; i < first_[v + 1]; ++i) {
            const Index side = sides_[i], to = other_end(side, v);
            if (const double way = distance + side_costs_[side]; way < tree.distance[to]) {
                tree.distance[to] = way;
                tree.from[to] = side;
                front.emplace(way, to);
            }
        }
    }
    return tree;
}

std::vector<Index> ChartPaths::path(const Tree& tree, Index vertex) const {
    std::vector<Index> sides;
    while (tree.from[vertex] >= 0) {
        sides.push_back(tree.from[vertex]);
        vertex = other_end(tree.from[vertex], vertex);
    }
    return sides;
}

namespace {

Index farthest(const std::vector<double>& distance) {
    return static_cast<Index>(std::max_element(distance.begin(), distance.end()) - distance.begin());
}

std::vector<Index> edges_of(const ChartPaths& paths, const std::vector<Index>& sides) {
    std::vector<Index> edges;
    for (const Index s : sides)
        if (paths.mate(s) >= 0) edges.push_back(paths.edge(s));
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    return edges;
}

// Sides outside the tree that are no part of the longest tree of triangles and holes across the others either.
std::vector<Index> loop_closers(const ChartPaths& paths, const ChartMesh& chart, const ChartPaths::Tree& tree) {
    const Index count = 3 * chart.triangle_count();
    std::vector<Index> nodes(count);  // on the other side of each: a triangle, or a hole behind them
    for (Index s = 0; s < count; ++s) nodes[s] = paths.mate(s) / 3;
    std::vector<Index> loop_of(chart.vertex_count(), -1);
    for (std::size_t i = 0; i < chart.loops.size(); ++i)
        for (const Index v : chart.loops[i]) loop_of[v] = static_cast<Index>(i);
    std::vector<std::pair<double, Index>> ways;
    for (Index s = 0; s < count; ++s) {
        const Index mate = paths.mate(s), a = paths.start(s), b = paths.end(s);
        if (mate < 0) nodes[s] = chart.triangle_count() + loop_of[a];
        if (mate > s || mate < 0) {
            const bool in_tree =
                tree.from[a] == s || tree.from[b] == s || (mate >= 0 && (tree.from[a] == mate || tree.from[b] == mate));
            if (!in_tree) ways.emplace_back(-(tree.distance[a] + tree.distance[b] + paths.cost(s)), s);
        }
    }
    std::sort(ways.begin(), ways.end());
    DisjointSets sets(chart.triangle_count() + chart.loops.size());
    std::vector<Index> closers;
    for (const auto& [way, s] : ways) {
        if (sets.lowest(s / 3) == sets.lowest(nodes[s])) {
            closers.push_back(s);
        } else {
            sets.join(s / 3, nodes[s]);
        }
    }
    return closers;
}

std::vector<Index> handle_cuts(const SurfaceDomain& domain, const ChartPaths& paths, const ChartMesh& chart,
                               const Eigen::VectorXd& costs) {
    std::vector<Index> best;
    double least = std::numeric_limits<double>::infinity();
    std::vector<double> apart(chart.vertex_count(), std::numeric_limits<double>::infinity());
    std::vector<bool> can_be_root(chart.vertex_count(), chart.loops.empty());
    if (!chart.loops.empty())
        for (const Index v : chart.loops.front()) can_be_root[v] = true;
    for (int i = 0; i < roots_tried; ++i) {
        Index root = -1;  // the one farthest from those before, of those that can be
        for (Index v = 0; v < chart.vertex_count(); ++v)
            if (can_be_root[v] && (root < 0 || apart[v] > apart[root])) root = v;
        const ChartPaths::Tree tree = paths.tree({root});
        for (Index v = 0; v < chart.vertex_count(); ++v) apart[v] = std::min(apart[v], tree.distance[v]);
        std::vector<Index> sides;
        for (const Index s : loop_closers(paths, chart, tree)) {
            sides.push_back(s);
            for (const Index end : {paths.start(s), paths.end(s)})
                for (const Index step : paths.path(tree, end)) sides.push_back(step);
        }
        std::vector<Index> edges = edges_of(paths, sides);
        if (chart.loops.empty()) edges = without_dead_ends(domain, std::move(edges));
        double total = 0;
        for (const Index e : edges) total += costs[e];
        if (total < least) {
            least = total;
            best = std::move(edges);
        }
    }
    return best;
}

// The path between two vertices far apart, longer by an edge where it is only one.
std::vector<Index> slit(const ChartPaths& paths, const ChartMesh& chart) {
    Index first = farthest(paths.tree({0}).distance);
    const ChartPaths::Tree tree = paths.tree({first});
    const Index last = farthest(tree.distance);
    std::vector<Index> sides = paths.path(tree, last);
    for (Index t = 0; sides.size() < 2 && t < chart.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            if (chart.triangles(t, k) == last && chart.triangles(t, (k + 1) % 3) != first) {
                sides.push_back(3 * t + k);
                break;
            }
    return edges_of(paths, sides);
}

}  // namespace

std::vector<Index> opening_cuts(const SurfaceDomain& domain, const ChartPaths& paths, const ChartMesh& chart,
                                const Eigen::VectorXd& costs) {
    if (chart.genus() > 0) return handle_cuts(domain, paths, chart, costs);
    return chart.loops.empty() ? slit(paths, chart) : std::vector<Index>{};
}

namespace {

// Vertices where the map is least round them and below the bound, the least first. Holes come before what lies beside
// them: a cut that reaches them opens what is round them, too.
std::vector<Index> tips_of(const ChartPaths& paths, const ChartMesh& chart, Eigen::VectorXd scale, double bound) {
    for (std::size_t i = 1; i < chart.loops.size(); ++i)
        for (const Index v : chart.loops[i]) scale[v] /= 2;
    std::vector<bool> least(chart.vertex_count(), true);
    for (Index s = 0; s < 3 * chart.triangle_count(); ++s) {
        const Index a = paths.start(s), b = paths.end(s);
        least[std::pair(scale[a], a) < std::pair(scale[b], b) ? b : a] = false;
    }
    std::vector<Index> tips;
    for (Index v = 0; v < chart.vertex_count(); ++v)
        if (least[v] && scale[v] < bound) tips.push_back(v);
    std::stable_sort(tips.begin(), tips.end(), [&](Index a, Index b) { return scale[a] < scale[b]; });
    return tips;
}

}  // namespace

std::vector<Index> relieving_cuts(const ChartPaths& paths, const ChartMesh& chart, const Eigen::VectorXd& scale,
                                  double bound, int most) {
    const std::vector<Index> tips = tips_of(paths, chart, scale, bound);
    if (tips.empty()) return {};
    std::vector<Index> sources = chart.loops.front(), sides;
    ChartPaths::Tree tree = paths.tree(sources);
    const std::vector<double> outward = tree.distance;
    int made = 0;
    for (const Index tip : tips) {
        // What has come much nearer by an earlier cut may be well now.
        if (!(tree.distance[tip] > outward[tip] / 2)) continue;
        for (Index v = tip; const Index s : paths.path(tree, tip)) {
            sides.push_back(s);
            sources.push_back(v);
            v = paths.other_end(s, v);
        }
        if (++made == most) break;
        tree = paths.tree(sources);
    }
    return edges_of(paths, sides);
}

}  // namespace octafield::surface::detail
