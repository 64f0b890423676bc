// Points of any place and index are where they were put, on a surface that keeps its shape; patterns and their edits.
#include <Eigen/QR>

#include "imposed_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {
namespace {

// Everything imposed is found, and nothing else inside.
void expect_imposed(const ImposedField& field) {
    std::map<Index, int> inner;
    std::vector<Index> boundary;
    for (const auto& p : surface_singularities(field.field).points)
        if (p.boundary) boundary.push_back(p.vertex);
    for (const auto& [v, t] : found_indices(field.field))
        if (std::find(boundary.begin(), boundary.end(), v) == boundary.end()) inner[v] = t;
    std::map<Index, int> expected;
    for (std::size_t i = 0; i < field.point_vertices.size(); ++i)
        expected[field.point_vertices[i]] = field.pattern.points[i].index_times_four;
    EXPECT_EQ(inner, expected);
    EXPECT_LT(field.closure, 1e-9);
}

// Each fine triangle lies in its origin, facing the same way, and they fill it.
void expect_parts_of(const SurfaceDomain& input, const ImposedField& field) {
    const SurfaceDomain& fine = field.field.domain;
    const Eigen::VectorXd areas = triangle_areas(fine.mesh()), wholes = triangle_areas(input.mesh());
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(wholes.size());
    for (Index t = 0; t < areas.size(); ++t) {
        sums[field.triangle_origins[t]] += areas[t];
        EXPECT_GT(fine.normals().row(t).dot(input.normals().row(field.triangle_origins[t])), 1 - 1e-6);
    }
    EXPECT_LT(((sums - wholes).array() / wholes.array()).abs().maxCoeff(), 1e-9);
    for (Index v = 0; v < fine.vertex_count(); ++v) {
        const ImposedPoint place{field.vertex_triangles[v], field.vertex_weights.row(v), 0};
        EXPECT_LT((imposed_position(input, place) - fine.mesh().vertices.row(v).transpose()).norm(), 1e-12);
        EXPECT_GE(place.weights.minCoeff(), -1e-15);
    }
    for (Index v = 0; v < input.vertex_count(); ++v)
        EXPECT_EQ(fine.mesh().vertices.row(v), input.mesh().vertices.row(v));
}

TEST(ImposedPoints, OfFacesEdgesAndVerticesAlike) {
    const SurfaceDomain domain(disk(9));
    const Index inner_edge = domain.topology().triangle_edges(100, 1);
    ASSERT_GE(domain.topology().edge_triangles.row(inner_edge).minCoeff(), 0);
    SingularPattern pattern;
    pattern.points = {{20, {0.2, 0.3, 0.5}, 1},
                      {100, {0, 0.4, 0.6}, 1},
                      {300, {0.999, 0.0005, 0.0005}, 1},
                      imposed_at_vertex(domain, 150, 1)};
    const ImposedField field = impose_singular_points(domain, pattern);
    EXPECT_EQ(field.point_vertices[3], 150);
    for (std::size_t i = 0; i < 4; ++i)
        EXPECT_LT((field.field.domain.mesh().vertices.row(field.point_vertices[i]).transpose() -
                   imposed_position(domain, pattern.points[i]))
                      .norm(),
                  1e-12);
    expect_imposed(field);
    expect_parts_of(domain, field);
}

TEST(ImposedPoints, OfAnyValenceOnACoarseMesh) {
    for (const int t : {3, 2, -2, -4, -6, -9, -20}) {
        const SurfaceDomain domain(disk(5));
        SingularPattern pattern;
        pattern.points.push_back(imposed_point(domain, Vector(0.13, 0.07, 0), t));
        for (int i = 0; i < std::abs(4 - t); ++i)
            pattern.points.push_back(
                imposed_point(domain, in_plane(std::polar(0.6, 0.1 + 2 * pi * i / std::abs(4 - t))), t < 4 ? 1 : -1));
        const ImposedField field = impose_singular_points(domain, pattern);
        expect_imposed(field);
        expect_parts_of(domain, field);
        const auto singularities = surface_singularities(field.field);
        std::vector<int> leaving(singularities.points.size(), 0);
        for (const Streamline& line : separatrices(field.field, singularities)) ++leaving[line.first_singularity];
        for (std::size_t i = 0; i < leaving.size(); ++i)
            EXPECT_EQ(leaving[i], 4 - singularities.points[i].index_times_symmetry);
    }
}

TEST(ImposedPoints, SeveralInOneTriangleOrOnOneEdgeAreKeptApart) {
    const SurfaceDomain domain(disk(6));
    SingularPattern in_triangle, on_edge;
    in_triangle.points = {{30, {0.2, 0.3, 0.5}, 1},
                          {30, {0.3, 0.3, 0.4}, -1},
                          {30, {0.6, 0.2, 0.2}, 3},
                          {30, {0.6, 0.21, 0.19}, -2},
                          {30, {0.1, 0.001, 0.899}, 3}};
    on_edge.points = {{30, {0.5, 0.5, 0}, 1},
                      {30, {0.2, 0.8, 0}, -1},
                      {30, {0.7, 0.3, 0}, 3},
                      {30, {0.6, 0.35, 0.05}, -2},
                      {30, {0.3, 0.45, 0.25}, 3}};
    for (const SingularPattern& pattern : {in_triangle, on_edge}) {
        const ImposedField field = impose_singular_points(domain, pattern);
        for (std::size_t i = 0; i < 5; ++i)
            EXPECT_LT((imposed_position(domain, field.pattern.points[i]) - imposed_position(domain, pattern.points[i]))
                          .norm(),
                      2e-4 * domain.mean_edge_length());
        expect_imposed(field);
        expect_parts_of(domain, field);
    }
}

TEST(ImposedPoints, NearEdgesAndVerticesAreWhereTheyWerePut) {
    const SurfaceDomain domain(disk(6));
    for (const double near : {0.1, 1e-2, 1e-3}) {
        SingularPattern pattern;
        pattern.points = {{30, {near, 0.4, 0.6 - near}, 1}, {70, {near, near / 3, 1 - near - near / 3}, 3}};
        const ImposedField field = impose_singular_points(domain, pattern);
        for (std::size_t i = 0; i < 2; ++i)
            EXPECT_LT((imposed_position(domain, field.pattern.points[i]) - imposed_position(domain, pattern.points[i]))
                          .norm(),
                      1e-12);
        expect_imposed(field);
        expect_parts_of(domain, field);
    }
}

TEST(ImposedPoints, OnTheBoundaryAreQuadsThere) {
    const SurfaceDomain domain(plate(10, [](double, double) { return true; }));
    SingularPattern pattern;  // a corner less, a place with 1 quad instead, on an edge and at a vertex
    pattern.corners = {{0, 2}};
    ASSERT_EQ(domain.mesh().vertices.row(0).norm(), 0);
    for (const Vector& place : {Vector(0.33, 0, 0), Vector(0.3, 0, 0)}) {
        pattern.points = {imposed_point(domain, place, 1)};
        const ImposedField field = impose_singular_points(domain, pattern);
        const auto found = found_indices(field.field);
        EXPECT_EQ(found.size(), 4u);
        EXPECT_EQ(found.count(field.point_vertices[0]) ? found.at(field.point_vertices[0]) : 0, 1);
        EXPECT_EQ(found.count(0), 0u);
        EXPECT_LT(surface_singularities(field.field).boundary_deviation, 1e-9);
    }
}

TEST(ImposedPoints, FeaturesAreCarriedOver) {
    const TriangleMesh cube = cube_surface(4);
    const SurfaceDomain domain(cube, detect_features(cube));
    SingularPattern pattern;
    for (const double x : {0.0, 1.0})
        for (const double y : {0.0, 1.0})
            for (const double z : {0.0, 1.0})
                pattern.points.push_back(imposed_point(domain, Vector(x, y, z == 0 ? 0.1 : 0.95), 1));
    const ImposedField field = impose_singular_points(domain, pattern);
    expect_imposed(field);
    expect_parts_of(domain, field);
    const SurfaceDomain& fine = field.field.domain;
    double length = 0;
    for (const auto& edge : fine.features().edges.rowwise())
        length += (fine.mesh().vertices.row(edge[0]) - fine.mesh().vertices.row(edge[1])).norm();
    EXPECT_NEAR(length, 12, 1e-9);
    EXPECT_EQ(fine.features().corners, domain.features().corners);
}

TEST(ImposedPoints, TheBoundaryIsFollowedExactlyAndStaysAFeature) {
    const TriangleMesh mesh = plate(10, [](double, double) { return true; });
    const SurfaceDomain domain(mesh, detect_features(mesh));
    SingularPattern pattern;
    pattern.points = {imposed_point(domain, Vector(0.33, 0, 0), 1), imposed_point(domain, Vector(0.5, 0.61, 0), -1)};
    const ImposedField field = impose_singular_points(domain, pattern);
    const SurfaceDomain& fine = field.field.domain;
    double length = 0;
    for (const auto& edge : fine.features().edges.rowwise())
        length += (fine.mesh().vertices.row(edge[0]) - fine.mesh().vertices.row(edge[1])).norm();
    EXPECT_NEAR(length, 4, 1e-9);
    for (Index e = 0; e < fine.edge_count(); ++e)
        if (fine.topology().edge_triangles.row(e).minCoeff() < 0) {
            EXPECT_EQ(field.field.values[e], 1.0);
        }
}

TEST(ImposedPoints, SeparateComponentsHaveFieldsOfTheirOwn) {
    const TriangleMesh two = joined({disk(5), annulus(0.3, 40, 6)});
    const SurfaceDomain domain(two);
    SingularPattern pattern;
    for (int i = 0; i < 4; ++i)
        pattern.points.push_back(imposed_point(domain, in_plane(std::polar(0.6, 0.3 + i * pi / 2)), 1));
    const ImposedField field = impose_singular_points(domain, pattern);
    expect_imposed(field);
    EXPECT_EQ(field.conditions.size(), 1u);
}

TEST(ImposedPoints, SameInputSameBits) {
    const SurfaceDomain domain(annulus(0.3, 40, 8));
    SingularPattern pattern;
    pattern.points = {imposed_point(domain, Vector(0.5, 0.1, 0), 1), imposed_point(domain, Vector(-0.5, 0.3, 0), -1)};
    const ImposedFieldOptions options{.inadmissible = Inadmissible::move};
    const ImposedField a = impose_singular_points(domain, pattern, options);
    const ImposedField b = impose_singular_points(domain, pattern, options);
    EXPECT_EQ(a.field.values, b.field.values);
    EXPECT_EQ(a.log_size, b.log_size);
}

TEST(ImposedPoints, DoNotDependOnTheUnitOfLength) {
    TriangleMesh mesh = disk(8);
    for (const double scale : {1e-6, 1e6}) {
        TriangleMesh scaled = mesh;
        scaled.vertices *= scale;
        const SurfaceDomain domain(scaled);
        SingularPattern pattern;
        for (int i = 0; i < 4; ++i)
            pattern.points.push_back(imposed_point(domain, scale * in_plane(std::polar(0.6, 0.3 + i * pi / 2)), 1));
        expect_imposed(impose_singular_points(domain, pattern));
    }
}

TEST(SingularPatterns, OfAComputedFieldCanBeImposedAndEdited) {
    const SurfaceDomain domain(plate(20, [](double, double) { return true; }));
    // No corner is followed as one: the field of one cross has the four corners all the same.
    const DirectionField computed = direction_field(domain);
    const SingularPattern pattern = singular_pattern(computed, surface_singularities(computed));
    EXPECT_TRUE(pattern.points.empty());
    EXPECT_EQ(pattern.corners.size(), 4u);
    const ImposedField same = impose_singular_points(domain, pattern);
    EXPECT_TRUE(same.pattern.points.empty());

    const SurfaceDomain round(disk(20));
    const DirectionField on_disk = direction_field(round);
    SingularPattern four = singular_pattern(on_disk, surface_singularities(on_disk));
    ASSERT_EQ(four.points.size(), 4u);
    expect_imposed(impose_singular_points(round, four));

    const auto at = [&](const ImposedPoint& p) { return imposed_position(round, p); };
    four = move_singular_point(round, four, 2, Vector(0.1, 0.2, 0));
    EXPECT_LT((at(four.points[2]) - Vector(0.1, 0.2, 0)).norm(), 1e-12);
    four = add_singular_pair(round, four, Vector(0.4, -0.3, 0), Vector(-0.4, -0.3, 0));
    ASSERT_EQ(four.points.size(), 6u);
    expect_imposed(impose_singular_points(round, four));
    const Index some[] = {0, 2, 4};
    four = merge_singular_points(round, four, some, Vector(-0.1, 0.05, 0));
    ASSERT_EQ(four.points.size(), 4u);
    EXPECT_EQ(four.points.back().index_times_four, 3);
    expect_imposed(impose_singular_points(round, four));
    const Index pair[] = {2, 3};  // of valence 5, and the merged one
    EXPECT_EQ(merge_singular_points(round, four, pair, Vector(0, 0, 0)).points.back().index_times_four, 2);
    const Index last[] = {3};
    EXPECT_EQ(remove_singular_points(four, last).points.size(), 3u);
}

TEST(CornerQuads, AreRoundedHalvesDown) {
    const auto fan = [](double angle) {  // a sector of four triangles with its corner at vertex 0
        std::vector<Vector> points = {Vector::Zero()};
        std::vector<Eigen::Vector3i> triangles;
        for (int i = 0; i <= 8; ++i) points.push_back(in_plane(std::polar(1.0, angle * i / 8)));
        for (int i = 1; i <= 8; ++i) triangles.emplace_back(0, i, i + 1);
        return SurfaceDomain(make_mesh(points, triangles));
    };
    for (const auto& [angle, quads] : std::map<double, int>{
             {30, 1}, {45, 1}, {60, 1}, {135, 1}, {136, 2}, {225, 2}, {226, 3}, {270, 3}, {315, 3}, {320, 4}}) {
        int found = 2;
        for (const CornerQuads& corner : default_corner_quads(fan(angle * degree)))
            if (corner.vertex == 0) found = corner.quads;
        EXPECT_EQ(found, quads) << angle;
    }
}

// A sector of the unit disk, rings growing geometrically from its tip, vertex 0; the arc's vertices last.
SurfaceDomain sector(double angle, int around, int rings) {
    std::vector<Vector> points = {Vector::Zero()};
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i <= around; ++i)
            points.push_back(in_plane(std::polar(std::pow(0.88, rings - 1 - j), angle * i / around)));
    for (int i = 1; i <= around; ++i) triangles.emplace_back(0, i, i + 1);
    for (int j = 0; j + 1 < rings; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = 1 + j * (around + 1) + i, b = a + around + 1;
            triangles.insert(triangles.end(), {{a, b, b + 1}, {a, b + 1, a + 1}});
        }
    return SurfaceDomain(make_mesh(points, triangles));
}

