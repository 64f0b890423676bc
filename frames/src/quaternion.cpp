#include "octafield/frames/quaternion.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"

namespace octafield::frames {

void throw_not_unit(const Quaternion& q) {
    throw InvalidInput("not a unit quaternion: norm " + std::to_string(q.norm()) + "; normalise it first", "not_unit");
}

Quaternion exp(const Vector3& rotation_vector) {
    const double angle = rotation_vector.norm();
    // sin(angle / 2) / angle, by its series where the quotient loses digits.
    const double scale = angle > 1e-4 ? std::sin(angle / 2) / angle : 0.5 - angle * angle / 48;
    const Vector3 v = scale * rotation_vector;
    return {std::cos(angle / 2), v.x(), v.y(), v.z()};
}

Vector3 log(const Quaternion& q) {
    const double sine = q.vec().norm();
    const double sign = q.w() < 0 ? -1 : 1;
    const double angle = 2 * std::atan2(sine, std::abs(q.w()));
    const double scale = sine > 1e-8 ? angle / sine : 2.0;
    return sign * scale * q.vec();
}

Quaternion rotation_between(const Vector3& from, const Vector3& to) { return Quaternion::FromTwoVectors(from, to); }

Quaternion frame_from_axes(const Vector3& direction, const Vector3& normal) {
    const Vector3 z = normal.stableNormalized();
    Vector3 x = direction - direction.dot(z) * z;
    if (!(x.stableNorm() > 1e-8 * direction.stableNorm())) {
        int smallest = 0;
        z.cwiseAbs().minCoeff(&smallest);
        x = Vector3::Unit(smallest) - z[smallest] * z;
    }
    x.stableNormalize();
    Matrix3 axes;
    axes << x, z.cross(x), z;
    return Quaternion(axes).normalized();
}

Quaternions random_rotations(std::int64_t n, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    Quaternions rows(n, 4);
    for (std::int64_t i = 0; i < n; ++i) {
        const double u = uniform01(generator);
        const double a = 2 * std::numbers::pi * uniform01(generator), b = 2 * std::numbers::pi * uniform01(generator);
        const double r = std::sqrt(1 - u), s = std::sqrt(u);
        rows.row(i) << r * std::sin(a), r * std::cos(a), s * std::sin(b), s * std::cos(b);
    }
    return rows;
}

}  // namespace octafield::frames
