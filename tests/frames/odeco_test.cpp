#include "octafield/frames/odeco.hpp"

#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/frames/tensor4.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {

namespace {

using std::numbers::pi;

Vector3 random_lengths(std::mt19937_64& generator) {
    return {normal01(generator), normal01(generator), normal01(generator)};
}

// The function on the sphere with these coordinates in harmonics of degrees 0, 2, 4.
double harmonic_value(const Odeco::Vector& v, const Vector3& x) {
    return v[0] / std::sqrt(4 * pi) + v.segment<5>(1).dot(Harmonics<2>::evaluate(x)) +
           v.tail<9>().dot(Harmonics<4>::evaluate(x));
}

double polynomial(const Quaternion& q, const Vector3& lengths, const Vector3& x) {
    return lengths.dot((q.toRotationMatrix().transpose() * x).array().pow(4).matrix());
}

// The tensor of the polynomial with these coordinates, by least squares on sampled directions (exact: 15 unknowns).
Tensor4::Full tensor_of(const Odeco::Vector& v) {
    const Quaternions samples = random_rotations(60, 91);
    Eigen::Matrix<double, 60, 15> powers;
    Eigen::Matrix<double, 60, 1> values;
    for (int i = 0; i < 60; ++i) {
        const Vector3 x = (row_quaternion(samples, i) * Vector3::UnitZ()).normalized();
        Eigen::Matrix<double, 9, 1> square;
        for (int n = 0; n < 9; ++n) square[n] = x[n / 3] * x[n % 3];
        powers.row(i) = Tensor4::from_full(square * square.transpose()).transpose();
        values[i] = harmonic_value(v, x);
    }
    return Tensor4::full(powers.colPivHouseholderQr().solve(values));
}

// Palmer, Bommes, Solomon 2020: the entries of the commutators of the contractions A_ij..
Eigen::VectorXd odeco_equations(const Tensor4::Full& a) {
    std::vector<Matrix3> contractions;
    for (const int ij : {0, 1, 2, 4, 5, 8}) contractions.push_back(a.row(ij).reshaped(3, 3));
    Eigen::VectorXd entries(45);
    int row = 0;
    for (int p = 0; p < 6; ++p)
        for (int q = 0; q < p; ++q) {
            const Matrix3 c = contractions[p] * contractions[q] - contractions[q] * contractions[p];
            entries[row++] = c(0, 1), entries[row++] = c(0, 2), entries[row++] = c(1, 2);
        }
    return entries;
}

TEST(Odeco, EmbeddingIsAFixedMultipleOfThePolynomialOnTheSphere) {
    std::mt19937_64 generator(92);
    const Quaternions samples = random_rotations(50, 93);
    double factor = 0;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Vector3 lengths = random_lengths(generator);
        for (int trial = 0; trial < 20; ++trial) {
            const Vector3 x = log(row_quaternion(samples, trial)).normalized();
            const double value = harmonic_value(Odeco::embed(q, lengths), x), expected = polynomial(q, lengths, x);
            if (factor == 0) factor = value / expected;
            EXPECT_NEAR(value, factor * expected, 1e-13);
        }
    }
    EXPECT_NEAR(factor, std::sqrt(16 * pi / 189) / (32 * pi / 315), 1e-13);  // sh4's factor over Funk and Hecke's
}

TEST(Odeco, UnitLengthsGiveTheSh4VectorInDegreeFourAndAreTheRepresentation) {
    const Quaternions samples = random_rotations(50, 94);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Odeco::Vector e = Odeco::embed(q);
        EXPECT_LT((e.tail<9>() - Sh4::embed(q)).norm(), 1e-14);
        EXPECT_LT(e.segment<5>(1).norm(), 1e-14);
        EXPECT_NEAR(e[0], std::sqrt(189.0 / 16), 1e-13);  // 3 sqrt(21/16)
        EXPECT_EQ(e, Odeco::embed(q, Vector3::Ones()));
    }
}

TEST(Odeco, FullDifferentialIsTheDerivative) {
    std::mt19937_64 generator(95);
    const Quaternions samples = random_rotations(30, 96);
    const double h = 1e-5;
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Vector3 lengths = random_lengths(generator);
        const Odeco::FullDifferential d = Odeco::differential(q, lengths);
        for (int k = 0; k < 3; ++k) {
            const Vector3 w = h * Vector3::Unit(k);
            const Odeco::Vector turned = Odeco::embed(exp(w) * q, lengths) - Odeco::embed(exp(-w) * q, lengths);
            const Odeco::Vector stretched = Odeco::embed(q, lengths + w) - Odeco::embed(q, lengths - w);
            EXPECT_LT((d.col(k) - turned / (2 * h)).norm(), 1e-8);
            EXPECT_LT((d.col(3 + k) - stretched / (2 * h)).norm(), 1e-9);
        }
        EXPECT_LT((Odeco::differential(q, Vector3::Ones()).leftCols<3>() - Odeco::differential(q)).norm(), 1e-13);
    }
}

