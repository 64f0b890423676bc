// What solvers share about boundary constraints.
#pragma once

#include "octafield/volume/boundary.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// Throws InvalidInput unless the constraints have one entry per site, of known kinds, with unit frames and axes.
void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints);
// Also requires the start to hold one unit quaternion per site.
void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start);

// The start moved onto the constraints, each frame as the site's kind moves it.
Quaternions constrained_start(const BoundaryConstraints& constraints, const Quaternions& start);

}  // namespace octafield::volume
