// Common eigenvectors of symmetric 3x3 matrices that commute, or nearly so.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"

namespace octafield::frames {

// The rotation whose columns make all R^T M R as diagonal as possible (least sum of squared off-diagonal entries):
// Jacobi angles (Cardoso and Souloumiac 1996) from the identity and from the eigenvectors of fixed combinations, the
// best of them. One combination alone may have repeated eigenvalues where the set has none in common.
Matrix3 joint_eigenvectors(const std::vector<Matrix3>& matrices);

}  // namespace octafield::frames
