// A smooth function on the vertices through values at places of the surface.
#pragma once

#include <vector>

#include "charts.hpp"

namespace octafield::surface::detail {

// (V, columns) P1, the least sum of squared differences from `values`, (n, columns) at `places` of `triangles`, plus a
// little times int |grad|^2. 0 on connected parts without a value.
Eigen::MatrixXd fitted_map(const Charts& charts, const std::vector<Index>& triangles,
                           const std::vector<Complex>& places, const Eigen::MatrixXd& values);

}  // namespace octafield::surface::detail
