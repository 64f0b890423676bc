// Odeco coordinates of polynomials and tensors, shared by the embedding and the nearest-point search.
#pragma once

#include "octafield/frames/odeco.hpp"
#include "quartic.hpp"

namespace octafield::frames {

// E(r): the polynomial (r . x)^4 of a unit axis r in odeco coordinates. <E(r), E(s)> depends on r . s only.
Odeco::Vector odeco_axis(const Vector3& r);

// Gram matrix of E at three orthonormal axes: odeco_alpha on the diagonal plus odeco_beta everywhere (from
// int (r . x)^8 : int (r . x)^4 (s . x)^4 = 35 : 3 on the sphere).
inline constexpr double odeco_alpha = 10.0 / 3, odeco_beta = 5.0 / 16;

// The quartic r -> <E(r), v>, as a form of degree 4.
Quartic odeco_correlation(const Odeco::Vector& v);

// Coordinates of tensor4.hpp of the tensor with these odeco coordinates.
Vector15 odeco_tensor(const Odeco::Vector& v);

// The lengths that bring embed(q, lengths) nearest to v, and their order: axes by falling length, right-handed.
OdecoFrame odeco_fit(const Quaternion& q, const Odeco::Vector& v);

}  // namespace octafield::frames
