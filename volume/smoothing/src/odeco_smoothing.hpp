// Smoothing of odeco tensors with free axis lengths (Palmer, Bommes, Solomon 2020).
#pragma once

#include <string_view>

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

inline constexpr std::string_view odeco_lengths_name = "odeco_lengths";

// `start` is on the constraints. All of the result but the sh4 energy. Throws InvalidInput where no site is held.
SmoothResult smooth_odeco_lengths(const Sampling& sampling, const BoundaryConstraints& constraints,
                                  const Quaternions& start, const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
