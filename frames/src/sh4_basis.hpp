// The harmonics c Y_4m of sh4.hpp as polynomials.
#pragma once

#include <Eigen/Core>

namespace octafield::frames {

// Rows: m = -4..4; columns: the monomials of quartic.hpp; c = sqrt(16 pi / 189).
const Eigen::Matrix<double, 9, 15>& axis_basis();

}  // namespace octafield::frames
