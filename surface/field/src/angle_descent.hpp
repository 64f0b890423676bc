// Descent on the energy of the angles to a local minimum.
#pragma once

#include <functional>

#include "start_field.hpp"

namespace octafield::surface::detail {

// Improves `values`, |f| = 1, in place; never raises the energy. `order`: elimination order of the system. `told` hears
// the energy after each step; false from it stops the descent. True at a minimum: gradient zero to a relative energy
// of 1e-10, no direction of negative curvature found.
bool descend_angles(const Problem& problem, const Eigen::VectorXi& order, Eigen::VectorXcd& values, std::uint64_t seed,
                    const std::function<bool(double energy)>& told);

}  // namespace octafield::surface::detail
