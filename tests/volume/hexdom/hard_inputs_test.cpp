// The whole way to a hex-dominant mesh, on inputs that are not kind.
#include "octafield/volume/hex_dominant.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <map>
#include <set>

#include "mixed_grids.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using testing::expect_sound;
using testing::kuhn_grid;

Quaternions turned(Index count, double angle) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(angle, Eigen::Vector3d(0.3, 0.5, 0.8).normalized()));
    return Eigen::RowVector4d(q.w(), q.x(), q.y(), q.z()).replicate(count, 1);
}

HexDominantOptions quick(double edge_length) {
    HexDominantOptions options;
    options.edge_length = edge_length;
    options.refinements = 0;
    return options;
}

void expect_proven(const MixedMesh& mesh) {
    expect_sound(mesh, 0);
    for (const std::uint8_t proven : proven_positive(mesh)) EXPECT_TRUE(proven);
}

TEST(HexDominant, CavitiesStayEmptyWhereFramesGoAgainstThem) {
    const TetMesh mesh = kuhn_grid(4, 4, 4, 1, Eigen::Vector3d::Zero(), [](int i, int j, int k) {
        return std::min({i, j, k}) == 0 || std::max({i, j, k}) == 3;
    });
    for (const double angle : {0.0, 0.7}) {
        HexDominantOptions options = quick(1);
        options.improve = false;
        const HexDominantMesh result =
            hex_dominant(mesh, turned(static_cast<Index>(mesh.vertices.rows()), angle), options);
        // Edges of the cube are no features, so some are cut off.
        EXPECT_NEAR(cell_volumes(result.mesh).sum(), 64 - 8, angle > 0 ? 3 : 1e-9) << angle;
        expect_proven(result.mesh);
    }
}

TEST(HexDominant, RegionsKeepTheirVolumesWhereTheLatticeCrossesTheInterfaceInsideOfTriangles) {
    const TetMesh mesh = kuhn_grid(6, 6, 6, 1);
    std::vector<Index> regions;
    for (const auto tet : mesh.tets.rowwise())
        regions.push_back(mesh.vertices(tet, Eigen::all).colwise().mean()[0] > 3 ? 1 : 0);
    const TetDomain domain(mesh, regions);
    for (const double angle : {0.0, 0.5}) {
        HexDominantOptions options = quick(1.2);
        options.improve = false;
        const HexDominantMesh result =
            hex_dominant(domain, turned(static_cast<Index>(mesh.vertices.rows()), angle), options);
        expect_proven(result.mesh);
        std::map<Index, double> sums;
        const Eigen::VectorXd volumes = cell_volumes(result.mesh);
        for (Index c = 0; c < volumes.size(); ++c) sums[result.regions[c]] += volumes[c];
        EXPECT_NEAR(sums[0], 108, 3);
        EXPECT_NEAR(sums[1], 108, 3);
    }
}

TEST(HexDominant, FeaturesInFlatPlacesStayEdges) {
    const TetMesh mesh = kuhn_grid(6, 6, 3, 1);
    const TetDomain plain(mesh);
    const Points& points = plain.surface().mesh.vertices;
    std::vector<Index> line(7, -1);  // along the middle of the upper side
    for (Index v = 0; v < points.rows(); ++v)
        if (points(v, 1) == 3 && points(v, 2) == 3) line[static_cast<std::size_t>(points(v, 0))] = v;
    surface::FeatureGraph features;
    features.edges.resize(6, 2);
    for (int i = 0; i < 6; ++i) features.edges.row(i) << std::min(line[i], line[i + 1]), std::max(line[i], line[i + 1]);
    features.corners = {std::min(line[0], line[6]), std::max(line[0], line[6])};
    const TetDomain domain = plain.with_features(surface::ordered_features(features, plain.surface().mesh));
    HexDominantOptions options = quick(1);
    options.improve = false;
    const MixedMesh result = hex_dominant(domain, turned(static_cast<Index>(mesh.vertices.rows()), 0.6), options).mesh;
    EXPECT_GT(result.hexahedra.rows(), 0);
    std::set<std::pair<double, double>> pieces;  // edges of faces along the line
    for (const auto& [ids, use] : testing::faces_of(result)) {
        const auto on_line = [&](Index v) {
            return std::abs(result.vertices(v, 1) - 3) < 1e-9 && std::abs(result.vertices(v, 2) - 3) < 1e-9;
        };
        for (const Index a : ids)
            for (const Index b : ids) {
                const bool across = ids.size() == 4 && use.across.count(b) && a == ids[0];
                if (a != b && !across && on_line(a) && on_line(b) && result.vertices(a, 0) < result.vertices(b, 0))
                    pieces.emplace(result.vertices(a, 0), result.vertices(b, 0));
            }
    }
    double length = 0;
    for (const auto& [from, to] : pieces) length += to - from;
    EXPECT_NEAR(length, 6, 1e-9);
}

TEST(HexDominant, MoreCellsThanFitAreRefusedAtOnce) {
    const TetMesh mesh = kuhn_grid(2, 2, 2, 1);
    for (const double length : {1e-3, 1e-9, 1e-200, 1e-320}) {
        try {
            hex_dominant(mesh, turned(static_cast<Index>(mesh.vertices.rows()), 0), quick(length));
            FAIL() << length;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "too_many_cells");
            EXPECT_NE(std::string(error.what()).find("larger edge length"), std::string::npos);
        }
    }
}

TEST(HexDominant, ASingleTetAndSizesFarAboveThePartGiveAMesh) {
    for (const int cubes : {1, 2}) {
        TetMesh mesh = kuhn_grid(cubes, cubes, cubes, 1);
        if (cubes == 1) mesh.tets = mesh.tets.topRows(1).eval();
        if (cubes == 1) mesh = {mesh.vertices(mesh.tets.row(0), Eigen::all), Eigen::RowVector4i(0, 1, 2, 3)};
        const HexDominantMesh result =
            hex_dominant(mesh, turned(static_cast<Index>(mesh.vertices.rows()), 0.4), quick(50));
        expect_proven(result.mesh);
    }
}

}  // namespace
}  // namespace octafield::volume
