#include "octafield/frames/harmonics.hpp"

#include <Eigen/SVD>
#include <cmath>
#include <numbers>

#include "octafield/frames/sh4.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

using std::numbers::pi;

template <class H>
class HarmonicsTest : public ::testing::Test {
public:
    static constexpr int degree = (H::size - 1) / 2;
};
using Degrees = ::testing::Types<Harmonics<2>, Harmonics<4>, Harmonics<6>, Harmonics<8>, Harmonics<9>>;
TYPED_TEST_SUITE(HarmonicsTest, Degrees);

std::vector<Quaternion> test_rotations(int n, std::uint64_t seed) {
    std::vector<Quaternion> list = nasty_frames();
    const Quaternions samples = random_rotations(n, seed);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) list.push_back(row_quaternion(samples, i));
    return list;
}

std::vector<Vector3> test_directions() {
    std::vector<Vector3> list;
    for (const Quaternion& q : test_rotations(30, 41)) list.push_back((q * Vector3::UnitZ()).normalized());
    return list;
}

// Associated Legendre function by the standard library (no Condon-Shortley phase), normalised here.
double textbook_value(int l, int m, const Vector3& x) {
    const int n = std::abs(m);
    double factor = (2 * l + 1) / (4 * pi) * (m == 0 ? 1 : 2);
    for (int k = l - n + 1; k <= l + n; ++k) factor /= k;
    const double azimuth = std::atan2(x.y(), x.x());
    return std::sqrt(factor) * std::assoc_legendre(l, n, std::clamp(x.z(), -1.0, 1.0)) *
           (m < 0 ? std::sin(n * azimuth) : std::cos(n * azimuth));
}

TYPED_TEST(HarmonicsTest, ValuesAreTheTextbookOnes) {
    constexpr int l = TestFixture::degree;
    for (const Vector3& x : test_directions()) {
        const auto y = TypeParam::evaluate(x);
        // The textbook's sine sqrt(1 - z^2) loses half the digits at the poles.
        const double accuracy = std::hypot(x.x(), x.y()) < 1e-3 ? 1e-7 : 1e-12;
        for (int m = -l; m <= l; ++m) EXPECT_NEAR(y[l + m], textbook_value(l, m, x), accuracy) << l << " " << m;
    }
}

// Unsoeld's theorem: the squares of all orders add to (2 l + 1) / (4 pi) in every direction, the poles included.
TYPED_TEST(HarmonicsTest, SquaresAddToTheSameEverywhere) {
    for (const Vector3& x : test_directions())
        EXPECT_NEAR(TypeParam::evaluate(x).squaredNorm(), TypeParam::size / (4 * pi), 1e-14);
}

TYPED_TEST(HarmonicsTest, OrdersNearThePolesKeepTheirRelativeAccuracy) {
    constexpr int l = TestFixture::degree;
    for (const double s : {1e-3, 1e-8, 1e-20}) {
        const auto y = TypeParam::evaluate({s * std::cos(0.3), s * std::sin(0.3), std::sqrt(1 - s * s)});
        // Y_l1 ~ sqrt((2 l + 1) l (l + 1) / (8 pi)) s cos(azimuth) to first order.
        const double slope = std::sqrt((2 * l + 1) * l * (l + 1) / (8 * pi)) * s;
        EXPECT_NEAR(y[l + 1] / (slope * std::cos(0.3)), 1, 1e-14 + 50 * s * s);
        EXPECT_NEAR(y[l - 1] / (slope * std::sin(0.3)), 1, 1e-14 + 50 * s * s);
    }
}

// Quadrature of the sphere from the Haar rule: its rotations carry the z axis to a product rule, exact to degree 18.
TYPED_TEST(HarmonicsTest, AreOrthonormal) {
    typename TypeParam::Matrix gram = TypeParam::Matrix::Zero();
    for (std::size_t k = 0; k < haar_rule().rotations.size(); ++k) {
        const auto y = TypeParam::evaluate((haar_rule().rotations[k] * Vector3::UnitZ()).normalized());
        gram += 4 * pi * haar_rule().weights[k] * y * y.transpose();
    }
    EXPECT_LT((gram - TypeParam::Matrix::Identity()).norm(), 1e-12);
}

TYPED_TEST(HarmonicsTest, RotationCarriesTheValuesAlong) {
    const std::vector<Vector3> directions = test_directions();
    const std::vector<Quaternion> rotations = test_rotations(50, 42);
    for (std::size_t i = 0; i < rotations.size(); ++i) {
        const Vector3& x = directions[i % directions.size()];
        const auto expected = TypeParam::evaluate((rotations[i] * x).normalized());
        EXPECT_LT((TypeParam::rotation(rotations[i]) * TypeParam::evaluate(x) - expected).norm(), 3e-14);
    }
}

TYPED_TEST(HarmonicsTest, RotationIsAnOrthogonalHomomorphism) {
    const std::vector<Quaternion> rotations = test_rotations(50, 43);
    for (std::size_t i = 0; i + 1 < rotations.size(); ++i) {
        const Quaternion &g = rotations[i], &h = rotations[i + 1];
        const auto d = TypeParam::rotation(g);
        EXPECT_LT((d * d.transpose() - TypeParam::Matrix::Identity()).norm(), 1e-13);
        EXPECT_LT((d * TypeParam::rotation(h) - TypeParam::rotation(g * h)).norm(), 1e-13);
        EXPECT_LT((TypeParam::rotation(Quaternion(-g.coeffs())) - d).norm(), 1e-13);
    }
    EXPECT_LT((TypeParam::rotation(Quaternion::Identity()) - TypeParam::Matrix::Identity()).norm(), 1e-14);
}

