// The laws every representation obeys (frames/representation.hpp), as one typed suite. Those of the registry join by
// themselves (registry_laws_test.cpp), one of another project by one line: INSTANTIATE_TYPED_TEST_SUITE_P(Name,
// RepresentationLaws, Type).
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "octafield/error.hpp"
#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/representation.hpp"

namespace octafield::frames {

constexpr double degree = std::numbers::pi / 180;

inline Quaternion row_quaternion(const Quaternions& rows, Eigen::Index i) {
    return from_wxyz(Vector4(rows.row(i).transpose()));
}

// Standard normal number from the platform-independent uniform one (Box and Muller 1958).
inline double normal01(std::mt19937_64& generator) {
    const double u = 1 - uniform01(generator);
    return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * uniform01(generator));
}

// Frames where formulas tend to break: the identity, half turns, 45-degree turns, axes aligned pairwise, points of the
// cut locus of the identity (faces, edges and corners of the region nearer to it than to its representatives), and
// neighbours of all of these.
inline std::vector<Quaternion> nasty_frames() {
    const double pi = std::numbers::pi;
    const Vector3 axes[] = {{1, 0, 0}, {0, 1, 0},  {0, 0, 1},  {1, 1, 0},  {0, 1, 1}, {1, 0, 1},
                            {1, 1, 1}, {1, -1, 0}, {1, 1, -1}, {1, 2, -3}, {3, 1, 2}};
    std::vector<Quaternion> list = {Quaternion::Identity()};
    for (const Vector3& axis : axes)
        for (const double angle : {pi, pi / 2, pi / 3, pi / 4, 1e-9, 1e-300})
            list.push_back(exp(angle * axis.normalized()));
    const double face = std::tan(pi / 8);  // Rodrigues vectors on the boundary of the region
    for (const Vector3& r : {Vector3(face, 0, 0), Vector3(face, face, 0), Vector3(face, face, 1 - 2 * face),
                             Vector3(1.0 / 3, 1.0 / 3, 1.0 / 3), Vector3(face, 0.1, -0.05)})
        list.push_back(Quaternion(1, r.x(), r.y(), r.z()).normalized());
    const std::size_t n = list.size();
    for (std::size_t i = 0; i < n; ++i) list.push_back((exp(Vector3(1e-8, -2e-8, 1e-8)) * list[i]).normalized());
    return list;
}

template <class R>
typename R::Vector random_vector(std::mt19937_64& generator) {
    typename R::Vector v;
    for (int c = 0; c < R::dimension; ++c) v[c] = normal01(generator);
    return v;
}

// Rotations and weights of a product rule in Euler angles (Gauss in the cosine, trapezia in the others) that is exact
// for the products of two embeddings of harmonic degree 9 at most.
struct HaarRule {
    std::vector<Quaternion> rotations;
    std::vector<double> weights;
};
inline const HaarRule& haar_rule() {
    static const HaarRule rule = [] {
        constexpr int degree = 18, turns = degree + 1, polar = degree / 2 + 1;
        HaarRule r;
        // Gauss-Legendre nodes as eigenvalues of the Jacobi matrix (Golub and Welsch 1969).
        Eigen::Matrix<double, polar, polar> jacobi = Eigen::Matrix<double, polar, polar>::Zero();
        for (int k = 1; k < polar; ++k) jacobi(k, k - 1) = jacobi(k - 1, k) = k / std::sqrt(4.0 * k * k - 1);
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, polar, polar>> eigen(jacobi);
        for (int i = 0; i < polar; ++i)
            for (int a = 0; a < turns; ++a)
                for (int c = 0; c < turns; ++c) {
                    const double beta = std::acos(eigen.eigenvalues()[i]), step = 2 * std::numbers::pi / turns;
                    r.rotations.push_back(exp(Vector3(0, 0, a * step)) * exp(Vector3(0, beta, 0)) *
                                          exp(Vector3(0, 0, c * step)));
                    const double first = eigen.eigenvectors()(0, i);
                    r.weights.push_back(first * first / (turns * turns));
                }
        return r;
    }();
    return rule;
}

template <int degree>
double harmonic_distance_squared(const Quaternion& p, const Quaternion& q) {
    const auto& a = Harmonics<degree>::octahedral();
    return (Harmonics<degree>::rotate(p, a) - Harmonics<degree>::rotate(q, a)).squaredNorm();
}

template <class R>
class RepresentationLaws : public ::testing::Test {};
TYPED_TEST_SUITE_P(RepresentationLaws);

TYPED_TEST_P(RepresentationLaws, EmbeddingIsInvariantUnderTheBinaryOctahedralGroupOnTheRight) {
    std::vector<Quaternion> frames = nasty_frames();
    const Quaternions samples = random_rotations(100, 1);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    for (const Quaternion& q : frames)
        for (const Quaternion& o : binary_octahedral_group())
            EXPECT_LT((TypeParam::embed(q * o) - TypeParam::embed(q)).norm(), 1e-13);
}

