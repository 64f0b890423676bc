// Fields on surfaces: what is isometric to a plane domain has its field; closed surfaces have the index sum of theirs.
#include "lines_fixtures.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface {
namespace {

constexpr int columns = 24, rows = 16;

// A trapezoid whose columns of vertices are straight lines.
TriangleMesh ruled_trapezoid(double bottom, double top) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int i = 0; i <= columns; ++i)
        for (int j = 0; j <= rows; ++j) {
            const double y = static_cast<double>(j) / rows;
            points.emplace_back((bottom + y * (top - bottom)) * i / columns, y, 0);
        }
    for (int i = 0; i < columns; ++i)
        for (int j = 0; j < rows; ++j) {
            const int a = i * (rows + 1) + j, b = a + rows + 1;
            triangles.emplace_back(a, b, b + 1);
            triangles.emplace_back(a, b + 1, a + 1);
        }
    return make_mesh(points, triangles);
}

// Folded along a column of vertices.
TriangleMesh folded(TriangleMesh mesh, int column, double angle) {
    const Vector low = mesh.vertices.row(column * (rows + 1)), high = mesh.vertices.row(column * (rows + 1) + rows);
    const Eigen::AngleAxisd turn(angle, (high - low).normalized());
    for (Index v = (column + 1) * (rows + 1); v < mesh.vertices.rows(); ++v)
        mesh.vertices.row(v) = low + turn * Vector(mesh.vertices.row(v).transpose() - low);
    return mesh;
}

TEST(NonOrthogonalFieldOnSurfaces, AFoldedPlaneHasTheFieldOfThePlane) {
    for (const double bottom : {1.2, 2.2}) {  // the acute corner has 68 and 35 degrees
        const TriangleMesh flat = ruled_trapezoid(bottom, 0.8);
        const TriangleMesh bent = folded(folded(flat, 8, 50 * degree), 15, -70 * degree);
        for (const SecondLine second : {SecondLine::fixed, SecondLine::free}) {
            NonOrthogonalFieldOptions options;
            options.second_line = second;
            const NonOrthogonalField plane = non_orthogonal_field(flat, options);
            const NonOrthogonalField field = non_orthogonal_field(bent, options);
            EXPECT_NEAR(field.energy, plane.energy, 1e-8 * plane.energy);
            double most = 0;
            for (Index v = 0; v < flat.vertices.rows(); ++v)
                most = std::max(most, squared_distance(power_sums({field.angles(v, 0), field.angles(v, 1)}),
                                                       power_sums({plane.angles(v, 0), plane.angles(v, 1)}), 1));
            EXPECT_LT(most, 1e-7);
            const auto points = surface_singularities(field), same = surface_singularities(plane);
            ASSERT_EQ(points.points.size(), same.points.size());
            for (std::size_t i = 0; i < same.points.size(); ++i)
                EXPECT_EQ(points.points[i].triangle, same.points[i].triangle);
            EXPECT_TRUE(points.agree);
        }
    }
}

TEST(VertexChartsOfSurfaces, CurvatureOfTheSphereIsSpreadOverItsTriangles) {
    const SurfaceDomain sphere(icosphere(2));
    const detail::VertexCharts charts(sphere);
    const Eigen::VectorXd areas = triangle_areas(sphere.mesh());
    double sum = 0;
    for (Index t = 0; t < sphere.triangle_count(); ++t) {
        double turn = 0;
        for (int k = 0; k < 3; ++k) {
            const Index e = sphere.topology().triangle_edges(t, k);
            turn += (sphere.topology().edges(e, 0) == sphere.mesh().triangles(t, k) ? 1 : -1) * charts.transport(e);
        }
        const double curvature = std::remainder(turn, 2 * pi);
        EXPECT_NEAR(curvature, 4 * pi * areas[t] / areas.sum(), 0.3 * 4 * pi / sphere.triangle_count());
        sum += curvature;
    }
    EXPECT_NEAR(sum, 4 * pi, 1e-9);
}

TEST(NonOrthogonalFieldOnSurfaces, ACylinderHasRingsAndStraightLines) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    const int around = 24, along = 8;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i)
            points.emplace_back(std::cos(2 * pi * i / around), std::sin(2 * pi * i / around), 2.0 * j / along);
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around;
            triangles.emplace_back(a, b, b + around);
            triangles.emplace_back(a, b + around, a + around);
        }
    const TriangleMesh mesh = make_mesh(points, triangles);
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    EXPECT_LT(field.energy, 1e-20);
    double most = 0;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        most = std::max(most, std::min(off(field.first.row(v), {0, 0, 1}), off(field.second.row(v), {0, 0, 1})));
    EXPECT_LT(most, 0.005);  // normals of vertices are not quite radial
    const SurfaceSingularities none = surface_singularities(field);
    EXPECT_TRUE(none.points.empty());
    EXPECT_TRUE(none.agree);
    EXPECT_EQ(none.euler_characteristic, 0);
}

