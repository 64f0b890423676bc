#include "seen_patch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double near = 1e-6;  // of the longer side of a rectangle

[[noreturn]] void no_rectangle(Index block) {
    throw GeometryError("a part of the walls of block " + std::to_string(block) +
                            " is no rectangle: walls are missing, or end inside it",
                        "not_a_box", {block});
}

}  // namespace

SeenPatch::SeenPatch(const TriangleTable& table, const BlockCharts& charts, const WallEdges& edges,
                     const WallEdges::Chains& chains, const std::vector<WallSide>& walls)
    : charts_(charts), edges_(edges), chains_(chains) {
    const WallSide first = walls[0];
    block_ = charts.tet_block[table.sides(first.triangle, first.side) / 4];
    box_side_ = charts.wall_sides[first.triangle][first.side];
    const int axis = box_side_ / 2;
    axes_ = {(axis + 1) % 3, (axis + 2) % 3};
    low_.setConstant(std::numeric_limits<double>::infinity());
    high_ = -low_;
    for (const WallSide wall : walls)
        for (int k = 0; k < 3; ++k) {
            const Eigen::Vector2d at = place(edges.block_vertex(wall, table.triangles(wall.triangle, k)));
            low_ = low_.cwiseMin(at);
            high_ = high_.cwiseMax(at);
        }
    std::array<std::vector<SideEdge>, 4> found;
    for (const WallSide wall : walls)
        for (int k = 0; k < 3; ++k) {
            const EdgeKey edge =
                edge_key(table.triangles(wall.triangle, k), table.triangles(wall.triangle, (k + 1) % 3));
            if (!edges.on_arc(edge)) continue;
            const int s = side_of(place(edges.block_vertex(wall, edge[0])), place(edges.block_vertex(wall, edge[1])));
            found[s].push_back(seen(wall, edge, s));
        }
    for (int s = 0; s < 4; ++s) sides_[s] = joined(found[s], s);
}

double SeenPatch::tolerance() const { return near * (high_ - low_).maxCoeff(); }

int SeenPatch::side_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const {
    for (int s = 0; s < 4; ++s) {
        const int across = 1 - s / 2;
        const double at = s % 2 ? high_[across] : low_[across];
        if (std::abs(a[across] - at) < tolerance() && std::abs(b[across] - at) < tolerance()) return s;
    }
    no_rectangle(block_);
}

SeenPatch::SideEdge SeenPatch::seen(WallSide wall, const EdgeKey& edge, int side) const {
    Index from = edge[0], to = edge[1];
    Index block_from = edges_.block_vertex(wall, from), block_to = edges_.block_vertex(wall, to);
    double start = place(block_from)[side / 2], end = place(block_to)[side / 2];
    if (start > end) {
        std::swap(from, to);
        std::swap(block_from, block_to);
        std::swap(start, end);
    }
    return {start, from, to, block_from, block_to};
}

SeenSide SeenPatch::joined(std::vector<SideEdge>& edges, int s) const {
    std::sort(edges.begin(), edges.end(), [](const auto& a, const auto& b) { return a.start < b.start; });
    if (edges.empty()) no_rectangle(block_);
    SeenSide side;
    side.ends.push_back(edges[0].block_from);
    for (std::size_t i = 0; i < edges.size(); ++i) {
        if (i > 0 && edges[i].block_from != edges[i - 1].block_to) no_rectangle(block_);
        const auto [arc, position] = chains_.place.at(edge_key(edges[i].from, edges[i].to));
        const auto& chain = chains_.arcs[arc];
        const bool along = chain[position] == edges[i].from;
        const Index last = static_cast<Index>(chain.size()) - 2;
        if (position == (along ? 0 : last)) side.arcs.push_back({arc, along});
        if (side.arcs.empty() || side.arcs.back().arc != arc) no_rectangle(block_);
        if (position == (along ? last : 0)) side.ends.push_back(edges[i].block_to);
    }
    const int along = s / 2;
    if (side.ends.size() != side.arcs.size() + 1 ||
        std::abs(place(side.ends.front())[along] - low_[along]) > tolerance() ||
        std::abs(place(side.ends.back())[along] - high_[along]) > tolerance())
        no_rectangle(block_);
    return side;
}

}  // namespace octafield::volume::detail
