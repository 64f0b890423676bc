// Quads of layouts: valid, conforming, on the surface, of the sizes asked for.
#include "octafield/surface/layout_quads.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

double total_area(const QuadMesh& mesh) { return triangle_areas(split_quads(mesh)).sum(); }

// Each edge has two quads that run it both ways, or is on the boundary; Euler's number is the surface's.
void expect_conforming(const LayoutQuads& quads, const QuadLayout& layout) {
    require_valid(quads.mesh, false);
    const auto& mesh = quads.mesh;
    std::map<std::pair<Index, Index>, int> uses;
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) ++uses[std::minmax(mesh.quads(q, k), mesh.quads(q, (k + 1) % 4))];
    EXPECT_EQ(static_cast<long>(mesh.vertices.rows()) - static_cast<long>(uses.size()) + mesh.quads.rows(),
              euler_characteristic(layout.domain.mesh()));
    const Eigen::VectorXd eta = quad_angle_quality(mesh);
    EXPECT_GT(quads.least_scaled_jacobian, 0.3);
}

LayoutQuads quads_of(const QuadLayout& layout, Index count) {
    LayoutQuadsOptions options;
    options.quad_count = count;
    return layout_quads(layout, options);
}

TEST(LayoutQuads, DiskInFiveBlocks) {
    const QuadLayout layout = quad_layout(disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    const LayoutQuads quads = quads_of(layout, 300);
    expect_conforming(quads, layout);
    EXPECT_NEAR(quads.mesh.quads.rows(), 300, 45);
    EXPECT_NEAR(total_area(quads.mesh), pi, 0.02);
}

TEST(LayoutQuads, LShapeIsSquares) {
    const QuadLayout layout = quad_layout(l_shape_field(8));
    LayoutQuadsOptions options;
    options.edge_length = 0.1;
    const LayoutQuads quads = layout_quads(layout, options);
    EXPECT_EQ(quads.mesh.quads.rows(), 75);
    expect_conforming(quads, layout);
    EXPECT_GT(quads.least_scaled_jacobian, 0.999);
    EXPECT_NEAR(total_area(quads.mesh), 0.75, 1e-9);
}

TEST(LayoutQuads, PolygonsInKites) {
    for (const int n : {3, 5, 6, 8}) {
        const QuadLayout layout = quad_layout(polygon_field(n, 72 / n));
        const LayoutQuads quads = quads_of(layout, 49 * n);
        EXPECT_EQ(quads.mesh.quads.rows(), 49 * n);
        expect_conforming(quads, layout);
        EXPECT_NEAR(total_area(quads.mesh), n / 2.0 * std::sin(2 * pi / n), 2e-3);
    }
}

TEST(LayoutQuads, HoledSquareInTwelveBlocks) {
    const QuadLayout layout = quad_layout(holed_field(12));
    const LayoutQuads quads = quads_of(layout, 500);
    expect_conforming(quads, layout);
    EXPECT_NEAR(total_area(quads.mesh), 4 - pi * 0.16, 0.02);
    // Vertices of valence other than 4 inside are the four points, of valence 5.
    std::vector<int> valence(quads.mesh.vertices.rows(), 0);
    for (Index q = 0; q < quads.mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) ++valence[quads.mesh.quads(q, k)];
    EXPECT_EQ(std::count(valence.begin(), valence.end(), 5), 4);
    EXPECT_EQ(std::count_if(valence.begin(), valence.end(), [](int v) { return v > 5; }), 0);
}

TEST(LayoutQuads, SphereWithEightPoints) {
    const SurfaceDomain domain(icosphere(2));
    SingularPattern pattern;
    for (int i = 0; i < 8; ++i)
        pattern.points.push_back(
            imposed_point(domain, Vector(i & 1 ? 1 : -1, i & 2 ? 1 : -1, i & 4 ? 1 : -1).normalized() * 0.999, 1));
    const QuadLayout layout = quad_layout(turned_for_layout(impose_singular_points(domain, pattern)));
    EXPECT_EQ(layout.vertices.size(), 8u);
    EXPECT_EQ(layout.sides.size(), 12u);
    EXPECT_EQ(layout.patches.size(), 6u);
    const LayoutQuads quads = quads_of(layout, 600);
    EXPECT_EQ(quads.mesh.quads.rows(), 600);
    expect_conforming(quads, layout);
    for (Index v = 0; v < quads.mesh.vertices.rows(); ++v) EXPECT_NEAR(quads.mesh.vertices.row(v).norm(), 1, 0.06);
}

TEST(LayoutQuads, AnnulusIsCutOnce) {
    const QuadLayout layout = quad_layout(impose_singular_points(SurfaceDomain(annulus(0.3, 64, 12)), {}));
    EXPECT_EQ(layout.vertices.size(), 2u);
    EXPECT_EQ(layout.sides.size(), 3u);
    ASSERT_EQ(layout.patches.size(), 1u);
    EXPECT_EQ(layout.patches[0].kind, PatchKind::quad);
    // In log r the annulus is log(1 / 0.3) by 2 pi.
    EXPECT_NEAR(layout.sides[1].length() / layout.sides[0].length(), 2 * pi / std::log(1 / 0.3), 0.02);
    const LayoutQuads quads = quads_of(layout, 500);
    expect_conforming(quads, layout);
    EXPECT_EQ(quads.mesh.quads.rows() % quads.patch_sizes.row(0).maxCoeff(), 0);
    EXPECT_GT(quads.least_scaled_jacobian, 0.95);
}

TEST(LayoutQuads, ThinChordsGetOneQuad) {
    LayoutCurveOptions options;
    options.end_tolerance = 0.004;
    const QuadLayout layout = quad_layout(disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})), options);
    const LayoutQuads quads = quads_of(layout, 800);
    require_valid(quads.mesh, false);
    EXPECT_EQ(*std::min_element(quads.chord_counts.begin(), quads.chord_counts.end()), 1);
}

TEST(LayoutQuads, WhatHasNoQuadLayoutIsTold) {
    const QuadLayout annulus_layout =
        quad_layout(impose_singular_points(SurfaceDomain(annulus(0.3, 40, 8)), {}), {}, false);
    ASSERT_EQ(annulus_layout.patches.size(), 1u);
    EXPECT_EQ(annulus_layout.patches[0].kind, PatchKind::annulus);
    EXPECT_EQ(kind_of([&] { quads_of(annulus_layout, 100); }), "no_quad_layout");
    const QuadLayout square = quad_layout(l_shape_field(4));
    EXPECT_EQ(kind_of([&] { layout_quads(square, {}); }), "bad_option");
    LayoutQuadsOptions options;
    options.edge_length = NAN;
    EXPECT_EQ(kind_of([&] { layout_quads(square, options); }), "bad_option");
    EXPECT_EQ(kind_of([&] { layout_quads({}, options); }), "bad_option");
}

}  // namespace
}  // namespace octafield::surface
