// What corners ask for, and what is refused.
#include "boundary_lines.hpp"
#include "lines_fixtures.hpp"

namespace octafield::surface {
namespace {

TEST(CornerQuads, FollowTheTableOfAnglesHalvesDown) {
    const std::vector<std::pair<double, int>> table = {{1, 1},   {45, 1},  {90, 1},  {135, 1}, {140, 2}, {180, 2},
                                                       {220, 2}, {225, 2}, {230, 3}, {270, 3}, {310, 3}, {315, 3},
                                                       {320, 4}, {360, 4}, {400, 4}, {450, 5}, {540, 6}};
    for (const auto& [degrees, quads] : table)
        EXPECT_EQ(detail::quads_of_angle(degrees * degree, pi / 4), quads) << degrees;
    EXPECT_EQ(detail::quads_of_angle(151.35 * degree, 28 * degree), 1);
    EXPECT_EQ(detail::quads_of_angle(153 * degree, 28 * degree), 2);
}

class Wedges : public ::testing::TestWithParam<std::tuple<int, SecondLine>> {};

TEST_P(Wedges, BothSidesAreFollowedAndNoPointSitsAtTheCorner) {
    const double angle = std::get<0>(GetParam()) * degree;
    const TriangleMesh mesh = wedge(angle, 0.06);
    NonOrthogonalFieldOptions options;
    options.second_line = std::get<1>(GetParam());
    const NonOrthogonalField field = non_orthogonal_field(mesh, options);
    const Vector low(std::cos(angle / 2), -std::sin(angle / 2), 0), high(low.x(), -low.y(), 0);
    const Index apex = vertex_at(mesh, Vector::Zero());
    EXPECT_EQ(field.quads[apex], 1);
    EXPECT_LT(std::min(std::max(off(field.first.row(apex), low), off(field.second.row(apex), high)),
                       std::max(off(field.first.row(apex), high), off(field.second.row(apex), low))),
              1e-9);
    // One line along each side all the way.
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector p = mesh.vertices.row(v);
        for (const Vector& side : {low, high})
            if (p.cross(side).norm() < 1e-9 && p.norm() < 0.999) {
                EXPECT_LT(std::min(off(field.first.row(v), side), off(field.second.row(v), side)), 1e-6);
            }
    }
    const SurfaceSingularities points = surface_singularities(field);
    EXPECT_TRUE(points.agree);
    ASSERT_EQ(inside(points).size(), 1u);  // three corners of one quad
    EXPECT_EQ(inside(points)[0].index_times_symmetry, 1);
    EXPECT_GT(inside(points)[0].position.norm(), 2 * mean_edge_length(mesh));
}

INSTANTIATE_TEST_SUITE_P(Degrees, Wedges,
                         ::testing::Combine(::testing::Values(15, 30, 45, 60, 75),
                                            ::testing::Values(SecondLine::fixed, SecondLine::free)));

// Squares of the grid [0, n] x [0, m] that `keep` holds for, each two triangles.
TriangleMesh grid(int n, int m, const std::function<bool(int, int)>& keep, bool slit = false) {
    std::vector<Vector> points;
    std::map<std::array<int, 3>, int> ids;
    std::vector<Eigen::Vector3i> triangles;
    // Across a slit along y = m / 2, x < n / 2, vertices are double.
    const auto id = [&](int i, int j, int row) {
        const int upper = slit && 2 * j == m && 2 * i < n && 2 * row >= m;
        const auto [place, fresh] = ids.try_emplace({i, j, upper}, static_cast<int>(points.size()));
        if (fresh) points.emplace_back(i, j, 0);
        return place->second;
    };
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < m; ++j) {
            if (!keep(i, j)) continue;
            const int a = id(i, j, j), b = id(i + 1, j, j), c = id(i + 1, j + 1, j), d = id(i, j + 1, j);
            triangles.emplace_back(a, b, c);
            triangles.emplace_back(a, c, d);
        }
    return make_mesh(points, triangles);
}

void expect_axes(const NonOrthogonalField& field) {
    for (Index v = 0; v < field.domain.vertex_count(); ++v) {
        EXPECT_LT(std::min(off(field.first.row(v), {1, 0, 0}), off(field.first.row(v), {0, 1, 0})), 1e-6);
        EXPECT_LT(std::min(off(field.second.row(v), {1, 0, 0}), off(field.second.row(v), {0, 1, 0})), 1e-6);
    }
}

