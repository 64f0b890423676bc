// Smoothing in a metric on frames: the sum of squares of dirichlet_blocks.hpp with differences of frames for those of
// vectors.
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// `options.representation` is a metric of smooth.hpp, `start` is on the constraints. All of the result but the sh4
// energy.
SmoothResult smooth_metric(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                           const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
