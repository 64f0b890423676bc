#include "octafield/frames/binary_groups.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

double apart(const Quaternion& p, const Quaternion& q) { return (p.coeffs() - q.coeffs()).norm(); }

bool contains(BinaryGroup group, const Quaternion& q) {
    for (const Quaternion& o : elements(group))
        if (apart(o, q) < 1e-14) return true;
    return false;
}

Quaternion power(const Quaternion& q, int n) { return n == 0 ? Quaternion::Identity() : q * power(q, n - 1); }

// Quaternions of any norm about 1: the forms are homogeneous, not only defined on the sphere.
std::vector<Quaternion> scaled_samples() {
    std::vector<Quaternion> list = nasty_frames();
    const Quaternions rotations = random_rotations(50, 31);
    for (Eigen::Index i = 0; i < rotations.rows(); ++i)
        list.emplace_back((0.8 + 0.008 * static_cast<double>(i)) * row_quaternion(rotations, i).coeffs());
    return list;
}

class BinaryGroups : public ::testing::TestWithParam<BinaryGroup> {};
INSTANTIATE_TEST_SUITE_P(All, BinaryGroups, ::testing::ValuesIn(all_binary_groups),
                         [](const auto& info) { return std::string(name_of(info.param)); });

TEST_P(BinaryGroups, IsAGroupOfTheKnownOrderWithTheIdentityFirst) {
    const auto& group = elements(GetParam());
    const std::size_t orders[] = {8, 24, 48, 120};
    ASSERT_EQ(group.size(), orders[static_cast<int>(GetParam())]);
    EXPECT_EQ(apart(group[0], Quaternion::Identity()), 0);
    for (std::size_t i = 0; i < group.size(); ++i) {
        EXPECT_NEAR(group[i].norm(), 1, 1e-15);
        for (std::size_t j = 0; j < group.size(); ++j) {
            if (i < j) {
                EXPECT_GT(apart(group[i], group[j]), 0.6);
            }
            EXPECT_TRUE(contains(GetParam(), group[i] * group[j]));
        }
    }
}

TEST_P(BinaryGroups, GeneratorsObeyTheRelationsAndGenerateTheGroup) {
    const Generators g = generators(GetParam());
    const Quaternion minus(-1, 0, 0, 0);
    EXPECT_LT(apart(power(g.a, g.p), minus), 1e-14);
    EXPECT_LT(apart(power(g.b, g.q), minus), 1e-14);
    EXPECT_LT(apart(g.c * g.c, minus), 1e-14);
    EXPECT_LT(apart(g.a * g.b * g.c, minus), 1e-14);
    EXPECT_NEAR(g.a.w(), std::cos(std::numbers::pi / g.p), 1e-15);
    EXPECT_NEAR(g.b.w(), std::cos(std::numbers::pi / g.q), 1e-15);
    std::vector<Quaternion> reached = {Quaternion::Identity()};
    for (std::size_t i = 0; i < reached.size(); ++i)
        for (const Quaternion& o : {g.a, g.b, g.c}) {
            const Quaternion next = reached[i] * o;
            EXPECT_TRUE(contains(GetParam(), next));
            bool known = false;
            for (const Quaternion& r : reached) known = known || apart(r, next) < 1e-12;
            if (!known) reached.push_back(next);
        }
    EXPECT_EQ(reached.size(), elements(GetParam()).size());
}

TEST_P(BinaryGroups, InvariantsAreUnchangedByTheGroupOnTheRight) {
    for (const Quaternion& q : scaled_samples())
        for (const Quaternion& o : elements(GetParam()))
            EXPECT_LT((invariants(GetParam(), q * o) - invariants(GetParam(), q)).norm(), 1e-12);
}

TEST_P(BinaryGroups, InvariantsAreHomogeneousOfTheirDegrees) {
    const auto degrees = invariant_degrees(GetParam());
    for (const Quaternion& q : scaled_samples()) {
        const Complex3 f = invariants(GetParam(), q);
        const Complex3 scaled = invariants(GetParam(), Quaternion(1.1 * q.coeffs()));
        for (int i = 0; i < 3; ++i) EXPECT_LT(std::abs(scaled[i] - std::pow(1.1, degrees[i]) * f[i]), 1e-12);
    }
}

TEST_P(BinaryGroups, InvariantsObeyTheRelation) {
    for (const Quaternion& q : scaled_samples()) {
        EXPECT_LT(std::abs(relation_residual(GetParam(), invariants(GetParam(), q))), 1e-11);
    }
    // Not identically zero: moved points leave the surface.
    Complex3 f = invariants(GetParam(), exp({0.3, -1.1, 0.7}));
    f[0] += 0.1;
    EXPECT_GT(std::abs(relation_residual(GetParam(), f)), 1e-3);
}

// By Bezout d0 d1 pairs (u, v) have given f0 and f1: one orbit of the group for either sign of f2.
TEST_P(BinaryGroups, DegreesMatchTheOrder) {
    const auto d = invariant_degrees(GetParam());
    EXPECT_EQ(static_cast<std::size_t>(d[0] * d[1]), 2 * elements(GetParam()).size());
    EXPECT_EQ(d[0] + d[1], d[2] + 2);
}

