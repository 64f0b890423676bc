// Quads on a surface, all moved at once until none is inverted.
#pragma once

#include "quad_smoother.hpp"

namespace octafield::surface::detail {

// Where vertices of quads may go.
struct Movable {
    Movable(const SmootherInput& input, const QuadMesh& mesh);
    std::vector<SideGrids::OnSeam> places;  // of the first vertices
    std::vector<bool> fixed;                // nodes and held vertices of seams, singular points inside
    std::vector<Index> held;       // these points; none where a field is followed, which tells where they belong
    std::vector<Index> part;       // of the surface, of each quad
    std::vector<Index> triangles;  // each quad was last seen at; -1: none yet
    std::vector<Index> quads;      // that count: all at first
};

// Least sum over the corners of quads of (|u|^2 + |v|^2) / (d + sqrt(d^2 + e^2)), u and v the edges there, d their
// parallelogram as the surface sees it, e falling with the worst d (Garanzha, Kaporin, Kudryavtseva, Protais, Ray,
// Sokolov 2021, for triangles): by L-BFGS in tangent planes, along seams, and back to the surface, a few times. The
// caller compares. Places on seams move with the mesh. of_sizes: how much it counts, for each corner, that s + 1 / s is
// small as well, s the parallelogram over the area that the quad has where all are as large as the surface has them
// there. A field to follow adds 40 sin^2 of the angle of each edge from one of its lines at the middle of the quad.
void untangle(const SmootherInput& input, Movable& movable, double of_sizes, QuadMesh& mesh);

}  // namespace octafield::surface::detail
