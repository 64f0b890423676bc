// Vertices of quads that become one.
#pragma once

#include "octafield/surface/quad_mesh.hpp"
#include "side_grids.hpp"

namespace octafield::surface::detail {

// At a node, at a held vertex, or at the mean of their places; on the seam, if any is on one. `held`: with their
// valences.
void merge_vertices(const Seams& seams, const std::vector<std::pair<Index, Index>>& same,
                    const std::vector<std::pair<Index, int>>& held, QuadMesh& mesh,
                    std::vector<SideGrids::OnSeam>& on_seams);

// Whether then no edge has more than two quads, held vertices their valences, and all others but the first, which are
// nodes, four quads (two on the boundary).
bool is_as_expected(const Quads& quads, const std::vector<std::pair<Index, Index>>& same,
                    const std::vector<std::pair<Index, int>>& held, Index nodes, Index vertex_count);

}  // namespace octafield::surface::detail
