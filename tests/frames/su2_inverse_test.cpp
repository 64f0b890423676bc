// The map from invariants back to quaternions, at and near every point_of where the thesis's formulas branch.

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "octafield/frames/su2.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

Complex3 point_of(const Quaternion& q) { return Su2::invariants({q.w(), q.x()}, {q.y(), q.z()}); }
Quaternion scaled(double factor, const Quaternion& q) { return Quaternion(factor * q.coeffs()); }

struct Branch {
    const char* name;
    Quaternion frame;
};

std::vector<Branch> branches() {
    const auto along_x = [](const Vector3& n) { return rotation_between(n.normalized(), Vector3::UnitX()); };
    const Quaternion turn = exp({0.3, 0, 0});
    return {{"u v = 0", Quaternion::Identity()},
            {"u^4 = v^4, h1 = 0", turn * binary_octahedral_group()[6]},
            {"double root, h2 = 0", turn * along_x({1, 1, 0})},
            {"double root, no axis across x", turn * along_x({1, 1, 0.4})},
            {"an axis across x", turn * exp({0, 0, 0.3})},
            {"f0~ = 0, h0 = 0", turn * along_x({1, 1, 1})},
            {"f1~ = 0, h0 = 0", turn * along_x({-1, 1, 1})}};
}

// Worst errors of the round trip.
struct Errors {
    double angle = 0, norm = 0;
    void add(const Quaternion& q) {
        const Complex3 h = point_of(q);
        const Quaternion back = Su2::inverse(h)[0];
        angle = std::max(angle, distance(back.normalized(), q.normalized()));
        norm = std::max(norm, std::abs(back.norm() / q.norm() - 1));
        norm = std::max(norm, std::abs(Su2::squared_norm(h) / q.squaredNorm() - 1) / 2);
    }
};

TEST(Su2Inverse, GivesBackRandomFramesToRounding) {
    const Quaternions samples = random_rotations(100000, 51);
    Errors errors;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) errors.add(row_quaternion(samples, i));
    EXPECT_LT(errors.angle, 2e-15);
    EXPECT_LT(errors.norm, 1e-15);
    RecordProperty("worst_angle", std::to_string(errors.angle));
}

TEST(Su2Inverse, IsAsAccurateOnAndNearEveryBranchPoint) {
    const Quaternions directions = random_rotations(200, 52);
    for (const Branch& branch : branches()) {
        Errors errors;
        for (int k = 1; k <= 17; ++k) {
            const double away = k == 17 ? 0 : std::pow(10.0, -k);
            for (Eigen::Index i = 0; i < directions.rows(); ++i) {
                const Vector3 w = away * row_quaternion(directions, i).vec().normalized();
                errors.add((exp(w) * branch.frame * binary_octahedral_group()[i % 48]).normalized());
            }
        }
        EXPECT_LT(errors.angle, 2e-15) << branch.name;
        EXPECT_LT(errors.norm, 1e-15) << branch.name;
    }
}

// No branch amplifies noise: the smallest singular value of the differential is 0.15.
TEST(Su2Inverse, NoiseOfTheInvariantsGrowsByTheJacobianOnly) {
    std::mt19937_64 generator(53);
    std::vector<Quaternion> frames;
    for (const Branch& branch : branches()) frames.push_back(branch.frame);
    const Quaternions samples = random_rotations(200, 54);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    for (const Quaternion& q : frames)
        for (const double noise : {1e-12, 1e-9, 1e-7})
            for (int trial = 0; trial < 20; ++trial) {
                const Su2::Vector n = noise * random_vector<Su2>(generator).normalized();
                const Quaternion back = Su2::inverse_frame(Su2::complex(Su2::embed(q) + n));
                EXPECT_LT(distance(back, q), 7 * noise + 1e-14);
                EXPECT_NEAR(Su2::squared_norm(Su2::complex(Su2::embed(q) + n)), 1, 7 * noise + 1e-14);
            }
}

TEST(Su2Inverse, All48QuaternionsAreDistinctAndHaveTheInvariants) {
    std::vector<Quaternion> frames = nasty_frames();
    for (const Branch& branch : branches()) frames.push_back(branch.frame);
    for (const Quaternion& q : frames) {
        const Complex3 h = point_of(q);
        const auto all = Su2::inverse(h);
        double nearest = 2;
        for (std::size_t i = 0; i < all.size(); ++i) {
            EXPECT_LT((point_of(all[i]) - h).norm(), 1e-14);
            nearest = std::min(nearest, (all[i].coeffs() - q.coeffs()).norm());
            for (std::size_t j = 0; j < i; ++j) EXPECT_GT((all[i].coeffs() - all[j].coeffs()).norm(), 0.7);
        }
        EXPECT_LT(nearest, 1e-15) << "q itself is one of them";
    }
}

TEST(Su2Inverse, ScaledQuaternionsComeBackWithTheirNorm) {
    const Quaternions samples = random_rotations(50, 55);
    for (const double scale : {1e-15, 1e-9, 1e-3, 0.5, 3.0, 1e3, 1e9, 1e16}) {
        Errors errors;
        for (Eigen::Index i = 0; i < samples.rows(); ++i) errors.add(scaled(scale, row_quaternion(samples, i)));
        for (const Branch& branch : branches()) errors.add(scaled(scale, branch.frame));
        EXPECT_LT(errors.angle, 2e-15) << scale;
        EXPECT_LT(errors.norm, 1e-15) << scale;
    }
}