TEST(Odeco, RotationTurnsTheAxesAndKeepsTheLengths) {
    std::mt19937_64 generator(97);
    const Quaternions samples = random_rotations(50, 98);
    for (Eigen::Index i = 0; i + 1 < samples.rows(); ++i) {
        const Quaternion g = row_quaternion(samples, i), q = row_quaternion(samples, i + 1);
        const Vector3 lengths = random_lengths(generator);
        EXPECT_LT((Odeco::rotate(g, Odeco::embed(q, lengths)) - Odeco::embed(g * q, lengths)).norm(), 1e-13);
    }
}

// 27 independent quadrics, as Palmer et al. state: their rank among the quadratic forms on R^15.
TEST(Odeco, EmbeddedTensorsSatisfyTheTwentySevenQuadricsAndOthersDoNot) {
    std::mt19937_64 generator(99);
    const Quaternions samples = random_rotations(50, 100);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Odeco::Vector v = Odeco::embed(row_quaternion(samples, i), random_lengths(generator));
        EXPECT_LT(odeco_equations(tensor_of(v)).norm(), 1e-12);
        EXPECT_GT(odeco_equations(tensor_of(random_vector<Odeco>(generator))).norm(), 1e-2);
        const Odeco::Vector near = v + 1e-4 * random_vector<Odeco>(generator);
        EXPECT_GT(odeco_equations(tensor_of(near)).norm(), 1e-7);
    }
    Eigen::MatrixXd values(200, 45);
    for (int i = 0; i < 200; ++i)
        values.row(i) = odeco_equations(Tensor4::full(random_vector<Odeco>(generator))).transpose();
    Eigen::JacobiSVD<Eigen::MatrixXd> svd(values);
    svd.setThreshold(1e-9);
    EXPECT_EQ(svd.rank(), 27);
}

void expect_same_axes(const OdecoFrame& found, const Quaternion& q, const Vector3& lengths, double accuracy) {
    EXPECT_GE(found.lengths[0], found.lengths[1]);
    EXPECT_GE(found.lengths[1], found.lengths[2]);
    EXPECT_NEAR(found.frame.norm(), 1, 1e-14);
    EXPECT_LT(distance(found.frame, q), accuracy);
    Vector3 sorted = lengths;
    std::sort(sorted.data(), sorted.data() + 3, std::greater<>());
    EXPECT_LT((found.lengths - sorted).norm(), accuracy);
    EXPECT_LT((Odeco::embed(found.frame, found.lengths) - Odeco::embed(q, lengths)).norm(), 10 * accuracy);
}

// The axes are as uncertain as the second largest length is small.
double condition(Vector3 lengths) {
    lengths = lengths.cwiseAbs().eval();
    std::sort(lengths.data(), lengths.data() + 3);
    return 1 + lengths[2] + lengths[2] / lengths[1];
}

TEST(Odeco, ExtractionFindsAxesAndLengthsOfAnyOdecoTensor) {
    std::mt19937_64 generator(101);
    std::vector<Quaternion> frames = nasty_frames();
    const Quaternions samples = random_rotations(300, 102);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) frames.push_back(row_quaternion(samples, i));
    for (const Quaternion& q : frames)
        for (const Vector3& lengths : {random_lengths(generator), Vector3(1, 1, 1), Vector3(2, 2, -1), Vector3(3, 1, 0),
                                       Vector3(-1, -1, -1), Vector3(1, -1, 0)})
            expect_same_axes(Odeco::extract(Odeco::embed(q, lengths)), q, lengths, 1e-13 * condition(lengths));
}

TEST(Odeco, WithTwoLengthsZeroTheOneAxisIsFound) {
    const Quaternions samples = random_rotations(50, 103);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const OdecoFrame found = Odeco::extract(Odeco::embed(q, {0, 2, 0}));
        EXPECT_LT((found.lengths - Vector3(2, 0, 0)).norm(), 1e-13);
        EXPECT_NEAR(std::abs((found.frame * Vector3::UnitX()).dot(q * Vector3::UnitY())), 1, 1e-14);
        EXPECT_LT(found.distance, 1e-13);
    }
}

