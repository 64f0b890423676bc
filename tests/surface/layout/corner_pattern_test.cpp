// Corners of computed fields made usable: the sum of indices stays.
#include "octafield/surface/corner_pattern.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

int sum_of(const SurfaceDomain& domain, const SingularPattern& pattern) {
    std::map<Index, int> quads;
    for (const CornerQuads& c : default_corner_quads(domain)) quads[c.vertex] = c.quads;
    for (const CornerQuads& c : pattern.corners) quads[c.vertex] = c.quads;
    int sum = 0;
    for (const auto& [vertex, count] : quads) sum += 2 - count;
    for (const ImposedPoint& p : pattern.points) sum += p.index_times_four;
    return sum;
}

int quads_at(const SurfaceDomain& domain, const std::vector<CornerQuads>& corners, const Vector& at) {
    for (const CornerQuads& c : corners)
        if ((domain.mesh().vertices.row(c.vertex).transpose() - at).norm() < 1e-9) return c.quads;
    return 2;
}

TEST(CornerPattern, WhatACornerLacksBecomesAPoint) {
    const SurfaceDomain domain(plate(6, [](double, double) { return true; }));
    const std::vector<CornerQuads> square = default_corner_quads(domain);
    ASSERT_EQ(square.size(), 4u);
    SingularPattern pattern;
    pattern.corners = square;
    pattern.corners[0].quads = 0;  // as of a computed field, with a point of valence 5 that makes up for it
    pattern.points = {imposed_point(domain, Vector(0.8, 0.7, 0), -1)};
    ASSERT_EQ(sum_of(domain, pattern), 4);
    const SingularPattern without = with_corner_quads(domain, pattern, square);
    EXPECT_TRUE(without.points.empty());
    EXPECT_EQ(sum_of(domain, without), 4);
    pattern.points.clear();
    pattern.corners[0].quads = 1;
    std::vector<CornerQuads> fewer = square;
    fewer[0].quads = 2;
    const SingularPattern with = with_corner_quads(domain, pattern, fewer);
    ASSERT_EQ(with.points.size(), 1u);
    EXPECT_EQ(with.points[0].index_times_four, 1);
    EXPECT_EQ(sum_of(domain, with), 4);
    const Vector corner = domain.mesh().vertices.row(square[0].vertex);
    EXPECT_LT((imposed_position(domain, with.points[0]) - corner).norm(), 0.4);
    EXPECT_NO_THROW(impose_singular_points(domain, with));
}

TEST(CornerPattern, ChangesOfOppositeSignCancel) {
    const SurfaceDomain domain(plate(6, [](double, double) { return true; }));
    SingularPattern pattern;
    pattern.corners = default_corner_quads(domain);
    pattern.corners[0].quads = 0;
    pattern.corners.push_back({domain.mesh().triangles(0, 0) == pattern.corners[0].vertex
                                   ? domain.mesh().triangles(0, 1)
                                   : domain.mesh().triangles(0, 0),
                               3});
    ASSERT_EQ(sum_of(domain, pattern), 4);
    const auto finite = finite_corner_quads(domain, pattern);
    for (const CornerQuads& c : finite) EXPECT_TRUE(c.quads == 1 || c.quads == 2);
    EXPECT_EQ(quads_at(domain, finite, Vector(0, 0, 0)), 1);
    const SingularPattern made = with_corner_quads(domain, pattern, finite);
    EXPECT_TRUE(made.points.empty());
    EXPECT_EQ(sum_of(domain, made), 4);
}

TEST(CornerPattern, WhatIsNoCornerIsRefused) {
    const SurfaceDomain domain(plate(4, [](double, double) { return true; }));
    EXPECT_EQ(kind_of([&] { with_corner_quads(domain, {}, {{1000, 1}}); }), "not_on_boundary");
    SingularPattern pattern;
    pattern.points = {{1000, Vector::Constant(1.0 / 3), 1}};
    EXPECT_EQ(kind_of([&] { with_corner_quads(domain, pattern, {}); }), "outside_surface");
}

}  // namespace
}  // namespace octafield::surface
