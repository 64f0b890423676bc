#include "octafield/surface/surface_domain.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "direction_field_fixtures.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {
namespace {

// The kind of the error that making a domain of these raises.
template <class Error>
std::string refusal(const TriangleMesh& mesh, const FeatureGraph& features = {}) {
    try {
        SurfaceDomain(mesh, features);
    } catch (const Error& error) {
        EXPECT_FALSE(error.elements().empty()) << error.what();
        return error.kind();
    }
    return "accepted";
}

TEST(SurfaceDomain, HoldsWhatTheFunctionsOfItsMeshGive) {
    const TriangleMesh mesh = torus(20, 12, 1, 0.4);
    const SurfaceDomain domain = mesh;
    const EdgeTopology topology = edge_topology(mesh);
    EXPECT_EQ(domain.topology().edges, topology.edges);
    EXPECT_EQ(domain.topology().triangle_edges, topology.triangle_edges);
    EXPECT_EQ(domain.topology().edge_triangles, topology.edge_triangles);
    EXPECT_EQ(domain.normals(), triangle_normals(mesh));
    EXPECT_EQ(domain.mean_edge_length(), mean_edge_length(mesh));
    EXPECT_EQ(domain.size(), shape_size(mesh));
    EXPECT_NEAR(domain.edge_lengths().mean(), domain.mean_edge_length(), 1e-14);
    EXPECT_NEAR((domain.corner_angles().rowwise().sum().array() - pi).abs().maxCoeff(), 0, 1e-14);
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            EXPECT_NEAR(domain.cotangents()(t, k) * std::tan(domain.corner_angles()(t, k)), 1, 1e-12);
}

TEST(SurfaceDomain, FansGoRoundEveryVertexInUseOnce) {
    for (const TriangleMesh& mesh : {icosphere(2), disk(5), joined({disk(3), icosphere(1)})}) {
        const SurfaceDomain domain = mesh;
        std::vector<int> seen(3 * domain.triangle_count(), 0);
        for (const auto& fan : domain.fans().fans) {
            bool at_rim = false;
            for (Index i = fan.first; i < fan.last; ++i) {
                const Index corner = domain.fans().corners[i];
                ++seen[corner];
                EXPECT_EQ(mesh.triangles(corner / 3, corner % 3), fan.vertex);
                for (const int side : {0, 2}) {
                    const Index edge = domain.topology().triangle_edges(corner / 3, (corner % 3 + side) % 3);
                    at_rim = at_rim || domain.topology().edge_triangles.row(edge).minCoeff() < 0;
                }
            }
            EXPECT_EQ(fan.closed, !at_rim);
        }
        EXPECT_TRUE(std::all_of(seen.begin(), seen.end(), [](int count) { return count == 1; }));
        EXPECT_EQ(static_cast<Index>(domain.fans().fans.size()), domain.vertex_count());
    }
}

TEST(SurfaceDomain, FeaturesAreOrderedAndTheMeshBoundaryCounts) {
    const TriangleMesh mesh = disk(4);
    const SurfaceDomain plain = mesh;
    const Edges& edges = plain.topology().edges;
    FeatureGraph given{Edges(3, 2), {5, 2, 5}};
    given.edges << edges(7, 1), edges(7, 0), edges(3, 0), edges(3, 1), edges(7, 0), edges(7, 1);
    const SurfaceDomain domain = plain.with_features(given);
    EXPECT_EQ(domain.features().edges, edges(std::vector<Index>{3, 7}, Eigen::all));
    EXPECT_EQ(domain.features().corners, (std::vector<Index>{2, 5}));
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const bool rim = domain.topology().edge_triangles.row(e).minCoeff() < 0;
        EXPECT_EQ(plain.is_feature()[e], rim);
        EXPECT_EQ(domain.is_feature()[e], rim || e == 3 || e == 7);
    }
    EXPECT_EQ(&domain.mesh(), &plain.mesh());  // shared, not copied
}

TEST(SurfaceDomain, RefusesUnsoundSurfacesNamingElements) {
    const TriangleMesh mesh = icosphere(1);
    TriangleMesh beyond = mesh, lost = mesh, turned = mesh, flat = mesh, tiny = mesh;
    beyond.triangles(3, 1) = static_cast<Index>(mesh.vertices.rows());
    lost.vertices(4, 2) = std::numeric_limits<double>::quiet_NaN();
    std::swap(turned.triangles(0, 0), turned.triangles(0, 1));
    flat.vertices.row(flat.triangles(0, 0)) =
        (flat.vertices.row(flat.triangles(0, 1)) + flat.vertices.row(flat.triangles(0, 2))) / 2;
    tiny.vertices *= 1e-160;
    EXPECT_EQ(refusal<GeometryError>(beyond), "index_out_of_range");
    EXPECT_EQ(refusal<GeometryError>(lost), "non_finite");
    EXPECT_EQ(refusal<GeometryError>(turned), "inconsistent_orientation");
    EXPECT_EQ(refusal<GeometryError>(flat), "degenerate_triangle");
    EXPECT_EQ(refusal<GeometryError>(tiny), "size_out_of_range");
    const Index count = static_cast<Index>(mesh.vertices.rows());
    EXPECT_EQ(refusal<InvalidInput>(mesh, {Edges{{0, count}}, {}}), "index_out_of_range");
    EXPECT_EQ(refusal<InvalidInput>(mesh, {Edges{{0, 0}}, {}}), "not_an_edge");
    EXPECT_EQ(refusal<InvalidInput>(mesh, {Edges(0, 2), {count}}), "index_out_of_range");
}

TEST(SurfaceDomain, IsMadeOnceForAFieldAndAllThatIsFoundOnIt) {
    const long long before = SurfaceDomain::made();
    const SurfaceDomain domain(icosphere(2));
    const PrincipalDirections lines = principal_directions(domain);
    const DirectionField field = direction_field(domain, {.guide = {lines.directions, lines.anisotropy}});
    const SurfaceSingularities found = surface_singularities(field);
    vertex_directions(field);
    triangle_directions(field);
    separatrices(field, found);
    even_streamlines(field, found);
    EXPECT_EQ(SurfaceDomain::made(), before + 1);
    EXPECT_EQ(&field.domain.mesh(), &domain.mesh());
}

}  // namespace
}  // namespace octafield::surface
