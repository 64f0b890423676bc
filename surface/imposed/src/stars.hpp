// The triangles round a vertex, as seen from it.
#pragma once

#include <vector>

#include "bisected_mesh.hpp"

namespace octafield::surface::detail {

struct Star {
    // The triangle from the centre to a side.
    struct Part {
        Index triangle;
        int side;                                  // from corner `side` to the next one; the centre is the third
        bool first_is_feature, second_is_feature;  // the edges from the centre to the ends of the side
    };
    Index centre;  // vertex
    std::vector<Part> parts;
    bool boundary;
    double angle;         // sum of the parts' angles
    double inner_radius;  // least distance from the centre to the parts' sides
    double longest;       // longest edge of the triangles
    Index longest_triangle;
};

Star star_of(const BisectedMesh& mesh, Index vertex);

// Bisects until the stars of the mesh's centres are round enough and no two of them, with the triangles beside them,
// overlap. Throws InvalidInput (kind "coincident_points", elements: places) for places that are too near to one
// another.
void separate_stars(BisectedMesh& mesh);

}  // namespace octafield::surface::detail