TEST(NonOrthogonalFieldOnSurfaces, PatchesOfLargeSpheresHaveTheFieldOfThePlane) {
    const auto lifted = [](double radius) {
        return [radius](const Vector& p) { return Vector(p.x(), p.y(), std::sqrt(radius * radius - p.squaredNorm())); };
    };
    const TriangleMesh oblique = parallelogram(60 * degree, 0.1), flat = right_trapezoid(30 * degree, 0.1);
    const double near = non_orthogonal_field(moved(oblique, lifted(10))).energy,
                 far = non_orthogonal_field(moved(oblique, lifted(40))).energy;
    EXPECT_LT(near, 0.01);
    EXPECT_LT(far, near / 100);  // angles are off by the area over the radius squared, energy by the square of that
    const NonOrthogonalField plane = non_orthogonal_field(flat), patch = non_orthogonal_field(moved(flat, lifted(100)));
    EXPECT_NEAR(patch.energy, plane.energy, 1e-3 * plane.energy);
    const auto points = surface_singularities(patch);
    EXPECT_EQ(inside(points).size(), 1u);
    EXPECT_TRUE(points.agree);
}

TEST(NonOrthogonalFieldOnSurfaces, AnOctantOfTheSphereHasOnePoint) {
    // Right corners of one quad each: the curvature takes what a plane triangle would need acute corners for.
    TriangleMesh mesh = polygon({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, 0.1);
    mesh.vertices.rowwise().normalize();
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    const SurfaceSingularities points = surface_singularities(field);
    ASSERT_EQ(inside(points).size(), 1u);
    EXPECT_EQ(inside(points)[0].index_times_symmetry, 1);
    EXPECT_LT((inside(points)[0].position.normalized() - Vector(1, 1, 1).normalized()).norm(), 0.15);
    EXPECT_TRUE(points.agree);
    // By symmetry lines are nearly at right angles.
    EXPECT_GT(field.smallest_angle, 80 * degree);
}

TEST(NonOrthogonalFieldOnSurfaces, ClosedSurfacesHaveTheirIndexSum) {
    for (const auto& [mesh, sum] : {std::pair(icosphere(2), 2.), std::pair(testing::torus(24, 12, 1, 0.4), 0.),
                                    std::pair(testing::cube_surface(6), 2.)}) {
        const NonOrthogonalField field = non_orthogonal_field(mesh);
        const SurfaceSingularities points = surface_singularities(field);
        EXPECT_TRUE(points.agree);
        EXPECT_EQ(points.index_sum, sum);
        EXPECT_LE(field.energy, field.start_energy * (1 + 1e-12));
        for (const auto& point : points.points) EXPECT_EQ(std::abs(point.index_times_symmetry), 1);
        const Points normals = vertex_normals(mesh);
        for (Index v = 0; v < mesh.vertices.rows(); ++v) {
            EXPECT_NEAR(field.first.row(v).norm(), 1, 1e-12);
            EXPECT_NEAR(field.second.row(v).dot(normals.row(v)), 0, 1e-12);
        }
    }
}

TEST(NonOrthogonalFieldOnSurfaces, PartsOfOneMeshDoNotSeeOneAnother) {
    const TriangleMesh closed = icosphere(2), open = parallelogram(60 * degree, 0.15);
    TriangleMesh both;
    both.vertices.resize(closed.vertices.rows() + open.vertices.rows(), 3);
    both.vertices << closed.vertices, open.vertices.rowwise() + Eigen::RowVector3d(5, 0, 0);
    both.triangles.resize(closed.triangles.rows() + open.triangles.rows(), 3);
    both.triangles << closed.triangles, open.triangles.array() + static_cast<Index>(closed.vertices.rows());
    const NonOrthogonalField field = non_orthogonal_field(both);
    const SurfaceSingularities points = surface_singularities(field);
    EXPECT_TRUE(points.agree);
    for (const auto& point : inside(points)) EXPECT_LT(point.triangle, closed.triangles.rows());
    const double alone = non_orthogonal_field(closed).energy;
    EXPECT_NEAR(field.energy, alone, 0.02 * alone);
}

}  // namespace
}  // namespace octafield::surface
