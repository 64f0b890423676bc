// The laws that the difference of every metric scheme obeys (volume/smoothing/src/frame_difference.hpp), as one typed
// suite: INSTANTIATE_TYPED_TEST_SUITE_P(Name, DifferenceLaws, Type).
#pragma once

#include <gtest/gtest.h>

#include <algorithm>

#include "frame_difference.hpp"
#include "octafield/frames/geodesic.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {

// How far derivatives may be from central differences; a scheme with smaller higher derivatives has a stricter bound.
template <class Scheme>
inline constexpr double derivative_error = 1e-5;

template <class Scheme>
class DifferenceLaws : public ::testing::Test {
protected:
    const Scheme scheme = Scheme::made({});

    static frames::Quaternion row(const Quaternions& rows, Eigen::Index i) {
        return frames::from_wxyz(frames::Vector4(rows.row(i).transpose()));
    }
    struct Pair {
        frames::Quaternion p, q;
    };
    // Frames so many radians apart, in random representatives.
    static std::vector<Pair> pairs(double angle) {
        const Quaternions sample = frames::random_rotations(40, 1);
        std::vector<Pair> list;
        for (Eigen::Index i = 0; i + 1 < sample.rows(); ++i) {
            const frames::Quaternion p = row(sample, i);
            const frames::Vector3 w = angle * row(sample, i + 1).vec().normalized();
            list.push_back({p, frames::frame_exp(p, w) * frames::binary_octahedral_group()[(7 * i) % 48]});
        }
        return list;
    }
    auto value(const frames::Quaternion& p, const frames::Quaternion& q) const {
        return scheme.difference(0, Scheme::at(p, false), Scheme::at(q, false), false).value;
    }
};

TYPED_TEST_SUITE_P(DifferenceLaws);

TYPED_TEST_P(DifferenceLaws, AFrameIsNotApartFromItself) {
    for (const auto& [p, q] : this->pairs(0)) EXPECT_LT(this->value(p, q).norm(), 1e-12);
}

TYPED_TEST_P(DifferenceLaws, TheLengthIsTheAngleToFirstOrder) {
    for (const double angle : {1e-4, 1e-3, 1e-2})
        for (const auto& [p, q] : this->pairs(angle)) EXPECT_NEAR(this->value(p, q).norm(), angle, angle * angle);
}

TYPED_TEST_P(DifferenceLaws, TheLengthDoesNotDependOnTheQuaternionsThatStandForTheFrames) {
    for (const auto& [p, q] : this->pairs(0.2)) {
        const double length = this->value(p, q).norm();
        for (const frames::Quaternion& o : frames::binary_octahedral_group())
            EXPECT_NEAR(this->value((p * o).normalized(), q).norm(), length, 1e-11);
    }
}

TYPED_TEST_P(DifferenceLaws, DerivativesAreThoseOfFiniteDifferences) {
    for (const double angle : {0.0, 1e-6, 1e-3, 0.02, 0.1, 0.25, 0.5}) {
        double worst = 0;
        for (const auto& [p, q] : this->pairs(angle)) {
            const auto exact = this->scheme.difference(0, TypeParam::at(p, true), TypeParam::at(q, true), true);
            EXPECT_LT((exact.value - this->value(p, q)).norm(), 1e-15);
            constexpr double h = 1e-5;
            for (int k = 0; k < 3; ++k) {
                const frames::Vector3 e = h * frames::Vector3::Unit(k);
                const auto by_first = ((this->value(frames::frame_exp(p, e), q) -
                                        this->value(frames::frame_exp(p, -e), q)) / (2 * h)).eval();
                const auto by_second = ((this->value(p, frames::frame_exp(q, e)) -
                                         this->value(p, frames::frame_exp(q, -e))) / (2 * h)).eval();
                worst = std::max(worst, (by_first - exact.by_first.col(k)).norm());
                worst = std::max(worst, (by_second - exact.by_second.col(k)).norm());
            }
        }
        EXPECT_LT(worst, derivative_error<TypeParam>) << angle;
    }
}

REGISTER_TYPED_TEST_SUITE_P(DifferenceLaws, AFrameIsNotApartFromItself, TheLengthIsTheAngleToFirstOrder,
                            TheLengthDoesNotDependOnTheQuaternionsThatStandForTheFrames,
                            DerivativesAreThoseOfFiniteDifferences);

}  // namespace octafield::volume
