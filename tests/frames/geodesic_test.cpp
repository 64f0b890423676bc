#include "octafield/frames/geodesic.hpp"

#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

Quaternions rows_of(const std::vector<Quaternion>& frames) {
    Quaternions rows(static_cast<Eigen::Index>(frames.size()), 4);
    for (std::size_t i = 0; i < frames.size(); ++i) rows.row(i) = to_wxyz(frames[i]).transpose();
    return rows;
}

// Frames within `spread` radians of `centre`, each as a random one of its 48 quaternions.
Quaternions cloud(const Quaternion& centre, double spread, int n, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::vector<Quaternion> frames;
    for (int i = 0; i < n; ++i) {
        Vector3 w(normal01(generator), normal01(generator), normal01(generator));
        w *= spread * uniform01(generator) / w.norm();
        frames.push_back(exp(w) * centre * binary_octahedral_group()[generator() % 48]);
    }
    return rows_of(frames);
}

TEST(FrameLog, IsTheShortestRotationBetweenTheFrames) {
    const Quaternions a = random_rotations(500, 21), b = random_rotations(500, 22);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        const Vector3 w = frame_log(p, q);
        EXPECT_NEAR(w.norm(), distance(p, q), 1e-14);
        EXPECT_LT(distance(frame_exp(p, w), q), 1e-14);
        EXPECT_LT((frame_log(q, p) + w).norm(), 1e-13);
    }
}

TEST(FrameLog, TurnsWithTheWorldAndIgnoresTheRepresentative) {
    const Quaternions a = random_rotations(100, 23), b = random_rotations(100, 24);
    for (Eigen::Index i = 0; i + 1 < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i), g = row_quaternion(a, i + 1);
        EXPECT_LT((frame_log(g * p, g * q) - g * frame_log(p, q)).norm(), 1e-13);
        for (const Quaternion& o : binary_octahedral_group())
            EXPECT_LT((frame_log(p * o, q) - frame_log(p, q)).norm(), 1e-13);
    }
}

TEST(Slerp, DividesTheDistanceInProportion) {
    const Quaternions a = random_rotations(100, 25), b = random_rotations(100, 26);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        EXPECT_LT(distance(slerp(p, q, 0), p), 1e-14);
        EXPECT_LT(distance(slerp(p, q, 1), q), 1e-14);
        EXPECT_NEAR(distance(p, slerp(p, q, 0.3)), 0.3 * distance(p, q), 1e-14);
        EXPECT_NEAR(distance(q, slerp(p, q, 0.3)), 0.7 * distance(p, q), 1e-14);
    }
}

TEST(Mean, OfTwoFramesIsHalfWay) {
    const Quaternions a = random_rotations(100, 27);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = exp(Vector3(0.2, -0.3, 0.25)) * p * octahedral_group()[5];
        const FrameMean m = frame_mean(rows_of({p, q}));
        EXPECT_TRUE(m.converged);
        EXPECT_LT(distance(m.frame, slerp(p, q, 0.5)), 1e-12);
        EXPECT_NEAR(m.variance, std::pow(distance(p, q) / 2, 2), 1e-12);
    }
}

TEST(Mean, BalancesTheLogarithmsAndNoNeighbourIsBetter) {
    const Quaternions centres = random_rotations(20, 28);
    for (Eigen::Index i = 0; i < centres.rows(); ++i) {
        const Quaternion centre = row_quaternion(centres, i);
        const Quaternions frames = cloud(centre, 0.3, 40, 29 + i);
        const FrameMean m = frame_mean(frames);
        EXPECT_TRUE(m.converged);
        EXPECT_LT(distance(m.frame, centre), 0.3);
        Vector3 sum = Vector3::Zero();
        for (Eigen::Index k = 0; k < frames.rows(); ++k) sum += frame_log(m.frame, row_quaternion(frames, k));
        EXPECT_LT(sum.norm(), 1e-11);
        for (const double t : {0.01, 0.2, 0.5})
            for (int k = 0; k < 3; ++k) {
                const Quaternion other = exp(t * Vector3::Unit(k)) * m.frame;
                double variance = 0;
                for (Eigen::Index j = 0; j < frames.rows(); ++j)
                    variance += std::pow(distance(other, row_quaternion(frames, j)), 2) / 40;
                EXPECT_GT(variance, m.variance);
            }
    }
}

TEST(Mean, WeightsActLikeRepeatedFramesAtAnyScale) {
    const Quaternions frames = cloud(Quaternion::Identity(), 0.3, 3, 60);
    Quaternions repeated(6, 4);
    repeated << frames.row(0), frames.row(1), frames.row(1), frames.row(2), frames.row(2), frames.row(2);
    for (const double scale : {1.0, 1e-300, 1e300}) {
        const FrameMean weighted = frame_mean(frames, scale * Eigen::Vector3d(1, 2, 3));
        EXPECT_LT(distance(weighted.frame, frame_mean(repeated).frame), 1e-12);
    }
}

