// Quads of a layout, patch by patch.
#pragma once

#include <array>

#include "octafield/surface/layout_quads.hpp"
#include "side_grids.hpp"

namespace octafield::surface::detail {

// Throws GeometryError (kind "no_quad_layout").
void require_quads(const QuadLayout& layout);
// Throws SolverError (kind "inverted_quads"); sets least_scaled_jacobian.
void require_convex(LayoutQuads& quads);

// Vertices: those of the grids, then those inside each patch.
class QuadBuilder {
public:
    // Equal numbers of quads on opposite sides of patches, which are to be quads.
    QuadBuilder(const QuadLayout& layout, SideGrids grids);
    void add_patch(Index patch);
    void add_grid(Index patch);  // its quads alone: vertices inside it are at 0
    // Vertices that are to be one: across patches without quads, and those of the grids.
    const std::vector<std::pair<Index, Index>>& same() const { return grids_.same; }
    const std::vector<std::pair<Index, int>>& held() const { return grids_.held; }
    // Without chord_counts. Throws SolverError (kind "folded_map").
    LayoutQuads result() &&;

private:
    std::vector<Index> along(const LayoutPatch& patch, int k) const;  // vertices of its side k

    const QuadLayout& layout_;
    SideGrids grids_;
    LayoutQuads result_;
    std::vector<Eigen::Vector3d> positions_;
    std::vector<std::array<Index, 4>> quads_;
    std::vector<std::array<Index, 2>> sizes_;
    std::vector<Index> folded_;
};

}  // namespace octafield::surface::detail
