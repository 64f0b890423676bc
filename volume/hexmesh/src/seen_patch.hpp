// A rectangle between blocks, as the block on one side of it has it.
#pragma once

#include <array>
#include <vector>

#include "block_arcs.hpp"

namespace octafield::volume::detail {

// The arcs of a side with the block's vertices between them.
struct SeenSide {
    std::vector<SideArc> arcs;
    std::vector<Index> ends;  // block vertices: before the first arc, between arcs, after the last one
};

// Four sides in the two parameters across the axis of the block's side, as BlockPatch has them.
class SeenPatch {
public:
    // Throws GeometryError (kind "not_a_box") where the walls fill no rectangle.
    SeenPatch(const TriangleTable& table, const BlockCharts& charts, const WallEdges& edges,
              const WallEdges::Chains& chains, const std::vector<WallSide>& walls);

    Index block() const { return block_; }
    int box_side() const { return box_side_; }
    const Eigen::Vector2d& low() const { return low_; }
    const Eigen::Vector2d& high() const { return high_; }
    const SeenSide& side(int s) const { return sides_[s]; }

    Eigen::Vector2d place(Index block_vertex) const {
        const Eigen::Vector3d& at = charts_.places[block_vertex];
        return {at[axes_[0]], at[axes_[1]]};
    }
    // Block vertex at the corner nearest to a place.
    Index corner_at(const Eigen::Vector2d& place) const {
        const Eigen::Vector2d middle = (low_ + high_) / 2;
        const SeenSide& side = sides_[place[1] > middle[1] ? 1 : 0];
        return place[0] > middle[0] ? side.ends.back() : side.ends.front();
    }

private:
    struct SideEdge {
        double start;  // lower parameter along the side
        Index from, to;
        Index block_from, block_to;
    };

    double tolerance() const;
    int side_of(const Eigen::Vector2d& a, const Eigen::Vector2d& b) const;
    SideEdge seen(WallSide wall, const EdgeKey& edge, int side) const;
    SeenSide joined(std::vector<SideEdge>& edges, int s) const;

    const BlockCharts& charts_;
    const WallEdges& edges_;
    const WallEdges::Chains& chains_;
    Index block_ = 0;
    int box_side_ = 0;
    std::array<int, 2> axes_{};
    Eigen::Vector2d low_, high_;
    std::array<SeenSide, 4> sides_;
};

}  // namespace octafield::volume::detail
