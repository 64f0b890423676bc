// Quads on a surface, made better without leaving it.
#pragma once

#include "octafield/surface/quad_mesh.hpp"
#include "side_grids.hpp"

namespace octafield::surface::detail {

struct SmootherInput {
    const QuadLayout& layout;
    const Seams& seams;
    const std::vector<SideGrids::OnSeam>& on_seams;  // of the first vertices
    const std::vector<Index>& patches;               // of each quad: of the layout
    const std::vector<Index>& fixed;                 // vertices inside the surface
    bool release;                                    // these, where bad quads are left
};

// Vertex by vertex, in their order: to where its neighbours' mean is, or a part of its edges' length in one of eight
// directions, if that raises the least scaled Jacobian of the quads round it (those that face against the surface count
// as less than any other). So the least of all never falls. Vertices on seams slide along them, those inside stay on
// the surface between seams. Ends when nothing moves.
void smooth(const SmootherInput& input, int rounds, QuadMesh& mesh);

// Quads whose normal is turned by a right angle or more from that of the surface nearest to their middle.
std::vector<Index> facing_away(const SmootherInput& input, QuadMesh& mesh);

}  // namespace octafield::surface::detail
