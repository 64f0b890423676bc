#include "octafield/volume/tet_domain.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <string>

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
    TetDomain found = TetDomain(mesh, regions);
};

TEST(TetDomain, OfOneRegionIsTheBoundary) {
    const TetMesh mesh = testing::kuhn_cube(3);
    const BoundarySurface boundary = boundary_surface(mesh);
    for (const std::vector<Index>& regions : {std::vector<Index>{}, std::vector<Index>(mesh.tets.rows(), 5)}) {
        const TetDomain found(mesh, regions);
        EXPECT_EQ(found.interface_triangles(), 0);
        EXPECT_EQ(found.surface().vertex_map, boundary.vertex_map);
        EXPECT_EQ(found.surface().mesh.triangles, boundary.mesh.triangles);
        EXPECT_EQ(found.surface().mesh.vertices, boundary.mesh.vertices);
        EXPECT_TRUE((found.sides().col(1).array() == -1).all());
    }
}

TEST(TetDomain, OfTwoHalvesAddsTheSquareBetweenThemFacingTheHigherId) {
    const Halves halves;
    EXPECT_EQ(halves.found.interface_triangles(), 2 * 4 * 4);
    const auto& mesh = halves.found.surface().mesh;
    for (Eigen::Index t = mesh.triangles.rows() - 32; t < mesh.triangles.rows(); ++t) {
        const auto p = [&](int k) { return Eigen::Vector3d(mesh.vertices.row(mesh.triangles(t, k))); };
        EXPECT_EQ(p(0).x(), 0.5);
        const Eigen::Vector3d normal = (p(1) - p(0)).cross(p(2) - p(0)).normalized();
        EXPECT_TRUE(normal.isApprox(Eigen::Vector3d(-1, 0, 0)));  // out of region 3, where x > 1/2, into region 7
        EXPECT_EQ(halves.regions[halves.found.sides()(t, 0)], 3);
        EXPECT_EQ(halves.regions[halves.found.sides()(t, 1)], 7);
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
    const Sheets sheets = halves.found.sheets();
    EXPECT_EQ(sheets.cuts.rows(), 16);  // the rim of the square
    EXPECT_EQ(sheets.mesh.vertices.rows(), halves.found.surface().mesh.vertices.rows() + 2 * 16);
    EXPECT_EQ(surface::euler_characteristic(sheets.mesh), 3);  // of three disks; throws unless manifold and oriented
    for (Eigen::Index v = 0; v < sheets.mesh.vertices.rows(); ++v)
        EXPECT_EQ(sheets.mesh.vertices.row(v), halves.found.surface().mesh.vertices.row(sheets.vertex_map[v]));
    EXPECT_TRUE(std::is_sorted(sheets.vertex_map.begin(), sheets.vertex_map.end()));
}

// The field of a cube with a cubic region inside: the interface's sides hold their normal, its edges the whole frame.
TEST(BoundaryConstraints, OfAnInterfaceAreThoseOfABoundary) {
    const TetMesh mesh = testing::kuhn_cube(4);
    const auto inside = [](double x) { return x >= 0.25 && x <= 0.75; };
    const auto regions =
        regions_of(mesh, [&](const auto& p) { return inside(p.x()) && inside(p.y()) && inside(p.z()) ? 2 : 1; });
    const TetDomain found(mesh, regions);
    EXPECT_EQ(found.interface_triangles(), 6 * 2 * 4);
    const surface::FeatureGraph features = surface::detect_features(found.surface().mesh);
    const Points directions = Eigen::RowVector3d(0.3, 0.5, 0.8).replicate(found.surface().mesh.vertices.rows(), 1);
    const TetDomain domain = found.with_features(features);
    const auto c = boundary_constraints(domain, directions);
    const int on_interface = 26;  // of the 27 vertices of 2^3 cells
    EXPECT_EQ(std::count(c.kind.begin(), c.kind.end(), VertexConstraint::free), 1);
    EXPECT_EQ(std::count(c.on_boundary.begin(), c.on_boundary.end(), 1), 98 + on_interface);
    EXPECT_EQ(std::count(c.kind.begin(), c.kind.end(), VertexConstraint::axis), 6 * 9 + 6);
    EXPECT_LT(alignment_angles(domain, c.frames).maxCoeff(), 1e-7);
}

TEST(BoundaryConstraints, WhereAnInterfaceMeetsTheBoundaryFitBoth) {
    const Halves halves;
    const Sheets sheets = halves.found.sheets();
    Edges edges = surface::detect_features(sheets.mesh).edges;  // the cube's and the rims
    for (Index& v : edges.reshaped()) v = sheets.vertex_map[v];
    const auto features = surface::feature_graph(halves.found.surface().mesh, edges);
    const Points directions =
        Eigen::RowVector3d(0.3, 0.5, 0.8).replicate(halves.found.surface().mesh.vertices.rows(), 1);
    const auto c = boundary_constraints(halves.found.with_features(features), directions);
    for (const auto edge : sheets.cuts.rowwise())
        for (const Index b : edge) {
            const Index v = halves.found.surface().vertex_map[b];
            EXPECT_EQ(c.kind[v], VertexConstraint::fixed);
            EXPECT_LT(frames::distance(frames::from_wxyz(c.frames.row(v)), frames::Quaternion::Identity()), 1e-7);
        }
}

// The surface's arrays say what the mesh's own say.
TEST(TetDomain, RowsAndSidesOfTheSurfaceAreThoseOfItsTriangles) {
    const Halves halves;
    const TetDomain& domain = halves.found;
    const auto& surface = domain.surface();
    for (Eigen::Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
        std::array<Index, 3> ids;
        for (int k = 0; k < 3; ++k) ids[k] = surface.vertex_map[surface.mesh.triangles(f, k)];
        std::sort(ids.begin(), ids.end());
        const auto row = domain.triangles().triangles.row(domain.surface_rows()[f]);
        EXPECT_EQ((std::array{row[0], row[1], row[2]}), ids);
        for (const Index tet : {domain.sides()(f, 0), domain.sides()(f, 1)})
            for (const Index v : ids) EXPECT_TRUE(tet < 0 || (halves.mesh.tets.row(tet).array() == v).any());
    }
    EXPECT_EQ(domain.boundary().mesh.triangles, boundary_surface(halves.mesh).mesh.triangles);
    EXPECT_EQ(domain.boundary().vertex_map, boundary_surface(halves.mesh).vertex_map);
}

TEST(TetDomain, CopiesShareOneMeshThatIsValidatedOnce) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const long long before = TetDomain::made();
    const TetDomain domain(mesh);
    const TetDomain copy = domain, other = domain.with_features(surface::detect_features(domain.surface().mesh));
    EXPECT_EQ(TetDomain::made(), before + 1);
    EXPECT_EQ(&copy.mesh(), &domain.mesh());
    EXPECT_EQ(&other.triangles(), &domain.triangles());
    EXPECT_EQ(domain.features().edges.rows(), 0);
    EXPECT_EQ(other.features().edges.rows(), 24);
    EXPECT_EQ(other.shared_mesh().get(), &domain.mesh());
}

