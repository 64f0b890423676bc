#include "octafield/frames/sh4.hpp"

#include <cmath>
#include <numbers>

#include "representation_laws.hpp"

namespace octafield::frames {

namespace {

using std::numbers::pi;

TEST(Sh4, IdentityFrameHasTheTextbookCoefficients) {
    Sh4::Vector expected = Sh4::Vector::Zero();
    expected[4] = std::sqrt(7.0 / 12), expected[8] = std::sqrt(5.0 / 12);
    EXPECT_LT((Sh4::embed(Quaternion::Identity()) - expected).norm(), 1e-15);
}

TEST(Sh4, EmbeddedFramesAreUnitVectors) {
    const Quaternions samples = random_rotations(200, 11);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
        EXPECT_NEAR(Sh4::embed(row_quaternion(samples, i)).norm(), 1, 1e-14);
}

// Huang et al. 2011: a turn by t about z mixes orders m and -m by the angle m t.
TEST(Sh4, RotationAboutZTurnsOrderMByMTimesTheAngle) {
    const Quaternion q = exp({0.3, -1.1, 0.7});
    const Sh4::Vector a = Sh4::embed(q);
    for (const double t : {0.1, 1.0, 2.5}) {
        Sh4::Vector expected;
        for (int m = -4; m <= 4; ++m) expected[m + 4] = std::cos(m * t) * a[m + 4] - std::sin(m * t) * a[4 - m];
        EXPECT_LT((Sh4::embed(exp({0, 0, t}) * q) - expected).norm(), 1e-14);
    }
}

TEST(Sh4, EveryRotationMovesAtSpeedRootTwentyThirds) {
    const Quaternions samples = random_rotations(100, 12);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Sh4::Differential d = Sh4::differential(row_quaternion(samples, i));
        EXPECT_LT((d.transpose() * d - 20.0 / 3 * Matrix3::Identity()).norm(), 1e-12);
    }
}

// DESIGN: the squared Frobenius distance of the fourth-order tensors is 6/5 of the squared sh4 distance.
TEST(Sh4, IsIsometricToTheFourthOrderTensor) {
    const Quaternions a = random_rotations(20, 13), b = random_rotations(20, 14);
    const auto tensor = [](const Quaternion& q, int i, int j, int k, int l) {
        const Matrix3 r = q.toRotationMatrix();
        double sum = 0;
        for (int m = 0; m < 3; ++m) sum += r(i, m) * r(j, m) * r(k, m) * r(l, m);
        return sum;
    };
    for (Eigen::Index row = 0; row < a.rows(); ++row) {
        const Quaternion p = row_quaternion(a, row), q = row_quaternion(b, row);
        double squared = 0;
        for (int n = 0; n < 81; ++n) {
            const int i = n / 27, j = n / 9 % 3, k = n / 3 % 3, l = n % 3;
            squared += std::pow(tensor(p, i, j, k, l) - tensor(q, i, j, k, l), 2);
        }
        EXPECT_NEAR(squared, 1.2 * (Sh4::embed(p) - Sh4::embed(q)).squaredNorm(), 1e-12);
    }
}

TEST(Sh4, ChordalOverGeodesicDistanceVariesByTheKnownFactor) {
    const Quaternions a = random_rotations(200000, 15);
    double least = 1e9, most = 0;
    const Quaternion identity = Quaternion::Identity();
    const Sh4::Vector reference = Sh4::embed(identity);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion q = row_quaternion(a, i);
        const double ratio = (Sh4::embed(q) - reference).norm() / distance(q, identity);
        least = std::min(least, ratio), most = std::max(most, ratio);
    }
    EXPECT_NEAR(most, std::sqrt(20.0 / 3), 0.02);  // attained by small rotations, which random samples only approach
    EXPECT_NEAR(std::sqrt(20.0 / 3) / least, 1.6488, 0.005);
}

TEST(Sh4, AxisHasNormRootFourTwentyFirstsAndSumsToTheFrame) {
    const Quaternions samples = random_rotations(50, 16);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Matrix3 r = row_quaternion(samples, i).toRotationMatrix();
        EXPECT_NEAR(Sh4::axis(r.col(0)).norm(), std::sqrt(4.0 / 21), 1e-14);
        const Sh4::Vector sum = Sh4::axis(r.col(0)) + Sh4::axis(r.col(1)) + Sh4::axis(r.col(2));
        EXPECT_LT((sum - Sh4::embed(row_quaternion(samples, i))).norm(), 1e-14);
    }
}

// Quadrature over the sphere: c Y_4m are orthogonal with squared norm c^2 = 16 pi / 189.
TEST(Sh4, AxisComponentsAreOrthogonalHarmonics) {
    Eigen::Matrix<double, 9, 9> gram = Eigen::Matrix<double, 9, 9>::Zero();
    // Product rule exact for degree 8: 16 equispaced azimuths, 5-point Gauss-Legendre in z.
    const double nodes[5] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831, 0.9061798459386640};
    const double weights[5] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                               0.2369268850561891};
    for (int iz = 0; iz < 5; ++iz)
        for (int ip = 0; ip < 16; ++ip) {
            const double z = nodes[iz], s = std::sqrt(1 - z * z), phi = 2 * pi * ip / 16;
            const Sh4::Vector y = Sh4::axis({s * std::cos(phi), s * std::sin(phi), z});
            gram += weights[iz] * 2 * pi / 16 * y * y.transpose();
        }
    EXPECT_LT((gram - 16 * pi / 189 * Eigen::Matrix<double, 9, 9>::Identity()).norm(), 1e-13);
}

TEST(Sh4, ProjectionIgnoresTheInputsScale) {
    std::mt19937_64 generator(17);
    Sh4::Vector v;
    for (int c = 0; c < 9; ++c) v[c] = normal01(generator);
    const Quaternion q = Sh4::project(v).frame;
    for (const double scale : {1e-200, 1e-9, 1e9, 1e150}) EXPECT_LT(distance(Sh4::project(scale * v).frame, q), 1e-7);
    EXPECT_NEAR(Sh4::project(Sh4::Vector::Zero()).distance, 1, 1e-15);
}

TEST(Sh4, HessianIsTheSecondDerivativeUnderRotationFromTheLeft) {
    const Quaternions samples = random_rotations(50, 18);
    std::mt19937_64 generator(19);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Sh4::Vector v = random_vector<Sh4>(generator);
        const Matrix3 hessian = Sh4::hessian(q, v);
        EXPECT_NEAR(hessian.trace(), -20 * v.dot(Sh4::embed(q)), 1e-12);  // the Laplacian on degree 4: -4 (4 + 1)
        for (int k = 0; k < 9; ++k) {
            const Vector3 w = Vector3(k % 3 - 1, k / 3 - 1, 1).normalized();
            const double h = 1e-3;
            const auto f = [&](double t) { return v.dot(Sh4::embed(exp(t * w) * q)); };
            const double numeric = (16 * (f(h) + f(-h)) - (f(2 * h) + f(-2 * h)) - 30 * f(0)) / (12 * h * h);
            EXPECT_NEAR(w.dot(hessian * w), numeric, 1e-7 * v.norm());
        }
    }
}

TEST(Sh4, RejectsQuaternionsThatAreNotUnit) {
    const Quaternion q(1, 1, 0, 0);
    const Sh4::Vector v = Sh4::Vector::Ones();
    EXPECT_THROW(Sh4::embed(q), InvalidInput);
    EXPECT_THROW(Sh4::differential(q), InvalidInput);
    EXPECT_THROW(Sh4::hessian(q, v), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