TEST(CornersOfNonOrthogonalFields, ANotchHasThreeQuadsAndAStraightField) {
    const auto field = non_orthogonal_field(grid(8, 8, [](int i, int j) { return i < 4 || j < 4; }));
    EXPECT_LT(field.energy, 1e-20);
    expect_axes(field);
    const SurfaceSingularities points = surface_singularities(field);
    EXPECT_TRUE(points.agree);
    ASSERT_EQ(points.points.size(), 6u);
    EXPECT_EQ(std::count_if(points.points.begin(), points.points.end(),
                            [](const auto& p) { return p.index_times_symmetry == -1; }),
              1);
}

TEST(CornersOfNonOrthogonalFields, TheEndOfASlitHasFourQuadsAndAStraightField) {
    for (const SecondLine second : {SecondLine::fixed, SecondLine::free}) {
        NonOrthogonalFieldOptions options;
        options.second_line = second;
        const auto field = non_orthogonal_field(grid(
                                                    8, 8, [](int, int) { return true; }, true),
                                                options);
        EXPECT_LT(field.energy, 1e-20);
        expect_axes(field);
        const SurfaceSingularities points = surface_singularities(field);
        EXPECT_TRUE(points.agree);
        ASSERT_EQ(points.points.size(), 7u);  // four corners, two at the mouth of the slit, its end
        const auto end = std::find_if(points.points.begin(), points.points.end(),
                                      [](const auto& p) { return p.index_times_symmetry == -2; });
        ASSERT_NE(end, points.points.end());
        EXPECT_NEAR((end->position - Vector(4, 4, 0)).norm(), 0, 1e-12);
    }
}

// The line along the slit goes on at its end, whatever the other one's angle.
TEST(CornersOfNonOrthogonalFields, ASlitAlongASideOfAParallelogramLeavesItsFieldStraight) {
    const Vector b(0.5, 0.9, 0);
    const TriangleMesh mesh = moved(grid(
                                        8, 8, [](int, int) { return true; }, true),
                                    [&](const Vector& p) { return Vector(p.x() * Vector(1, 0, 0) + p.y() * b); });
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    EXPECT_LT(field.energy, 1e-20);
    const Index end = vertex_at(mesh, 4 * Vector(1, 0, 0) + 4 * b);
    EXPECT_EQ(field.quads[end], 4);
    EXPECT_LT(std::min(off(field.first.row(end), {1, 0, 0}), off(field.second.row(end), {1, 0, 0})), 1e-9);
    EXPECT_LT(std::min(off(field.first.row(end), b), off(field.second.row(end), b)), 1e-9);
    EXPECT_TRUE(surface_singularities(field).agree);
}

TEST(CornersOfNonOrthogonalFields, AngleGoesLinearlyAlongSides) {
    const TriangleMesh mesh = right_trapezoid(60 * degree, 0.1);
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    const double length = 0.8 + 1 / std::tan(60 * degree);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {  // bottom: 90 degrees on the left, 60 inside on the right
        if (std::abs(mesh.vertices(v, 1)) > 1e-12) continue;
        const double angle = (90 + 30 * mesh.vertices(v, 0) / length) * degree;
        const Vector across(std::cos(angle), std::sin(angle), 0);
        EXPECT_LT(std::min(off(field.first.row(v), across), off(field.second.row(v), across)), 1e-9);
    }
}

template <class Exception>
void expect_refused(const SurfaceDomain& domain, const NonOrthogonalFieldOptions& options, const std::string& kind,
                    const std::vector<Index>& elements = {}) {
    try {
        non_orthogonal_field(domain, options);
        FAIL() << "not refused: " << kind;
    } catch (const Exception& error) {
        EXPECT_EQ(error.kind(), kind) << error.what();
        if (!elements.empty()) {
            EXPECT_EQ(error.elements(), elements);
        }
    }
}

