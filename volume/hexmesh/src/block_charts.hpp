// Tets between walls share a chart: their parameters after transitions.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "octafield/volume/block_complex.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {

struct BlockCharts {
    std::vector<Index> tet_block;
    Rows<double, 12> charts;
    Rows<double, 3> low, high;
    Tets block_vertices;
    std::vector<Eigen::Vector3d> places;  // of the block vertices, in their block's chart
    // Per row of the triangle table and side of it: 2 axis + end of the block's box; -1: no wall.
    std::vector<std::array<std::int8_t, 2>> wall_sides;
    std::vector<Index> wall_rows;  // rows of the triangle table that are walls, ascending
};

// Throws InvalidInput ("index_out_of_range": walls), GeometryError: "bent_wall" (tets), "not_a_box"
// (blocks that go round a singular curve).
BlockCharts block_charts(const SeamlessMap& map, const TriangleTable& table);

}  // namespace octafield::volume::detail