TEST_P(BinaryGroups, InvariantsSeparateQuaternionsThatNoElementJoins) {
    const Quaternions rotations = random_rotations(200, 32);
    for (Eigen::Index i = 0; i + 1 < rotations.rows(); ++i) {
        const Quaternion p = row_quaternion(rotations, i), q = row_quaternion(rotations, i + 1);
        double nearest = 2;
        for (const Quaternion& o : elements(GetParam())) nearest = std::min(nearest, apart(p * o, q));
        EXPECT_GT((invariants(GetParam(), p) - invariants(GetParam(), q)).norm(), 0.01 * nearest);
    }
}

TEST_P(BinaryGroups, NamesGoBothWays) { EXPECT_EQ(binary_group(name_of(GetParam())), GetParam()); }

TEST(BinaryGroup, SmallerGroupsLieInLargerOnes) {
    for (const Quaternion& o : elements(BinaryGroup::vierer)) EXPECT_TRUE(contains(BinaryGroup::tetrahedral, o));
    for (const Quaternion& o : elements(BinaryGroup::tetrahedral)) {
        EXPECT_TRUE(contains(BinaryGroup::octahedral, o));
        EXPECT_TRUE(contains(BinaryGroup::icosahedral, o));
    }
    const auto& octahedral = elements(BinaryGroup::octahedral);
    for (std::size_t i = 0; i < octahedral.size(); ++i)
        EXPECT_EQ(apart(octahedral[i], binary_octahedral_group()[i]), 0);
}

// A larger group's invariants vary over a smaller group's, and not the other way round.
TEST(BinaryGroup, TetrahedralInvariantsTellAQuarterTurn) {
    const Quaternion q = exp({0.3, -1.1, 0.7}), quarter = exp({std::numbers::pi / 2, 0, 0});
    const Complex3 f = invariants(BinaryGroup::tetrahedral, q), g = invariants(BinaryGroup::tetrahedral, q * quarter);
    EXPECT_LT(std::abs(f[0] + g[0]) + std::abs(f[1] - g[1]) + std::abs(f[2] + g[2]), 1e-14);
    EXPECT_GT(std::abs(f[0]), 0.01);
}

// Thesis (4.25) as printed, u = q0 - i q1 and v = q2 + i q3: invariant under the group on the wrong side.
TEST(BinaryGroup, PrintedPairOfTheThesisIsInvariantOnTheLeft) {
    const auto printed = [](const Quaternion& q) {
        return invariants(BinaryGroup::octahedral, {q.w(), -q.x(), q.y(), q.z()});
    };
    const Quaternion q = exp({0.3, -1.1, 0.7});
    double left = 0, right = 0;
    for (const Quaternion& o : elements(BinaryGroup::octahedral)) {
        left = std::max(left, (printed(o * q) - printed(q)).norm());
        right = std::max(right, (printed(q * o) - printed(q)).norm());
    }
    EXPECT_LT(left, 1e-14);
    EXPECT_GT(right, 0.1);
}

// The roots of the quadratic form of an axis (header) are what its rotations fix.
TEST(BinaryGroup, IcosahedralFormsAreTheProductsOverTheAxes) {
    const auto axis_form = [](const Vector3& n, const Quaternion& q) {
        const Complex u(q.w(), q.x()), v(q.y(), q.z()), b(n.y(), n.z());
        return b * u * u - Complex(0, 2 * n.x()) * u * v + std::conj(b) * v * v;
    };
    const double half_angles[3] = {std::numbers::pi / 5, std::numbers::pi / 3, std::numbers::pi / 2};
    const std::size_t counts[3] = {6, 10, 15};
    for (int f = 0; f < 3; ++f) {
        std::vector<Vector3> axes;
        for (const Quaternion& o : elements(BinaryGroup::icosahedral)) {
            if (std::abs(o.w() - std::cos(half_angles[f])) > 1e-12) continue;
            const Vector3 n = o.vec().normalized();
            bool known = false;
            for (const Vector3& a : axes) known = known || std::abs(std::abs(a.dot(n)) - 1) < 1e-12;
            if (!known) axes.push_back(n);
        }
        ASSERT_EQ(axes.size(), counts[f]);
        Complex ratio = 0;
        for (const Quaternion& q : scaled_samples()) {
            Complex product = 1;
            for (const Vector3& n : axes) product *= axis_form(n, q);
            const Complex form = invariants(BinaryGroup::icosahedral, q)[f];
            if (ratio == 0.0 && std::abs(form) > 0.01) ratio = product / form;
            EXPECT_LT(std::abs(product - ratio * form), 1e-10 * (1 + std::abs(ratio)));
        }
    }
}

TEST(BinaryGroup, BadInputIsATypedError) {
    EXPECT_THROW(binary_group("dodecahedral"), InvalidInput);
    for (const double bad : {std::nan(""), std::numeric_limits<double>::infinity()})
        EXPECT_THROW(invariants(BinaryGroup::octahedral, {1, bad, 0, 0}), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
