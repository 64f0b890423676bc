// Smoothing of odeco tensors with free axis lengths (Palmer, Bommes, Solomon 2020).
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// A Minimise of scheme_table.hpp. Throws InvalidInput where no site is held. L-BFGS is its default: Gauss-Newton steps
// are dear with six unknowns a site, and no better where singular curves still move.
SmoothResult smooth_odeco_lengths(const Sampling& sampling, const BoundaryConstraints& constraints,
                                  const Quaternions& start, const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