TEST(Mean, OfFramesAllOverTheGroupIsAtLeastAsGoodAsEveryFrameOfTheList) {
    for (std::uint64_t seed = 70; seed < 80; ++seed) {
        const Quaternions frames = random_rotations(12, seed);
        const FrameMean m = frame_mean(frames);
        for (Eigen::Index i = 0; i < frames.rows(); ++i) {
            double variance = 0;
            for (Eigen::Index k = 0; k < frames.rows(); ++k)
                variance += std::pow(distance(row_quaternion(frames, i), row_quaternion(frames, k)), 2) / 12;
            EXPECT_LE(m.variance, variance);
        }
    }
}

double variance_at(const Quaternions& frames, const Quaternion& centre) {
    double sum = 0;
    for (Eigen::Index i = 0; i < frames.rows(); ++i) sum += std::pow(distance(centre, row_quaternion(frames, i)), 2);
    return sum / static_cast<double>(frames.rows());
}

// The smallest variance that plain descents, by the public logarithm, reach from the starts.
double best_descent(const Quaternions& frames, const Quaternions& starts) {
    double best = std::numeric_limits<double>::infinity();
    for (Eigen::Index s = 0; s < starts.rows(); ++s) {
        Quaternion centre = row_quaternion(starts, s);
        for (int step = 0; step < 12; ++step) {
            Vector3 sum = Vector3::Zero();
            for (Eigen::Index i = 0; i < frames.rows(); ++i) sum += frame_log(centre, row_quaternion(frames, i));
            centre = frame_exp(centre, sum / static_cast<double>(frames.rows()));
        }
        best = std::min(best, variance_at(frames, centre));
    }
    return best;
}

TEST(Mean, OfSpreadOutFramesIsNotBeatenByDescentsFromElsewhere) {
    const Quaternions starts = random_rotations(100, 81);
    for (std::uint64_t seed = 100; seed < 160; ++seed) {
        const Quaternions frames = random_rotations(6, seed);
        const FrameMean m = frame_mean(frames);
        EXPECT_TRUE(m.converged);
        EXPECT_NEAR(m.variance, variance_at(frames, m.frame), 1e-14);
        EXPECT_LE(m.variance, best_descent(frames, starts) * (1 + 1e-9)) << seed;
    }
}

TEST(Mean, OfManyFramesIsFoundInAFewPasses) {
    const Quaternions near = cloud(Quaternion::Identity(), 0.35, 200000, 61), all = random_rotations(20000, 62);
    const FrameMean m = frame_mean(near);
    EXPECT_TRUE(m.converged);
    EXPECT_LE(m.iterations, 12);
    EXPECT_LT(m.frame.angularDistance(closest_representative(Quaternion::Identity(), m.frame)), 0.01);
    EXPECT_LE(frame_mean(all).variance, variance_at(all, Quaternion::Identity()));
    EXPECT_LE(frame_mean(all).iterations, 50);
}

TEST(Mean, FramesOfNoWeightDoNotMatter) {
    Quaternions frames = random_rotations(2000, 63);
    frames.topRows(40) = cloud(Quaternion::Identity(), 0.3, 40, 64);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(frames.rows());
    weights.head(40).setOnes();
    EXPECT_LT(distance(frame_mean(frames, weights).frame, frame_mean(frames.topRows(40)).frame), 1e-12);
}

// A few heavy frames among many light ones: the sample that is scanned goes by weight.
TEST(Mean, OfManyFramesIsThatOfTheHeavyOnes) {
    Quaternions frames = random_rotations(2000, 65);
    Eigen::VectorXd weights = Eigen::VectorXd::Constant(frames.rows(), 1e-12);
    for (const int i : {3, 700, 701, 1200, 1650, 1999}) weights[i] = 1;
    Quaternions heavy(6, 4);
    heavy << frames.row(3), frames.row(700), frames.row(701), frames.row(1200), frames.row(1650), frames.row(1999);
    EXPECT_NEAR(frame_mean(frames, weights).variance, frame_mean(heavy).variance, 1e-6);
}

TEST(Slerp, ExtrapolatesAnyFiniteDistanceToAUnitQuaternion) {
    const Quaternion p = exp({0.3, 0.1, 0}), q = exp({0, 0.4, 0.2});
    for (const double t : {1e20, 1e155, 1e300}) {
        EXPECT_NEAR(slerp(p, q, t).norm(), 1, 1e-15);
        EXPECT_NEAR(frame_exp(p, Vector3(t, -t, t)).norm(), 1, 1e-15);
    }
    EXPECT_THROW(slerp(p, q, std::numeric_limits<double>::infinity()), InvalidInput);
}

TEST(Mean, RefusesWhatHasNone) {
    EXPECT_THROW(frame_mean(Quaternions(0, 4)), InvalidInput);
    const Quaternions two = random_rotations(2, 1);
    EXPECT_THROW(frame_mean(two, Eigen::VectorXd::Ones(3)), InvalidInput);
    EXPECT_THROW(frame_mean(two, Eigen::VectorXd::Zero(2)), InvalidInput);
    EXPECT_THROW(frame_mean(two, Eigen::Vector2d(-1, 2)), InvalidInput);
    EXPECT_THROW(frame_mean(two, Eigen::Vector2d(std::nan(""), 2)), InvalidInput);
    EXPECT_THROW(frame_mean(2 * two), InvalidInput);
}

}  // namespace
}  // namespace octafield::frames
