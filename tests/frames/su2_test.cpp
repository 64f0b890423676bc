#include "octafield/frames/su2.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "representation_laws.hpp"
#include "su2_points.hpp"

namespace octafield::frames {

namespace {

using std::numbers::pi;

Vector3 unit_vector(std::mt19937_64& g) { return Vector3(normal01(g), normal01(g), normal01(g)).normalized(); }

// Smallest angle between n and an axis of the frame.
double axis_angle(const Quaternion& q, const Vector3& n) {
    const Matrix3 r = q.toRotationMatrix();
    double least = pi;
    for (int k = 0; k < 3; ++k)
        least = std::min(least, std::atan2(r.col(k).cross(n).norm(), std::abs(r.col(k).dot(n))));
    return least;
}

TEST(Su2, IdentityFrameIsOneZeroZero) { EXPECT_LT((point(Quaternion::Identity()) - Complex3(1, 0, 0)).norm(), 1e-15); }

// A frame with a body diagonal along world x: h0 = 0; with one along x and |(u v)^2| = 1/6 for all axes, |h1| = 2/27.
TEST(Su2, BodyDiagonalAlongXHasNoFirstInvariant) {
    const Complex3 h = point(rotation_between(Vector3(1, 1, 1).normalized(), Vector3::UnitX()));
    EXPECT_LT(std::abs(h[0]), 1e-15);
    EXPECT_NEAR(std::abs(h[1]), 2.0 / 27, 1e-15);
    EXPECT_NEAR(std::norm(h[2]), 108 * std::pow(2.0 / 27, 3), 1e-14);
}

TEST(Su2, EmbeddedFramesLieOnTheModelSurface) {
    const Quaternions samples = random_rotations(500, 41);
    for (Eigen::Index i = 0; i < samples.rows(); ++i)
        EXPECT_LT(std::abs(Su2::surface_residual(point(row_quaternion(samples, i)))), 1e-15);
}

TEST(Su2, TurnsAboutWorldXArePhases) {
    const Quaternion q = exp({0.3, -1.1, 0.7});
    const Complex3 h = point(q);
    for (const double t : {0.1, 1.0, 2.5}) {
        const Complex3 expected(std::polar(1.0, 4 * t) * h[0], std::polar(1.0, 6 * t) * h[1],
                                std::polar(1.0, 9 * t) * h[2]);
        EXPECT_LT((point(exp({t, 0, 0}) * q) - expected).norm(), 1e-14);
    }
}

TEST(Su2, HalfTurnAboutXTurnsOnlyTheSignOfTheLastInvariant) {
    const Complex3 h = point(exp({0.3, -1.1, 0.7})), k = point(exp({pi, 0, 0}) * exp({0.3, -1.1, 0.7}));
    EXPECT_LT((k - Complex3(h[0], h[1], -h[2])).norm(), 1e-14);
}

// Header: x_k = -(n_y + i n_z)^2 / 4 over the axes are the roots of 16 x^3 - h0 x + h1.
TEST(Su2, AxesAreTheRootsOfTheCubic) {
    const Quaternions samples = random_rotations(200, 42);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Matrix3 r = row_quaternion(samples, i).toRotationMatrix();
        const Complex3 h = point(row_quaternion(samples, i));
        for (int k = 0; k < 3; ++k) {
            const Complex x = -std::pow(Complex(r(1, k), r(2, k)), 2) / 4.0;
            EXPECT_LT(std::abs(16.0 * x * x * x - h[0] * x + h[1]), 1e-15);
        }
    }
}

TEST(Su2, JacobianIsTheComplexDerivative) {
    std::mt19937_64 generator(43);
    for (int trial = 0; trial < 50; ++trial) {
        const Complex u(normal01(generator), normal01(generator)), v(normal01(generator), normal01(generator));
        const double size = std::sqrt(std::norm(u) + std::norm(v));
        const Complex a = u / size, b = v / size;
        const Su2::Jacobian j = Su2::jacobian(a, b);
        const double h = 1e-5;
        for (const Complex& step : {Complex(h, 0), Complex(0, h)}) {
            EXPECT_LT(((Su2::invariants(a + step, b) - Su2::invariants(a - step, b)) / (2.0 * step) - j.col(0)).norm(),
                      1e-7);
            EXPECT_LT(((Su2::invariants(a, b + step) - Su2::invariants(a, b - step)) / (2.0 * step) - j.col(1)).norm(),
                      1e-7);
        }
    }
}

TEST(Su2, SingularValuesOfTheJacobianStayInTheKnownRange) {
    const Quaternions samples = random_rotations(50000, 44);
    double least = 9, most = 0;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Su2::Jacobian j = Su2::jacobian({q.w(), q.x()}, {q.y(), q.z()});
        const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2cd> eigen(j.adjoint() * j, Eigen::EigenvaluesOnly);
        least = std::min(least, std::sqrt(eigen.eigenvalues()[0]));
        most = std::max(most, std::sqrt(eigen.eigenvalues()[1]));
    }
    EXPECT_GT(least, 0.3018);
    EXPECT_LT(least, 0.304);
    EXPECT_LT(most, 8 + 1e-12);
    // The largest is attained at the identity.
    const Su2::Jacobian j = Su2::jacobian(1, 0);
    Eigen::Matrix2cd expected = Eigen::Matrix2cd::Zero();
    expected(0, 0) = 64, expected(1, 1) = 1;
    EXPECT_LT((j.adjoint() * j - expected).norm(), 1e-13);
    EXPECT_GT(most, 7.98);
}

