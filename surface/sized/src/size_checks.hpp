// Checks of sizes.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface::detail {

// Throws InvalidInput (kind "own_lengths") where the domain has edge lengths of its own.
void require_in_space(const SurfaceDomain& domain);

// One finite length > 0 for each of `count` places, `what` ("vertex"); with no word about places of no triangle.
// Throws InvalidInput (kinds "wrong_size", "bad_size").
void require_lengths(const Eigen::VectorXd& lengths, Eigen::Index count, const char* what);

}  // namespace octafield::surface::detail
