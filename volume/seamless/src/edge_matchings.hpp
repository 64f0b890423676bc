// Matchings along the edges of a mesh, and singular curves made shorter by changing them.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume::detail {

class EdgeMatchings {
public:
    // The nearest ones of frames at the vertices.
    EdgeMatchings(const TetDomain& domain, const Quaternions& frames);

    // q_from o is close to q_to, for the element o of the octahedral group; of an edge or a vertex with itself.
    int operator()(Index from, Index to) const;

    // What goes from one end of an edge to the other becomes element (*this)(from, to).
    void turn(Index from, Index to, int element);

    const std::vector<Index>& triangles_at(Index a, Index b) const;  // rows of the table

    // What is left round the triangle of the table: 0 where it is not singular.
    int holonomy(Index row) const { return holonomy(row, -1, 0); }

    // Edges inside the mesh get other elements where that makes triangles singular that are fewer, or of simpler turns,
    // than those that become regular: curves that go round more than half of an edge go round its other side, small
    // loops vanish. Until none does; each step lowers a sum of whole numbers. Returns the number of steps.
    int shorten_curves();

private:
    Index row_of(Index a, Index b) const;  // of the edge, a < b
    int holonomy(Index row, Index edge, int instead) const;
    int cost_round(Index edge, int element) const;

    const TetDomain& domain_;
    std::vector<Index> begin_, higher_;  // edges by their lower vertex
    std::vector<std::uint8_t> element_;  // from the lower vertex to the higher
    Rows<Index, 3> edges_of_;            // per triangle a < b < c: ab, bc, ac
    std::vector<std::vector<Index>> triangles_of_;
};

}  // namespace octafield::volume::detail
