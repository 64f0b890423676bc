#include "octafield/frames/su2_metric.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "representation_laws.hpp"
#include "su2_points.hpp"

namespace octafield::frames {
namespace {

using Distance = double (*)(const Quaternion&, const Quaternion&);

// Quantiles 1 % and 99 % of metric over angle for random frames that far apart.
std::pair<double, double> distortion(Distance metric, double angle) {
    const Quaternions frames = random_rotations(20000, 61), turns = random_rotations(20000, 62);
    std::vector<double> ratios;
    for (Eigen::Index i = 0; i < frames.rows(); ++i) {
        const Quaternion p = row_quaternion(frames, i);
        const Quaternion q = exp(angle * row_quaternion(turns, i).vec().normalized()) * p;
        ratios.push_back(metric(p, q) / distance(p, q));
    }
    std::sort(ratios.begin(), ratios.end());
    return {ratios[ratios.size() / 100], ratios[ratios.size() - ratios.size() / 100]};
}

// Table of the design document, computed there by independent code.
TEST(Su2Metric, DistortionsAreThePublishedOnes) {
    const auto naive = distortion(su2_metric::naive, 2 * degree);
    EXPECT_NEAR(naive.first, 0.48, 0.015);
    EXPECT_NEAR(naive.second, 3.7, 0.02);
    const double table[3][3] = {{2, 0.995, 1.001}, {5, 0.967, 1.007}, {10, 0.88, 1.03}};
    for (const auto& row : table) {
        const auto midpoint = distortion(su2_metric::pulled_back_midpoint, row[0] * degree);
        EXPECT_NEAR(midpoint.first, row[1], 0.002) << row[0];
        EXPECT_NEAR(midpoint.second, row[2], 0.003) << row[0];
    }
}

TEST(Su2Metric, MidpointIsThirdOrderSymmetricSecondAndEndFirst) {
    const Quaternions frames = random_rotations(500, 63), turns = random_rotations(500, 64);
    const Distance metrics[3] = {su2_metric::pulled_back_at_end, su2_metric::pulled_back_symmetric,
                                 su2_metric::pulled_back_midpoint};
    const double at_least[3] = {0.9, 1.9, 1.9};  // order of the relative error
    for (int k = 0; k < 3; ++k) {
        double errors[2] = {0, 0};
        for (int s = 0; s < 2; ++s)
            for (Eigen::Index i = 0; i < frames.rows(); ++i) {
                const double angle = s == 0 ? 0.01 : 0.001;
                const Quaternion p = row_quaternion(frames, i);
                const Quaternion q = exp(angle * row_quaternion(turns, i).vec().normalized()) * p;
                errors[s] += std::abs(metrics[k](p, q) / angle - 1);
            }
        EXPECT_GT(std::log10(errors[0] / errors[1]), at_least[k]) << k;
    }
}

TEST(Su2Metric, PulledBackIsAFormOfRankTwoThatDependsOnTheFrameOnly) {
    const Quaternions frames = random_rotations(20, 65);
    for (Eigen::Index i = 0; i < frames.rows(); ++i) {
        const Quaternion q = row_quaternion(frames, i);
        const su2_metric::Matrix3c m = su2_metric::pulled_back(q);
        EXPECT_LT((m - m.adjoint()).norm(), 1e-13);
        const Eigen::SelfAdjointEigenSolver<su2_metric::Matrix3c> eigen(m);
        EXPECT_LT(std::abs(eigen.eigenvalues()[0]), 1e-13);
        EXPECT_GT(eigen.eigenvalues()[1], 1.0 / 64.1);
        EXPECT_LT(eigen.eigenvalues()[2], 1 / (0.3018 * 0.3018));
        for (const Quaternion& o : binary_octahedral_group())
            EXPECT_LT((su2_metric::pulled_back(q * o) - m).norm(), 1e-12);
        // On tangent vectors it is a quarter of the squared angle.
        const Su2::Differential d = Su2::differential(q);
        for (int k = 0; k < 3; ++k) {
            const Complex3 t = Su2::complex(d.col(k));
            EXPECT_NEAR(t.dot(m * t).real(), 0.25, 1e-13);
        }
    }
}

TEST(Su2Metric, NaiveIsNotAMultipleOfTheAngle) {
    // Thesis figure 4.7a: turns about one axis look longer than about the others. Here that axis is x.
    const Quaternion identity = Quaternion::Identity();
    EXPECT_NEAR(su2_metric::naive(identity, exp({1e-4, 0, 0})) / 1e-4, 4, 1e-5);
    EXPECT_NEAR(su2_metric::naive(identity, exp({0, 1e-4, 0})) / 1e-4, 0.5, 1e-5);
    EXPECT_NEAR(su2_metric::naive(identity, exp({0, 0, 1e-4})) / 1e-4, 0.5, 1e-5);
}

TEST(Su2Metric, GeodesicOperationsOnTheVarietyAgreeWithThoseOnFrames) {
    std::vector<Quaternion> frames = nasty_frames();
    const Quaternions samples = random_rotations(200, 66);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const Complex3 h = point(frames[i]), k = point(frames[i + 1]);
        const double angle = distance(frames[i], frames[i + 1]);
        EXPECT_NEAR(su2_metric::distance(h, k), angle, 1e-14);
        EXPECT_NEAR(su2_metric::distance(k, h), angle, 1e-14);
        const Complex3 tangent = su2_metric::log(h, k);
        EXPECT_NEAR(su2_metric::length(h, tangent), angle, 1e-13);
        EXPECT_LT((su2_metric::exp(h, tangent) - k).norm(), 1e-12);
    }
}

TEST(Su2Metric, LogIsTheVelocityOfTheGeodesic) {
    const Quaternion p = exp({0.3, -1.1, 0.7}), q = exp({0.2, 0.3, -0.1}) * p;
    const Complex3 h = point(p), tangent = su2_metric::log(h, point(q));
    const double s = 1e-5;
    const Complex3 velocity = (su2_metric::exp(h, s * tangent) - su2_metric::exp(h, -s * tangent)) / (2 * s);
    EXPECT_LT((velocity - tangent).norm(), 1e-8);
    EXPECT_NEAR(su2_metric::distance(h, su2_metric::exp(h, 0.5 * tangent)), 0.5 * distance(p, q), 1e-14);
}

TEST(Su2Metric, OnlyTheTangentPartOfAVectorCounts) {
    const Quaternion q = exp({0.3, -1.1, 0.7});
    const Complex3 h = point(q);
    const Su2::Differential d = Su2::differential(q);
    Su2::Vector normal = Su2::Vector::Unit(3);
    normal -= d * (d.transpose() * d).inverse() * d.transpose() * normal;
    const Complex3 tangent = Su2::complex(d * Vector3(0.1, 0.2, -0.1));
    EXPECT_NEAR(su2_metric::length(h, tangent + Su2::complex(normal)), std::sqrt(0.06), 1e-13);
    EXPECT_LT((su2_metric::exp(h, Su2::complex(normal)) - h).norm(), 1e-13);
}

TEST(Su2Metric, MeanIsTheKarcherMean) {
    const Quaternion centre = exp({0.3, -1.1, 0.7});
    std::vector<Complex3> points;
    const Vector3 offsets[4] = {{0.1, 0.05, 0}, {-0.1, -0.05, 0}, {0, 0.1, -0.12}, {0, -0.1, 0.12}};
    for (int i = 0; i < 4; ++i)  // any of the 48 quaternions of each frame
        points.push_back(point(exp(offsets[i]) * centre * binary_octahedral_group()[7 * i + 3]));
    EXPECT_LT(su2_metric::distance(su2_metric::mean(points), point(centre)), 1e-10);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(4);
    weights[2] = 3;
    EXPECT_LT(su2_metric::distance(su2_metric::mean(points, weights), points[2]), 1e-10);
    const auto cost = [&](const Complex3& h) {
        double sum = 0;
        for (const Complex3& p : points) sum += std::pow(su2_metric::distance(h, p), 2);
        return sum;
    };
    const Complex3 mean = su2_metric::mean(points);
    for (int k = 0; k < 3; ++k)
        for (const double sign : {0.01, -0.01})
            EXPECT_GT(cost(point(exp(sign * Vector3::Unit(k)) * Su2::inverse_frame(mean))), cost(mean));
}

TEST(Su2Metric, BadInputIsATypedError) {
    const Complex3 h = point(exp({0.3, -1.1, 0.7}));
    const Complex3 off = h + Complex3(0, 0.1, 0), scaled = Su2::invariants({0.9, 0.9}, {0.1, 0});
    for (const Complex3& bad : {off, scaled, Complex3(0, 0, 0), Complex3(std::nan(""), 0, 0)}) {
        EXPECT_THROW(su2_metric::distance(bad, h), InvalidInput);
        EXPECT_THROW(su2_metric::distance(h, bad), InvalidInput);
        EXPECT_THROW(su2_metric::log(h, bad), InvalidInput);
        EXPECT_THROW(su2_metric::exp(bad, h), InvalidInput);
        EXPECT_THROW(su2_metric::mean({h, bad}), InvalidInput);
    }
    EXPECT_THROW(su2_metric::exp(h, Complex3(std::nan(""), 0, 0)), InvalidInput);
    EXPECT_THROW(su2_metric::mean({}), InvalidInput);
    EXPECT_THROW(su2_metric::naive({2, 0, 0, 0}, Quaternion::Identity()), InvalidInput);
    EXPECT_THROW(su2_metric::pulled_back({0, 0, 0, 0}), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
