#include <algorithm>

#include "../../frames/src/sh4_bound.hpp"
#include "../../frames/src/sh4_kernel.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "sh4_inputs.hpp"

namespace octafield::frames {
namespace {

// Misses are counted against the certificate's search, which ends at the proven maximum.
void expect_all_global(const Vectors& inputs) {
    int uncertified = 0, improved = 0;
    double largest_gap = 0;
    for (const Sh4::Vector& v : inputs) {
        const CertifiedProjection p = sh4_project_certified(v);
        uncertified += !p.certified, improved += p.improved;
        largest_gap = std::max(largest_gap, p.gap);
    }
    EXPECT_EQ(uncertified, 0);
    EXPECT_EQ(improved, 0) << "sh4_project missed the global maximum";
    EXPECT_LE(largest_gap, 1e-9);
}

TEST(Sh4Certificate, FastProjectionIsGloballyOptimalOnRandomInputs) { expect_all_global(random_inputs(10000, 21)); }
TEST(Sh4Certificate, FastProjectionIsGloballyOptimalNearTheCutLocus) { expect_all_global(near_cut_locus(1800, 22)); }

sh4::LocalExpansion expansion(const Sh4::Vector& v, const Quaternion& q) {
    // Body coordinates: exp(w) q = q exp(R^T w).
    const Matrix3 r = q.toRotationMatrix();
    return {value(v, q), r.transpose() * Sh4::differential(q).transpose() * v, r.transpose() * Sh4::hessian(q, v) * r};
}

TEST(Sh4Certificate, KernelExpandsLikeSh4) {
    std::mt19937_64 generator(30);
    const Vectors inputs = random_inputs(20, 31);
    for (const Sh4::Vector& v : inputs)
        for (const sh4::Kernel& kernel : sh4::kernels()) {
            double form[sh4::form_size], in[32], out[80];
            EXPECT_NEAR(sh4::unit_form(v.data(), form), 1, 1e-15);
            const Quaternion q = random_rotation(generator);
            const Vector4 c = to_wxyz(q);
            for (int k = 0; k < 32; ++k) in[k] = 3 * c[k / 8];
            kernel.expand(form, in, 8, 8, out);
            const sh4::LocalExpansion e = expansion(v, q);
            const int rows[6] = {0, 1, 2, 1, 2, 0}, columns[6] = {0, 1, 2, 2, 0, 1};
            for (int lane = 0; lane < 8; ++lane) {
                EXPECT_NEAR(out[lane], e.value, 1e-14);
                for (int k = 0; k < 3; ++k) EXPECT_NEAR(out[8 * (1 + k) + lane], e.gradient[k], 1e-13);
                for (int k = 0; k < 6; ++k) EXPECT_NEAR(out[8 * (4 + k) + lane], e.hessian(rows[k], columns[k]), 1e-13);
            }
        }
}

TEST(Sh4Certificate, NoSampledFrameExceedsTheBounds) {
    std::mt19937_64 generator(32);
    Vectors inputs = random_inputs(600, 33);
    const Vectors near = near_cut_locus(600, 34);
    for (const Sh4::Vector& v : near) inputs.push_back(v.normalized());
    double tightest = 1;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
        const Sh4::Vector& v = inputs[i];
        const Quaternion q = i % 3 == 0 ? Sh4::project(v).frame : random_rotation(generator);
        const sh4::LocalExpansion e = expansion(v, q);
        const double rho = std::pow(10, -2.5 * uniform01(generator)), radius = sh4::radius_below(e);
        const double upper = sh4::upper_bound(e, rho, i % 2 ? -10 : 10);
        double highest = -1;
        for (int k = 0; k < 400; ++k) {
            const Vector3 u = std::cbrt(uniform01(generator)) * (random_rotation(generator) * Vector3::UnitX());
            highest = std::max(highest, value(v, (q * exp(rho * u)).normalized()));
            if (!(radius > 0)) continue;
            ASSERT_LE(value(v, (q * exp(radius * u)).normalized()), e.value + e.gradient.norm() * radius + 1e-14);
        }
        ASSERT_LE(highest, upper);
        if (i % 2) tightest = std::min(tightest, (upper - highest) / rho);
    }
    EXPECT_LT(tightest, 0.01);
}

TEST(Sh4Certificate, ConstantsOfTheBoundsHoldForTheGenerators) {
    const auto& g = Harmonics<4>::generators();
    const Sh4::Vector a = Sh4::embed(Quaternion::Identity());
    Eigen::Matrix<double, 9, 3> t2;
    t2 << (g[1] * g[2] + g[2] * g[1]) * a, (g[2] * g[0] + g[0] * g[2]) * a, (g[0] * g[1] + g[1] * g[0]) * a;
    EXPECT_LT((t2.transpose() * t2 / 4 - 35.0 / 3 * Matrix3::Identity()).norm(), 1e-12);
    t2 /= 2 * std::sqrt(35.0 / 3);
    double third = 0, t2_part = 0, fourth = 0;
    const Quaternions samples = random_rotations(20000, 35);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        Vector3 u = row_quaternion(samples, i) * Vector3::UnitX();
        if (i == 0) u = {1, 0, 0};
        if (i == 1) u = {std::sqrt(0.5), std::sqrt(0.5), 0};
        const Harmonics<4>::Matrix turn = u[0] * g[0] + u[1] * g[1] + u[2] * g[2];
        const Sh4::Vector cubic = turn * turn * turn * a;
        EXPECT_NEAR((turn * a).norm(), Sh4::speed, 1e-12);
        third = std::max(third, cubic.norm());
        t2_part = std::max(t2_part, (t2.transpose() * cubic).norm());
        fourth = std::max(fourth, (turn * cubic).norm());
    }
    EXPECT_NEAR(third, 16 * Sh4::speed, 1e-9);
    EXPECT_NEAR(t2_part, std::sqrt(945.0) / 2, 1e-9);
    EXPECT_NEAR(fourth, 64 * Sh4::speed, 1e-9);
}

