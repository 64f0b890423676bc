// Vertices at the same place made one.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// For each point the id of the first point with equal coordinates (-0 equals 0), itself if there is none before.
std::vector<Index> first_equal_points(const Points& points);

// Every triangle corner moved to the first equal vertex; vertices that were merged into another are dropped, all others
// stay, used or not.
TriangleMesh merge_equal_points(const TriangleMesh& mesh);

}  // namespace octafield::surface
