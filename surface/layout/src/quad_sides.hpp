// How the sides of quads meet.
#pragma once

#include <vector>

#include "octafield/surface/quad_mesh.hpp"

namespace octafield::surface::detail {

// Side 4 q + k of quad q runs from its corner k to corner k + 1.
struct QuadSides {
    // Throws GeometryError (kind "non_manifold_edge"). Ids are those of vertices.
    explicit QuadSides(const Quads& quads);

    Index from(Index side) const { return quads(side / 4, side % 4); }
    static Index turned(Index side, int steps) { return side - side % 4 + (side % 4 + steps) % 4; }
    bool is_irregular(Index vertex) const {
        return !out[vertex].empty() && out[vertex].size() != (boundary[vertex] ? 2u : 4u);
    }

    const Quads& quads;
    std::vector<Index> mates;             // of each side; -1: boundary
    std::vector<std::vector<Index>> out;  // sides from each vertex
    std::vector<bool> boundary;           // of each vertex
    std::vector<Index> irregular;         // vertices, ascending
};

// Throws InvalidInput (kind "not_quads") where there are triangles, GeometryError (kind "index_out_of_range").
void require_only_quads(const QuadMesh& mesh);

}  // namespace octafield::surface::detail