// Near a corner of angle phi with v quads the size goes as r^(1 - v pi / (2 phi)): fitted on the middle ray with the
// next terms, r^(n pi / phi), of a harmonic function between straight sides.
TEST(CornerQuads, GiveTheSizeItsPower) {
    for (const auto& [angle, quads] :
         std::vector<std::pair<double, int>>{{30, 1}, {45, 1}, {60, 1}, {135, 1}, {135, 2}, {270, 3}, {270, 2}}) {
        const int around = 24, rings = 40;
        const SurfaceDomain domain = sector(angle * degree, around, rings);
        const int first = 1 + (rings - 1) * (around + 1), left = quads;  // for the arc, beside its ends of one quad
        SingularPattern pattern;
        pattern.corners = {{0, quads}, {first, 1}, {first + around, 1}};
        for (int i = 1; i <= left; ++i) pattern.corners.push_back({first + around * i / (left + 1), 1});
        const ImposedField field = impose_singular_points(domain, pattern);
        Eigen::MatrixXd terms(20, 4);
        Eigen::VectorXd h(20);
        for (int i = 0; i < 20; ++i) {
            const double r = 0.03 * std::pow(10.0, i / 19.0), power = 180 / angle;
            terms.row(i) << 1, std::log(r), std::pow(r, power), std::pow(r, 2 * power);
            const SurfaceDomain& fine = field.field.domain;
            const ImposedPoint at = imposed_point(fine, in_plane(std::polar(r, angle * degree / 2)), 0);
            h[i] = 0;
            for (int k = 0; k < 3; ++k) h[i] += at.weights[k] * field.log_size[fine.mesh().triangles(at.triangle, k)];
        }
        const double power = 1 - quads * 90 / angle, found = terms.colPivHouseholderQr().solve(h)[1];
        EXPECT_NEAR(found, power, 0.01 + 0.01 * std::abs(power)) << angle;
    }
}

