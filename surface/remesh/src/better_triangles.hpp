// Local moves that raise the quality of the worst triangles.
#pragma once

#include "close_rounds.hpp"

namespace octafield::surface {

// Triangles of a quality below `bound` (triangle_qualities), the worst first: an edge is flipped, collapsed or split,
// or a corner moved on the input, whichever first makes the worst triangle concerned better and turns none over. Rounds
// until none is left or nothing helps, `rounds` at most. alive: called now and then, may throw.
void better_triangles(Working& work, CloseRounds& on_input, double bound, int rounds,
                      const std::function<void()>& alive);

// Of one triangle: 2 inscribed over circumscribed radius, 1 for equilateral ones, 0 without area.
double radius_ratio(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c);
double quality_of(const Working& work, Face face);

}  // namespace octafield::surface
