// Features that meet at a few degrees, on a fan of triangles round one vertex.
#include "octafield/surface/feature_needles.hpp"
#include "layout_fixtures.hpp"

namespace octafield::surface {
namespace {

// Vertex 0 in the middle, 1, 2, ... round it at these angles (degrees).
SurfaceDomain wheel(const std::vector<double>& angles, const std::vector<Index>& spokes) {
    const auto count = static_cast<Index>(angles.size());
    TriangleMesh mesh{Points(count + 1, 3), Triangles(count, 3)};
    mesh.vertices.row(0).setZero();
    for (Index i = 0; i < count; ++i) {
        const double angle = angles[i] * std::numbers::pi / 180, radius = 1 + 0.01 * i;
        mesh.vertices.row(i + 1) << radius * std::cos(angle), radius * std::sin(angle), 0;
        mesh.triangles.row(i) << 0, i + 1, (i + 1) % count + 1;
    }
    Edges edges(static_cast<Index>(spokes.size()), 2);
    for (std::size_t k = 0; k < spokes.size(); ++k) edges.row(static_cast<Index>(k)) << 0, spokes[k];
    return SurfaceDomain(mesh, feature_graph(mesh, edges));
}

// With a second wheel's worth of triangles outside, so that the sides opposite to the middle are inside.
SurfaceDomain ringed_wheel(const std::vector<double>& angles, const std::vector<Index>& spokes) {
    const SurfaceDomain small = wheel(angles, spokes);
    TriangleMesh mesh = small.mesh();
    const Index inner = 5;
    mesh.vertices.conservativeResize(11, 3);
    mesh.triangles.conservativeResize(15, 3);
    for (Index i = 0; i < inner; ++i) {
        mesh.vertices.row(6 + i) = 2 * mesh.vertices.row(1 + i);
        const Index j = (i + 1) % inner;
        mesh.triangles.row(5 + 2 * i) << 1 + i, 6 + i, 6 + j;
        mesh.triangles.row(6 + 2 * i) << 1 + i, 6 + j, 1 + j;
    }
    return SurfaceDomain(mesh, small.features());
}

std::vector<std::pair<Index, Index>> inner_features(const SurfaceDomain& domain) {
    std::vector<std::pair<Index, Index>> result;
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (domain.is_feature()[e] && domain.topology().edge_triangles.row(e).minCoeff() >= 0)
            result.emplace_back(domain.topology().edges(e, 0), domain.topology().edges(e, 1));
    return result;
}

using Pairs = std::vector<std::pair<Index, Index>>;

TEST(FeatureNeedles, AreCutOffInFrontOfTheTip) {
    const SurfaceDomain domain = ringed_wheel({0, 4, 90, 180, 270}, {1, 2, 4});
    const BluntedFeatures made = blunted_features(domain);
    EXPECT_EQ(made.tips, std::vector<Index>{0});
    // The shorter one, to vertex 1, has gone.
    EXPECT_EQ(inner_features(made.domain), (Pairs{{0, 2}, {0, 4}, {1, 2}}));
    EXPECT_TRUE(blunted_features(domain, 0.05).tips.empty());
}

// One feature that turns back at its tip: neither of its edges there may be left, or it would end inside a face.
TEST(FeatureNeedles, OfOneFeatureLoseBothEdgesAtTheTip) {
    const BluntedFeatures made = blunted_features(ringed_wheel({0, 4, 90, 180, 270}, {1, 2}));
    EXPECT_EQ(made.tips, std::vector<Index>{0});
    EXPECT_EQ(inner_features(made.domain), (Pairs{{1, 2}}));
    EXPECT_TRUE(blunted_features(ringed_wheel({0, 4, 90, 180, 270}, {1, 3})).tips.empty());
}

TEST(FeatureNeedles, StayWhereNothingIsSharpOrTheFaceIsOneTriangle) {
    EXPECT_TRUE(blunted_features(ringed_wheel({0, 40, 90, 180, 270}, {1, 2, 4})).tips.empty());  // wide
    EXPECT_TRUE(blunted_features(wheel({0, 4, 90, 180, 270}, {1, 2, 4})).tips.empty());  // the face is that triangle
    EXPECT_TRUE(blunted_features(ringed_wheel({0, 4, 90, 180, 270}, {})).tips.empty());
}

}  // namespace
}  // namespace octafield::surface
