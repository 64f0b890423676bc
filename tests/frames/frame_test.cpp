#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

using std::numbers::pi;
TEST(Quaternion, ExpOfLogIsTheRotation) {
    const Quaternions samples = random_rotations(200, 21);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        EXPECT_NEAR(std::abs(exp(log(q)).dot(q)), 1, 1e-14);
        EXPECT_LE(log(q).norm(), pi + 1e-12);
    }
}

TEST(Quaternion, LogOfExpIsTheVectorDownToTinyAngles) {
    for (const double angle : {0.0, 1e-300, 1e-20, 1e-9, 1e-5, 9.9e-5, 1.01e-4, 0.5, 3.0, 3.14159}) {
        const Vector3 w = angle * Vector3(1, -2, 0.5).normalized();
        EXPECT_LE((log(exp(w)) - w).norm(), 1e-14 * angle) << angle;
    }
}

TEST(Quaternion, ExpMatchesEigensAngleAxis) {
    const Vector3 w(0.4, -0.9, 1.3);
    EXPECT_LT((exp(w).toRotationMatrix() - Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix()).norm(),
              1e-14);
}

TEST(Quaternion, ExpOfAHugeVectorIsAUnitQuaternionAboutIt) {
    const Vector3 axis = Vector3(1, -2, 0.5).normalized();
    for (const double angle : {1e16, 1e100, 1e153, 1e154, 1e155, 1e200, 1e300, 1.5e308}) {
        const Quaternion q = exp(angle * axis);
        EXPECT_NEAR(q.norm(), 1, 1e-15) << angle;
        EXPECT_LT(q.vec().cross(axis).norm(), 1e-15) << angle;
    }
    EXPECT_NEAR(exp(Vector3::Constant(std::numeric_limits<double>::max())).norm(), 1, 1e-15);
}

TEST(Quaternion, RotationBetweenIsExactAtEveryAngleUpToOppositeVectors) {
    const Quaternions samples = random_rotations(300, 41);
    std::vector<double> angles = {0.3, pi / 2, 2, 3};
    for (int k = 1; k <= 16; ++k) angles.push_back(std::pow(10.0, -k));
    for (const double angle : angles)
        for (Eigen::Index i = 0; i < samples.rows(); ++i) {
            const Matrix3 axes = row_quaternion(samples, i).toRotationMatrix();
            const Vector3 from = axes.col(0).normalized(), side = axes.col(1);
            const Vector3 near = (std::cos(angle) * from + std::sin(angle) * side).normalized();
            for (const Vector3& to : {near, Vector3(-near)}) {
                const Quaternion q = rotation_between(from, to);
                EXPECT_NEAR(q.norm(), 1, 1e-15) << angle;
                EXPECT_LT((q * from - to).norm(), 2e-15) << angle;
                const double expected = std::cos(to == near ? angle / 2 : (pi - angle) / 2);
                EXPECT_NEAR(q.w(), expected, 5e-16) << angle << ": the shortest arc";
                EXPECT_LT(std::abs(q.vec().dot(from)), 5e-16) << angle;
            }
        }
    const Vector3 v = Vector3(3, -1, 2).normalized();
    EXPECT_EQ(rotation_between(v, v).w(), 1);
    EXPECT_LT((rotation_between(v, -v) * v + v).norm(), 1e-15);
    EXPECT_LT((rotation_between(1e-300 * v, 1e300 * Vector3::UnitX()) * v - Vector3::UnitX()).norm(), 1e-15);
    EXPECT_THROW(rotation_between(v, Vector3::Zero()), InvalidInput);
    EXPECT_THROW(rotation_between(Vector3(std::nan(""), 0, 0), v), InvalidInput);
}

TEST(Quaternion, FrameFromAxesHasTheNormalAsThirdAxisForAnyDirection) {
    const Vector3 normal = Vector3(1, 2, -0.5).normalized();
    for (const Vector3& direction : {Vector3(0.2, 0.1, 5), normal, Vector3(-3 * normal), Vector3(0, 0, 0)}) {
        const Quaternion q = frame_from_axes(direction, normal);
        EXPECT_LT((q * Vector3::UnitZ() - normal).norm(), 1e-14);
        EXPECT_NEAR(q.norm(), 1, 1e-15);
    }
    const Quaternion q = frame_from_axes({1, 0, 0}, {0, 0, 1});
    EXPECT_LT((q * Vector3::UnitX() - Vector3::UnitX()).norm(), 1e-15);
}

TEST(Quaternion, RandomRotationsAreUniformAndReproducible) {
    const Quaternions q = random_rotations(20000, 5);
    EXPECT_EQ(q, random_rotations(20000, 5));
    EXPECT_NE(q, random_rotations(20000, 6));
    const Eigen::Matrix4d moment = q.transpose() * q / q.rows();  // uniform on the 3-sphere: I / 4
    EXPECT_LT((moment - Eigen::Matrix4d::Identity() / 4).cwiseAbs().maxCoeff(), 0.01);
}

