// Symmetric fourth-order tensors on R^3 split into the harmonic degrees 0, 2 and 4.
#pragma once

#include <array>

#include "quartic.hpp"

namespace octafield::frames {

using Matrix15 = Eigen::Matrix<double, 15, 15>;

// First row and size of degree 2 k in band coordinates (order m = -l..l within each degree).
inline constexpr std::array<int, 3> band_start = {0, 1, 6}, band_size = {1, 5, 9};

// Square roots of the multiplicities of the monomials: tensor4 coordinates over tensor entries A_ijkl.
const Vector15& root_multiplicities();

// Orthogonal Q: tensor4 coordinates to band coordinates on which rotations act by Harmonics<0, 2, 4>.
// The rank-one tensor r^4 has the band coordinates sqrt(kernel_eigenvalues()[k]) Y_lm(r), l = 2 k.
const Matrix15& quartic_bands();

// lambda_l = 2 pi int_-1^1 t^4 P_l(t) dt, l = 0, 2, 4: (r . x)^4 = sum_l lambda_l sum_m Y_lm(r) Y_lm(x)
// (Funk and Hecke).
const std::array<double, 3>& kernel_eigenvalues();

}  // namespace octafield::frames
