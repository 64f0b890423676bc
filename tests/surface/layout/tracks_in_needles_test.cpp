// Curves where the surface is one triangle wide, and in parts far smaller than the whole.
#include <cmath>

#include "layout_fixtures.hpp"

namespace octafield::surface {
namespace {

struct Strip {
    TriangleMesh mesh;
    std::vector<Index> wide_end;       // vertices of it but its two corners
    std::vector<CornerQuads> corners;  // one quad each
};

// Between a line and a circle that nearly touches it, one triangle wide: at x = 0 its vertices 0 and 1, and a wide end
// with more.
Strip needle(double tip, double radius, int columns, int at_the_end) {
    Strip strip;
    const auto width = [&](double x) { return tip + x * x / (2 * radius); };
    strip.mesh.vertices.resize(2 * columns + at_the_end, 3);
    for (int i = 0; i < columns; ++i) {
        strip.mesh.vertices.row(2 * i) << 2 * i, 0, 0;
        strip.mesh.vertices.row(2 * i + 1) << 2 * i - (i == 0 ? tip / 3 : 0), width(2 * i), 0;
    }
    const double end = 2 * columns;
    for (int j = 0; j < at_the_end; ++j)
        strip.mesh.vertices.row(2 * columns + j) << end, width(end) * j / (at_the_end - 1), 0;
    std::vector<std::array<Index, 3>> triangles;
    for (Index i = 0; i + 1 < columns; ++i) {
        triangles.push_back({2 * i, 2 * i + 2, 2 * i + 3});
        triangles.push_back({2 * i, 2 * i + 3, 2 * i + 1});
    }
    const Index low = 2 * columns - 2, high = low + 1, first = low + 2;
    for (Index j = 0; j + 1 < at_the_end; ++j)
        triangles.push_back({j < at_the_end / 2 ? low : high, first + j, first + j + 1});
    triangles.push_back({low, first + at_the_end / 2, high});
    strip.mesh.triangles.resize(static_cast<Eigen::Index>(triangles.size()), 3);
    for (std::size_t t = 0; t < triangles.size(); ++t)
        for (int k = 0; k < 3; ++k) strip.mesh.triangles(static_cast<Eigen::Index>(t), k) = triangles[t][k];
    for (Index j = 1; j + 1 < at_the_end; ++j) strip.wide_end.push_back(first + j);
    for (const Index corner : {0, 1, first, first + at_the_end - 1}) strip.corners.push_back({corner, 1});
    return strip;
}

TEST(TracksInNeedles, RunFromTheWideEndToTheTip) {
    for (const double tip : {0.01, 0.05, 0.2})
        for (const double radius : {20.0, 40.0}) {
            const Strip strip = needle(tip, radius, 10, 12);
            const SurfaceDomain domain(strip.mesh);
            const ImposedField field = impose_singular_points(domain, {{}, strip.corners});
            LayoutCurveOptions options;
            options.cut_vertices = strip.wide_end;
            const LayoutCurves found = layout_curves(field, options);
            ASSERT_EQ(found.curves.size(), strip.wide_end.size());
            for (const LayoutCurve& curve : found.curves) {
                const Index edge = curve.points.back().edge;
                ASSERT_GE(edge, 0);
                const auto ends = found.domain.topology().edges.row(edge);
                for (int k = 0; k < 2; ++k)
                    EXPECT_LE(found.domain.mesh().vertices(ends[k], 0), 1e-9)
                        << tip << " " << radius << " from " << curve.first_vertex;
            }
        }
}

// Two disks far apart, one of them far larger.
TEST(TracksInSmallParts, JoinPointsAsTheyDoInAPartOfItsOwn) {
    const auto sources = four_in_disk(0.5, {2, 90, 180, 270});
    const TriangleMesh disk = surface::disk(30);
    const SingularPattern pattern = pattern_of(SurfaceDomain(disk), sources);
    const LayoutCurves expected = layout_curves(impose_singular_points(disk, pattern));
    ASSERT_EQ(expected.curves.size(), 8u);
    const Eigen::Index n = disk.vertices.rows(), f = disk.triangles.rows();
    TriangleMesh both{Points(n + 4, 3), Triangles(f + 2, 3)};
    both.vertices.topRows(n) = disk.vertices;
    both.vertices.bottomRows(4) << 100, 0, 0, 400, 0, 0, 400, 300, 0, 100, 300, 0;
    both.triangles.topRows(f) = disk.triangles;
    both.triangles.bottomRows(2) << static_cast<Index>(n), static_cast<Index>(n + 1), static_cast<Index>(n + 2),
        static_cast<Index>(n), static_cast<Index>(n + 2), static_cast<Index>(n + 3);
    const LayoutCurves found = layout_curves(impose_singular_points(both, pattern));
    EXPECT_GT(found.end_tolerance, 2);  // above all distances in the disk
    EXPECT_EQ(found.traced, expected.traced);
    EXPECT_EQ(found.curves.size(), 8u);
}

}  // namespace
}  // namespace octafield::surface
