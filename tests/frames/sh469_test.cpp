#include "octafield/frames/sh469.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/sh4.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {

namespace {

using std::numbers::pi;

// The su2 invariants, typed here from DESIGN and not taken from the library.
std::array<std::complex<double>, 3> su2_invariants(const Quaternion& q) {
    const std::complex<double> u(q.w(), q.x()), v(q.y(), q.z());
    const std::complex<double> u4 = u * u * u * u, v4 = v * v * v * v;
    return {u4 * u4 + 14.0 * u4 * v4 + v4 * v4, std::pow(u * v * (u4 - v4), 2),
            u * v * (u4 - v4) * (u4 * u4 * u4 - 33.0 * u4 * v4 * (u4 + v4) + v4 * v4 * v4)};
}

template <class F>
double left_average(const F& f) {
    double sum = 0;
    for (std::size_t k = 0; k < haar_rule().rotations.size(); ++k)
        sum += haar_rule().weights[k] * f(haar_rule().rotations[k]);
    return sum;
}

TEST(Sh469, SquaredDistanceIsTheLeftAverageOfTheSu2Distance) {
    const Quaternions samples = random_rotations(8, 51);
    for (Eigen::Index i = 0; i + 1 < samples.rows(); ++i) {
        const Quaternion p = row_quaternion(samples, i), q = row_quaternion(samples, i + 1);
        std::array<double, 3> each;
        for (int k = 0; k < 3; ++k)
            each[k] = left_average(
                [&](const Quaternion& g) { return std::norm(su2_invariants(g * p)[k] - su2_invariants(g * q)[k]); });
        const Sh469::Vector difference = Sh469::embed(p) - Sh469::embed(q);
        EXPECT_NEAR(each[0], difference.head<9>().squaredNorm(), 1e-13);
        EXPECT_NEAR(each[1], difference.segment<13>(9).squaredNorm(), 1e-14);
        EXPECT_NEAR(each[2], difference.tail<19>().squaredNorm(), 1e-14);
    }
}

TEST(Sh469, DefaultWeightsAreTheMeanSquaresOfTheSu2Invariants) {
    for (int k = 0; k < 3; ++k)
        EXPECT_NEAR(left_average([&](const Quaternion& g) { return std::norm(su2_invariants(g)[k]); }),
                    Sh469::band_weights[k], 1e-14);
}

TEST(Sh469, BandsAreTheTurnedInvariantsOfTheirDegrees) {
    const Quaternions samples = random_rotations(50, 52);
    const BandWeights weights = {0.3, 2, 5};
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        Sh469::Vector expected;
        expected << std::sqrt(0.3) * Sh4::embed(q),
            std::sqrt(2.0) * (Harmonics<6>::rotation(q) * Harmonics<6>::octahedral()),
            std::sqrt(5.0) * (Harmonics<9>::rotation(q) * Harmonics<9>::octahedral());
        EXPECT_LT((Sh469::embed(q, weights) - expected).norm(), 1e-13);
    }
}

TEST(Sh469, WithOneDegreeOnlyTheProjectionIsThatOfSh4) {
    std::mt19937_64 generator(53);
    for (int trial = 0; trial < 100; ++trial) {
        const Sh469::Vector v = random_vector<Sh469>(generator);
        const Quaternion frame = Sh469::project(v, nullptr, {1, 0, 0}).frame;
        const double reference = Sh4::project(v.head<9>()).distance;
        EXPECT_NEAR((Sh4::embed(frame) - v.head<9>()).norm(), reference, 1e-9);
    }
}

