// Unit quaternions as rotations. Public arrays hold (w, x, y, z), scalar first; Eigen's own storage order stays inside.
#pragma once

#include <Eigen/Geometry>
#include <cmath>
#include <cstdint>
#include <random>

#include "octafield/arrays.hpp"

namespace octafield::frames {

using Quaternion = Eigen::Quaterniond;
using Vector3 = Eigen::Vector3d;
using Vector4 = Eigen::Vector4d;  // (w, x, y, z)
using Matrix3 = Eigen::Matrix3d;

inline Vector4 to_wxyz(const Quaternion& q) { return {q.w(), q.x(), q.y(), q.z()}; }

[[noreturn]] void throw_not_unit(const Quaternion& q);

template <class Derived>
Quaternion from_wxyz(const Eigen::MatrixBase<Derived>& wxyz) {
    return {wxyz[0], wxyz[1], wxyz[2], wxyz[3]};
}

// Throws InvalidInput unless |q| = 1 to 1e-6 (NaN and infinities included).
inline void require_unit(const Quaternion& q) {
    if (!(std::abs(q.squaredNorm() - 1) < 2e-6)) throw_not_unit(q);
}

// Rotation by |w| radians about w / |w|; accurate for every w, the zero vector included. A unit quaternion for
// every finite w, although beyond 1e16 radians the angle itself is below rounding.
Quaternion exp(const Vector3& rotation_vector);

// The rotation vector of q with angle in [0, pi]: exp(log(q)) is q or -q. Any rotation by pi returns one of its two
// vectors.
Vector3 log(const Quaternion& q);

// Rotation that takes `from` to `to` (of any length) by the shortest arc, to rounding at every angle; opposite vectors
// turn by pi about some perpendicular axis. Throws InvalidInput if one is zero or not finite.
Quaternion rotation_between(const Vector3& from, const Vector3& to);

// Right-handed frame whose third axis is `normal` and whose first axis is the part of `direction` orthogonal to it.
// `direction` may be any vector, a nearly parallel one included: then the first axis is arbitrary but deterministic.
Quaternion frame_from_axes(const Vector3& direction, const Vector3& normal);

// (n, 4) rotations distributed uniformly over SO(3) (Shoemake 1992); one seed gives the same generator stream on every
// platform.
Quaternions random_rotations(std::int64_t n, std::uint64_t seed);

// A double in [0, 1) with 53 random bits: unlike std::uniform_real_distribution the same on every platform.
inline double uniform01(std::mt19937_64& generator) { return static_cast<double>(generator() >> 11) * 0x1p-53; }

}  // namespace octafield::frames