// The thesis finds 96 candidates of which half belong to (h0, h1, -h2).
TEST(Su2Inverse, TheOtherSignOfTheLastInvariantIsAnotherFrame) {
    const Quaternions samples = random_rotations(200, 56);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        Complex3 h = point_of(q);
        h[2] = -h[2];
        const Quaternion back = Su2::inverse_frame(h);
        EXPECT_LT(distance(back, exp({std::numbers::pi, 0, 0}) * q), 1e-14);
    }
}

TEST(Su2Inverse, PointsOffTheSurfaceAreRefusedWithTheResidual) {
    const Quaternions samples = random_rotations(100, 57);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
        for (int c = 0; c < 3; ++c) {
            Complex3 h = point_of(row_quaternion(samples, i));
            // The direction in C^3 across the surface: orthogonal to both columns of the Jacobian.
            const Quaternion q = row_quaternion(samples, i);
            const Su2::Jacobian j = Su2::jacobian({q.w(), q.x()}, {q.y(), q.z()});
            const Complex3 across = j.col(0).cross(j.col(1)).conjugate().normalized();
            h += std::pow(10.0, -c - 2) * across;
            try {
                Su2::inverse(h);
                ADD_FAILURE() << "accepted";
            } catch (const InvalidInput& error) {
                EXPECT_EQ(error.kind(), "off_surface");
                EXPECT_NE(std::string(error.what()).find("residual"), std::string::npos);
            }
            EXPECT_NO_THROW(Su2::inverse(h, 0.1));
        }
    EXPECT_THROW(Su2::inverse(Complex3(0, 0, 1)), InvalidInput);
    EXPECT_THROW(Su2::inverse(Complex3(0, 1, 0)), InvalidInput);
    EXPECT_THROW(Su2::inverse(Complex3(1, 0, 0.1)), InvalidInput);
    // Huge, but (1, 1e-150, 0) after scaling: the identity frame.
    EXPECT_LT(distance(Su2::inverse_frame(Complex3(1e300, 1e300, 1e300)), Quaternion::Identity()), 1e-14);
}

TEST(Su2Inverse, ToleranceMustBePositiveAndFinite) {
    const Complex3 h = point_of(exp({0.3, -1.1, 0.7}));
    for (const double bad : {std::nan(""), 0.0, -1e-6, std::numeric_limits<double>::infinity()}) try {
            Su2::inverse_frame(h, bad);
            ADD_FAILURE() << "accepted " << bad;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "bad_option");
            EXPECT_NE(std::string(error.what()).find("tolerance"), std::string::npos);
        }
}

// All three scaled alike, which is not how invariants scale.
TEST(Su2Inverse, PointsScaledFarDownAreRefusedWithoutANaN) {
    const Complex3 h = point_of(exp({0.3, -1.1, 0.7}));
    for (int k = 1; k <= 307; ++k) try {
            Su2::inverse(std::pow(10.0, -k) * h);
            ADD_FAILURE() << "accepted at 1e-" << k;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "off_surface");
            EXPECT_EQ(std::string(error.what()).find("nan"), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find("inf"), std::string::npos) << error.what();
        }
}

TEST(Su2Inverse, ZeroNaNAndInfinityAreTypedErrors) {
    EXPECT_THROW(Su2::inverse(Complex3(0, 0, 0)), InvalidInput);
    EXPECT_EQ(Su2::squared_norm(Complex3(0, 0, 0)), 0);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
        for (int c = 0; c < 3; ++c)
            for (const Complex& value : {Complex(bad, 0), Complex(0, bad)}) {
                Complex3 h = point_of(exp({0.3, -1.1, 0.7}));
                h[c] = value;
                EXPECT_THROW(Su2::inverse(h), InvalidInput);
                EXPECT_THROW(Su2::inverse_frame(h), InvalidInput);
                EXPECT_THROW(Su2::squared_norm(h), InvalidInput);
            }
}

// Thesis (4.29, 4.30), by any root of the cubic and the quadratic for u^8 and v^8: the same where it keeps its digits
// (a fourth root of u^8 or v^8 near zero keeps a quarter of them).
TEST(Su2Inverse, SquaredNormAgreesWithTheThesis) {
    const Quaternions samples = random_rotations(200, 58);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = scaled(0.7 + 0.003 * static_cast<double>(i), row_quaternion(samples, i));
        const Complex3 h = point_of(q);
        for (const Quaternion& o : {Quaternion(1, 0, 0, 0), binary_octahedral_group()[16]}) {
            const Quaternion p = q * o;
            const Complex x = std::pow(Complex(p.w(), p.x()) * Complex(p.y(), p.z()), 2);
            const Complex delta = std::sqrt(h[0] * h[0] - 28.0 * h[0] * x * x + 192.0 * std::pow(x, 4));
            const Complex sum = h[0] - 14.0 * x * x;
            const double thesis = std::pow(std::abs(sum + delta) / 2, 0.25) + std::pow(std::abs(sum - delta) / 2, 0.25);
            EXPECT_NEAR(Su2::squared_norm(h), thesis, 1e-7);
        }
        EXPECT_NEAR(Su2::squared_norm(h), q.squaredNorm(), 1e-14);
    }
}

}  // namespace
}  // namespace octafield::frames
