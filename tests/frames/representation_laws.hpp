// The laws every representation obeys (frames/representation.hpp), as one typed suite. A new representation joins by
// one line: INSTANTIATE_TYPED_TEST_SUITE_P(Name, RepresentationLaws, Type).
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/representation.hpp"

namespace octafield::frames {

inline Quaternion row_quaternion(const Quaternions& rows, Eigen::Index i) {
    return from_wxyz(Vector4(rows.row(i).transpose()));
}

// Standard normal number from the platform-independent uniform one (Box and Muller 1958).
inline double normal01(std::mt19937_64& generator) {
    const double u = 1 - uniform01(generator);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * 3.141592653589793 * uniform01(generator));
}

template <class R>
class RepresentationLaws : public ::testing::Test {};
TYPED_TEST_SUITE_P(RepresentationLaws);

TYPED_TEST_P(RepresentationLaws, EmbeddingIsInvariantUnderTheBinaryOctahedralGroupOnTheRight) {
    const Quaternions samples = random_rotations(50, 1);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        for (const Quaternion& o : binary_octahedral_group())
            EXPECT_LT((TypeParam::embed(q * o) - TypeParam::embed(q)).norm(), 1e-13);
    }
}

TYPED_TEST_P(RepresentationLaws, DistinctFramesHaveDistinctEmbeddings) {
    const Quaternions a = random_rotations(500, 2), b = random_rotations(500, 3);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        EXPECT_GT((TypeParam::embed(p) - TypeParam::embed(q)).norm(), 0.1 * distance(p, q));
    }
}

TYPED_TEST_P(RepresentationLaws, DifferentialIsTheDerivativeUnderRotationFromTheLeft) {
    const Quaternions samples = random_rotations(50, 4);
    const double h = 1e-5;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const auto differential = TypeParam::differential(q);
        for (int k = 0; k < 3; ++k) {
            const Vector3 w = h * Vector3::Unit(k);
            const typename TypeParam::Vector numeric =
                (TypeParam::embed(exp(w) * q) - TypeParam::embed(exp(-w) * q)) / (2 * h);
            EXPECT_LT((differential.col(k) - numeric).norm(), 1e-8);
        }
    }
}

TYPED_TEST_P(RepresentationLaws, ProjectionOfAnEmbeddedFrameIsThatFrame) {
    const Quaternions samples = random_rotations(300, 5);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Projection p = TypeParam::project(TypeParam::embed(q));
        EXPECT_LT(distance(p.frame, q), 1e-7);
        EXPECT_LT(p.distance, 1e-6);
        EXPECT_NEAR(p.frame.norm(), 1, 1e-14);
    }
}

TYPED_TEST_P(RepresentationLaws, NoSampledFrameIsNearerThanTheProjection) {
    const Quaternions samples = random_rotations(4000, 6);
    std::mt19937_64 generator(7);
    for (int trial = 0; trial < 100; ++trial) {
        typename TypeParam::Vector v;
        for (int c = 0; c < TypeParam::dimension; ++c) v[c] = normal01(generator);
        const Projection p = TypeParam::project(v);
        EXPECT_NEAR(p.distance, (v - TypeParam::embed(p.frame)).norm(), 1e-12);
        double sampled = std::numeric_limits<double>::infinity();
        for (Eigen::Index i = 0; i < samples.rows(); ++i)
            sampled = std::min(sampled, (v - TypeParam::embed(row_quaternion(samples, i))).norm());
        EXPECT_LE(p.distance, sampled + 1e-12);
    }
}

TYPED_TEST_P(RepresentationLaws, ProjectionIsStationaryWhicheverGuessItStartsFrom) {
    const Quaternions guesses = random_rotations(200, 8);
    std::mt19937_64 generator(9);
    for (Eigen::Index i = 0; i < guesses.rows(); ++i) {
        typename TypeParam::Vector v;
        for (int c = 0; c < TypeParam::dimension; ++c) v[c] = normal01(generator);
        const Quaternion guess = row_quaternion(guesses, i);
        const Projection with = TypeParam::project(v, &guess), without = TypeParam::project(v);
        EXPECT_NEAR(with.distance, without.distance, 1e-9);
        EXPECT_LT((TypeParam::differential(with.frame).transpose() * (v - TypeParam::embed(with.frame))).norm(), 1e-6);
    }
}

REGISTER_TYPED_TEST_SUITE_P(RepresentationLaws, EmbeddingIsInvariantUnderTheBinaryOctahedralGroupOnTheRight,
                            DistinctFramesHaveDistinctEmbeddings, DifferentialIsTheDerivativeUnderRotationFromTheLeft,
                            ProjectionOfAnEmbeddedFrameIsThatFrame, NoSampledFrameIsNearerThanTheProjection,
                            ProjectionIsStationaryWhicheverGuessItStartsFrom);

}  // namespace octafield::frames