TEST(Su2, MeanSquaresOverTheSphereAreTheBandWeights) {
    const auto& rule = haar_rule();
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < rule.rotations.size(); ++k)
        sum += rule.weights[k] * point(rule.rotations[k]).cwiseAbs2();
    EXPECT_LT((sum - Vector3(8.0 / 15, 8.0 / 3003, 8.0 / 399)).norm(), 1e-13);
}

TEST(Su2Axis, TurnedFramesHaveTheAxisAndPeriodAQuarterTurn) {
    std::mt19937_64 generator(45);
    for (int trial = 0; trial < 200; ++trial) {
        const Vector3 n = unit_vector(generator);
        const Su2Axis axis(n);
        const double t = 7 * uniform01(generator);
        EXPECT_LT(distance(axis.turn_frame(0), rotation_between(Vector3::UnitX(), n)), 1e-7);
        EXPECT_LT(distance(axis.turn_frame(t), exp(t * n) * rotation_between(Vector3::UnitX(), n)), 1e-7);
        EXPECT_LT((axis.turn_frame(t) * Vector3::UnitX() - n).norm(), 1e-14);
        EXPECT_LT((axis.turn(t) - point(axis.turn_frame(t))).norm(), 1e-14);
        EXPECT_LT((axis.turn(t) - axis.turn(t + pi / 2)).norm(), 1e-13);
    }
}

TEST(Su2Axis, TurnsRunRoundTheEllipses) {
    std::mt19937_64 generator(46);
    std::vector<Vector3> axes = {Vector3::UnitX(), -Vector3::UnitX(), Vector3::UnitY(), Vector3::UnitZ()};
    for (int trial = 0; trial < 100; ++trial) axes.push_back(unit_vector(generator));
    for (const Vector3& n : axes) {
        const Su2Axis axis(n);
        const auto e = axis.ellipse();
        EXPECT_NEAR(std::abs(e.plus), std::pow((1 + n.x()) / 2, 4), 1e-14);
        EXPECT_NEAR(std::abs(e.minus), std::pow((1 - n.x()) / 2, 4), 1e-14);
        for (const double t : {0.0, 0.2, 1.3}) {
            const Complex swing = e.plus * std::polar(1.0, 4 * t) + e.minus * std::polar(1.0, -4 * t);
            const Complex3 h = axis.turn(t);
            EXPECT_LT(std::abs(h[0] - (e.center0 + swing)), 1e-14);
            EXPECT_LT(std::abs(h[1] - (e.center1 + e.ratio * swing)), 1e-14);
        }
    }
}

