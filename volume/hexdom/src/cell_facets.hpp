// Faces of a cell that is to be made of tets, and the tets within them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "cell_shapes.hpp"
#include "tet_topology.hpp"

namespace octafield::volume::detail {

// A face of a cell on triangles of the tet mesh. A quad may have two triangles on either diagonal, on both where a flat
// tet lies against it.
struct CellFacet {
    int corners;
    std::array<Index, 4> round;  // outward
    // pairs[k]: triangles (k, k+1, k+2) and (k, k+2, k+3) of `round`, mod 4; -1 both where one is not there. Of a
    // triangle pairs[0][0].
    std::array<std::array<Index, 2>, 2> pairs;
    int inner = 0;  // the pair the tets within end at

    // The corners of half h of pair k, outward.
    std::array<Index, 3> half(int k, int h) const { return {round[k], round[k + 1 + h], round[(k + 2 + h) % 4]}; }
};

using CellFacets = std::array<CellFacet, 6>;  // the first of shape.faces.size()

// Nothing where the tet mesh has no triangles for a face.
std::optional<CellFacet> quad_facet(const TetTopology& topology, const std::array<Index, 4>& round);
std::optional<CellFacets> cell_facets(const TetTopology& topology, const CellShape& shape, const Index* ids);

constexpr int most_inner_tets = 32;

struct InnerTets {
    std::array<Index, most_inner_tets> tets;
    int count = 0;
};

// The tets on the cell's vertices that its faces enclose, no flat one on the four vertices of a quad among them; sets
// `inner`. False where there are others within, or more, or one for which taken[tet] (empty: none is) is not 0, or
// between two a triangle for which walls (the same) is not 0.
bool find_inner_tets(const TetTopology& topology, const Tets& tets, const CellShape& shape, const Index* ids,
                     const std::vector<std::uint8_t>& taken, const std::vector<std::uint8_t>& walls, CellFacets& facets,
                     InnerTets& found);

// The tet against the cell's inner pair from outside whose vertices are the quad's, -1: none.
Index flat_tet_outside(const TetTopology& topology, const CellFacet& facet);

}  // namespace octafield::volume::detail
