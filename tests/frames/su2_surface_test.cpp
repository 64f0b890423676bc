#include "octafield/frames/su2_surface.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "octafield/frames/geodesic.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

// Random frames, and those with axes along x and on its diagonals, where roots of the cubic of Su2 vanish or meet.
std::vector<Quaternion> surface_samples() {
    const Quaternions random = random_rotations(400, 71);
    std::vector<Quaternion> list;
    for (Eigen::Index i = 0; i < random.rows(); ++i) list.push_back(row_quaternion(random, i));
    for (const Vector3& to : {Vector3(1, 0, 0), Vector3(1, 1, 0), Vector3(1, 1, 1)})
        for (const double about : {0.0, 0.3})
            list.push_back((exp({about, 0, 0}) * rotation_between(to.normalized(), {1, 0, 0})).normalized());
    return list;
}
Quaternion turned(const Quaternion& q, const Vector3& w) { return (exp(w) * q).normalized(); }
Su2::Vector nearest(const Su2::Vector& h) { return Su2::embed(Su2::inverse_frame(Su2::complex(h))); }

TEST(Su2Surface, ItsEquationsHoldOnFramesAndNowhereBeside) {
    for (const Quaternion& q : surface_samples()) {
        const Su2::Vector h = Su2::embed(q);
        EXPECT_LT(su2_surface::residual(h).norm(), 1e-14);
        // Of a quaternion of norm 1 + e: F stays, P grows by 0.386 to 0.911 times 2 e.
        const double e = 1e-6;
        const Complex s(std::sqrt(1 + 2 * e), 0);
        const Vector3 beside =
            su2_surface::residual(Su2::real(Su2::invariants(s * Complex(q.w(), q.x()), s * Complex(q.y(), q.z()))));
        EXPECT_LT(beside.head<2>().norm(), 1e-14);
        EXPECT_GT(beside[2], 0.386 * 2 * e);
        EXPECT_LT(beside[2], 0.912 * 2 * e);
    }
}

// Oracle: the derivative in (u, v), which the surface's own tangents do not use.
TEST(Su2Surface, TangentsAreTheMotionsOfFrames) {
    for (const Quaternion& q : surface_samples())
        EXPECT_LT((su2_surface::point(Su2::embed(q)).turns - Su2::differential(q)).norm(), 2e-14);
}

TEST(Su2Surface, PointsBesideItAreRestoredByTheShortestWayToFirstOrder) {
    const Quaternions random = random_rotations(10, 72);
    for (const Quaternion& q : surface_samples()) {
        const auto at = su2_surface::point(Su2::embed(q));
        for (Eigen::Index k = 0; k < random.rows(); ++k) {
            Su2::Vector aside;
            aside << random.row(k).transpose(), random.row((k + 1) % 10).head<2>().transpose();
            aside *= 1e-5;
            const auto back = su2_surface::restored(at.h + aside);
            ASSERT_TRUE(back);
            EXPECT_LT((nearest(*back) - *back).norm(), 1e-13);
            // Along the surface the step is that of the orthogonal projection.
            const Su2::Vector along = at.turns * su2_surface::turn_of(at.turns, aside);
            EXPECT_LT((*back - at.h - along).norm(), 1e-3 * aside.norm());
        }
    }
}

TEST(Su2Surface, RetractionStaysOnItAndFollowsGeodesicsToSecondOrder) {
    double worst[2] = {0, 0};
    const auto frames = surface_samples();
    for (std::size_t i = 0; i + 1 < frames.size(); ++i) {
        const Su2::Vector h = Su2::embed(frames[i]);
        const Vector3 direction = (frames[i + 1].vec() + Vector3(0.01, 0, 0)).normalized();
        for (const double length : {1e-3, 1e-2, 0.3, 2.0}) {
            const auto k = su2_surface::retracted(h, length * direction);
            ASSERT_TRUE(k);
            EXPECT_LT((nearest(*k) - *k).norm(), 1e-13);
            if (length > 0.1) continue;
            const Quaternion reached = Su2::inverse_frame(Su2::complex(*k));
            double& error = worst[length > 5e-3];
            error = std::max(error, distance(reached, turned(frames[i], length * direction)));
            const auto w = su2_surface::turn_between(h, *k);
            ASSERT_TRUE(w);
            EXPECT_LT((*w - length * direction).norm(), 1e-12);
        }
        EXPECT_EQ(*su2_surface::retracted(h, Vector3::Zero()), su2_surface::restored(h));
        EXPECT_FALSE(su2_surface::retracted(h, Vector3::Constant(std::nan(""))));
    }
    EXPECT_LT(worst[0], 1e-7);
    EXPECT_NEAR(worst[1] / worst[0], 1000, 200);  // third order in the length
}

// Oracle: the rotation that made the second frame.
TEST(Su2Surface, LogIsTheRotationVectorOfTheShortestGeodesic) {
    const auto frames = surface_samples();
    for (const double angle : {0.0, 1e-5, 1.0, 5.0, 12.0, 15.0, 20.0, 30.0, 39.0, 41.0, 60.0}) {
        int found = 0, asked = 0;
        for (std::size_t i = 0; i + 1 < frames.size(); i += angle > 12 ? 4 : 1) {
            const Vector3 w = angle * degree * (frames[i + 1].vec() + Vector3(0.01, 0, 0)).normalized();
            const Quaternion q = turned(frames[i], w);
            const auto turn =
                su2_surface::log(su2_surface::point(Su2::embed(frames[i])), su2_surface::point(Su2::embed(q)));
            ++asked;
            if (!turn) continue;
            ++found;
            // Frames turned far can be near by another way.
            EXPECT_NEAR(turn->norm(), distance(frames[i], q), 3e-8);
            EXPECT_LT(turn->norm(), 40 * degree);
            if (angle < 45) {
                EXPECT_LT((*turn - w).norm(), 3e-8);
            }
        }
        const double share = angle <= 15 ? 1 : angle <= 20 ? 0.95 : 0;
        EXPECT_GE(found, share * asked) << angle;
    }
}

}  // namespace
}  // namespace octafield::frames