TEST(Su2Axis, ResidualVanishesExactlyOnFramesWithTheAxis) {
    const Quaternions samples = random_rotations(300, 47);
    std::mt19937_64 generator(48);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        for (int k = 0; k < 3; ++k)
            for (const double sign : {1.0, -1.0}) {
                const auto zero = Su2Axis(sign * q.toRotationMatrix().col(k)).residual(point(q));
                EXPECT_LT(std::abs(zero[0]) + std::abs(zero[1]), 1e-14);
            }
        const Vector3 n = unit_vector(generator);
        const auto other = Su2Axis(n).residual(point(q));
        EXPECT_GT(std::abs(other[0]) + std::abs(other[1]), 1e-4 * std::pow(axis_angle(q, n), 3));
    }
}

TEST(Su2, SecondDerivativesAreThoseOfTheJacobian) {
    std::mt19937_64 generator(50);
    const auto number = [&] { return Complex(2 * uniform01(generator) - 1, 2 * uniform01(generator) - 1); };
    for (int trial = 0; trial < 100; ++trial) {
        const Complex u = number(), v = number(), du = 1e-6 * number(), dv = 1e-6 * number();
        const Su2::Jacobian change = Su2::jacobian(u + du, v + dv) - Su2::jacobian(u - du, v - dv);
        const auto second = Su2::second_derivatives(u, v);
        for (int i = 0; i < 3; ++i) {
            const Eigen::Matrix<Complex, 2, 1> step(2.0 * du, 2.0 * dv);
            EXPECT_LT((second[i] * step - change.row(i).transpose()).norm(),
                      1e-9 * second[i].norm() * step.norm() + 1e-14 * Su2::jacobian(u, v).norm());
            EXPECT_LT(std::abs(second[i](0, 1) - second[i](1, 0)), 1e-14 * second[i].norm());
        }
    }
}

TEST(Su2Axis, OnlyTheSecondResidualTellsTheMirrorImage) {
    std::mt19937_64 generator(49);
    for (int trial = 0; trial < 200; ++trial) {
        const Vector3 n = unit_vector(generator), mirrored(-n.x(), n.y(), n.z());
        const Complex3 h = Su2Axis(n).turn(uniform01(generator));
        const auto r = Su2Axis(mirrored).residual(h);
        EXPECT_LT(std::abs(r[0]), 1e-15);
        const double p = std::pow((1 + n.x()) / 2, 4), m = std::pow((1 - n.x()) / 2, 4);
        EXPECT_NEAR(std::abs(r[1]), 2 * std::abs((p * p - m * m) * h[2]), 1e-14);
    }
}

TEST(Su2Axis, StaysAccurateNearTheXAxis) {
    for (const double sign : {1.0, -1.0})
        for (int k = 0; k <= 17; ++k) {
            const double s = k == 17 ? 0 : std::pow(10.0, -k);
            const Vector3 n = Vector3(sign, 0.6 * s, 0.8 * s).normalized();
            EXPECT_LT((Su2Axis(n).turn_frame(0.4) * Vector3::UnitX() - n).norm(), 2e-15);
        }
}

TEST(Su2Axis, AxisMustBeAUnitVector) {
    EXPECT_THROW(Su2Axis(Vector3(0, 0, 0)), InvalidInput);
    EXPECT_THROW(Su2Axis(Vector3(1, 1, 0)), InvalidInput);
    EXPECT_THROW(Su2Axis(Vector3(std::nan(""), 0, 0)), InvalidInput);
    for (const double size : {1e-300, 1e-200, 1e200, 1e300}) {
        try {
            const Su2Axis axis(size * Vector3(1, 1, 0));
            ADD_FAILURE() << "accepted " << size;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "not_unit_vector");
            EXPECT_LT(std::string(error.what()).size(), 100u);
            EXPECT_EQ(std::string(error.what()).find("inf"), std::string::npos) << error.what();
            EXPECT_EQ(std::string(error.what()).find("norm 0;"), std::string::npos) << error.what();
        }
    }
}

}  // namespace
}  // namespace octafield::frames