TEST(NonOrthogonalFieldRefuses, OptionsOutOfRange) {
    const SurfaceDomain domain(grid(2, 2, [](int, int) { return true; }));
    const auto refused = [&](const std::function<void(NonOrthogonalFieldOptions&)>& set) {
        NonOrthogonalFieldOptions options;
        set(options);
        expect_refused<InvalidInput>(domain, options, "bad_option");
    };
    refused([](auto& o) { o.method = "newton"; });
    for (const double bad : {0., -1., double(NAN), double(INFINITY)}) refused([&](auto& o) { o.lambda = bad; });
    for (const double bad : {0., -0.1, pi / 2, double(NAN)}) refused([&](auto& o) { o.corner_angle = bad; });
    for (const double bad : {0., 1., double(NAN)}) refused([&](auto& o) { o.least_angle = bad; });
    refused([](auto& o) { o.max_iterations = 0; });
    refused([](auto& o) { o.inertia = -1; });
    refused([](auto& o) { o.penalty = NAN; });
    refused([](auto& o) { o.tolerance = -1; });
    refused([](auto& o) { o.method = "poly_vector", o.second_line = SecondLine::free; });
}

TEST(NonOrthogonalFieldRefuses, CornersThatCannotBe) {
    const TriangleMesh mesh = grid(4, 4, [](int, int) { return true; });
    const SurfaceDomain domain(mesh);
    const Index middle = vertex_at(mesh, {2, 2, 0}), side = vertex_at(mesh, {2, 0, 0}),
                corner = vertex_at(mesh, {0, 0, 0});
    const auto refused = [&](std::vector<CornerQuads> corners, const std::string& kind, std::vector<Index> elements) {
        NonOrthogonalFieldOptions options;
        options.corners = std::move(corners);
        expect_refused<InvalidInput>(domain, options, kind, elements);
    };
    refused({{middle, 1}}, "not_on_boundary", {middle});
    refused({{25, 1}, {-1, 1}}, "not_on_boundary", {25, -1});
    refused({{corner, 1}, {side, 2}, {corner, 2}}, "given_twice", {corner});
    refused({{side, 1}}, "bad_corner", {side});  // both lines along one straight side
    refused({{side, 3}}, "bad_corner", {side});
    refused({{corner, 0}}, "bad_corner", {corner});
    refused({{corner, 3}}, "bad_corner", {corner});
    refused({{corner, 4}}, "bad_corner", {corner});
}

TEST(NonOrthogonalFieldRefuses, SurfacesItCannotServe) {
    expect_refused<GeometryError>(SurfaceDomain(), {}, "empty");
    // Two triangles that share a vertex only.
    const TriangleMesh touching =
        make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, {{0, 1, 2}, {0, 3, 4}});
    expect_refused<GeometryError>(touching, {}, "non_manifold_vertex", {0});
    const TriangleMesh mesh = grid(2, 2, [](int, int) { return true; });
    Edges diagonal(1, 2);
    diagonal << vertex_at(mesh, {0, 0, 0}), vertex_at(mesh, {1, 1, 0});
    const SurfaceDomain creased(mesh, feature_graph(mesh, diagonal));
    expect_refused<InvalidInput>(creased, {}, "features_inside");
}

TEST(NonOrthogonalFieldRefuses, FieldsThatDoNotFitTheirSurface) {
    NonOrthogonalField field = non_orthogonal_field(grid(3, 3, [](int, int) { return true; }));
    const auto kind = [&] {
        try {
            surface_singularities(field);
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return std::string("none");
    };
    EXPECT_EQ(kind(), "none");
    field.angles(2, 1) = NAN;
    EXPECT_EQ(kind(), "not_finite");
    field.angles.conservativeResize(5, 2);
    EXPECT_EQ(kind(), "wrong_size");
}

TEST(NonOrthogonalField, VerticesInNoTriangleHaveNoLines) {
    TriangleMesh mesh = grid(3, 3, [](int, int) { return true; });
    mesh.vertices.conservativeResize(mesh.vertices.rows() + 1, 3);
    mesh.vertices.bottomRows(1) << 9, 9, 9;
    const NonOrthogonalField field = non_orthogonal_field(mesh);
    EXPECT_TRUE(field.first.bottomRows(1).isZero(0));
    EXPECT_EQ(field.quads.back(), 0);
    EXPECT_TRUE(surface_singularities(field).agree);
}

}  // namespace
}  // namespace octafield::surface
