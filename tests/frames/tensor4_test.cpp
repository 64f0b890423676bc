#include "octafield/frames/tensor4.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "representation_laws.hpp"

namespace octafield::frames {

namespace {

// The definition, all 81 entries.
Tensor4::Full frame_tensor(const Quaternion& q, const Vector3& lengths = Vector3::Ones()) {
    const Matrix3 r = q.toRotationMatrix();
    Tensor4::Full a = Tensor4::Full::Zero();
    for (int n = 0; n < 81; ++n)
        for (int m = 0; m < 3; ++m)
            a(n / 9, n % 9) += lengths[m] * r(n / 27, m) * r(n / 9 % 3, m) * r(n / 3 % 3, m) * r(n % 3, m);
    return a;
}

std::vector<Quaternion> frames(int n, std::uint64_t seed) {
    std::vector<Quaternion> list = nasty_frames();
    const Quaternions samples = random_rotations(n, seed);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) list.push_back(row_quaternion(samples, i));
    return list;
}

TEST(Tensor4, FullTensorIsTheSumOfFourthPowersOfTheAxes) {
    for (const Quaternion& q : frames(50, 61)) {
        EXPECT_LT((Tensor4::full(Tensor4::embed(q)) - frame_tensor(q)).norm(), 1e-14);
        EXPECT_LT((Tensor4::from_full(frame_tensor(q)) - Tensor4::embed(q)).norm(), 1e-14);
    }
}

TEST(Tensor4, DistanceIsTheFrobeniusDistanceAndSixFifthsOfTheSquaredSh4Distance) {
    const Quaternions a = random_rotations(50, 62), b = random_rotations(50, 63);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        const double squared = (Tensor4::embed(p) - Tensor4::embed(q)).squaredNorm();
        EXPECT_NEAR(squared, (frame_tensor(p) - frame_tensor(q)).squaredNorm(), 1e-13);
        EXPECT_NEAR(squared, 1.2 * (Sh4::embed(p) - Sh4::embed(q)).squaredNorm(), 1e-13);
    }
}

TEST(Tensor4, MonomialsAreTheCoefficientsOfThePolynomial) {
    std::mt19937_64 generator(64);
    const auto v = random_vector<Tensor4>(generator);
    const Tensor4::Full a = Tensor4::full(v);
    const Vector3 p(0.3, -1.2, 0.8);
    const double x = p.x(), y = p.y(), z = p.z();
    Tensor4::Vector monomials;  // in the order of the header
    monomials << x * x * x * x, x * x * x * y, x * x * x * z, x * x * y * y, x * x * y * z, x * x * z * z,
        x * y * y * y, x * y * y * z, x * y * z * z, x * z * z * z, y * y * y * y, y * y * y * z, y * y * z * z,
        y * z * z * z, z * z * z * z;
    Eigen::Matrix<double, 9, 1> square;
    for (int n = 0; n < 9; ++n) square[n] = p[n / 3] * p[n % 3];
    EXPECT_NEAR(Tensor4::monomials(v).dot(monomials), square.dot(a * square), 1e-12);
    EXPECT_LT((Tensor4::from_monomials(Tensor4::monomials(v)) - v).norm(), 1e-15 * v.norm() * 4);
}

TEST(Tensor4, MandelMatrixActsOnSymmetricMatricesAndKeepsNorms) {
    std::mt19937_64 generator(65);
    const auto v = random_vector<Tensor4>(generator);
    const auto coordinates = [](const Matrix3& s) {
        const double r = std::sqrt(2);
        return Eigen::Matrix<double, 6, 1>(s(0, 0), s(1, 1), s(2, 2), r * s(1, 2), r * s(2, 0), r * s(0, 1));
    };
    Matrix3 s = Matrix3::Random();
    s = (s + s.transpose()).eval();
    const Tensor4::Full a = Tensor4::full(v);
    Matrix3 image = Matrix3::Zero();
    for (int n = 0; n < 81; ++n) image(n / 27, n / 9 % 3) += a(n / 9, n % 9) * s(n / 3 % 3, n % 3);
    EXPECT_LT((Tensor4::mandel(v) * coordinates(s) - coordinates(image)).norm(), 1e-13);
    EXPECT_NEAR(Tensor4::mandel(v).norm(), a.norm(), 1e-13);
    EXPECT_NEAR(v.norm(), a.norm(), 1e-13);
    EXPECT_LT((Tensor4::from_mandel(Tensor4::mandel(v)) - v).norm(), 1e-14);
}

TEST(Tensor4, FromFullAndFromMandelDropExactlyTheAsymmetricPart) {
    std::mt19937_64 generator(66);
    Tensor4::Full a;
    for (int n = 0; n < 81; ++n) a(n / 9, n % 9) = normal01(generator);
    const Tensor4::Full symmetric = Tensor4::full(Tensor4::from_full(a));
    EXPECT_NEAR((a - symmetric).cwiseProduct(symmetric).sum(), 0, 1e-12);  // orthogonal
    for (int n = 0; n < 81; ++n) {
        const int i = n / 27, j = n / 9 % 3, k = n / 3 % 3, l = n % 3;
        EXPECT_EQ(symmetric(3 * i + j, 3 * k + l), symmetric(3 * k + j, 3 * l + i));
    }
    // xx yy + yy xx - 2 xy xy has no fully symmetric part.
    Tensor4::Mandel m = Tensor4::Mandel::Zero();
    m(0, 1) = m(1, 0) = 1, m(5, 5) = -1;
    EXPECT_LT(Tensor4::from_mandel(m).norm(), 1e-15);
}

