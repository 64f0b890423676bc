// Streamlines and separatrices of non-orthogonal fields. Oracle: a linear map of the plane takes the curves of an
// orthogonal field to those of a non-orthogonal one, and the straight separatrices of its singular point to straight
// lines.
#include "lines_fixtures.hpp"
#include "octafield/surface/non_orthogonal_streamlines.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface {
namespace {

using End = StreamlineEnd;

// Lines along a(p) and b(p) at each vertex.
NonOrthogonalField prescribed(const TriangleMesh& mesh, const std::function<std::array<Vector, 2>(const Vector&)>& at) {
    NonOrthogonalField field;
    field.domain = mesh;
    const detail::VertexCharts charts(field.domain);
    field.angles = Rows<double, 2>::Zero(mesh.vertices.rows(), 2);
    field.quads.assign(mesh.vertices.rows(), 0);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const auto [a, b] = at(mesh.vertices.row(v));
        const TwoLines lines = ordered({charts.lowered(v, a.transpose()), charts.lowered(v, b.transpose())});
        field.angles.row(v) << lines.first, lines.second;
        if (charts.on_boundary(v)) field.quads[v] = 2;
    }
    return field;
}

struct Sheared {
    Eigen::Matrix3d map;
    NonOrthogonalField field;
    double turn;  // of the orthogonal field on the positive x axis
};

// Crosses of index t / 4 about 0, and what `map` makes of them.
Sheared sheared_point(int t, double turn, const Eigen::Matrix3d& map) {
    const TriangleMesh mesh =
        moved(disk(12), [&](const Vector& p) { return Vector(map * (p + Vector(0.013, 0.021, 0))); });
    const Eigen::Matrix3d back = map.inverse();
    return {map,
            prescribed(mesh,
                       [&](const Vector& p) -> std::array<Vector, 2> {
                           const Vector q = back * p;
                           const double angle = turn + t / 4.0 * std::atan2(q.y(), q.x());
                           return {map * Vector(std::cos(angle), std::sin(angle), 0),
                                   map * Vector(-std::sin(angle), std::cos(angle), 0)};
                       }),
            turn};
}

class Points4 : public ::testing::TestWithParam<int> {};

