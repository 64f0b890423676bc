#include "octafield/frames/registry.hpp"

#include "octafield/frames/geodesic.hpp"
#include "representation_laws.hpp"

namespace octafield::frames {
namespace {

TEST(Registry, FindsEveryRepresentationByItsNameAndNoOther) {
    for (const std::string& name : Representations::names()) {
        std::string found;
        with_representation(name, [&]<Representation R>() { found = R::name; });
        EXPECT_EQ(found, name);
    }
    try {
        with_representation("sh5", []<Representation>() {});
        FAIL();
    } catch (const InvalidInput& error) {
        for (const std::string& name : Representations::names())
            EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
    }
}

TEST(Conversions, BetweenAllPairsCommute) {
    const Quaternions samples = random_rotations(50, 31);
    Representations::for_each([&]<Representation A>() {
        Representations::for_each([&]<Representation B>() {
            for (Eigen::Index i = 0; i < samples.rows(); ++i) {
                const Quaternion q = row_quaternion(samples, i);
                const auto b = B::embed(A::project(A::embed(q)).frame);
                EXPECT_LT((b - B::embed(q)).norm(), 1e-6) << A::name << " to " << B::name;
                EXPECT_LT((A::embed(B::project(b).frame) - A::embed(q)).norm(), 1e-6) << A::name << " to " << B::name;
            }
        });
    });
}

TEST(Metrics, AreSymmetricWhereTheyClaimAndZeroOnlyForTheSameFrame) {
    const Quaternions a = random_rotations(200, 32), b = random_rotations(200, 33);
    for (const Metric& m : metrics())
        for (Eigen::Index i = 0; i < a.rows(); ++i) {
            const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
            for (const Quaternion& o : {octahedral_group()[4], octahedral_group()[12], octahedral_group()[20]}) {
                EXPECT_LT(m.distance(p, p * o), 1e-7) << m.name;
                EXPECT_NEAR(m.distance(p * o, q), m.distance(p, q), 1e-9 * (1 + m.distance(p, q))) << m.name;
            }
            EXPECT_GT(m.distance(p, q), 0.02 * distance(p, q)) << m.name;
            if (m.name == "su2_end") continue;
            EXPECT_NEAR(m.distance(p, q), m.distance(q, p), 1e-9 * (1 + m.distance(p, q))) << m.name;
        }
}

TEST(Metrics, MeasureTheAngleTimesTheirSpeedAtSmallAngles) {
    const Quaternions a = random_rotations(200, 34), directions = random_rotations(200, 35);
    for (const Metric& m : metrics()) {
        if (m.speed == 0) continue;
        for (Eigen::Index i = 0; i < a.rows(); ++i) {
            const Vector3 w = 1e-4 * log(row_quaternion(directions, i)).normalized();
            const Quaternion p = row_quaternion(a, i), q = exp(w) * p;
            // The pulled-back metric at an end is exact to first order only.
            EXPECT_NEAR(m.distance(p, q) / (m.speed * 1e-4), 1, 2e-3) << m.name;
        }
    }
}

TEST(Metrics, Su2GeodesicIsTheGeodesicDistance) {
    const Quaternions a = random_rotations(500, 36), b = random_rotations(500, 37);
    for (Eigen::Index i = 0; i < a.rows(); ++i) {
        const Quaternion p = row_quaternion(a, i), q = row_quaternion(b, i);
        EXPECT_NEAR(metric("su2_geodesic").distance(p, q), distance(p, q), 1e-9);
    }
}

TEST(Metrics, UnknownNamesAreRefusedWithTheKnownOnes) {
    try {
        metric("manhattan");
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_NE(std::string(error.what()).find("su2_midpoint"), std::string::npos);
    }
}

}  // namespace
}  // namespace octafield::frames
