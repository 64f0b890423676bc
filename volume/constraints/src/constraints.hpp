// What solvers share about boundary constraints.
#pragma once

#include "octafield/volume/boundary.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// Throws InvalidInput unless the constraints have one entry per site, with unit frames and axes.
void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints);
// Also requires the start to hold one unit quaternion per site.
void require_fitting(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start);

// The start moved onto the constraints: fixed frames taken over, the axis nearest to a fixed axis turned onto it.
Quaternions constrained_start(const BoundaryConstraints& constraints, const Quaternions& start);

}  // namespace octafield::volume
