#include "octafield/frames/sh4_projection.hpp"

#include <algorithm>
#include <cstring>

#include "../../frames/src/sh4_kernel.hpp"
#include "sh4_inputs.hpp"

namespace octafield::frames {
namespace {

using std::numbers::pi;
struct Batch {
    std::vector<double> frames, distances;
    explicit Batch(const Vectors& v, const std::vector<Vector4>* guess = nullptr, std::string_view set = {})
        : frames(4 * v.size()), distances(v.size()) {
        const auto n = static_cast<std::int64_t>(v.size());
        const double* g = guess ? guess->front().data() : nullptr;
        if (set.empty())
            sh4_project(v.front().data(), g, n, frames.data(), distances.data());
        else
            sh4_project(v.front().data(), g, n, frames.data(), distances.data(), set);
    }
    Quaternion frame(std::size_t i) const {
        return {frames[4 * i], frames[4 * i + 1], frames[4 * i + 2], frames[4 * i + 3]};
    }
    bool same_bits(std::size_t i, const Projection& p) const {
        const Vector4 q = to_wxyz(p.frame);
        return std::memcmp(q.data(), &frames[4 * i], 4 * sizeof(double)) == 0 && p.distance == distances[i];
    }
    bool operator==(const Batch& other) const { return frames == other.frames && distances == other.distances; }
};

Vectors mixed_inputs() {
    Vectors v = random_inputs(150, 1);
    const Vectors near = near_cut_locus(150, 2);
    v.insert(v.end(), near.begin(), near.end());
    std::mt19937_64 generator(3);
    for (int i = 0; i < 100; ++i)
        v.push_back(Sh4::embed(random_rotation(generator)) + 0.2 * random_vector<Sh4>(generator).normalized());
    v.insert(v.begin() + 7, Sh4::Vector::Zero());
    v.insert(v.begin() + 19, 1e-300 * v[3]);
    v.insert(v.begin() + 23, 1e300 * v[5]);
    return v;
}

std::vector<Vector4> some_guesses(std::size_t n) {
    std::mt19937_64 generator(4);
    std::vector<Vector4> guess;
    for (std::size_t i = 0; i < n; ++i) guess.push_back(to_wxyz(random_rotation(generator)));
    return guess;
}

TEST(Sh4Projection, BitsDoNotDependOnBatchOrderOrInstructionSet) {
    const Vectors v = mixed_inputs();
    const std::vector<Vector4> guesses = some_guesses(v.size());
    for (const std::vector<Vector4>* guess : {static_cast<const std::vector<Vector4>*>(nullptr), &guesses}) {
        const Batch reference(v, guess);
        for (const std::string_view set : sh4_instruction_sets()) EXPECT_TRUE(Batch(v, guess, set) == reference) << set;
        Vectors reversed(v.rbegin(), v.rend());
        std::vector<Vector4> reversed_guesses(guesses.rbegin(), guesses.rend());
        const Batch backwards(reversed, guess ? &reversed_guesses : nullptr);
        for (std::size_t i = 0; i < v.size(); ++i) {
            const Quaternion start = from_wxyz(guesses[i]);
            EXPECT_TRUE(reference.same_bits(i, Sh4::project(v[i], guess ? &start : nullptr))) << i;
            EXPECT_TRUE(
                reference.same_bits(i, {backwards.frame(v.size() - 1 - i), backwards.distances[v.size() - 1 - i]}))
                << i;
        }
    }
}

TEST(Sh4Projection, AWrongGuessCostsTimeOnly) {
    Vectors v = random_inputs(2000, 23);
    const Vectors near = near_cut_locus(2000, 24);
    v.insert(v.end(), near.begin(), near.end());
    const std::vector<Vector4> guess = some_guesses(v.size());
    const Batch with(v, &guess), without(v);
    for (std::size_t i = 0; i < v.size(); ++i)
        EXPECT_NEAR(value(v[i], with.frame(i)), value(v[i], without.frame(i)), 1e-9) << i;
}

TEST(Sh4Projection, ReachesAStationaryFrameToRounding) {
    const Vectors v = random_inputs(2000, 25);
    const Batch batch(v);
    for (std::size_t i = 0; i < v.size(); ++i) {
        const Quaternion q = batch.frame(i);
        EXPECT_LT((Sh4::differential(q).transpose() * v[i]).norm(), 2e-13);
        EXPECT_NEAR(q.norm(), 1, 1e-15);
        EXPECT_NEAR(batch.distances[i], (v[i] - Sh4::embed(q)).norm(), 1e-14);
    }
}

// Federer 1959, theorem 4.18: the reach is the infimum of |b - a|^2 / (2 dist(b - a, T_a)). All a are alike.
TEST(Sh4Projection, ReachOfTheEmbeddedFramesIsRootFiveTwelfths) {
    const Quaternion identity = Quaternion::Identity();
    const Sh4::Vector a = Sh4::embed(identity);
    const Sh4::Differential tangents = Sh4::differential(identity) / Sh4::speed;
    const auto ratio = [&](const Quaternion& q) {
        const Sh4::Vector d = Sh4::embed(q) - a;
        return d.squaredNorm() / (2 * (d - tangents * (tangents.transpose() * d)).norm());
    };
    double least = 1;
    const Quaternions samples = random_rotations(300000, 26);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) {
        const Quaternion q = row_quaternion(samples, i);
        if (distance(q, identity) > 1e-3) least = std::min(least, ratio(q));
    }
    EXPECT_GT(least, std::sqrt(sh4::reach_squared) - 1e-9);
    EXPECT_LT(least, std::sqrt(sh4::reach_squared) + 0.01);
    for (const double t : {0.01, 0.2, 0.7}) EXPECT_NEAR(ratio(exp({0, 0, t})), std::sqrt(sh4::reach_squared), 1e-9);
    EXPECT_GE(sh4::sure_value * sh4::sure_value, 1 - sh4::reach_squared);
    EXPECT_NEAR(sh4::sure_value, std::sqrt(7.0 / 12), 1e-15);
}

// The same statement from the rotation matrix alone. With S = 3 - sum R_ij^4 and T_ij = sum_c R_ic R_jc (R_ic^2 -
// R_jc^2): a.b = 1 - 5/6 S, and the tangential part of b is 5/3 (T_12^2 + T_23^2 + T_31^2), so that the reach is
// sqrt(5/12) if and only if T_12^2 + T_23^2 + T_31^2 >= S (1 - S) everywhere, with equality somewhere.
TEST(Sh4Projection, ReachAgreesWithAnInequalityOnRotationMatrices) {
    const auto excess = [](const Quaternion& q) {
        const Matrix3 r = q.toRotationMatrix();
        const double s = 3 - r.array().pow(4).sum();
        double squares = 0;
        for (int i = 0; i < 3; ++i) {
            const auto x = r.row(i).array(), y = r.row((i + 1) % 3).array();
            const double t = (x * y * (x.square() - y.square())).sum();
            squares += t * t;
        }
        return squares - s * (1 - s);
    };
    const Quaternions samples = random_rotations(300000, 27);
    for (Eigen::Index i = 0; i < samples.rows(); ++i) ASSERT_GE(excess(row_quaternion(samples, i)), -1e-14);
    for (const double t : {0.1, 0.5, 1.0}) EXPECT_NEAR(excess(exp({t, 0, 0})), 0, 1e-15);
    std::mt19937_64 generator(28);
    for (int i = 0; i < 20000; ++i)  // near the turns about an axis, where it is nearly an equality
        ASSERT_GE(excess((exp({0, 0, uniform01(generator)}) * exp(std::pow(10, -4 * uniform01(generator)) *
                                                                  (random_rotation(generator) * Vector3::UnitX())))
                             .normalized()),
                  -1e-14);
}

// At the edge of the test: v = F a + the rest normal, F = sure_value |v|, a is a nearest frame; the test may not be
// weaker.
TEST(Sh4Projection, TheEarlyExitIsTakenOnlyAtGlobalMaxima) {
    std::mt19937_64 generator(29);
    for (int i = 0; i < 500; ++i) {
        const Quaternion q = random_rotation(generator);
        const Sh4::Vector a = Sh4::embed(q);
        Sh4::Vector n = random_vector<Sh4>(generator);
        // A third along the direction of largest curvature, where the bound is sharp.
        if (i % 3 == 0) n = Sh4::embed((q * exp({0, 0, pi / 4})).normalized());
        Eigen::Matrix<double, 9, 4> kept;
        kept << a, Sh4::differential(q) / Sh4::speed;
        n -= kept * (kept.transpose() * n);
        const double f = sh4::sure_value + 1e-9 + 0.1 * uniform01(generator) * (i % 2);
        const Sh4::Vector v = f * a + std::sqrt(1 - f * f) * n.normalized();
        const CertifiedProjection certified = sh4_project_certified(v);
        EXPECT_TRUE(certified.certified);
        EXPECT_NEAR(value(v, certified.projection.frame), f, 1e-9);
        const Quaternion guess = (q * exp({0.02, -0.01, 0.03})).normalized();
        EXPECT_NEAR(value(v, Sh4::project(v, &guess).frame), f, 1e-9);
    }
}

TEST(Sh4Projection, TakesTinyHugeAndZeroInputs) {
    const Vectors inputs = random_inputs(50, 37);
    for (const Sh4::Vector& v : inputs) {
        const Quaternion q = Sh4::project(v).frame;
        for (const double scale : {1e-320, 1e-300, 1e-9, 1e9, 1e300}) {
            const Projection p = Sh4::project(scale * v);
            EXPECT_LT(distance(p.frame, q), scale < 1e-310 ? 1e-2 : 1e-7);
            EXPECT_NEAR(p.distance / std::max(1.0, scale), scale < 1 ? 1.0 : (v - Sh4::embed(q) / scale).norm(), 2e-9);
        }
    }
    const Projection zero = Sh4::project(Sh4::Vector::Zero());
    EXPECT_EQ(to_wxyz(zero.frame), Vector4(1, 0, 0, 0));
    EXPECT_EQ(zero.distance, 1);
}

TEST(Sh4Projection, NamesTheRowsThatAreNotFinite) {
    Vectors v = random_inputs(40, 38);
    v[3][8] = std::numeric_limits<double>::infinity(), v[17][0] = std::nan("");
    try {
        const Batch batch(v);
        FAIL() << "accepted";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.elements(), (std::vector<std::int32_t>{3, 17}));
        EXPECT_EQ(error.kind(), "non_finite");
    }
    v = random_inputs(2, 39);
    for (const Vector4& bad : {Vector4(0, 0, 0, 0), Vector4(1, 0, std::nan(""), 0)}) {
        const std::vector<Vector4> guess = {Vector4(1, 0, 0, 0), bad};
        EXPECT_THROW(Batch(v, &guess), InvalidInput);
    }
    EXPECT_THROW(Batch(v, nullptr, "abacus"), InvalidInput);
}

