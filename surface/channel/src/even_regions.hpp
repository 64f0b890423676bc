// Regions need an even number of edges round them: a mesh of quads has twice as many sides as edges inside and once
// those of the boundary.
#pragma once

#include "inside_mesh.hpp"

namespace octafield::surface::detail {

struct EvenOutline : Outline {
    std::vector<Index> split;  // segments of the input that were split at their middles, ascending
};

// Of each part of the channel. Throws GeometryError (kinds "odd_boundary", "odd_interior", "outside_line").
EvenOutline make_even(const Outline& outline, const InsideMesh& inside, OddLoops odd_loops);

}  // namespace octafield::surface::detail