TEST(Tensor4, MandelMatrixOfAFrameIsAProjectorOfRankThree) {
    for (const Quaternion& q : frames(50, 67)) {
        const Tensor4::Mandel p = Tensor4::mandel(Tensor4::embed(q));
        EXPECT_LT((p * p - p).norm(), 1e-14);
        EXPECT_NEAR(p.trace(), 3, 1e-14);
    }
}

TEST(Tensor4, AffineParametersAreOrthonormalCoordinatesOfTheTensorsWithAFramesTraces) {
    std::mt19937_64 generator(68);
    for (int trial = 0; trial < 50; ++trial) {
        Tensor4::Affine p, p2;
        for (int c = 0; c < 9; ++c) p[c] = normal01(generator), p2[c] = normal01(generator);
        const Tensor4::Vector v = Tensor4::from_affine(p), v2 = Tensor4::from_affine(p2);
        EXPECT_NEAR((v - v2).norm(), (p - p2).norm(), 1e-13);
        EXPECT_LT((Tensor4::affine(v) - p).norm(), 1e-14);
        EXPECT_LT(Tensor4::residual(Tensor4::full(v)).partial_trace, 1e-13);
        // affine() is the orthogonal projection: what it drops is orthogonal to the subspace.
        const auto any = random_vector<Tensor4>(generator);
        const Tensor4::Vector foot = Tensor4::from_affine(Tensor4::affine(any));
        EXPECT_NEAR((any - foot).dot(v - v2), 0, 1e-12);
        // The origin is nearest to zero.
        EXPECT_NEAR(Tensor4::from_affine(Tensor4::Affine::Zero()).dot(v - v2), 0, 1e-13);
    }
    for (const Quaternion& q : frames(20, 69))
        EXPECT_LT((Tensor4::from_affine(Tensor4::affine(Tensor4::embed(q))) - Tensor4::embed(q)).norm(), 1e-14);
}

TEST(Tensor4, IsometryWithSh4GoesBothWays) {
    std::mt19937_64 generator(70);
    for (const Quaternion& q : frames(50, 71)) {
        EXPECT_LT((Tensor4::to_sh4(Tensor4::embed(q)) - Sh4::embed(q)).norm(), 1e-14);
        EXPECT_LT((Tensor4::from_sh4(Sh4::embed(q)) - Tensor4::embed(q)).norm(), 1e-14);
        const auto a = random_vector<Sh4>(generator), b = random_vector<Sh4>(generator);
        EXPECT_LT((Tensor4::to_sh4(Tensor4::from_sh4(a)) - a).norm(), 1e-14);
        EXPECT_NEAR((Tensor4::from_sh4(a) - Tensor4::from_sh4(b)).norm(), std::sqrt(1.2) * (a - b).norm(), 1e-13);
    }
}

TEST(Tensor4, RotationIsThatOfAllFourIndices) {
    std::mt19937_64 generator(72);
    for (const Quaternion& g : frames(5, 73)) {
        const auto v = random_vector<Tensor4>(generator);
        const Tensor4::Full a = Tensor4::full(v);
        const Matrix3 r = g.toRotationMatrix();
        Eigen::Matrix<double, 9, 9> pair;
        for (int n = 0; n < 81; ++n) pair(n / 9, n % 9) = r(n / 27, n / 3 % 3) * r(n / 9 % 3, n % 3);
        const Tensor4::Full expected = pair * a * pair.transpose();
        EXPECT_LT((Tensor4::full(Tensor4::rotate(g, v)) - expected).norm(), 1e-13);
    }
}

TEST(Tensor4, ResidualsVanishForFramesAndDetectPerturbations) {
    std::mt19937_64 generator(74);
    for (const Quaternion& q : frames(50, 75)) {
        const Tensor4::Full a = frame_tensor(q);
        const Tensor4::Residual exact = Tensor4::residual(a);
        EXPECT_LT(exact.symmetry + exact.partial_trace + exact.projector, 3e-14);
        for (const double size : {1e-9, 1e-3, 1.0}) {
            Tensor4::Full noise;
            for (int n = 0; n < 81; ++n) noise(n / 9, n % 9) = normal01(generator);
            const Tensor4::Residual off = Tensor4::residual(a + size * noise / noise.norm());
            EXPECT_GT(off.symmetry, 0.1 * size);
            EXPECT_GT(off.partial_trace + off.projector, 0.01 * size);
            EXPECT_LT(off.symmetry, size);
        }
    }
}

