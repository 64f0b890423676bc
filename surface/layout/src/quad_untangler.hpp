// Quads on a surface, all moved at once until none is inverted.
#pragma once

#include "quad_smoother.hpp"

namespace octafield::surface::detail {

// Where vertices of quads may go.
struct Movable {
    Movable(const SmootherInput& input, const QuadMesh& mesh);
    std::vector<SideGrids::OnSeam> places;  // of the first vertices
    std::vector<bool> fixed;                // nodes of seams, singular points inside
    std::vector<Index> held;                // these
    std::vector<Index> part;                // of the surface, of each quad
};

// Least sum over the corners of quads of (|u|^2 + |v|^2) / (d + sqrt(d^2 + e^2)), u and v the edges there, d their
// parallelogram as the surface sees it, e falling with the worst d (Garanzha, Kaporin, Kudryavtseva, Protais, Ray,
// Sokolov 2021, for triangles): by L-BFGS in tangent planes, along seams, and back to the surface, a few times. The
// caller compares. Places on seams move with the mesh.
void untangle(const SmootherInput& input, Movable& movable, QuadMesh& mesh);

}  // namespace octafield::surface::detail
