// Motorcycle graphs: T-meshes of rectangles, whatever the separatrices do.
#include "octafield/surface/motorcycle_graph.hpp"
#include "octafield/error.hpp"
#include "quad_checks.hpp"

namespace octafield::surface {
namespace {

struct Counts {
    std::size_t vertices, sides, patches;
};

int t_joints(const QuadLayout& layout) {
    int count = 0;
    for (const LayoutVertex& v : layout.vertices) count += v.kind == LayoutVertexKind::t_joint;
    return count;
}

void expect_counts(const QuadLayout& layout, const Counts& counts, int joints) {
    EXPECT_EQ(layout.vertices.size(), counts.vertices);
    EXPECT_EQ(layout.sides.size(), counts.sides);
    EXPECT_EQ(layout.patches.size(), counts.patches);
    EXPECT_EQ(t_joints(layout), joints);
}

// Disks with four corners, sides end to end, two patches at each side inside; three sides at a T-joint, which one patch
// runs straight past; opposite sides of one length.
void expect_rectangles(const QuadLayout& layout, double mismatch) {
    std::vector<int> left(layout.sides.size(), 0), right(layout.sides.size(), 0), straight(layout.vertices.size(), 0);
    for (const LayoutPatch& patch : layout.patches) {
        ASSERT_EQ(patch.kind, PatchKind::quad);
        ASSERT_EQ(patch.corner_sides.size(), 4u);
        ASSERT_EQ(patch.corner_sides[0], 0);
        const auto& loop = patch.loops[0];
        double sums[4] = {0, 0, 0, 0};
        int k = -1;
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const LayoutSide &a = layout.sides[loop[i].side], &b = layout.sides[loop[(i + 1) % loop.size()].side];
            EXPECT_EQ(loop[i].reversed ? a.first : a.last, loop[(i + 1) % loop.size()].reversed ? b.last : b.first);
            ++(loop[i].reversed ? right : left)[loop[i].side];
            if (k < 3 && patch.corner_sides[k + 1] == static_cast<Index>(i)) {
                ++k;
            } else {
                ++straight[loop[i].reversed ? a.last : a.first];
            }
            sums[k] += a.length();
        }
        for (int d = 0; d < 2; ++d) EXPECT_NEAR(sums[d], sums[d + 2], mismatch);
    }
    std::vector<int> ends(layout.vertices.size(), 0);
    for (std::size_t s = 0; s < layout.sides.size(); ++s) {
        EXPECT_EQ(left[s], 1);
        EXPECT_EQ(right[s], layout.sides[s].curve >= 0 ? 1 : 0);
        EXPECT_GT(layout.sides[s].length(), 0);
        ++ends[layout.sides[s].first];
        ++ends[layout.sides[s].last];
    }
    for (std::size_t v = 0; v < ends.size(); ++v) {
        const bool joint = layout.vertices[v].kind == LayoutVertexKind::t_joint;
        EXPECT_EQ(straight[v], joint ? 1 : 0);
        EXPECT_TRUE(!joint || ends[v] == 3);
    }
}

TEST(MotorcycleGraph, IsTheLayoutWhereAllSeparatricesJoin) {
    const QuadLayout in_disk = motorcycle_graph(disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    expect_counts(in_disk, {8, 12, 5}, 0);
    expect_rectangles(in_disk, 0.02);
    const QuadLayout holed = motorcycle_graph(holed_field(12));
    expect_counts(holed, {20, 32, 12}, 0);
    expect_rectangles(holed, 0.05);
    const QuadLayout bent = motorcycle_graph(l_shape_field(8));
    expect_counts(bent, {8, 10, 3}, 0);
    expect_rectangles(bent, 1e-3);
}

// In a layout two of the kite's separatrices are one closed curve round the disk, and others run to the boundary beside
// one another in thin strips. Here they stop before.
TEST(MotorcycleGraph, OfTheKiteIsFinite) {
    const auto sources = four_in_disk(0.85009, {0, 85, 180, 275});
    const ImposedField field = disk_field(26, sources);
    LayoutCurveOptions options;
    options.end_tolerance = 0.004;
    const QuadLayout layout = motorcycle_graph(field, options);
    EXPECT_LE(layout.patches.size(), 9u);
    EXPECT_GT(t_joints(layout), 0);
    expect_rectangles(layout, 0.02);
    double round = 0;
    for (const LayoutSide& side : layout.sides) round += side.curve < 0 ? side.length() : 0;
    EXPECT_NEAR(round / unit_of(field, sources), 6.41265, 0.06);  // int exp(-H) by quadrature
    for (const LayoutCurve& c : layout.curves.curves) EXPECT_NE(c.first_vertex, c.last_vertex);
    const QuadLayout whole = quad_layout(field, options);
    EXPECT_GT(whole.patches.size(), layout.patches.size());
}

// Each separatrix ends once, so there are no more patches than ends, whatever the positions: v - e + f = 1, and every
// vertex but points has three sides or more.
TEST(MotorcycleGraph, OfRandomPatternsIsSmall) {
    std::mt19937 random(7);
    for (int round = 0; round < 24; ++round) {
        const auto sources = random_sources(random, round % 4);
        LayoutCurveOptions options;
        if (round % 2) options.end_tolerance = 0.002;
        const QuadLayout layout = motorcycle_graph(disk_field(16, sources), options);
        expect_rectangles(layout, 0.2);
        int starts = 0;
        for (const Source& s : sources) starts += 4 - s.index_times_four;
        EXPECT_EQ(layout.curves.traced, starts);
        EXPECT_LE(layout.patches.size(), static_cast<std::size_t>(starts));
        for (const LayoutCurve& c : layout.curves.curves)
            EXPECT_LT(c.points.back().length, 8 * std::sqrt(layout.curves.parameter_area));
    }
}

TEST(MotorcycleGraph, OfSurfacesWithoutPointsIsCut) {
    const QuadLayout ring = motorcycle_graph(impose_singular_points(SurfaceDomain(annulus(0.3, 64, 12)), {}));
    expect_counts(ring, {2, 3, 1}, 0);
    expect_rectangles(ring, 0.02);
    // Two closed curves: along them the torus is 2 pi by 2 pi r / sqrt(R^2 - r^2) in quad coordinates.
    const QuadLayout closed = motorcycle_graph(impose_singular_points(SurfaceDomain(torus(60, 30, 1, 0.5)), {}));
    expect_counts(closed, {1, 2, 1}, 0);
    expect_rectangles(closed, 1e-9);
    const double a = closed.sides[0].length(), b = closed.sides[1].length();
    EXPECT_NEAR(std::max(a, b) / std::min(a, b), std::sqrt(3.0), 5e-3);
}

TEST(MotorcycleGraph, OfASphereNeedsNoTurning) {
    for (const int seed : {1, 2, 3}) {
        const QuadLayout layout = motorcycle_graph(sphere_field(3, random_points(seed)));
        expect_rectangles(layout, 0.1);
        EXPECT_LE(layout.patches.size(), 24u);
    }
}

TEST(MotorcycleGraph, OfRotatedFieldsIsFinite) {
    const SurfaceDomain domain(annulus(0.3, 64, 16));
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) {
        sources.push_back({std::polar(0.5, 90 * i * degree), -1});
        sources.push_back({std::polar(0.7, (90 * i + 10) * degree), 1});
    }
    ImposedFieldOptions options;
    options.inadmissible = Inadmissible::rotate;
    const ImposedField field = impose_singular_points(domain, pattern_of(domain, sources), options);
    EXPECT_EQ(kind_of([&] { quad_layout(field); }), "rotated_field");
    const QuadLayout layout = motorcycle_graph(field);
    for (const LayoutPatch& patch : layout.patches) EXPECT_EQ(patch.kind, PatchKind::quad);
    EXPECT_LE(layout.patches.size(), 32u);
}

TEST(MotorcycleGraph, IsTheSameInEveryRun) {
    std::mt19937 random(5);
    const ImposedField field = disk_field(16, random_sources(random, 3));
    const QuadLayout a = motorcycle_graph(field), b = motorcycle_graph(field);
    ASSERT_EQ(a.sides.size(), b.sides.size());
    for (std::size_t s = 0; s < a.sides.size(); ++s) {
        EXPECT_EQ(a.sides[s].points, b.sides[s].points);
        EXPECT_EQ(a.sides[s].parameters, b.sides[s].parameters);
    }
}

TEST(MotorcycleGraph, WhatHasNoneIsTold) {
    const ImposedField field = l_shape_field(4);
    LayoutCurveOptions options;
    options.end_tolerance = -1;
    EXPECT_EQ(kind_of([&] { motorcycle_graph(field, options); }), "bad_option");
    options = {};
    options.cut_vertices = {1000};
    EXPECT_EQ(kind_of([&] { motorcycle_graph(field, options); }), "bad_option");
    options = {};
    options.max_length = 0.1;
    EXPECT_EQ(kind_of([&] { motorcycle_graph(field, options); }), "long_separatrix");
    EXPECT_EQ(kind_of([&] { motorcycle_graph({}); }), "bad_field");
}

}  // namespace
}  // namespace octafield::surface