// Rounding does not choose among equally near frames: a change in the last bits of the input leaves the choice.
TEST(Sh4Projection, TiesAreSettledByAFixedOrder) {
    std::mt19937_64 generator(40);
    for (int i = 0; i < 100; ++i) {
        const Sh4::Vector v = equidistant_sum(0, generator);
        const Quaternion q = Sh4::project(v).frame;
        for (int k = 0; k < 5; ++k) {
            Sh4::Vector other = v * (1 + 0.3 * k);
            for (int c = 0; c < 9; ++c) other[c] *= 1 + 2e-16 * (uniform01(generator) - 0.5);
            EXPECT_LT(distance(Sh4::project(other).frame, q), 1e-6);
        }
    }
}

TEST(Sh4Projection, TheGuessMayHaveAnyLengthButZero) {
    const Quaternions guesses = random_rotations(50, 44);
    std::mt19937_64 generator(45);
    for (Eigen::Index i = 0; i < guesses.rows(); ++i) {
        const auto v = random_vector<Sh4>(generator);
        const Vector4 guess = guesses.row(i).transpose();
        Vector4 expected, frame;
        double expected_distance, distance_to;
        sh4_project(v.data(), guess.data(), 1, expected.data(), &expected_distance);
        for (const double size : {1e-307, 1e-200, 1e-30, 0.1, 3.0, 1e155, 1e307}) {
            const Vector4 sized = size * guess;
            sh4_project(v.data(), sized.data(), 1, frame.data(), &distance_to);
            EXPECT_LT(std::min((frame - expected).norm(), (frame + expected).norm()), 1e-9) << size;
            EXPECT_NEAR(distance_to, expected_distance, 1e-12) << size;
        }
    }
}

}  // namespace
}  // namespace octafield::frames