TEST(TetDomain, RefusesUnsoundMeshesAndFeaturesThatAreNotOfItsSurface) {
    TetMesh inverted = testing::kuhn_cube(1);
    std::swap(inverted.tets(2, 0), inverted.tets(2, 1));
    EXPECT_THROW(TetDomain{inverted}, GeometryError);
    const TetDomain domain(testing::kuhn_cube(2));
    const auto kind_of = [&](const Edges& edges, std::vector<Index> corners) -> std::string {
        try {
            domain.with_features({edges, std::move(corners)});
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return "no error";
    };
    EXPECT_EQ(kind_of(Edges{{0, 1000}}, {}), "index_out_of_range");
    EXPECT_EQ(kind_of(Edges{{0, static_cast<Index>(domain.surface().vertex_map.size()) - 1}}, {}), "not_an_edge");
    EXPECT_EQ(kind_of(Edges(0, 2), {1000}), "index_out_of_range");
    EXPECT_EQ(kind_of(domain.with_features(surface::detect_features(domain.surface().mesh)).features().edges, {0}),
              "no error");
}

TEST(Sheets, CarryFeaturesToAllTheirCopies) {
    const Halves halves;
    const Sheets& sheets = halves.found.sheets();
    const auto features = surface::feature_graph(halves.found.surface().mesh, sheets.cuts);
    const auto found = features_on_sheets(features, sheets);
    EXPECT_EQ(found.edges.rows(), 3 * 16);  // of two caps and the square
    for (const Index v : found.edges.reshaped())
        EXPECT_EQ(halves.found.surface().mesh.vertices(sheets.vertex_map[v], 0), 0.5);
}

TEST(TetDomain, RefusesANumberOfIdsThatIsNotThatOfTheTets) {
    EXPECT_THROW(TetDomain(testing::kuhn_cube(1), {1, 2}), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
