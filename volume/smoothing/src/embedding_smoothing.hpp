// Smoothing of embedded frames: the trust region, or Ceres' least-squares solvers.
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// Of options.representation, one of frames/registry.hpp; a Minimise of scheme_table.hpp.
SmoothResult smooth_embedding(const Sampling& sampling, const BoundaryConstraints& constraints,
                              const Quaternions& start, const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