TEST(CornerQuads, ChoiceThatNeedsTheFewestPointsIsOffered) {
    // A parallelogram of acute angle 28.65 degrees: 1 and 2 quads by angle, which asks for two points inside.
    const auto skewed = [](double angle) {
        TriangleMesh mesh = plate(6, [](double, double) { return true; });
        for (Index v = 0; v < mesh.vertices.rows(); ++v) {
            mesh.vertices(v, 0) += mesh.vertices(v, 1) * std::cos(angle);
            mesh.vertices(v, 1) *= std::sin(angle);
        }
        return SurfaceDomain(mesh);
    };
    const SurfaceDomain sharp = skewed(0.5);
    EXPECT_EQ(default_corner_quads(sharp).size(), 2u);
    const CornerChoice choice = fewest_points_corner_quads(sharp);
    EXPECT_EQ(choice.inner_index_before, std::vector<int>{2});
    EXPECT_EQ(choice.inner_index, std::vector<int>{0});
    EXPECT_EQ(choice.changed.size(), 2u);
    EXPECT_NO_THROW(impose_singular_points(sharp, {{}, choice.corners}));
    EXPECT_THROW(impose_singular_points(sharp, {}), InvalidInput);
    const CornerChoice blunt = fewest_points_corner_quads(skewed(1.0));
    EXPECT_TRUE(blunt.changed.empty());
    // A circle has no corners to round another way.
    const CornerChoice round = fewest_points_corner_quads(SurfaceDomain(disk(8)));
    EXPECT_TRUE(round.changed.empty());
    EXPECT_EQ(round.inner_index, std::vector<int>{4});
}

}  // namespace
}  // namespace octafield::surface