TEST(Sh469, OtherWeightsProjectToTheNearestOfManyFrames) {
    const Quaternions samples = random_rotations(4000, 54);
    std::mt19937_64 generator(55);
    for (const BandWeights weights : {BandWeights{1, 1, 1}, {0, 1, 0}, {0, 0, 3}, {1e-3, 1e4, 2}}) {
        std::vector<Sh469::Vector> embedded;
        for (Eigen::Index i = 0; i < samples.rows(); ++i)
            embedded.push_back(Sh469::embed(row_quaternion(samples, i), weights));
        for (int trial = 0; trial < 50; ++trial) {
            const Sh469::Vector v = random_vector<Sh469>(generator);
            const Projection p = Sh469::project(v, nullptr, weights);
            double sampled = p.distance;
            for (const Sh469::Vector& e : embedded) sampled = std::min(sampled, (v - e).norm());
            EXPECT_GE(sampled, p.distance - 1e-12);
            EXPECT_NEAR(p.distance, (v - Sh469::embed(p.frame, weights)).norm(), 1e-12 * (1 + p.distance));
            const Quaternion q = row_quaternion(samples, trial);
            EXPECT_LT(distance(Sh469::project(Sh469::embed(q, weights), nullptr, weights).frame, q), 1e-7);
        }
    }
}

TEST(Sh469, UnusableWeightsAreTypedErrors) {
    const Quaternion q = Quaternion::Identity();
    for (const BandWeights bad : {BandWeights{-1, 1, 1}, {0, 0, 0}, {1, std::nan(""), 1}, {1, 1, INFINITY}}) {
        EXPECT_THROW(Sh469::embed(q, bad), InvalidInput);
        EXPECT_THROW(Sh469::differential(q, bad), InvalidInput);
        EXPECT_THROW(Sh469::hessian(q, Sh469::Vector::Zero(), bad), InvalidInput);
        EXPECT_THROW(Sh469::project(Sh469::Vector::Zero(), nullptr, bad), InvalidInput);
    }
}

// Squared chordal over squared geodesic distance of the frames `identity` and q in degrees 4, 6, 9 (unit weights).
Vector3 squared_ratios(const Quaternion& q) {
    const double angle = distance(q, Quaternion::Identity());
    return Vector3(harmonic_distance_squared<4>(q, Quaternion::Identity()),
                   harmonic_distance_squared<6>(q, Quaternion::Identity()),
                   harmonic_distance_squared<9>(q, Quaternion::Identity())) /
           (angle * angle);
}

// Degree 4 is distorted most at the corners of the cut locus, 62.7994 degrees: squared chord 35/12, from the matrix
// with entries 0, 1/2 and sqrt(1/2) there, so that the largest over the smallest ratio is 4 / sqrt(7) times that angle,
// 1.65708. (Random sampling reaches the corner slowly: 1.6488 from the usual sample sizes.)
TEST(Sh469, Sh4IsDistortedMostAtTheCornerOfTheCutLocus) {
    const double t = std::tan(pi / 8);
    const Quaternion corner = Quaternion(1, t, t, 1 - 2 * t).normalized();
    const double angle = std::acos((2 * std::numbers::sqrt2 - 1) / 4);
    const double least = squared_ratios(corner)[0];
    EXPECT_NEAR(least, 35.0 / 12 / (angle * angle), 1e-13);
    EXPECT_NEAR(std::sqrt(20.0 / 3 / least), 4 / std::sqrt(7.0) * angle, 1e-13);
    EXPECT_GT(std::sqrt(20.0 / 3 / least), 1.6488);
    const Quaternions samples = random_rotations(50000, 56);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const double ratio = squared_ratios(row_quaternion(samples, i))[0];
        EXPECT_GT(ratio, least);
        EXPECT_LT(ratio, 20.0 / 3);
    }
}

// Small angles have the squared ratio s_l = l (l + 1) / 3 in degree l, so with weights w the squared distortion is at
// least sum w_l s_l / sum w_l c_l, c_l the ratios of any one frame: a mean of the s_l / c_l. At the frame where degree
// 4 is distorted most, degrees 6 and 9 are distorted more still, so no weights bring it down.
TEST(Sh469, DegreesSixAndNineNeverLowerTheDistortionOfSh4) {
    const double t = std::tan(pi / 8);
    const Vector3 c = squared_ratios(Quaternion(1, t, t, 1 - 2 * t).normalized());
    const Vector3 distortion = Vector3(20.0 / 3, 42.0 / 3, 90.0 / 3).cwiseQuotient(c).cwiseSqrt();
    EXPECT_GT(distortion[1], distortion[0] + 0.1);
    EXPECT_GT(distortion[2], distortion[0] + 0.1);
}

}  // namespace
}  // namespace octafield::frames