TYPED_TEST_P(RepresentationLaws, DistinctFramesHaveDistinctEmbeddings) {
    const Quaternions a = random_rotations(500, 2), b = random_rotations(500, 3);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        EXPECT_GT((TypeParam::embed(p) - TypeParam::embed(q)).norm(), 0.1 * distance(p, q));
    }
}

TYPED_TEST_P(RepresentationLaws, RotationsFromTheLeftActLinearlyWhereTheyDo) {
    if constexpr (Equivariant<TypeParam>) {
        const Quaternions samples = random_rotations(100, 10);
        std::mt19937_64 generator(11);
        for (Eigen::Index i = 0; i + 1 < samples.rows(); ++i) {
            const Quaternion g = row_quaternion(samples, i), q = row_quaternion(samples, i + 1);
            EXPECT_LT((TypeParam::rotate(g, TypeParam::embed(q)) - TypeParam::embed(g * q)).norm(), 1e-13);
            // On all of R^d: a homomorphism.
            const auto v = random_vector<TypeParam>(generator);
            EXPECT_LT((TypeParam::rotate(g, TypeParam::rotate(q, v)) - TypeParam::rotate(g * q, v)).norm(), 1e-12);
            // Its differential is isotropic.
            const auto j = TypeParam::differential(q);
            const Matrix3 expected = TypeParam::speed * TypeParam::speed * Matrix3::Identity();
            EXPECT_LT((j.transpose() * j - expected).norm(), 1e-12);
        }
    } else {
        // No linear map does: the span of (embed(g q_k))_k over samples would determine it, and does not fit.
        constexpr int d = TypeParam::dimension;
        const Quaternions samples = random_rotations(40 * d, 12);
        const Quaternion g = exp(Vector3(0.3, -0.5, 0.4));
        Eigen::MatrixXd before(samples.rows(), d), after(samples.rows(), d);
        for (Eigen::Index i = 0; i < samples.rows(); ++i) {
            before.row(i) = TypeParam::embed(row_quaternion(samples, i)).transpose();
            after.row(i) = TypeParam::embed(g * row_quaternion(samples, i)).transpose();
        }
        const Eigen::MatrixXd map = before.colPivHouseholderQr().solve(after);
        EXPECT_GT((before * map - after).norm(), 0.1 * after.norm());
    }
}

TYPED_TEST_P(RepresentationLaws, LeftAverageOfSquaredDistanceIsTheWeightedSumOfTheHarmonicDegrees) {
    const Quaternions samples = random_rotations(8, 13);
    for (Eigen::Index i = 0; i + 1 < samples.rows(); ++i) {
        const Quaternion p = row_quaternion(samples, i), q = row_quaternion(samples, i + 1);
        double average = 0;
        for (std::size_t k = 0; k < haar_rule().rotations.size(); ++k) {
            const Quaternion& g = haar_rule().rotations[k];
            average += haar_rule().weights[k] * (TypeParam::embed(g * p) - TypeParam::embed(g * q)).squaredNorm();
        }
        const BandWeights w = TypeParam::band_weights;
        EXPECT_NEAR(average,
                    w[0] * harmonic_distance_squared<4>(p, q) + w[1] * harmonic_distance_squared<6>(p, q) +
                        w[2] * harmonic_distance_squared<9>(p, q),
                    1e-12 * average);
    }
}

TYPED_TEST_P(RepresentationLaws, DifferentialIsTheDerivativeUnderRotationFromTheLeft) {
    std::vector<Quaternion> frames = nasty_frames();
    const Quaternions samples = random_rotations(50, 4);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    const double h = 1e-5;
    for (const Quaternion& q : frames) {
        const auto differential = TypeParam::differential(q);
        for (int k = 0; k < 3; ++k) {
            const Vector3 w = h * Vector3::Unit(k);
            const typename TypeParam::Vector numeric =
                (TypeParam::embed(exp(w) * q) - TypeParam::embed(exp(-w) * q)) / (2 * h);
            EXPECT_LT((differential.col(k) - numeric).norm(), 2e-8);
        }
    }
}

TYPED_TEST_P(RepresentationLaws, HessianIsTheSecondDerivativeUnderRotationFromTheLeft) {
    const Quaternions samples = random_rotations(50, 14);
    std::mt19937_64 generator(15);
    const double h = 1e-4;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const auto v = random_vector<TypeParam>(generator);
        const auto value = [&](const Vector3& w) { return v.dot(TypeParam::embed(exp(w) * q)); };
        Matrix3 numeric;
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                const Vector3 a = h * Vector3::Unit(j), b = h * Vector3::Unit(k);
                numeric(j, k) = (value(a + b) - value(a - b) - value(b - a) + value(-a - b)) / (4 * h * h);
            }
        EXPECT_LT((TypeParam::hessian(q, v) - numeric).norm(), 1e-4 * (1 + numeric.norm()));
    }
}

