// Singular points of prescribed fields; oracles are the fields' formulas and Euler characteristics.
#include "octafield/surface/surface_singularities.hpp"

#include <limits>

#include "direction_field_fixtures.hpp"

namespace octafield::surface {
namespace {

Vector at_angle(double angle) { return Vector(std::cos(angle), std::sin(angle), 0); }
double polar_angle(const Vector& x) { return std::atan2(x.y(), x.x()); }

TEST(SurfaceSingularities, ResultStatesTheSumAndTheEulerCharacteristic) {
    const auto outward = [](const Vector& x) { return x; };
    const auto tube = [](const Vector& x) -> Vector { return x - Vector(x.x(), x.y(), 0).normalized(); };
    for (const int symmetry : {1, 2, 3, 4, 6}) {
        const auto on_sphere = icosphere(3);
        const auto sphere = surface_singularities(prescribed(on_sphere, symmetry, azimuth, outward));
        EXPECT_TRUE(sphere.agree);
        EXPECT_EQ(sphere.euler_characteristic, 2);
        EXPECT_EQ(sphere.index_sum, 2);
        EXPECT_EQ(sphere.boundary_deviation, 0);
        const auto on_torus = torus(20, 12, 1, 0.4);
        const auto ring = surface_singularities(prescribed(on_torus, symmetry, azimuth, tube));
        EXPECT_TRUE(ring.agree);
        EXPECT_TRUE(ring.points.empty());
        EXPECT_EQ(ring.euler_characteristic, 0);
    }
}

TEST(SurfaceSingularities, PartsThatTouchAtAVertexCountOnePerPart) {
    // Two tetrahedra with one common vertex.
    const TriangleMesh mesh =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}},
                  {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}, {0, 4, 5}, {0, 6, 4}, {0, 5, 6}, {4, 6, 5}});
    DirectionField field;
    field.domain = mesh;
    field.values = Eigen::VectorXcd::Ones(field.domain.edge_count());
    const auto found = surface_singularities(field);
    EXPECT_EQ(found.euler_characteristic, 4);
    EXPECT_EQ(found.index_sum, 4);
    EXPECT_TRUE(found.agree);
}

TEST(SurfaceSingularities, FieldAtAnAngleToTheBoundaryHasItsPointsInsideOnly) {
    // Round the centre, turned against the circle by an angle that varies along it.
    const TriangleMesh mesh = disk(12);
    for (const int symmetry : {1, 2, 3, 4, 6}) {
        const double most = 0.8 * pi / symmetry;
        const auto direction = [&](const Vector& x) {
            return at_angle(polar_angle(x) + pi / 2 + most * std::sin(3 * polar_angle(x)));
        };
        const auto found = surface_singularities(prescribed(mesh, symmetry, direction, up));
        EXPECT_TRUE(found.agree);
        for (const auto& point : found.points) EXPECT_FALSE(point.boundary);
        EXPECT_NEAR(found.boundary_deviation, most, 0.02 * most);
    }
}

TEST(SurfaceSingularities, ConstantFieldInADiskHasPointsWhereItChangesTheBranchThatFollowsTheCircle) {
    const TriangleMesh mesh = disk(20);
    for (const int symmetry : {2, 4, 6}) {
        const auto field = prescribed(
            mesh, symmetry, [](auto&) { return at_angle(0.05); }, up);
        const auto found = surface_singularities(field);
        EXPECT_TRUE(found.agree);
        EXPECT_EQ(found.index_sum, 1);
        ASSERT_EQ(static_cast<int>(found.points.size()), symmetry);
        for (const auto& point : found.points) {
            EXPECT_TRUE(point.boundary);
            EXPECT_EQ(point.index_times_symmetry, 1);
            // Half way between two of the N directions, seen from the circle.
            const double turns = (polar_angle(point.position) + pi / 2 - 0.05) * symmetry / (2 * pi);
            EXPECT_NEAR(std::abs(turns - std::floor(turns) - 0.5), 0, symmetry * 0.5 / 60);
        }
        EXPECT_NEAR(found.boundary_deviation, pi / symmetry, 2 * pi / 120);
    }
}

TEST(SurfaceSingularities, FieldAcrossTheBoundaryHasNoneThere) {
    // The worst angle everywhere, but for rounding and the mesh: rays, and for N = 4 the diagonals of rays and circles.
    const TriangleMesh mesh = disk(12);
    for (const int symmetry : {2, 4, 6}) {
        const auto direction = [&](const Vector& x) { return at_angle(polar_angle(x) + pi / 2 + pi / symmetry); };
        const auto found = surface_singularities(prescribed(mesh, symmetry, direction, up));
        EXPECT_TRUE(found.agree);
        EXPECT_EQ(found.index_sum, 1);
        for (const auto& point : found.points) EXPECT_FALSE(point.boundary);
        EXPECT_NEAR(found.boundary_deviation, pi / symmetry, 1e-3);
    }
}

TEST(SurfaceSingularities, ZerosAtEdgeMidpointsKeepTheSumExact) {
    for (const int symmetry : {1, 3, 4}) {
        const TriangleMesh mesh = icosphere(2);
        DirectionField field = prescribed(mesh, symmetry, azimuth, [](const Vector& x) { return x; });
        for (Index e = 0; e < field.values.size(); e += 3) field.values[e] = e % 2 == 0 ? 0 : 1e-300;
        EXPECT_TRUE(surface_singularities(field).agree);
    }
}

TEST(SurfaceSingularities, DoNotDependOnTheUnit) {
    TriangleMesh mesh = disk(9);
    const Vector zero(0.171, 0.092, 0);
    std::vector<Vector> places;
    for (const double unit : {1.0, 1e-6, 1e6}) {
        TriangleMesh scaled = mesh;
        scaled.vertices *= unit;
        const auto direction = [&](const Vector& x) { return at_angle(polar_angle(x - unit * zero) / 4); };
        const auto found = surface_singularities(prescribed(scaled, 4, direction, up));
        int inside = 0;
        for (const auto& point : found.points) {
            if (point.boundary) continue;
            ++inside;
            EXPECT_LT((point.position / unit - zero).norm(), 0.1);
            places.push_back(point.position / unit);
        }
        EXPECT_EQ(inside, 1);
    }
    for (const Vector& place : places) EXPECT_NEAR((place - places[0]).norm(), 0, 1e-9);
}

TEST(SurfaceSingularities, RefuseValuesThatAreNotFiniteAndOtherMeshes) {
    const TriangleMesh mesh = disk(3);
    DirectionField field = prescribed(mesh, 4, azimuth, up);
    field.values[7] = std::numeric_limits<double>::quiet_NaN();
    try {
        surface_singularities(field);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "not_finite");
        EXPECT_EQ(error.elements(), std::vector<Index>{7});
    }
    field.domain = disk(4);
    try {
        surface_singularities(field);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "wrong_size");
    }
}

}  // namespace
}  // namespace octafield::surface
