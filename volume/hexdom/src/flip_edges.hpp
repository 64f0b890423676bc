// Edges of a surface flipped: for better angles, and for edges that are wanted.
#pragma once

#include <utility>
#include <vector>

#include "thin_complex.hpp"

namespace octafield::volume::detail {

// Edges wanted between points: once there, they are not flipped away.
class WantedEdges {
public:
    WantedEdges(const Quads& quads, Index points);
    bool has(Index a, Index b) const;
    const std::vector<std::pair<Index, Index>>& all() const { return edges_; }  // lower first, in lexicographic order

private:
    std::vector<std::pair<Index, Index>> edges_;
    std::vector<Index> first_;  // (points + 1) of the edges of each lower vertex
};

// Flips while the least angle of two triangles grows by it (Lawson 1977) or a wanted edge comes of it; not edges of
// curves, nor wanted ones. No new edge is longer than the bound and all edges of the two triangles. Says how many.
Index flip_edges(TriangleComplex& complex, const WantedEdges& wanted, const LengthBound& bound);

// Flips all edges that cross the way from a to b (Sloan 1993), seen along the normal there. False, and few edges
// changed, where curves, other wanted edges or vertices are in the way or triangles would turn by 60 degrees and more.
bool recover_edge(TriangleComplex& complex, const WantedEdges& wanted, Index a, Index b);

}  // namespace octafield::volume::detail
