// Cell complexes of layouts: counts and lengths.
#include "octafield/surface/quad_layout.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

struct CellCounts {
    std::size_t vertices, sides, patches;
};

void expect_all_quads(const QuadLayout& layout, const CellCounts& counts) {
    EXPECT_EQ(layout.vertices.size(), counts.vertices);
    EXPECT_EQ(layout.sides.size(), counts.sides);
    EXPECT_EQ(layout.patches.size(), counts.patches);
    for (const LayoutPatch& patch : layout.patches) EXPECT_EQ(patch.kind, PatchKind::quad);
}

// Sides meet end to end round every patch, and each side has a patch on either side, the boundary's on the left only.
void expect_complex(const QuadLayout& layout) {
    std::vector<int> left(layout.sides.size(), 0), right(layout.sides.size(), 0);
    for (const LayoutPatch& patch : layout.patches)
        for (const auto& loop : patch.loops)
            for (std::size_t i = 0; i < loop.size(); ++i) {
                const LayoutSide &a = layout.sides[loop[i].side], &b = layout.sides[loop[(i + 1) % loop.size()].side];
                const bool back = loop[(i + 1) % loop.size()].reversed;
                EXPECT_EQ(loop[i].reversed ? a.first : a.last, back ? b.last : b.first);
                ++(loop[i].reversed ? right : left)[loop[i].side];
            }
    for (std::size_t s = 0; s < layout.sides.size(); ++s) {
        EXPECT_EQ(left[s], 1);
        EXPECT_EQ(right[s], layout.sides[s].curve >= 0 ? 1 : 0);
        EXPECT_GT(layout.sides[s].length(), 0);
    }
}

TEST(QuadLayout, FourPointsInTheDisk) {
    const auto sources = four_in_disk(0.5, {0, 90, 180, 270});
    const QuadLayout layout = quad_layout(disk_field(26, sources));
    expect_all_quads(layout, {8, 12, 5});
    expect_complex(layout);
    EXPECT_LT(layout.largest_mismatch, 0.02);
    EXPECT_EQ(layout.chords.size(), 3u);  // two across the middle, one round it
}

TEST(QuadLayout, LShapeHasThreePatches) {
    const QuadLayout layout = quad_layout(l_shape_field(8));
    expect_all_quads(layout, {8, 10, 3});
    expect_complex(layout);
    EXPECT_LT(layout.largest_mismatch, 1e-3);
    for (const LayoutSide& side : layout.sides) EXPECT_NEAR(side.length(), 0.5, 1e-3);
}

TEST(QuadLayout, PolygonsHaveAsManyKitesAsCorners) {
    for (const int n : {3, 5, 6, 8}) {
        const QuadLayout layout = quad_layout(polygon_field(n, 72 / n));
        const auto count = static_cast<std::size_t>(n);
        expect_all_quads(layout, {2 * count + 1, 3 * count, count});
        expect_complex(layout);
        EXPECT_LT(layout.largest_mismatch, 0.03);
    }
}

TEST(QuadLayout, SquareWithARoundHole) {
    const QuadLayout layout = quad_layout(holed_field(12));
    expect_all_quads(layout, {20, 32, 12});
    expect_complex(layout);
    EXPECT_LT(layout.largest_mismatch, 0.05);
}

TEST(QuadLayout, NearMissesThatAreNotJoinedGiveThinPatchesOfTheSameSurface) {
    const auto sources = four_in_disk(0.85009, {0, 85, 180, 275});
    const ImposedField field = disk_field(26, sources);
    LayoutCurveOptions options;
    options.end_tolerance = 0.03;
    expect_all_quads(quad_layout(field, options), {8, 12, 5});
    options.end_tolerance = 0.004;
    const QuadLayout layout = quad_layout(field, options);
    expect_complex(layout);
    const auto loop = std::find_if(layout.curves.curves.begin(), layout.curves.curves.end(),
                                   [](const LayoutCurve& c) { return c.first_vertex == c.last_vertex; });
    ASSERT_NE(loop, layout.curves.curves.end());
    // It bounds a flat cylinder with the circle, so its length is int exp(-H) round that, 6.41265 by quadrature.
    EXPECT_NEAR(loop->points.back().length / unit_of(field, sources), 6.41265, 0.06);
    // Points 0 and 2 are joined, point 3 to itself: 10 curves, four-cornered patches all the same.
    EXPECT_EQ(layout.curves.curves.size(), 10u);
    for (const LayoutPatch& patch : layout.patches) EXPECT_EQ(patch.kind, PatchKind::quad);
    EXPECT_GT(layout.patches.size(), 12u);
}

TEST(QuadLayout, CornersThatShareAnEdgeAreJoinedAlongIt) {
    const auto plus = [](double x, double y) {
        const auto middle = [](double u) { return u > 1.0 / 3 && u < 2.0 / 3; };
        return middle(x) || middle(y);
    };
    for (const int n : {3, 6, 9}) {
        const QuadLayout layout = quad_layout(impose_singular_points(SurfaceDomain(plate(n, plus)), {}));
        expect_all_quads(layout, {12, 16, 5});
        expect_complex(layout);
        EXPECT_EQ(layout.curves.curves.size(), 4u);
    }
}

// Two disks, one of them alone, and a vertex in no triangle: each part has its own layout.
TEST(QuadLayout, PartsOfASurfaceAreLaidOutEach) {
    const auto sources = four_in_disk(0.5, {0, 90, 180, 270});
    const TriangleMesh one = disk(14);
    const auto count = static_cast<Index>(one.vertices.rows()), faces = static_cast<Index>(one.triangles.rows());
    TriangleMesh both{Points(2 * count + 1, 3), Triangles(2 * faces, 3)};
    both.vertices << Eigen::RowVector3d(9, 9, 9), one.vertices, one.vertices.rowwise() + Eigen::RowVector3d(3, 0, 0);
    both.triangles << one.triangles.array() + 1, one.triangles.array() + count + 1;
    const SurfaceDomain domain(both);
    SingularPattern pattern = pattern_of(domain, sources);
    for (const Source& s : sources) pattern.points.push_back(imposed_point(domain, in_plane(s.at + 3.0), 1));
    const QuadLayout layout = quad_layout(impose_singular_points(domain, pattern));
    expect_all_quads(layout, {16, 24, 10});
    expect_complex(layout);
}

TEST(QuadLayout, IsTheSameInEveryRun) {
    const ImposedField field = holed_field(8);
    const QuadLayout a = quad_layout(field), b = quad_layout(field);
    ASSERT_EQ(a.sides.size(), b.sides.size());
    for (std::size_t s = 0; s < a.sides.size(); ++s) {
        EXPECT_EQ(a.sides[s].points, b.sides[s].points);
        EXPECT_EQ(a.sides[s].parameters, b.sides[s].parameters);
    }
}

}  // namespace
}  // namespace octafield::surface
