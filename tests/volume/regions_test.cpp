#include "octafield/volume/regions.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "octafield/volume/boundary.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

// A cube of 4^3 cells whose tets get the id region(cell centre).
template <class Region>
std::vector<Index> regions_of(const TetMesh& mesh, const Region& region) {
    std::vector<Index> ids;
    for (const auto tet : mesh.tets.rowwise()) {
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const Index v : tet) centre += mesh.vertices.row(v).transpose() / 4;
        ids.push_back(region(centre));
    }
    return ids;
}

struct Halves {
    TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions = regions_of(mesh, [](const auto& p) { return p.x() < 0.5 ? 7 : 3; });
    RegionSurface found = region_surface(mesh, regions);
};

TEST(RegionSurface, OfOneRegionIsTheBoundary) {
    const TetMesh mesh = testing::kuhn_cube(3);
    const BoundarySurface boundary = boundary_surface(mesh);
    for (const std::vector<Index>& regions : {std::vector<Index>{}, std::vector<Index>(mesh.tets.rows(), 5)}) {
        const RegionSurface found = region_surface(mesh, regions);
        EXPECT_EQ(found.interface_triangles, 0);
        EXPECT_EQ(found.surface.vertex_map, boundary.vertex_map);
        EXPECT_EQ(found.surface.mesh.triangles, boundary.mesh.triangles);
        EXPECT_EQ(found.surface.mesh.vertices, boundary.mesh.vertices);
        EXPECT_TRUE((found.sides.col(1).array() == -1).all());
    }
}

TEST(RegionSurface, OfTwoHalvesAddsTheSquareBetweenThemFacingTheHigherId) {
    const Halves halves;
    EXPECT_EQ(halves.found.interface_triangles, 2 * 4 * 4);
    const auto& mesh = halves.found.surface.mesh;
    for (Eigen::Index t = mesh.triangles.rows() - 32; t < mesh.triangles.rows(); ++t) {
        const auto p = [&](int k) { return Eigen::Vector3d(mesh.vertices.row(mesh.triangles(t, k))); };
        EXPECT_EQ(p(0).x(), 0.5);
        const Eigen::Vector3d normal = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
        EXPECT_TRUE(normal.isApprox(Eigen::Vector3d(-1, 0, 0)));  // out of region 3, where x > 1/2, into region 7
        EXPECT_EQ(halves.regions[halves.found.sides(t, 0)], 3);
        EXPECT_EQ(halves.regions[halves.found.sides(t, 1)], 7);
    }
}

TEST(Sheets, OfAManifoldSurfaceAreTheSurface) {
    const BoundarySurface boundary = boundary_surface(testing::kuhn_cube(3));
    const Sheets sheets = cut_into_sheets(boundary.mesh);
    EXPECT_EQ(sheets.mesh.triangles, boundary.mesh.triangles);
    EXPECT_EQ(sheets.mesh.vertices, boundary.mesh.vertices);
    EXPECT_EQ(sheets.cuts.rows(), 0);
}

TEST(Sheets, OfTwoHalvesAreTwoCapsAndASquare) {
    const Halves halves;
    const Sheets sheets = cut_into_sheets(halves.found.surface.mesh);
    EXPECT_EQ(sheets.cuts.rows(), 16);  // the rim of the square
    EXPECT_EQ(sheets.mesh.vertices.rows(), halves.found.surface.mesh.vertices.rows() + 2 * 16);
    EXPECT_EQ(surface::euler_characteristic(sheets.mesh), 3);  // of three disks; throws unless manifold and oriented
    for (Eigen::Index v = 0; v < sheets.mesh.vertices.rows(); ++v)
        EXPECT_EQ(sheets.mesh.vertices.row(v), halves.found.surface.mesh.vertices.row(sheets.vertex_map[v]));
    EXPECT_TRUE(std::is_sorted(sheets.vertex_map.begin(), sheets.vertex_map.end()));
}

// The field of a cube with a cubic region inside: the interface's sides hold their normal, its edges the whole frame.
TEST(BoundaryConstraints, OfAnInterfaceAreThoseOfABoundary) {
    const TetMesh mesh = testing::kuhn_cube(4);
    const auto inside = [](double x) { return x >= 0.25 && x <= 0.75; };
    const auto regions =
        regions_of(mesh, [&](const auto& p) { return inside(p.x()) && inside(p.y()) && inside(p.z()) ? 2 : 1; });
    const RegionSurface found = region_surface(mesh, regions);
    EXPECT_EQ(found.interface_triangles, 6 * 2 * 4);
    const surface::FeatureGraph features = surface::detect_features(found.surface.mesh);
    const Points directions = Eigen::RowVector3d(0.3, 0.5, 0.8).replicate(found.surface.mesh.vertices.rows(), 1);
    const auto c = boundary_constraints(static_cast<Index>(mesh.vertices.rows()), found.surface, features, directions);
    const int on_interface = 26;  // of the 27 vertices of 2^3 cells
    EXPECT_EQ(std::count(c.kind.begin(), c.kind.end(), VertexConstraint::free), 1);
    EXPECT_EQ(std::count(c.on_boundary.begin(), c.on_boundary.end(), 1), 98 + on_interface);
    EXPECT_EQ(std::count(c.kind.begin(), c.kind.end(), VertexConstraint::axis), 6 * 9 + 6);
    EXPECT_LT(alignment_angles(found.surface, features, c.frames).maxCoeff(), 1e-7);
}

TEST(BoundaryConstraints, WhereAnInterfaceMeetsTheBoundaryFitBoth) {
    const Halves halves;
    const Sheets sheets = cut_into_sheets(halves.found.surface.mesh);
    Edges edges = surface::detect_features(sheets.mesh).edges;  // the cube's and the rims
    for (Index& v : edges.reshaped()) v = sheets.vertex_map[v];
    const auto features = surface::feature_graph(halves.found.surface.mesh, edges);
    const Points directions = Eigen::RowVector3d(0.3, 0.5, 0.8).replicate(halves.found.surface.mesh.vertices.rows(), 1);
    const auto c = boundary_constraints(static_cast<Index>(halves.mesh.vertices.rows()), halves.found.surface, features,
                                        directions);
    for (const auto edge : sheets.cuts.rowwise())
        for (const Index b : edge) {
            const Index v = halves.found.surface.vertex_map[b];
            EXPECT_EQ(c.kind[v], VertexConstraint::fixed);
            EXPECT_LT(frames::distance(frames::from_wxyz(c.frames.row(v)), frames::Quaternion::Identity()), 1e-7);
        }
}

TEST(RegionSurface, RefusesANumberOfIdsThatIsNotThatOfTheTets) {
    EXPECT_THROW(region_surface(testing::kuhn_cube(1), {1, 2}), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