// Each of the three conditions is needed: tensors that meet the two others and are no frames.
TEST(Tensor4, TwoOfTheThreeConditionsDoNotMakeAFrame) {
    const Quaternion q = row_quaternion(random_rotations(1, 76), 0);
    // Symmetric, a projector, wrong traces: one or two axes.
    for (const Vector3& lengths : {Vector3(1, 0, 0), Vector3(1, 1, 0)}) {
        const Tensor4::Residual r = Tensor4::residual(frame_tensor(q, lengths));
        EXPECT_LT(r.symmetry + r.projector, 1e-14);
        EXPECT_GT(r.partial_trace, 0.9);
    }
    // Symmetric, right traces, no projector: the point of Chemin's subspace half-way between two frames.
    const Tensor4::Vector middle = (Tensor4::embed(q) + Tensor4::embed(Quaternion::Identity())) / 2;
    const Tensor4::Residual half = Tensor4::residual(Tensor4::full(middle));
    EXPECT_LT(half.symmetry + half.partial_trace, 1e-14);
    EXPECT_GT(half.projector, 0.1);
    EXPECT_GT(Tensor4::project(middle).distance, 0.1);
    // The symmetric part is a frame, the tensor is not symmetric.
    Tensor4::Full a = frame_tensor(q);
    a(1, 1) += 0.5, a(0, 4) -= 0.25, a(4, 0) -= 0.25;  // A_xyxy against A_xxyy, A_yyxx
    a(1, 3) += 0.5, a(3, 1) += 0.5, a(3, 3) += 0.5;
    a(0, 4) -= 0.75, a(4, 0) -= 0.75;
    const Tensor4::Residual r = Tensor4::residual(a);
    EXPECT_LT(r.partial_trace + r.projector, 1e-14);
    EXPECT_GT(r.symmetry, 0.5);
}

TEST(Tensor4, RecoveryByEigentensorsIsExactForFrames) {
    for (const Quaternion& q : frames(500, 77)) {
        EXPECT_LT(distance(Tensor4::recover(Tensor4::embed(q)), q), 1e-14);
        EXPECT_LT(distance(Tensor4::recover(1e200 * Tensor4::embed(q)), q), 1e-14);
    }
}

TEST(Tensor4, RecoveryErrsByTheOrderOfTheNoise) {
    std::mt19937_64 generator(78);
    for (const Quaternion& q : frames(100, 79))
        for (const double size : {1e-8, 1e-4, 1e-2, 5e-2}) {
            const Tensor4::Vector noise = random_vector<Tensor4>(generator).normalized();
            EXPECT_LT(distance(Tensor4::recover(Tensor4::embed(q) + size * noise), q), size);
        }
}

// Chemin et al. 2018 and the thesis take the eigenvectors of the sum of the three eigentensors. Which three an
// eigensolver returns is arbitrary: r_m r_m^T are as good as any, and their sum is the identity, whose eigenvectors
// are all vectors. Random bases of the eigenspace come close to it often enough to spoil a field.
TEST(Tensor4, TheSumOfTheEigentensorsAloneDoesNotDetermineTheFrame) {
    const Quaternion q = row_quaternion(random_rotations(1, 80), 0);
    const Matrix3 r = q.toRotationMatrix();
    const auto recovered_from_sum = [&](const Matrix3& mixing, double noise) {
        Matrix3 sum = noise * (Matrix3() << 0, 1, 2, 1, 0, 3, 2, 3, 0).finished();
        for (int m = 0; m < 3; ++m) sum += mixing.colwise().sum()[m] * r.col(m) * r.col(m).transpose();
        Matrix3 axes = Eigen::SelfAdjointEigenSolver<Matrix3>(sum).eigenvectors();
        if (axes.determinant() < 0) axes.col(0) *= -1;
        return distance(Quaternion(axes), q);
    };
    EXPECT_GT(recovered_from_sum(Matrix3::Identity(), 1e-12), 0.1);  // a trillionth of noise, a wrong frame
    const Quaternions mixings = random_rotations(2000, 81);
    int spoiled = 0;
    for (Eigen::Index i = 0; i < mixings.rows(); ++i)
        spoiled += recovered_from_sum(row_quaternion(mixings, i).toRotationMatrix(), 1e-3) > 0.01;
    EXPECT_GT(spoiled, 20);
    EXPECT_LT(distance(Tensor4::recover(Tensor4::embed(q)), q), 1e-14);
}

TEST(Tensor4, UnusableInputIsATypedError) {
    EXPECT_THROW(Tensor4::recover(Tensor4::Vector::Zero()), InvalidInput);
    EXPECT_THROW(Tensor4::recover(Tensor4::Vector::Constant(std::nan(""))), InvalidInput);
    EXPECT_THROW(Tensor4::residual(Tensor4::Full::Constant(INFINITY)), InvalidInput);
    EXPECT_THROW(Tensor4::rotate(Quaternion(2, 0, 0, 0), Tensor4::Vector::Zero()), InvalidInput);
    EXPECT_THROW(Tensor4::hessian(Quaternion::Identity(), Tensor4::Vector::Constant(std::nan(""))), InvalidInput);
    EXPECT_LT(distance(Tensor4::project(Tensor4::Vector::Zero()).frame, Quaternion::Identity()), 1e-15);
}

}  // namespace
}  // namespace octafield::frames
