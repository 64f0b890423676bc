// The tracer takes any field of directions in charts: two directions that are not at right angles, which no
// DirectionField has.
#include <gtest/gtest.h>

#include <numbers>

#include "charts.hpp"
#include "field_tracer.hpp"
#include "mesh_fixtures.hpp"

namespace octafield::surface::detail {
namespace {

// The lines along a and b, the same in all of the plane.
class TwoDirections : public Charts {
public:
    TwoDirections(const TriangleMesh& mesh, Eigen::Vector3d a, Eigen::Vector3d b)
        : Charts(mesh), directions_{std::move(a), std::move(b)} {}

    int symmetry() const { return 4; }  // a, b and their opposites
    Complex direction(Index t, Complex, Complex heading) const {
        Complex nearest = heading;
        double most = -1;
        for (const Eigen::Vector3d& d : directions_) {
            const Complex here = lower_vector(t, d.normalized());
            for (const Complex way : {here, -here})
                if (dot(way, heading) > most) most = dot(way, heading), nearest = way;
        }
        return nearest;
    }

private:
    std::array<Eigen::Vector3d, 2> directions_;
};

static_assert(TracedField<TwoDirections>);
static_assert(!TracedField<Charts>);

TEST(TracedField, LinesOfTwoObliqueDirectionsAreStraightFromTriangleToTriangle) {
    const TriangleMesh mesh = testing::disk(9);
    const Eigen::Vector3d a(1, 0.1, 0), b(std::cos(1.1), std::sin(1.1), 0);  // 57 degrees apart
    const TwoDirections field(mesh, a, b);
    const SurfaceSingularities none;
    const FieldTracer<TwoDirections> tracer(field, none, {});
    for (const Eigen::Vector3d& direction : {a, b, Eigen::Vector3d(-a), Eigen::Vector3d(-b)}) {
        const Index t = 10;
        const Complex heading = field.lower_vector(t, direction.normalized());
        const TracedCurve curve = tracer.trace({t, field.centroid(t), heading});
        EXPECT_EQ(curve.end, StreamlineEnd::boundary);
        ASSERT_GT(curve.points.size(), 8u);
        for (const Eigen::Vector3d& p : curve.points)
            EXPECT_LT((p - curve.points.front()).cross(direction.normalized()).norm(), 1e-5);
        EXPECT_NEAR(curve.length, (curve.points.back() - curve.points.front()).norm(), 1e-9);
    }
}

}  // namespace
}  // namespace octafield::surface::detail
