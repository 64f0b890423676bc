// Which edges are features.
#pragma once

#include <vector>

#include "octafield/surface/features.hpp"

namespace octafield::surface::detail {

// (E): edges listed in `features`, in either order, and edges of the mesh boundary.
std::vector<bool> feature_flags(const FeatureGraph& features, const EdgeTopology& topology);

}  // namespace octafield::surface::detail