TEST(OctahedralGroup, HasTwentyFourDistinctSignedPermutations) {
    for (int a = 0; a < octahedral_order; ++a) {
        const Matrix3 r = octahedral_group()[a].toRotationMatrix();
        EXPECT_NEAR(r.determinant(), 1, 1e-14);
        for (int i = 0; i < 3; ++i) EXPECT_NEAR(r.col(i).cwiseAbs().maxCoeff(), 1, 1e-14);
        for (int b = 0; b < a; ++b) EXPECT_GT((r - octahedral_group()[b].toRotationMatrix()).norm(), 0.5);
    }
}

TEST(OctahedralGroup, ProductTableAndInversesAgreeWithMatrices) {
    for (int a = 0; a < octahedral_order; ++a) {
        EXPECT_EQ(octahedral_product(a, octahedral_inverse(a)), 0);
        for (int b = 0; b < octahedral_order; ++b) {
            const Matrix3 product = octahedral_group()[a].toRotationMatrix() * octahedral_group()[b].toRotationMatrix();
            EXPECT_LT((octahedral_group()[octahedral_product(a, b)].toRotationMatrix() - product).norm(), 1e-13);
        }
    }
}

TEST(OctahedralGroup, ElementsStandInTheDocumentedOrder) {
    const Vector3 diagonals[8] = {{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                                  {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
    const Vector3 edges[6] = {{1, 1, 0}, {0, 1, 1}, {1, 0, 1}, {-1, 1, 0}, {0, -1, 1}, {1, 0, -1}};
    for (int a = 0; a < octahedral_order; ++a) {
        Vector3 axis = Vector3::Zero();
        double angle = 0;
        if (a >= 1 && a < 4) axis = Vector3::Unit(a - 1), angle = 180;
        if (a >= 4 && a < 10) axis = (a % 2 ? -1 : 1) * Vector3::Unit((a - 4) / 2), angle = 90;
        if (a >= 10 && a < 16) axis = edges[a - 10].normalized(), angle = 180;
        if (a >= 16) axis = diagonals[a - 16].normalized(), angle = 120;
        EXPECT_LT((octahedral_group()[a].toRotationMatrix() - exp(angle * degree * axis).toRotationMatrix()).norm(),
                  1e-14)
            << a;
        const double turn = 2 * std::acos(std::min(1.0, octahedral_group()[a].w())) / degree;
        EXPECT_NEAR(turn, angle, 1e-5);
    }
}

TEST(OctahedralGroup, ClassesHaveTheirSizes) {
    std::array<int, 5> count{};
    for (int a = 0; a < octahedral_order; ++a) ++count[static_cast<int>(octahedral_class(a))];
    EXPECT_EQ(count, (std::array<int, 5>{1, 3, 6, 6, 8}));
}

TEST(Matching, RecoversThePlantedElementAndInvertsWhenSwapped) {
    const Quaternions samples = random_rotations(50, 22);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
        for (int o = 0; o < octahedral_order; ++o) {
            const Quaternion q = row_quaternion(samples, i);
            const Quaternion other = exp({0.05, -0.1, 0.2}) * q * octahedral_group()[o];
            EXPECT_EQ(matching(q, other), o);
            EXPECT_EQ(matching(other, q), octahedral_inverse(o));
            EXPECT_NEAR(closest_representative(q, other).angularDistance(other), distance(q, other), 1e-7);
        }
}

// Mackenzie 1958: distribution of the misorientation angle of random cube pairs.
TEST(Distance, OfRandomPairsFollowsTheMackenzieDistribution) {
    const Quaternions a = random_rotations(100000, 23), b = random_rotations(100000, 24);
    double sum = 0, most = 0;
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const double d = distance(row_quaternion(a, i), row_quaternion(b, i));
        sum += d;
        most = std::max(most, d);
    }
    EXPECT_GT(sum / a.rows(), 40.65 * degree);
    EXPECT_LT(sum / a.rows(), 40.85 * degree);
    EXPECT_LT(most, 62.7994 * degree + 1e-6);
    EXPECT_GT(most, 61 * degree);
}

TEST(Distance, IsAMetricOnFramesAndExactForSmallAngles) {
    const Quaternions samples = random_rotations(300, 25);
    for (Eigen::Index i = 0; i + 2 < samples.rows(); ++i) {
        const Quaternion p = row_quaternion(samples, i), q = row_quaternion(samples, i + 1),
                         r = row_quaternion(samples, i + 2);
        EXPECT_NEAR(distance(p, q), distance(q, p), 1e-14);
        EXPECT_LE(distance(p, r), distance(p, q) + distance(q, r) + 1e-14);
        EXPECT_NEAR(distance(r * p, r * q), distance(p, q), 1e-13);
    }
    EXPECT_NEAR(distance(Quaternion::Identity(), exp({1e-9, 0, 0})), 1e-9, 1e-16);
}

TEST(Distance, LargestIsAttainedByTheKnownRotation) {
    // 62.7994 degrees: half the trace relation cos = (2 sqrt 2 - 1) / 4 (Handscomb 1958).
    EXPECT_NEAR(std::acos((2 * std::numbers::sqrt2 - 1) / 4) / degree, 62.7994, 1e-4);
}

}  // namespace
}  // namespace octafield::frames
