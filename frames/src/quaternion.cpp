#include "octafield/frames/quaternion.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"

namespace octafield::frames {
namespace {

void require_direction(const Vector3& v) {
    if (!v.allFinite() || v.isZero(0))
        throw InvalidInput("a vector that is zero or not finite has no direction", "not_unit_vector");
}

// A unit vector perpendicular to the unit vector z.
Vector3 perpendicular(const Vector3& z) {
    int smallest = 0;
    z.cwiseAbs().minCoeff(&smallest);
    return (Vector3::Unit(smallest) - z[smallest] * z).normalized();
}

}  // namespace

void throw_not_unit(const Quaternion& q) {
    throw InvalidInput("not a unit quaternion: norm " + std::to_string(q.norm()) + "; normalise it first", "not_unit");
}

Quaternion exp(const Vector3& rotation_vector) {
    const Vector3 half = rotation_vector / 2;
    double angle = half.norm();
    Vector3 v;
    if (angle < 5e-5) {
        v = (1 - angle * angle / 6) * half;  // the series of sin(angle) / angle: the quotient loses digits
    } else if (angle < 1e150) {
        v = std::sin(angle) / angle * half;
    } else {
        angle = half.stableNorm();
        v = std::sin(angle) * (half / angle);
    }
    return {std::cos(angle), v.x(), v.y(), v.z()};
}

Vector3 log(const Quaternion& q) {
    const double sine = q.vec().norm();
    const double sign = q.w() < 0 ? -1 : 1;
    const double angle = 2 * std::atan2(sine, std::abs(q.w()));
    const double scale = sine > 1e-8 ? angle / sine : 2.0;
    return sign * scale * q.vec();
}

// (|a + b|, |a - b| axis) / 2: of the sum and the difference of unit vectors the shorter one is free of rounding, and
// its cross product with a, which is that of b up to sign, has all digits too.
Quaternion rotation_between(const Vector3& from, const Vector3& to) {
    constexpr double indistinct = 4e-16;
    require_direction(from), require_direction(to);
    const Vector3 a = from.stableNormalized(), b = to.stableNormalized(), sum = a + b, difference = b - a;
    const bool acute = difference.squaredNorm() < sum.squaredNorm();
    Vector3 axis = a.cross(acute ? difference : sum);
    if (axis.norm() < indistinct) {
        if (acute) return Quaternion::Identity();
        axis = perpendicular(a);
        return {0, axis.x(), axis.y(), axis.z()};
    }
    axis *= difference.norm() / axis.norm();
    return Quaternion(sum.norm(), axis.x(), axis.y(), axis.z()).normalized();
}

Quaternion frame_from_axes(const Vector3& direction, const Vector3& normal) {
    const Vector3 z = normal.stableNormalized();
    Vector3 x = direction - direction.dot(z) * z;
    if (!(x.stableNorm() > 1e-8 * direction.stableNorm())) {
        x = perpendicular(z);
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