TYPED_TEST(HarmonicsTest, RotateIsTheMatrixTimesTheVector) {
    std::mt19937_64 generator(44);
    for (const Quaternion& g : test_rotations(20, 45)) {
        typename TypeParam::Vector c;
        for (int i = 0; i < TypeParam::size; ++i) c[i] = normal01(generator);
        EXPECT_LT((TypeParam::rotate(g, c) - TypeParam::rotation(g) * c).norm(), 1e-13);
    }
}

TYPED_TEST(HarmonicsTest, GeneratorsAreTheDerivativesOfRotationsAndCommuteAsAxesDo) {
    const auto& g = TypeParam::generators();
    constexpr double l = TestFixture::degree, h = 1e-5;
    for (int k = 0; k < 3; ++k) {
        EXPECT_EQ(g[k], -g[k].transpose());
        const auto &a = g[(k + 1) % 3], &b = g[(k + 2) % 3];
        EXPECT_LT((a * b - b * a - g[k]).norm(), 1e-13);
        const Vector3 w = h * Vector3::Unit(k);
        EXPECT_LT(((TypeParam::rotation(exp(w)) - TypeParam::rotation(exp(-w))) / (2 * h) - g[k]).norm(), 1e-7);
    }
    EXPECT_LT((g[0] * g[0] + g[1] * g[1] + g[2] * g[2] + l * (l + 1) * TypeParam::Matrix::Identity()).norm(), 1e-12);
}

TYPED_TEST(HarmonicsTest, DerivativesAreTheGeneratorsTimesTheVector) {
    const auto c = TypeParam::evaluate(Vector3(0.4, -0.5, 0.7).normalized());
    for (int k = 0; k < 3; ++k)
        EXPECT_LT((TypeParam::derivatives(c).col(k) - TypeParam::generators()[k] * c).norm(), 1e-14);
}

// The fixed space of O is the image of the mean over its 24 rotations: of dimension 1 (0 in degree 2), spanned by
// octahedral().
TYPED_TEST(HarmonicsTest, TheOctahedralVectorIsTheOnlyInvariant) {
    typename TypeParam::Matrix mean = TypeParam::Matrix::Zero();
    const auto& a = TypeParam::octahedral();
    for (const Quaternion& o : octahedral_group()) {
        mean += TypeParam::rotation(o) / octahedral_order;
        EXPECT_LT((TypeParam::rotation(o) * a - a).norm(), 1e-14);
    }
    EXPECT_LT((mean - a * a.transpose()).norm(), 1e-14);
    EXPECT_NEAR(a.norm(), TestFixture::degree == 2 ? 0 : 1, 1e-15);
}

TYPED_TEST(HarmonicsTest, UnusableInputIsATypedError) {
    const double nan = std::nan("");
    using Vector = typename TypeParam::Vector;
    EXPECT_THROW(TypeParam::evaluate(Vector3(0, 0, 2)), InvalidInput);
    EXPECT_THROW(TypeParam::evaluate(Vector3(0, 0, 0)), InvalidInput);
    EXPECT_THROW(TypeParam::evaluate(Vector3(nan, 0, 1)), InvalidInput);
    EXPECT_THROW(TypeParam::rotation(Quaternion(1, 1, 0, 0)), InvalidInput);
    EXPECT_THROW(TypeParam::rotate(Quaternion(nan, 0, 0, 0), Vector::Zero()), InvalidInput);
    EXPECT_THROW(TypeParam::rotate(Quaternion::Identity(), Vector::Constant(nan)), InvalidInput);
}

TEST(Harmonics, SignsOfTheOctahedralVectorsAreAsDocumented) {
    EXPECT_LT((Harmonics<4>::octahedral() - Sh4::embed(Quaternion::Identity())).norm(), 1e-15);
    EXPECT_GT(Harmonics<6>::octahedral()[6], 0);
    EXPECT_GT(Harmonics<8>::octahedral()[8], 0);
    EXPECT_GT(Harmonics<9>::octahedral()[9 - 4], 0);
}

// The even degrees are invariant under the full cube group, degree 9 changes sign under inversion: a chiral form,
// x y z (x2 - y2)(y2 - z2)(z2 - x2) on the sphere.
TEST(Harmonics, TheOctahedralFunctionOfDegreeNineIsTheAntisymmetricProduct) {
    const auto product = [](const Vector3& p) {
        const double x = p.x() * p.x(), y = p.y() * p.y(), z = p.z() * p.z();
        return p.prod() * (x - y) * (y - z) * (z - x);
    };
    const auto value = [](const Vector3& p) { return Harmonics<9>::octahedral().dot(Harmonics<9>::evaluate(p)); };
    const Vector3 at = Vector3(0.3, -0.8, 0.5).normalized();
    const double ratio = value(at) / product(at);
    for (const Vector3& x : test_directions()) EXPECT_NEAR(value(x), ratio * product(x), 1e-13);
}

}  // namespace
}  // namespace octafield::frames
