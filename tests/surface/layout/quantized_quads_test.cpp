// Quads of T-meshes: conforming, with the pattern's irregular vertices and no others.
#include "octafield/surface/quantized_quads.hpp"
#include "octafield/error.hpp"
#include "quad_checks.hpp"

namespace octafield::surface {
namespace {

TEST(QuantizedQuads, OfLayoutsWithoutJointsAreTheirs) {
    const ImposedField field = disk_field(26, four_in_disk(0.5, {0, 90, 180, 270}));
    const QuantizedQuads quads = quantized(motorcycle_graph(field), 1000);
    expect_conforming(quads, 1);
    EXPECT_EQ(irregularities(quads.mesh), expected_irregularities(field.pattern));
    EXPECT_EQ(quads.patch_sizes.rows(), 5);
    EXPECT_EQ(quads.t_joints, 0);
    EXPECT_TRUE(quads.optimal);
    EXPECT_NEAR(quads.mesh.quads.rows(), 1000, 60);
    EXPECT_GT(quads.least_scaled_jacobian, 0.8);
}

TEST(QuantizedQuads, OfTheLShapeAreSquares) {
    QuantizedQuadsOptions options;
    options.edge_length = 0.1;
    const QuantizedQuads quads = quantized_quads(motorcycle_graph(l_shape_field(8)), options);
    expect_conforming(quads, 1);
    EXPECT_EQ(quads.mesh.quads.rows(), 75);
    EXPECT_EQ(quads.arc_counts, std::vector<int>(10, 5));
    EXPECT_NEAR(quads.deviation, 0, 1e-2);
    EXPECT_GT(quads.least_scaled_jacobian, 0.999);
}

// Of one size there are 3 n^2: all arcs are as long as one another. 5 x 4 + 4 x 4 + 5 x 5 are 61.
TEST(QuantizedQuads, AreAsManyAsWantedWhereAllArcsAreOfOneLength) {
    const QuadLayout layout = motorcycle_graph(l_shape_field(8));
    for (const Index wanted : {56, 60, 90}) {
        const QuantizedQuads quads = quantized(layout, wanted);
        expect_conforming(quads, 1);
        EXPECT_LE(std::abs(quads.mesh.quads.rows() - wanted), 0.02 * wanted) << wanted;
    }
}

TEST(QuantizedQuads, OfTheKiteHaveNoJoints) {
    const auto sources = four_in_disk(0.85009, {0, 85, 180, 275});
    const ImposedField field = disk_field(26, sources);
    LayoutCurveOptions curves;
    curves.end_tolerance = 0.004;
    const QuantizedQuads quads = quantized(motorcycle_graph(field, curves), 1000);
    expect_conforming(quads, 1);
    EXPECT_GT(quads.t_joints, 0);
    EXPECT_EQ(irregularities(quads.mesh), expected_irregularities(field.pattern));
    EXPECT_GT(quads.least_scaled_jacobian, 0.5);
}

// The patterns of which the layouts of some have a separatrix too long, and hundreds of patches.
TEST(QuantizedQuads, OfRandomPatternsAreValid) {
    std::mt19937 random(7);
    for (int round = 0; round < 24; ++round) {
        const ImposedField field = disk_field(16, random_sources(random, round % 4));
        LayoutCurveOptions curves;
        if (round % 2) curves.end_tolerance = 0.002;
        const QuadLayout layout = motorcycle_graph(field, curves);
        const QuantizedQuads quads = quantized(layout, 1000);
        expect_conforming(quads, 1);
        EXPECT_EQ(irregularities(quads.mesh), expected_irregularities(field.pattern)) << round;
        EXPECT_TRUE(quads.optimal) << round;
        EXPECT_NEAR(quads.mesh.quads.rows(), 1000, 100) << round;
        EXPECT_GT(quads.least_scaled_jacobian, 0.3) << round;
    }
}

TEST(QuantizedQuads, OfClosedSurfaces) {
    for (const int seed : {1, 2, 3}) {
        const QuantizedQuads quads = quantized(motorcycle_graph(sphere_field(4, random_points(seed))), 1000);
        expect_conforming(quads, 2);
        EXPECT_EQ(irregularities(quads.mesh), std::multiset<int>({-1, -1, -1, -1, -1, -1, -1, -1}));
        for (Index v = 0; v < quads.mesh.vertices.rows(); ++v) EXPECT_NEAR(quads.mesh.vertices.row(v).norm(), 1, 0.02);
        EXPECT_GT(quads.least_scaled_jacobian, 0.5);
    }
    const SurfaceDomain domain(torus(60, 30, 1, 0.5));
    const QuantizedQuads ring = quantized(motorcycle_graph(impose_singular_points(domain, {})), 1000);
    expect_conforming(ring, 0);
    EXPECT_TRUE(irregularities(ring.mesh).empty());
    EXPECT_EQ(ring.patch_sizes.rows(), 1);
    EXPECT_GT(ring.least_scaled_jacobian, 0.95);
}

// Eight points of valence 3 have corners for six blocks.
TEST(QuantizedQuads, FewBlocksAreFewerAndQuadsAsGoodAsWanted) {
    for (const int seed : {2}) {
        const QuadLayout layout = motorcycle_graph(sphere_field(3, random_points(seed)));
        QuantizedQuadsOptions options;
        options.quad_count = 1000;
        options.blocks = Blocks::fine;
        const QuantizedQuads fine = quantized_quads(layout, options);
        options.blocks = Blocks::few;
        options.least_jacobian = 0;
        const QuantizedQuads fewest = quantized_quads(layout, options);
        options.least_jacobian = 0.7;
        const QuantizedQuads good = quantized_quads(layout, options);
        for (const QuantizedQuads* quads : {&fine, &fewest, &good}) {
            expect_conforming(*quads, 2, quads == &fine ? Blocks::fine : Blocks::few);
            EXPECT_EQ(irregularities(quads->mesh), irregularities(fine.mesh));
            EXPECT_EQ(quads->fewest_blocks, 6);
            EXPECT_GE(quads->patch_sizes.rows(), 6);
        }
        EXPECT_LE(fewest.patch_sizes.rows(), good.patch_sizes.rows());
        EXPECT_LT(good.patch_sizes.rows(), fine.patch_sizes.rows() / 2);
        EXPECT_GE(good.least_scaled_jacobian, 0.7);
    }
}

// Whatever is asked for, quads are no worse than 0.7 of the best that was found.
TEST(QuantizedQuads, WhereNoneAreAsGoodAsWantedTheyAreNearlyAsGoodAsTheBest) {
    const QuadLayout layout = motorcycle_graph(sphere_field(4, random_points(2)));
    QuantizedQuadsOptions options;
    options.quad_count = 1500;
    options.least_jacobian = 1;
    const QuantizedQuads quads = quantized_quads(layout, options);
    options.blocks = Blocks::fine;
    const QuantizedQuads fine = quantized_quads(layout, options);
    EXPECT_LT(fine.least_scaled_jacobian, 1);
    EXPECT_GE(quads.least_scaled_jacobian, 0.7 * fine.least_scaled_jacobian);
    EXPECT_LT(quads.patch_sizes.rows(), fine.patch_sizes.rows());
}

// Lines at an angle wind round and round a torus; turned for a layout they close after one round.
TEST(QuantizedQuads, OfATorusWhoseFieldIsTurnedAreOneBlock) {
    const ImposedField field = impose_singular_points(SurfaceDomain(torus(60, 30, 1, 0.5)), {});
    for (const double degrees : {10.0, 40.0}) {
        ImposedField turned = field;
        turned.field.values *= std::polar(1.0, 4 * degrees * pi / 180);
        const QuantizedQuads winding = quantized(motorcycle_graph(turned), 600);
        EXPECT_GT(winding.patch_sizes.rows(), 10);
        EXPECT_EQ(winding.fewest_blocks, 1);
        const QuantizedQuads quads = quantized(motorcycle_graph(turned_for_layout(turned)), 600, Blocks::few);
        expect_conforming(quads, 0);
        EXPECT_TRUE(irregularities(quads.mesh).empty());
        EXPECT_EQ(quads.patch_sizes.rows(), 1) << degrees;
        EXPECT_GE(quads.least_scaled_jacobian, 0.95) << degrees;
    }
}

TEST(QuantizedQuads, RelativeWeightsKeepShortArcs) {
    std::mt19937 random(9);
    const QuadLayout layout = motorcycle_graph(disk_field(16, random_sources(random, 1)));
    QuantizedQuadsOptions options;
    options.quad_count = 2000;
    options.weights = ArcWeights::relative;
    const QuantizedQuads relative = quantized_quads(layout, options);
    expect_conforming(relative, 1, options.blocks);
    EXPECT_LE(relative.bound, relative.deviation + 1e-9);
}

TEST(QuantizedQuads, SmoothingNeverMakesTheWorstQuadWorse) {
    std::mt19937 random(7);
    for (int round = 0; round < 4; ++round) {
        const QuadLayout layout = motorcycle_graph(disk_field(16, random_sources(random, round)));
        QuantizedQuadsOptions options;
        options.quad_count = 1000;
        options.blocks = Blocks::fine;
        options.smoothing = 0;
        const QuantizedQuads before = quantized_quads(layout, options);
        options.smoothing = 20;
        const QuantizedQuads after = quantized_quads(layout, options);
        EXPECT_EQ(before.mesh.quads, after.mesh.quads);
        EXPECT_GE(after.least_scaled_jacobian, before.least_scaled_jacobian);
        EXPECT_GT(after.least_scaled_jacobian, 0.6);
        const EdgeCounts counts = counted_edges(after.mesh);
        double moved = 0;
        for (Index v = 0; v < after.mesh.vertices.rows(); ++v) {
            const Eigen::RowVector3d a = before.mesh.vertices.row(v), b = after.mesh.vertices.row(v);
            moved += (a - b).norm();
            EXPECT_NEAR(b[2], 0, 1e-12);
            const bool singular = !counts.on_boundary[v] && counts.quads_at[v] != 4;
            EXPECT_TRUE(!singular || a == b);
            EXPECT_TRUE(!counts.on_boundary[v] || std::abs(b.norm() - 1) < 1e-2);  // on the polygon
        }
        EXPECT_GT(moved, 0);
    }
}

TEST(QuantizedQuads, AreTheSameInEveryRun) {
    std::mt19937 random(7);
    const ImposedField field = disk_field(16, random_sources(random, 3));
    const QuantizedQuads a = quantized(motorcycle_graph(field), 1000), b = quantized(motorcycle_graph(field), 1000);
    EXPECT_EQ(a.arc_counts, b.arc_counts);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.quads, b.mesh.quads);
    EXPECT_EQ(a.patches, b.patches);
}

TEST(QuantizedQuads, WhatGivesNoneIsTold) {
    const QuadLayout layout = motorcycle_graph(l_shape_field(4));
    QuantizedQuadsOptions options;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.edge_length = NAN;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.edge_length = 1e-9;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.edge_length = 0.1;
    options.smoothing = -1;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.smoothing = 0;
    for (const double wrong : {-0.1, 1.1, static_cast<double>(NAN)}) {
        options.least_jacobian = wrong;
        EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    }
    options.least_jacobian = 0.5;
    options.most_nodes = 0;
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.most_nodes = 10;
    options.origins.assign(1000, 0);
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.origins.assign(9, 0);
    EXPECT_EQ(kind_of([&] { quantized_quads(layout, options); }), "bad_option");
    options.origins.clear();
    EXPECT_EQ(kind_of([&] { quantized_quads({}, options); }), "bad_option");
    std::mt19937 random(7);
    const QuadLayout jointed = motorcycle_graph(disk_field(16, random_sources(random, 1)));
    LayoutQuadsOptions plain;
    plain.quad_count = 100;
    EXPECT_EQ(kind_of([&] { layout_quads(jointed, plain); }), "t_joints");
}

}  // namespace
}  // namespace octafield::surface
