// Separatrices of imposed fields against closed forms.
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

TEST(LayoutCurves, FourPointsInTheDiskGiveEightArcs) {
    const struct {
        double radius, crossing, a, b;
    } cases[] = {{0.5, 0.4000554, 1.571180408, 0.820325648}, {0.8500923, 0.6982677, 1.600959759, 0.280557937}};
    for (const auto& c : cases) {
        const auto sources = four_in_disk(c.radius, {0, 90, 180, 270});
        const ImposedField field = disk_field(40, sources);
        const LayoutCurves found = layout_curves(field);
        const double unit = unit_of(field, sources);
        EXPECT_EQ(found.traced, 12);
        ASSERT_EQ(found.curves.size(), 8u);
        int inner = 0;
        for (const LayoutCurve& curve : found.curves) {
            const double length = curve.points.back().length / unit;
            EXPECT_NEAR(length, curve.last_vertex >= 0 ? c.a : c.b, 0.01);
            if (curve.last_vertex < 0) continue;
            ++inner;
            for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
                const Complex p = curve_point(field, curve.points[i]), q = curve_point(field, curve.points[i + 1]);
                const Complex ray = std::polar(1.0, (std::floor(std::arg(p) / (pi / 2)) + 0.5) * pi / 2);
                const double sp = (std::conj(ray) * p).imag(), sq = (std::conj(ray) * q).imag();
                if (sp * sq > 0) continue;
                const double at = std::abs(p + (q - p) * (sp / (sp - sq)));
                EXPECT_NEAR(at, c.crossing, 2e-3);
            }
        }
        EXPECT_EQ(inner, 4);
    }
}

// By numerical integration of the closed form: the offsets of one point turned, to either side.
TEST(LayoutCurves, NearMissesHaveTheOffsetsOfTheClosedForm) {
    const struct {
        double turned, first, second;
    } cases[] = {{5, 6.35e-3, 5.70e-3}, {10, 1.34e-2, 1.08e-2}, {20, 3.03e-2, 1.96e-2}};
    for (const auto& c : cases) {
        const auto sources = four_in_disk(0.85009, {c.turned, 90, 180, 270});
        const ImposedField field = disk_field(40, sources);
        LayoutCurveOptions options;
        options.end_tolerance = 0.06;
        const LayoutCurves found = layout_curves(field, options);
        const double unit = unit_of(field, sources);
        ASSERT_EQ(found.curves.size(), 8u);
        std::vector<double> offsets;
        for (const LayoutCurve& curve : found.curves)
            if (curve.first_vertex == field.point_vertices[0] || curve.last_vertex == field.point_vertices[0])
                if (curve.last_vertex >= 0) offsets.push_back(std::abs(curve.offset) / unit);
        ASSERT_EQ(offsets.size(), 2u);
        std::sort(offsets.begin(), offsets.end());
        EXPECT_NEAR(offsets[1], c.first, 2e-3);
        EXPECT_NEAR(offsets[0], c.second, 2e-3);
    }
}

// Each ends at its own separatrix of the other point: the curves round a point keep their order and directions.
TEST(LayoutCurves, ValenceEightInTheMiddleReachesItsEightBoundaryPoints) {
    std::vector<Source> sources = {{0.0, -4}};
    for (int i = 0; i < 8; ++i) sources.push_back({std::polar(1.0, pi / 4 * i), 1});
    const ImposedField field = disk_field(32, sources);
    const LayoutCurves found = layout_curves(field);
    const double unit = unit_of(field, sources);
    ASSERT_EQ(found.curves.size(), 8u);
    for (const LayoutCurve& curve : found.curves) {
        EXPECT_EQ(curve.first_vertex, field.point_vertices[0]);
        EXPECT_LT(curve.last_vertex, 0);  // between the points, where the eight squares have their sides
        EXPECT_NEAR(curve.points.back().length / unit, 0.463518669, 0.01);
    }
}

TEST(LayoutCurves, WhatHasNoCurvesIsTold) {
    ImposedField field = l_shape_field(4);
    LayoutCurveOptions options;
    options.end_tolerance = NAN;
    EXPECT_EQ(kind_of([&] { layout_curves(field, options); }), "bad_option");
    options.end_tolerance = -1;
    EXPECT_EQ(kind_of([&] { layout_curves(field, options); }), "bad_option");
    options = {};
    options.cut_vertices = {1000};
    EXPECT_EQ(kind_of([&] { layout_curves(field, options); }), "bad_option");
    options = {};
    options.max_length = 0.1;
    EXPECT_EQ(kind_of([&] { layout_curves(field, options); }), "long_separatrix");
    for (const auto& damage : std::vector<std::function<void(ImposedField&)>>{
             [](ImposedField& f) { f.log_size.resize(3); }, [](ImposedField& f) { f.field.values.resize(0); },
             [](ImposedField& f) { f.log_size[2] = NAN; }, [](ImposedField& f) { f.point_vertices = {0}; },
             [](ImposedField& f) { f.pattern.corners[0].vertex = 1000; }, [](ImposedField& f) { f = {}; }}) {
        ImposedField damaged = field;
        damage(damaged);
        EXPECT_EQ(kind_of([&] { layout_curves(damaged); }), "bad_field");
    }
    ImposedField cornered = field;
    cornered.pattern.corners[0].quads = 0;
    EXPECT_EQ(kind_of([&] { layout_curves(cornered); }), "infinite_corner");
    field.conditions.push_back({true, 0, 0.1, 0.1, 2.5});
    EXPECT_EQ(kind_of([&] { layout_curves(field); }), "rotated_field");
}

}  // namespace
}  // namespace octafield::surface