TEST(Sh4Certificate, EndsOnCurvesOfMaximisersAndOnExactTies) {
    std::mt19937_64 generator(36);
    for (int family = 0; family < equidistant_families; ++family)
        for (int i = 0; i < 3; ++i) {
            const CertifiedProjection p = sh4_project_certified(equidistant_sum(family, generator));
            EXPECT_TRUE(p.certified) << family;
            EXPECT_LE(p.gap, 1e-9);
            EXPECT_FALSE(p.improved);
        }
    EXPECT_TRUE(sh4_project_certified(Sh4::axis({0.6, 0, 0.8})).certified);
    EXPECT_TRUE(sh4_project_certified(-Sh4::axis({0.6, 0, 0.8})).certified);
    const CertifiedProjection zero = sh4_project_certified(Sh4::Vector::Zero());
    EXPECT_TRUE(zero.certified);
    EXPECT_EQ(zero.gap, 0);
}

// Without enough boxes the bound is loose but still a bound.
TEST(Sh4Certificate, SaysSoWhenTheBoxesDoNotSuffice) {
    const Sh4::Vector v = Sh4::axis({0.6, 0, 0.8}).normalized();
    for (const std::int64_t boxes : {0, 600, 5000}) {
        const CertifiedProjection p = sh4_project_certified(v, 1e-9, boxes);
        EXPECT_FALSE(p.certified);
        EXPECT_GT(p.gap, 1e-9);
        EXPECT_LE(p.boxes, boxes);
    }
    EXPECT_THROW(sh4_project_certified(v, 0), InvalidInput);
    EXPECT_THROW(sh4_project_certified(v, std::nan("")), InvalidInput);
    EXPECT_THROW(sh4_project_certified(std::nan("") * v), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
