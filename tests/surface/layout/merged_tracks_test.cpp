// Tracks that become one: what must not, vertices that do, and quads moved all at once.
#include <random>

#include "block_structures.hpp"
#include "merged_vertices.hpp"
#include "quad_checks.hpp"
#include "quad_untangler.hpp"
#include "zero_arcs.hpp"

namespace octafield::surface {
namespace {

std::vector<Index> own_origins(const QuadLayout& layout) {
    std::vector<Index> result(layout.domain.vertex_count());
    std::iota(result.begin(), result.end(), 0);
    return result;
}

// Four points in a disk: five patches, four arcs between points, four from a point to the boundary, four along it.
TEST(MergedTracks, TwoPointsNeverBecomeOneNorAPointAndTheBoundary) {
    const QuadLayout layout = motorcycle_graph(disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    const detail::Seams seams = detail::find_seams(layout, own_origins(layout));
    const std::vector<int> part_counts(seams.parts.size(), 1);
    int wrong_arcs = 0;
    for (std::size_t a = 0; a < layout.sides.size(); ++a) {
        if (layout.sides[a].curve < 0) continue;  // along the boundary
        std::vector<int> counts(layout.sides.size(), 1);
        counts[a] = 0;
        const auto wrong = detail::wrongly_merged(layout, seams, counts, part_counts);
        ++wrong_arcs;
        EXPECT_EQ(wrong, (std::vector<std::vector<Index>>{{static_cast<Index>(a)}}));
    }
    EXPECT_EQ(wrong_arcs, 8);
    EXPECT_TRUE(detail::wrongly_merged(layout, seams, std::vector<int>(layout.sides.size(), 1), part_counts).empty());
}

// Across a patch without quads the points on its two sides would be one: the disk with the middle patch flat.
TEST(MergedTracks, PointsOnTwoSidesOfAFlatPatchAreTold) {
    const QuadLayout layout = motorcycle_graph(disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    const detail::Seams seams = detail::find_seams(layout, own_origins(layout));
    const std::vector<int> part_counts(seams.parts.size(), 1);
    const auto middle = std::find_if(layout.patches.begin(), layout.patches.end(), [&](const LayoutPatch& patch) {
        return std::none_of(patch.loops[0].begin(), patch.loops[0].end(),
                            [&](const DirectedSide& s) { return layout.sides[s.side].curve < 0; });
    });
    ASSERT_NE(middle, layout.patches.end());
    std::vector<int> counts(layout.sides.size(), 1);
    counts[middle->loops[0][0].side] = counts[middle->loops[0][2].side] = 0;
    const auto wrong = detail::wrongly_merged(layout, seams, counts, part_counts);
    EXPECT_EQ(wrong.size(), 2u);
}

// 3 x 1 quads; the middle one is to have no width.
TEST(MergedTracks, VerticesBecomeOneInTheirMiddleOrWhereOneIsHeld) {
    QuadMesh mesh;
    mesh.vertices.resize(8, 3);
    for (Index i = 0; i < 8; ++i) mesh.vertices.row(i) << i % 4, i / 4, 0;
    mesh.quads.resize(2, 4);
    mesh.quads << 0, 1, 5, 4, 2, 3, 7, 6;
    std::vector<detail::SideGrids::OnSeam> on_seams;
    EXPECT_TRUE(detail::is_as_expected(mesh.quads, {{1, 2}, {5, 6}}, {}, 0, 8) == false);  // corners of one quad
    detail::merge_vertices({}, {{1, 2}, {6, 5}}, {{6, 3}}, mesh, on_seams);
    ASSERT_EQ(mesh.vertices.rows(), 6);
    EXPECT_TRUE(mesh.vertices.row(1).isApprox(Eigen::RowVector3d(1.5, 0, 0)));
    EXPECT_TRUE(mesh.vertices.row(4).isApprox(Eigen::RowVector3d(2, 1, 0)));
    Quads expected(2, 4);
    expected << 0, 1, 4, 3, 1, 2, 5, 4;
    EXPECT_EQ(mesh.quads, expected);
}

TEST(MergedTracks, OneEdgeWithThreeQuadsIsNotExpected) {
    Quads quads(3, 4);
    quads << 0, 1, 3, 2, 2, 3, 5, 4, 6, 7, 9, 8;
    const std::vector<std::pair<Index, int>> corners = {{0, 1}, {1, 1}, {4, 1}, {5, 1}, {6, 1}, {7, 1}, {8, 1}, {9, 1}};
    EXPECT_TRUE(detail::is_as_expected(quads, {}, corners, 0, 10));
    EXPECT_FALSE(detail::is_as_expected(quads, {{6, 2}, {7, 3}}, corners, 0, 10));
    EXPECT_FALSE(detail::is_as_expected(quads, {}, {}, 0, 10));        // corners are no regular vertices
    EXPECT_FALSE(detail::is_as_expected(quads, {{0, 1}}, {}, 0, 10));  // a quad with a vertex twice
}

// Vertices inside a square thrown about.
TEST(MergedTracks, QuadsThatAreTangledAreUntangledAllAtOnce) {
    const QuadLayout layout = motorcycle_graph(polygon_field(4, 8));
    const detail::Seams seams = detail::find_seams(layout, own_origins(layout));
    QuantizedQuads quads = quantized(layout, 200);
    ASSERT_GT(quads.least_scaled_jacobian, 0.3);
    std::vector<int> counts = quads.arc_counts;
    std::vector<int> part_counts(seams.parts.size());
    for (std::size_t a = 0; a < seams.uses.size(); ++a)
        if (seams.uses[a].size() == 1) part_counts[seams.uses[a][0].part] = counts[a];
    detail::SideGrids grids = detail::seamed_grids(layout, seams, counts, part_counts);
    const detail::SurfaceParts parts(layout);
    const std::vector<Index> none;
    const detail::SmootherInput input{layout, parts, seams, grids.on_seams, quads.tiles, none, false};
    std::mt19937 random(5);
    std::uniform_real_distribution<double> by(-0.2, 0.2);
    for (auto v = static_cast<Index>(grids.on_seams.size()); v < quads.mesh.vertices.rows(); ++v)
        for (int k = 0; k < 2; ++k)
            quads.mesh.vertices(v, k) = std::clamp(quads.mesh.vertices(v, k) + by(random), -0.95, 0.95);
    ASSERT_LT(scaled_jacobians(quads.mesh).minCoeff(), -0.5);
    detail::prepare(input, detail::Start::untangled, quads.mesh);
    EXPECT_GT(scaled_jacobians(quads.mesh).minCoeff(), 0.2);
    EXPECT_LT(quads.mesh.vertices.col(2).cwiseAbs().maxCoeff(), 1e-12);
}

}  // namespace
}  // namespace octafield::surface
