// Points of the grids of arcs, patches and blocks, each made once.
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "block_grids.hpp"
#include "octafield/volume/all_hex.hpp"

namespace octafield::volume::detail {

// What keeps a point in its place where several become one: the support first, then what it is a point of.
enum class PointOf : std::uint8_t { block, patch, arc, node };

class GridPoints {
public:
    Index add(const Eigen::Vector3d& at, std::uint8_t support, PointOf what) {
        points_.push_back({at, support, what});
        return static_cast<Index>(points_.size()) - 1;
    }
    // Two are one vertex, as an arc between them has no edge.
    void join(Index a, Index b) {
        if (a != b) same_.emplace_back(a, b);
    }
    // Hexahedra of points to hexahedra of vertices, those that any has. Throws GeometryError ("collapsed_cell").
    BlockHexahedra mesh(const std::vector<std::array<Index, 8>>& hexahedra, std::vector<Index> blocks) const;

private:
    struct Point {
        Eigen::Vector3d at;
        std::uint8_t support;
        PointOf what;
        bool before(const Point& o) const { return support != o.support ? support > o.support : what > o.what; }
    };
    std::vector<Point> points_;
    std::vector<std::pair<Index, Index>> same_;
};

// A patch divided by its arcs' numbers: (i, j) at row i * (size[1] + 1) + j.
struct PatchGrid {
    std::array<int, 2> size;
    std::vector<Index> points;
    std::vector<Eigen::Vector2d> places;  // in the patch's parameters
    std::size_t at(int i, int j) const { return static_cast<std::size_t>(i) * (size[1] + 1) + j; }
};

// Points of nodes and arcs, then of one patch after another.
class PatchGrids {
public:
    PatchGrids(const SeamlessMap& map, const BlockComplex& blocks, const std::vector<int>& numbers, GridPoints& points);
    PatchGrid grid(const BlockPatch& patch);

private:
    // The points of a side with their parameter along it, from `low` to `high`.
    struct Line {
        std::vector<Index> points;
        std::vector<double> places;
    };
    void add_nodes();
    void add_arcs();
    Line line(const std::vector<SideArc>& side, double low, double high);
    void place_inside(const BlockPatch& patch, PatchGrid& grid);

    const SeamlessMap& map_;
    const BlockComplex& blocks_;
    const std::vector<int>& numbers_;
    GridPoints& points_;
    std::vector<std::vector<Index>> arc_points_;
};

}  // namespace octafield::volume::detail