TYPED_TEST_P(RepresentationLaws, ProjectionOfAnEmbeddedFrameIsThatFrame) {
    std::vector<Quaternion> frames = nasty_frames();
    const Quaternions samples = random_rotations(2000, 5);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    for (const Quaternion& q : frames) {
        const Projection p = TypeParam::project(TypeParam::embed(q));
        EXPECT_LT(distance(p.frame, q), 1e-13);
        EXPECT_LT(p.distance, 1e-13);
        EXPECT_NEAR(p.frame.norm(), 1, 1e-14);
    }
}

TYPED_TEST_P(RepresentationLaws, ProjectionIsIdempotent) {
    std::mt19937_64 generator(16);
    for (int trial = 0; trial < 100; ++trial) {
        const auto v = random_vector<TypeParam>(generator);
        const Projection once = TypeParam::project(v);
        EXPECT_LT(distance(TypeParam::project(TypeParam::embed(once.frame)).frame, once.frame), 1e-13);
    }
}

TYPED_TEST_P(RepresentationLaws, NoSampledFrameIsNearerThanTheProjection) {
    const Quaternions samples = random_rotations(4000, 6);
    std::vector<typename TypeParam::Vector> embedded;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) embedded.push_back(TypeParam::embed(row_quaternion(samples, i)));
    std::mt19937_64 generator(7);
    for (int trial = 0; trial < 1000; ++trial) {
        const auto v = random_vector<TypeParam>(generator);
        const Projection p = TypeParam::project(v);
        EXPECT_NEAR(p.distance, (v - TypeParam::embed(p.frame)).norm(), 1e-12);
        double sampled = std::numeric_limits<double>::infinity();
        for (const auto& e : embedded) sampled = std::min(sampled, (v - e).norm());
        EXPECT_LE(p.distance, sampled + 1e-12);
    }
}

TYPED_TEST_P(RepresentationLaws, ProjectionIsStationaryWhicheverGuessItStartsFrom) {
    const Quaternions guesses = random_rotations(200, 8);
    std::mt19937_64 generator(9);
    for (Eigen::Index i = 0; i < guesses.rows(); ++i) {
        const auto v = random_vector<TypeParam>(generator);
        const Quaternion guess = row_quaternion(guesses, i);
        const Projection with = TypeParam::project(v, &guess), without = TypeParam::project(v);
        EXPECT_NEAR(with.distance, without.distance, 1e-9);
        EXPECT_LT((TypeParam::differential(with.frame).transpose() * (v - TypeParam::embed(with.frame))).norm(), 1e-6);
    }
}

TYPED_TEST_P(RepresentationLaws, AnyFiniteVectorHasAProjection) {
    using Vector = typename TypeParam::Vector;
    std::mt19937_64 generator(17);
    const auto direction = random_vector<TypeParam>(generator);
    for (const double size : {0.0, 1e-300, 1e-20, 1e10, 1e150, 1e300}) {
        const Vector v = size * direction;
        const Projection p = TypeParam::project(v);
        EXPECT_NEAR(p.frame.norm(), 1, 1e-14) << size;
        EXPECT_TRUE(std::isfinite(p.distance)) << size;
    }
    for (int c = 0; c < TypeParam::dimension; ++c)
        EXPECT_NEAR(TypeParam::project(Vector::Unit(c)).frame.norm(), 1, 1e-14);
}

TYPED_TEST_P(RepresentationLaws, NaNAndInfinityAreTypedErrors) {
    using Vector = typename TypeParam::Vector;
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()}) {
        for (int c = 0; c < TypeParam::dimension; ++c) {
            Vector v = TypeParam::embed(Quaternion::Identity());
            v[c] = bad;
            EXPECT_THROW(TypeParam::project(v), InvalidInput);
        }
        EXPECT_THROW(TypeParam::embed(Quaternion(bad, 0, 0, 0)), InvalidInput);
        EXPECT_THROW(TypeParam::differential(Quaternion(0, 0, bad, 0)), InvalidInput);
    }
    EXPECT_THROW(TypeParam::embed(Quaternion(2, 0, 0, 0)), InvalidInput);
    EXPECT_THROW(TypeParam::embed(Quaternion(0, 0, 0, 0)), InvalidInput);
}

REGISTER_TYPED_TEST_SUITE_P(RepresentationLaws, EmbeddingIsInvariantUnderTheBinaryOctahedralGroupOnTheRight,
                            DistinctFramesHaveDistinctEmbeddings, RotationsFromTheLeftActLinearlyWhereTheyDo,
                            LeftAverageOfSquaredDistanceIsTheWeightedSumOfTheHarmonicDegrees,
                            DifferentialIsTheDerivativeUnderRotationFromTheLeft,
                            HessianIsTheSecondDerivativeUnderRotationFromTheLeft,
                            ProjectionOfAnEmbeddedFrameIsThatFrame, ProjectionIsIdempotent,
                            NoSampledFrameIsNearerThanTheProjection, ProjectionIsStationaryWhicheverGuessItStartsFrom,
                            AnyFiniteVectorHasAProjection, NaNAndInfinityAreTypedErrors);

}  // namespace octafield::frames
