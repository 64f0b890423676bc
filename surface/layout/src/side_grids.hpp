// The vertices of quads on the sides of a layout.
#pragma once

#include "seams.hpp"

namespace octafield::surface::detail {

struct SideGrids {
    std::vector<Eigen::Vector3d> positions;
    std::vector<std::vector<Index>> vertices;  // along each side of the layout, both ends; its first if without quads
    struct OnSeam {
        Index seam;         // -1: a node
        double at;          // length along it
        bool held = false;  // stays there, though it is no node
    };
    std::vector<OnSeam> on_seams;               // of the first vertices; the others are inside the surface
    std::vector<Eigen::VectorXd> along;         // of each point of a side: its place, counted in quads; increasing
    std::vector<std::pair<Index, Index>> same;  // vertices that are to be one: ends of sides without quads
    std::vector<std::pair<Index, int>> held;    // vertices at singular points inside the surface, with their valences
};

// In equal steps of parameters. Vertices: of the layout, then those inside each side.
SideGrids side_grids(const QuadLayout& layout, const std::vector<int>& counts);

// The same, but both sides of a seam have the same vertices: nodes first, then those of each seam, then those of the
// layout inside the surface. part_counts: quads along each part of a seam, 0 where places of the two sides become one.
SideGrids seamed_grids(const QuadLayout& layout, const Seams& seams, const std::vector<int>& counts,
                       const std::vector<int>& part_counts);

}  // namespace octafield::surface::detail
