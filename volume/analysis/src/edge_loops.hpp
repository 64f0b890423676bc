// Matchings of frames in the tets across triangles, and what a frame carried round an edge comes back as.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octafield/arrays.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {

// Per triangle of the table: the matching from the tet on its first side to the one on its second, so that all who use
// it agree, also in a tie; 0 on the boundary. of_tets: unit quaternions.
std::vector<std::uint8_t> triangle_matchings(const TriangleTable& table, const Quaternions& of_tets, int threads);

// The same lifted to the binary octahedral group (frames/octahedral_lift.hpp), and the triangles where they are a tie.
struct LiftedMatchings {
    std::vector<std::uint8_t> element, tie;
};
LiftedMatchings lifted_matchings(const TriangleTable& table, const Quaternions& of_tets, int threads);

// A tet at the edge ab, a < b: the way round a -> b (right-handed) enters it through the triangle with vertex `enter`
// and leaves it through the one with vertex `leave`.
struct TetAtEdge {
    Index a, b, tet, enter, leave, triangle;  // triangle: row in the table of that of `leave`
};

// All tets at all edges, by (a, b), then by tet. Near linear.
std::vector<TetAtEdge> tets_at_edges(const TetMesh& mesh, const TriangleTable& table, int threads);

// Round an edge.
struct EdgeLoop {
    bool closed = false;  // one loop of tets: the edge is inside the mesh
    int holonomy = 0;     // the frame of the lowest tet comes back as q h; 0 where not closed
    int lift = 0;         // the same in the binary octahedral group, where the matchings are lifted; else not meant
};

// tets: those at one edge. matching: of triangle_matchings, or lifted ones.
EdgeLoop edge_loop(std::span<const TetAtEdge> tets, const TriangleTable& table,
                   const std::vector<std::uint8_t>& matching);

// Calls use(first, last, loop) for every edge in order; its tets are [first, last).
template <class Use>
void for_each_edge_loop(const std::vector<TetAtEdge>& tets, const TriangleTable& table,
                        const std::vector<std::uint8_t>& matching, const Use& use) {
    for (std::size_t first = 0, last; first < tets.size(); first = last) {
        for (last = first + 1; last < tets.size() && tets[last].a == tets[first].a && tets[last].b == tets[first].b;)
            ++last;
        use(first, last, edge_loop({&tets[first], last - first}, table, matching));
    }
}

}  // namespace octafield::volume
