// Quads on a surface, made better without leaving it.
#pragma once

#include "followed_field.hpp"
#include "octafield/surface/quad_mesh.hpp"
#include "side_grids.hpp"
#include "surface_parts.hpp"

namespace octafield::surface::detail {

constexpr double bad = 0.3;  // scaled Jacobian: quads below are rescued

struct SmootherInput {
    const QuadLayout& layout;
    const SurfaceParts& parts;
    const Seams& seams;
    std::vector<SideGrids::OnSeam>& on_seams;  // of the first vertices; moved with them
    const std::vector<Index>& patches;         // of each quad: of the layout
    const std::vector<Index>& fixed;           // vertices inside the surface
    bool release;                              // these, where bad quads are left
    FollowedField follow = {};                 // that edges are drawn to
};

// Bad quads that are left are rescued: what is round them once more from relaxed places, then with singular points
// released, and last all at once round one after the other.
enum class Rescue {
    where_few,  // near them, if they are few of all
    near_them,
    everywhere,  // all that can move is moved again: much dearer, and a little better
};

// Vertex by vertex, in their order: to where its neighbours' mean is, or a part of its edges' length in one of eight
// directions, if that raises the least scaled Jacobian of the quads round it (those that face against the surface count
// as less than any other). So the least of all never falls. Vertices on seams slide along them, those inside stay on
// the surface between seams. Ends when nothing moves.
// Returns whether bad quads were rescued, or there were none.
bool smooth(const SmootherInput& input, int rounds, Rescue rescue, QuadMesh& mesh);

enum class Start {
    mapped,     // as it is
    relaxed,    // vertices at the means of their neighbours
    untangled,  // all moved at once, for the shapes of quads (quad_untangler.hpp)
    evened,     // and for their sizes, with the singular points that are released
    held,       // likewise, without these
    freed,      // likewise, from relaxed places, with the singular points that are released otherwise
};
void prepare(const SmootherInput& input, Start start, QuadMesh& mesh);

// By how much the quads are all better than that, or than the angle between features that they are given.
double least_margin(const SmootherInput& input, double wanted, QuadMesh& mesh);

// Quads whose normal is turned by a right angle or more from that of the surface nearest to their middle.
std::vector<Index> facing_away(const SmootherInput& input, QuadMesh& mesh);

}  // namespace octafield::surface::detail
