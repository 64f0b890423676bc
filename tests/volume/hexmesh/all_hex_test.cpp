#include "octafield/volume/all_hex.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "octafield/surface/features.hpp"
#include "seamless_fixtures.hpp"

namespace octafield::volume {
namespace {

using namespace testing;

TEST(BlockComplex, ABoxIsOneBlockWithItsCornersAndEdges) {
    const BlockComplex blocks = block_complex(identity_map(kuhn_grid(3, 2, 1, 0.5)));
    EXPECT_EQ(blocks.block_count(), 1);
    EXPECT_EQ(blocks.nodes.size(), 8U);
    EXPECT_EQ(blocks.arcs.size(), 12U);
    EXPECT_EQ(blocks.patches.size(), 6U);
    std::map<double, int> lengths;
    for (const BlockArc& arc : blocks.arcs) ++lengths[arc.length()];
    EXPECT_EQ(lengths, (std::map<double, int>{{0.5, 4}, {1, 4}, {1.5, 4}}));
}

TEST(BlockComplex, AWallMayEndInTheMiddleOfABlocksSide) {
    const BlockComplex blocks = block_complex(l_shape());
    EXPECT_EQ(blocks.block_count(), 2);
    // Eight corners each, two of them shared; two corners of the low block are within edges of the tall one.
    EXPECT_EQ(blocks.nodes.size(), 14U);
    Index inner = 0;
    for (const BlockPatch& patch : blocks.patches) inner += patch.places.size() == 2;
    EXPECT_EQ(inner, 1);
}

TEST(BlockComplex, ParametersOfATetMayBeTurnedAndMoved) {
    SeamlessMap map = l_shape();
    const Eigen::AngleAxisd turn(std::numbers::pi / 2, Eigen::Vector3d::UnitZ());
    for (Index t = 0; t < map.mesh.tets.rows(); t += 3)
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector3d at = map.parameters.block<1, 3>(t, 3 * k).transpose();
            map.parameters.block<1, 3>(t, 3 * k) = (turn * at + Eigen::Vector3d(3, -2, 0.25)).transpose();
        }
    EXPECT_LT(seamless_report(map).residual, 1e-12);
    const BlockComplex blocks = block_complex(map);
    EXPECT_EQ(blocks.block_count(), 2);
    EXPECT_EQ(blocks.arcs.size(), block_complex(l_shape()).arcs.size());
    // Charts of the two blocks are turned against each other, so the wall between them is seen in two ways.
    std::vector<int> numbers;
    for (const BlockArc& arc : blocks.arcs) numbers.push_back(static_cast<int>(std::lround(3 * arc.length())));
    const BlockHexahedra made = block_hexahedra(map, blocks, numbers);
    require_valid(made.mesh);
    EXPECT_LT((cell_volumes(made.mesh).array() - 1. / 27).abs().maxCoeff(), 1e-12);
}

TEST(BlockComplex, WhatIsNoMapOfBlocksIsNamed) {
    SeamlessMap flipped = l_shape(), torn = l_shape(), bare = l_shape();
    flipped.parameters.block<1, 3>(4, 0).swap(flipped.parameters.block<1, 3>(4, 3));
    EXPECT_EQ(kind_of([&] { block_complex(flipped); }), "flipped_tet");
    torn.parameters.row(5) *= 1.01;
    EXPECT_EQ(kind_of([&] { block_complex(torn); }), "torn_map");
    bare.walls.resize(0, 3);
    EXPECT_EQ(kind_of([&] { block_complex(bare); }), "bent_wall");
    SeamlessMap holed = l_shape();
    holed.walls.conservativeResize(holed.walls.rows() - 1, 3);
    EXPECT_NE(kind_of([&] { block_complex(holed); }), "none");
    SeamlessMap lost = l_shape();
    lost.walls(0, 0) = 1000;
    EXPECT_EQ(kind_of([&] { block_complex(lost); }), "index_out_of_range");
    lost = l_shape();
    lost.parameters.conservativeResize(3, 12);
    EXPECT_EQ(kind_of([&] { block_complex(lost); }), "wrong_size");
    lost = l_shape();
    lost.parameters(2, 2) = std::nan("");
    EXPECT_EQ(kind_of([&] { block_complex(lost); }), "non_finite_parameter");
}

TEST(ArcNumbers, HexahedraAreCountedBeyondThirtyTwoBits) {
    const BlockComplex blocks = block_complex(identity_map(kuhn_grid(1, 1, 1, 1)));
    EXPECT_EQ(arc_numbers(blocks, 5000, std::vector<int>(12, 1)).hexahedra, 125000000000);
}

TEST(ArcNumbers, OppositeSidesOfPatchesHaveTheSameSum) {
    const BlockComplex blocks = block_complex(l_shape());
    std::vector<int> least(blocks.arcs.size(), 1);
    least[0] = 5;
    const ArcNumbers found = arc_numbers(blocks, 2, least);
    EXPECT_GE(found.numbers[0], 5);
    EXPECT_LE(found.bound, found.deviation + 1e-9);
    for (const BlockPatch& patch : blocks.patches)
        for (const int s : {0, 2}) {
            int difference = 0;
            for (const SideArc& part : patch.sides[s]) difference += found.numbers[part.arc];
            for (const SideArc& part : patch.sides[s + 1]) difference -= found.numbers[part.arc];
            EXPECT_EQ(difference, 0);
        }
    EXPECT_EQ(kind_of([&] { arc_numbers(blocks, 2, {1}); }), "wrong_size");
}

TEST(BlockHexahedra, AnLIsFilledWithEqualCubes) {
    const SeamlessMap map = l_shape();
    const BlockComplex blocks = block_complex(map);
    const ArcNumbers numbers = arc_numbers(blocks, 3, std::vector<int>(blocks.arcs.size(), 1));
    EXPECT_EQ(numbers.hexahedra, 3 * 9 * 6);
    const BlockHexahedra made = block_hexahedra(map, blocks, numbers.numbers);
    require_valid(made.mesh);
    EXPECT_EQ(made.mesh.hexahedra.rows(), numbers.hexahedra);
    EXPECT_LT((cell_volumes(made.mesh).array() - 1. / 27).abs().maxCoeff(), 1e-12);
    EXPECT_EQ(cell_boundary(made.mesh).mesh.quads.rows(), (3 * 2) * 9 + 8 * 2 * 9);
}

TEST(BlockHexahedra, ABlockWithoutEdgesAcrossIsClosedUp) {
    SeamlessMap map = identity_map(kuhn_grid(3, 1, 1, 1));
    add_plane(map, 0, 1);
    add_plane(map, 0, 2);
    const BlockComplex blocks = block_complex(map);
    ASSERT_EQ(blocks.block_count(), 3);
    std::vector<int> numbers(blocks.arcs.size(), 2);
    for (std::size_t a = 0; a < blocks.arcs.size(); ++a) {
        const auto& vertices = blocks.arcs[a].vertices;
        const double middle = (map.mesh.vertices(vertices.front(), 0) + map.mesh.vertices(vertices.back(), 0)) / 2;
        if (middle == 1.5) numbers[a] = 0;
    }
    const BlockHexahedra made = block_hexahedra(map, blocks, numbers);
    EXPECT_EQ(made.mesh.hexahedra.rows(), 16);
    EXPECT_EQ(cell_boundary(made.mesh).mesh.quads.rows(), 2 * 4 + 4 * 4 * 2);
    EXPECT_EQ(kind_of([&] { block_hexahedra(map, blocks, {1, 2}); }), "wrong_size");
    numbers[0] += 1;
    EXPECT_EQ(kind_of([&] { block_hexahedra(map, blocks, numbers); }), "not_a_box");
}

TEST(BlockHexahedra, VerticesKnowWhatTheyLieOn) {
    SeamlessMap map = identity_map(kuhn_grid(2, 2, 2, 0.5));
    const BoundarySurface surface = boundary_surface(map.mesh);
    const surface::FeatureGraph features = surface::detect_features(surface.mesh);
    map.features = features.edges;
    for (Index e = 0; e < map.features.rows(); ++e)
        for (int k = 0; k < 2; ++k) map.features(e, k) = surface.vertex_map[map.features(e, k)];
    for (const Index corner : features.corners) map.corners.push_back(surface.vertex_map[corner]);
    const BlockComplex blocks = block_complex(map);
    const BlockHexahedra made = block_hexahedra(map, blocks, std::vector<int>(12, 3));
    std::array<int, 4> kinds{};
    for (const std::uint8_t kind : made.support) ++kinds[kind];
    EXPECT_EQ(kinds, (std::array{8, 24, 24, 8}));
}

TEST(AllHex, TheNumberIsNearTheWantedOneAndTheSameEachTime) {
    const SeamlessMap map = l_shape();
    for (const Index wanted : {6, 100, 1000}) {
        AllHexOptions options;
        options.cells = wanted;
        const AllHexMesh made = all_hex(map, options);
        EXPECT_NEAR(made.mesh.hexahedra.rows(), wanted, 0.1 * wanted);
        EXPECT_NEAR(cell_volumes(made.mesh).sum(), 6, 1e-9);
        EXPECT_TRUE(made.mesh.vertices == all_hex(map, options).mesh.vertices);
    }
}

TEST(AllHex, OptionsAreBounded) {
    const SeamlessMap map = l_shape();
    const auto with = [&](auto set) {
        AllHexOptions options;
        set(options);
        return kind_of([&] { all_hex(map, options); });
    };
    EXPECT_EQ(with([](AllHexOptions& o) { o.cells = -1; }), "option_out_of_range");
    EXPECT_EQ(with([](AllHexOptions& o) { o.edge_length = -1; }), "option_out_of_range");
    EXPECT_EQ(with([](AllHexOptions& o) { o.edge_length = o.cells = 1; }), "option_out_of_range");
    EXPECT_EQ(with([](AllHexOptions& o) { o.good = 1; }), "option_out_of_range");
    EXPECT_EQ(with([](AllHexOptions& o) { o.edge_length = 1e-4; }), "too_many_cells");
    EXPECT_EQ(with([](AllHexOptions& o) { o.edge_length = 1e-200; }), "too_many_cells");
    EXPECT_EQ(with([](AllHexOptions& o) { o.cells = 2000000000; }), "too_many_cells");
    EXPECT_EQ(with([](AllHexOptions& o) {
                  o.cells = 100;
                  o.most_hexahedra = 50;
              }),
              "too_many_cells");
}

}  // namespace
}  // namespace octafield::volume
