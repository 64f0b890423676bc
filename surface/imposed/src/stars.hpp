// The triangles round a place, as seen from it.
#pragma once

#include <vector>

#include "bisected_mesh.hpp"

namespace octafield::surface::detail {

struct Star {
    // The triangle from the place to a side that does not hold it.
    struct Part {
        Index triangle;
        int side;                                  // from corner `side` to the next one
        Vector weights;                            // of the place in the triangle
        bool first_is_feature, second_is_feature;  // the lines from the place to the ends of the side
    };
    std::vector<Part> parts;
    Vector centre;
    Index vertex;         // -1: not at a vertex
    bool boundary;        // the place is on the boundary
    double angle;         // sum of the parts' angles
    double inner_radius;  // least distance from the centre to the parts' sides
    double longest;       // longest edge of the triangles
    Index longest_triangle;
};

Star star_of(const BisectedMesh& mesh, const Place& place);

// Bisects until stars are round enough and no two of them, with the triangles beside them, overlap. Throws InvalidInput
// (kind "coincident_points", elements: places) for places that are too near to one another; `names` are what messages
// call them.
void separate_stars(BisectedMesh& mesh);

}  // namespace octafield::surface::detail