TEST_P(Points4, SeparatricesOfAShearedPointAreStraightInTheShearedDirections) {
    const int t = GetParam();
    Eigen::Matrix3d map = Eigen::Matrix3d::Identity();
    map(0, 1) = 0.6;
    map(1, 1) = 0.8;
    for (const double turn : {0.0, 0.35, 0.8, 1.3}) {
        const Sheared sheared = sheared_point(t, turn, map);
        const SurfaceSingularities points = surface_singularities(sheared.field);
        ASSERT_EQ(points.points.size(), 1u);
        EXPECT_EQ(points.points[0].index_times_symmetry, t);
        EXPECT_LT(points.points[0].position.norm(), 0.05);
        const auto lines = separatrices(sheared.field, points);
        ASSERT_EQ(static_cast<int>(lines.size()), 4 - t);
        std::vector<double> expected;
        for (int m = 0; m < 4 - t; ++m) {
            const double phi = (turn + m * pi / 2) / (1 - t / 4.0);
            const Vector way = map * Vector(std::cos(phi), std::sin(phi), 0);
            expected.push_back(std::atan2(way.y(), way.x()));
        }
        for (const Streamline& line : lines) {
            EXPECT_EQ(line.first_end, End::singularity);
            EXPECT_EQ(line.last_end, End::boundary);
            EXPECT_EQ(line.first_singularity, 0);
            const Vector end = line.points.bottomRows(1).transpose();
            const double angle = std::atan2(end.y(), end.x());
            auto nearest = std::min_element(expected.begin(), expected.end(), [&](double a, double b) {
                return std::abs(std::remainder(a - angle, 2 * pi)) < std::abs(std::remainder(b - angle, 2 * pi));
            });
            ASSERT_NE(nearest, expected.end());
            EXPECT_LT(std::abs(std::remainder(*nearest - angle, 2 * pi)), 6 * degree) << t << ", turned by " << turn;
            expected.erase(nearest);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Indices, Points4, ::testing::Values(1, -1));

TEST(CurvesOfNonOrthogonalFields, InAParallelogramTheyAreParallelToItsSides) {
    const double angle = 50 * degree;
    const TriangleMesh mesh = parallelogram(angle, 0.1);
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    const SurfaceSingularities points;  // near corners, which are singular points, too, curves would end
    const Vector a(1, 0, 0), b(std::cos(angle), std::sin(angle), 0);
    std::vector<StreamlineSeed> seeds;
    for (const Index t : {5, 60, 111}) {
        seeds.push_back({t, a});
        seeds.push_back({t, b});
    }
    const auto lines = streamlines(field, points, seeds);
    ASSERT_EQ(lines.size(), seeds.size());
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Vector way = lines[i].points.bottomRows(1).transpose() - lines[i].points.topRows(1).transpose();
        EXPECT_LT(off(way.transpose(), seeds[i].direction), 1e-5);
        EXPECT_NEAR(way.norm(), i % 2 == 0 ? 1.3 : 1.0, 1e-4);  // from side to side
        EXPECT_NEAR(lines[i].length, way.norm(), 1e-6);
        EXPECT_EQ(lines[i].first_end, End::boundary);
        EXPECT_EQ(lines[i].last_end, End::boundary);
    }
}

TEST(CurvesOfNonOrthogonalFields, TwoLeaveAShearedNotchAlongItsSides) {
    std::vector<Vector> corners;
    std::vector<Eigen::Vector3i> triangles;
    std::map<std::pair<int, int>, int> ids;
    const Vector b(0.5, 0.9, 0);
    const auto id = [&](int i, int j) {
        const auto [place, fresh] = ids.try_emplace({i, j}, static_cast<int>(corners.size()));
        if (fresh) corners.emplace_back(i * Vector(1, 0, 0) + j * b);
        return place->second;
    };
    for (int i = 0; i < 8; ++i)
        for (int j = 0; j < 8; ++j) {
            if (i >= 4 && j >= 4) continue;
            triangles.emplace_back(id(i, j), id(i + 1, j), id(i + 1, j + 1));
            triangles.emplace_back(id(i, j), id(i + 1, j + 1), id(i, j + 1));
        }
    const TriangleMesh mesh = make_mesh(corners, triangles);
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    EXPECT_LT(field.energy, 1e-20);
    const SurfaceSingularities points = surface_singularities(field);
    const auto lines = separatrices(field, points);
    ASSERT_EQ(lines.size(), 2u);  // corners of one quad have none
    const Vector notch = 4 * Vector(1, 0, 0) + 4 * b;
    for (const Streamline& line : lines) {
        EXPECT_LT((line.points.row(0).transpose() - notch).norm(), 1e-12);
        EXPECT_EQ(line.last_end, End::boundary);
        const Vector way = line.points.bottomRows(1).transpose() - notch;
        EXPECT_LT(std::min((way + Vector(4, 0, 0)).norm(), (way + 4 * b).norm()), 1e-3);
    }
    EXPECT_GT((lines[0].points.bottomRows(1) - lines[1].points.bottomRows(1)).norm(), 1);
}

TEST(CurvesOfNonOrthogonalFields, BadSeedsAndOptionsAreRefused) {
    const NonOrthogonalField field = non_orthogonal_field(parallelogram(60 * degree, 0.3));
    const SurfaceSingularities points = surface_singularities(field);
    try {
        streamlines(field, points, {{0, {1, 0, 0}}, {9999, {1, 0, 0}}, {0, {0, 0, 1}}});
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "bad_seed");
        EXPECT_EQ(error.elements(), (std::vector<Index>{1, 2}));
    }
    StreamlineOptions options;
    options.max_length = -1;
    EXPECT_THROW(streamlines(field, points, {}, options), InvalidInput);
    SurfaceSingularities elsewhere = points;
    elsewhere.points[0].vertex = 9999;
    EXPECT_THROW(separatrices(field, elsewhere), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
