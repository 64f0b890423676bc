// Neighbours of vertices, triangles round edges and tets at triangles of a tet mesh, in arrays: for searches.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::volume::detail {

struct TetTopology {
    // Vertex v: entries [start[v], start[v + 1]) of neighbours, ascending, and of the edges to them.
    std::vector<Index> neighbour_start, neighbours, neighbour_edges;
    // Edge e: entries [link_start[e], link_start[e + 1]): the third vertices of its triangles, ascending, and those.
    std::vector<Index> link_start, link_vertices, link_triangles;
    // Of a triangle: the tet that has it outward with its vertices ascending (up to a rotation), then the other; -1:
    // none.
    std::vector<std::array<Index, 2>> triangle_tets;
    std::vector<std::array<Index, 4>> tet_triangles;  // in no order that means anything

    explicit TetTopology(const Tets& tets, Index vertex_count);

    std::span<const Index> around(Index vertex) const {
        return {neighbours.data() + neighbour_start[vertex], neighbours.data() + neighbour_start[vertex + 1]};
    }
    std::span<const Index> link(Index edge) const {
        return {link_vertices.data() + link_start[edge], link_vertices.data() + link_start[edge + 1]};
    }
    Index edge(Index a, Index b) const;                // -1: none
    Index triangle_at(Index edge, Index third) const;  // -1: none, also of edge -1
    Index triangle(Index a, Index b, Index c) const { return triangle_at(edge(a, b), c); }
    // Of triangles given by their vertices, (triangles) 1: those that are there; empty where none are given.
    std::vector<std::uint8_t> marked(const Triangles& given) const;
    Index edge_count() const { return static_cast<Index>(link_start.size()) - 1; }
    Index triangle_count() const { return static_cast<Index>(triangle_tets.size()); }

    // The tet for which a, b, c, the vertices of the triangle, go round outward; -1: none.
    Index tet_inside(Index triangle, Index a, Index b, Index c) const {
        return triangle_tets[triangle][(a < b) + (b < c) + (c < a) == 2 ? 0 : 1];
    }
    Index tet_outside(Index triangle, Index a, Index b, Index c) const { return tet_inside(triangle, a, c, b); }
};

}  // namespace octafield::volume::detail