TEST(Odeco, NearestToAnOdecoTensorIsItself) {
    std::mt19937_64 generator(104);
    const Quaternions samples = random_rotations(200, 105);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Vector3 lengths = random_lengths(generator);
        const OdecoFrame found = Odeco::nearest(Odeco::embed(q, lengths));
        EXPECT_LT(found.distance, 1e-12);
        expect_same_axes(found, q, lengths, 1e-9 * condition(lengths));
    }
}

TEST(Odeco, NearestIsStationaryInAxesAndLengths) {
    std::mt19937_64 generator(106);
    for (int trial = 0; trial < 200; ++trial) {
        const auto v = random_vector<Odeco>(generator);
        const OdecoFrame found = Odeco::nearest(v);
        const Odeco::Vector rest = v - Odeco::embed(found.frame, found.lengths);
        EXPECT_LT((Odeco::differential(found.frame, found.lengths).transpose() * rest).norm(), 1e-7);
        EXPECT_NEAR(found.distance, rest.norm(), 1e-12);
        EXPECT_LT((Odeco::nearest(Odeco::embed(found.frame, found.lengths)).distance), 1e-11);  // idempotent
    }
}

// The claim of the header: global near the variety. Reference: local ascents from many random starts.
TEST(Odeco, NearestIsTheBestOfManyRandomStarts) {
    std::mt19937_64 generator(107);
    const Quaternions samples = random_rotations(400, 108);
    for (const double noise : {0.01, 0.1, 0.3, 100.0})
        for (int trial = 0; trial < 100; ++trial) {
            const Quaternion q = row_quaternion(samples, trial);
            const Odeco::Vector clean = Odeco::embed(q, random_lengths(generator));
            const Odeco::Vector v = clean + noise * clean.norm() * random_vector<Odeco>(generator).normalized();
            const double found = Odeco::nearest(v).distance;
            for (int k = 0; k < 40; ++k) {
                const Quaternion start = row_quaternion(samples, (40 * trial + k) % samples.rows());
                EXPECT_LE(found, Odeco::nearest_local(v, start).distance + 1e-9 * v.norm());
            }
            const Quaternion guess = row_quaternion(samples, trial + 1);
            EXPECT_LE(Odeco::nearest(v, &guess).distance, found + 1e-9 * v.norm());
        }
}

TEST(Odeco, NearestCommutesWithRotationAndScale) {
    std::mt19937_64 generator(109);
    const Quaternions samples = random_rotations(50, 110);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const auto v = random_vector<Odeco>(generator);
        const double expected = Odeco::nearest(v).distance;
        EXPECT_NEAR(Odeco::nearest(Odeco::rotate(row_quaternion(samples, i), v)).distance, expected, 1e-9);
        for (const double scale : {1e-200, 1e-9, 1e150})
            EXPECT_NEAR(Odeco::nearest(scale * v).distance / scale, expected, 1e-9);
    }
}

TEST(Odeco, TheLocalSearchStaysInItsBasin) {
    std::mt19937_64 generator(111);
    const Quaternions samples = random_rotations(100, 112);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        const Odeco::Vector v = Odeco::embed(q, {1.2, 1.0, 0.8}) + 0.02 * random_vector<Odeco>(generator);
        const Quaternion start = exp(Vector3(0.1, -0.05, 0.08)) * q;
        EXPECT_LT(distance(Odeco::nearest_local(v, start).frame, q), 0.1);
    }
}

TEST(Odeco, ZeroHasZeroLengthsAndBadInputIsATypedError) {
    const Odeco::Vector zero = Odeco::Vector::Zero(), bad = Odeco::Vector::Constant(std::nan(""));
    const Quaternion q = Quaternion::Identity();
    EXPECT_EQ(Odeco::nearest(zero).lengths, Vector3::Zero());
    EXPECT_EQ(Odeco::extract(zero).lengths, Vector3::Zero());
    EXPECT_EQ(Odeco::nearest_local(zero, q).lengths, Vector3::Zero());
    EXPECT_THROW(Odeco::nearest(bad), InvalidInput);
    EXPECT_THROW(Odeco::nearest_local(bad, q), InvalidInput);
    EXPECT_THROW(Odeco::nearest_local(zero, Quaternion(2, 0, 0, 0)), InvalidInput);
    EXPECT_THROW(Odeco::extract(bad), InvalidInput);
    EXPECT_THROW(Odeco::rotate(q, bad), InvalidInput);
    EXPECT_THROW(Odeco::hessian(q, bad), InvalidInput);
    EXPECT_THROW(Odeco::embed(q, Vector3(1, INFINITY, 1)), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
