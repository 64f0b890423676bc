// Smoothing in the metric of the invariants with the metric held during each step, to show how that fails.
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// A Minimise of scheme_table.hpp.
SmoothResult smooth_frozen(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                           const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
