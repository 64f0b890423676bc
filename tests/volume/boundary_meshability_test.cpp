#include "octafield/volume/boundary_meshability.hpp"

#include <gtest/gtest.h>

#include <map>
#include <numbers>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::degree;
using testing::kuhn_grid;
using testing::sample;

BoundaryMeshability check_field(const TetMesh& mesh, const Quaternions& frames, double angle = 40 * degree) {
    const TetDomain domain(mesh);
    return boundary_meshability(domain.with_features(surface::detect_features(domain.surface().mesh, {.angle = angle})),
                                frames);
}

Quaternions constant(const TetMesh& mesh, const Quaternion& q = Quaternion::Identity()) {
    return sample(mesh, [&](const Vector3&) { return q; });
}

std::map<int, int> wedges_by_number(const BoundaryMeshability& found) {
    std::map<int, int> counts;
    for (const FeatureWedge& w : found.wedges) {
        EXPECT_EQ(w.hexahedra_a, w.hexahedra_b);
        EXPECT_EQ(w.hexahedra_a, w.around);
        ++counts[w.hexahedra_a];
    }
    return counts;
}

TEST(BoundaryMeshability, OfACubeHasOneHexahedronAtEveryEdgeAndCorner) {
    const TetMesh mesh = testing::kuhn_cube(4);
    const BoundaryMeshability found = check_field(mesh, constant(mesh));
    EXPECT_EQ(wedges_by_number(found), (std::map<int, int>{{1, 48}}));
    EXPECT_TRUE(found.crossings.empty());
    for (const FeatureWedge& w : found.wedges) EXPECT_NEAR(w.angle, 90 * degree, 1e-12);
    ASSERT_EQ(found.corners.size(), 8u);
    for (const SurfaceCorner& c : found.corners) {
        EXPECT_EQ(c.feature_edges, 3);
        EXPECT_EQ(c.sectors, 3);
        EXPECT_EQ(c.inside, 0);
        EXPECT_TRUE(c.meshable);
    }
    EXPECT_EQ(found.non_meshable_wedges + found.non_meshable_corners, 0);
}

TEST(BoundaryMeshability, OfAStepHasThreeHexahedraAtTheConcaveEdge) {
    const TetMesh mesh = kuhn_grid(4, 4, 4, 0.25, Vector3::Zero(), [](int i, int j, int) { return i < 2 || j < 2; });
    const BoundaryMeshability found = check_field(mesh, constant(mesh));
    EXPECT_EQ(wedges_by_number(found), (std::map<int, int>{{1, 5 * 4 + 2 * 16}, {3, 4}}));
    EXPECT_EQ(found.corners.size(), 12u);
    for (const SurfaceCorner& c : found.corners) EXPECT_EQ(c.inside, 0);
    EXPECT_EQ(found.non_meshable_corners, 0);
}

// A notch with a corner where three concave edges meet: two hexahedra-free octants fewer than the full ball.
TEST(BoundaryMeshability, OfACubeWithoutAnOctantHasSevenHexahedraInTheConcaveCorner) {
    const TetMesh mesh =
        kuhn_grid(4, 4, 4, 0.25, Vector3::Zero(), [](int i, int j, int k) { return i < 2 || j < 2 || k < 2; });
    const BoundaryMeshability found = check_field(mesh, constant(mesh));
    EXPECT_EQ(wedges_by_number(found)[3], 6);
    EXPECT_EQ(found.non_meshable_corners, 0);
    for (const SurfaceCorner& c : found.corners) {
        const Vector3 x = mesh.vertices.row(c.vertex).transpose();
        // Three edges go on inside from the concave corner: 2 s = 6.
        EXPECT_EQ(c.inside, (x - Vector3::Constant(0.5)).norm() < 1e-9 ? 6 : 0);
    }
}

// A wedge of angle 30 degrees at the z axis, swept by the field: constant, both faces keep their nearest axes.
TetMesh wedge(double angle, int n = 3) {
    TetMesh mesh = testing::kuhn_cube(n);  // the square (x, y) becomes a sector
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector3 x = mesh.vertices.row(v).transpose();
        const double radius = 0.2 + std::max(x.x(), x.y()), phi = angle * std::atan2(x.y(), x.x()) / (90 * degree);
        const double full = std::max(x.x(), x.y()) == 0 ? 0 : radius;
        mesh.vertices.row(v) << full * std::cos(phi), full * std::sin(phi), x.z();
    }
    return mesh;
}

struct WedgeCase {
    double angle;
    int hexahedra;
};

class EdgesOfWedges : public ::testing::TestWithParam<WedgeCase> {};

TEST_P(EdgesOfWedges, HaveTheNumberOfQuarterTurnsThatTheFieldLeaves) {
    const auto [angle, hexahedra] = GetParam();
    const TetMesh mesh = wedge(angle);
    ASSERT_GT(tet_volumes(mesh).minCoeff(), 0);
    // The twist at the edge that fits both faces best; everywhere the same.
    const Quaternion q = frames::exp({0, 0, angle / 2 - hexahedra * 45 * degree});
    const BoundaryMeshability found = check_field(mesh, constant(mesh, q), 20 * degree);
    int seen = 0;
    for (const FeatureWedge& w : found.wedges)
        if (mesh.vertices.row(w.a).head<2>().norm() + mesh.vertices.row(w.b).head<2>().norm() < 1e-9) {
            ++seen;
            EXPECT_NEAR(w.angle, angle, 1e-9);
            EXPECT_EQ(w.hexahedra_a, hexahedra);
            EXPECT_EQ(w.hexahedra_b, hexahedra);
            EXPECT_EQ(w.meshable, hexahedra >= 1);
        }
    EXPECT_EQ(seen, 3);
}

INSTANTIATE_TEST_SUITE_P(Angles, EdgesOfWedges,
                         ::testing::Values(WedgeCase{30 * degree, 0}, WedgeCase{60 * degree, 1},
                                           WedgeCase{90 * degree, 1}, WedgeCase{120 * degree, 1},
                                           WedgeCase{150 * degree, 2}, WedgeCase{210 * degree, 2},
                                           WedgeCase{250 * degree, 3}, WedgeCase{280 * degree, 3}));

// A sector about the z axis of `parts` prisms per layer, each of three tets.
TetMesh sector(double angle, int parts, int layers) {
    TetMesh mesh{Points((parts + 2) * (layers + 1), 3), Tets(3 * parts * layers, 4)};
    const auto id = [&](int layer, int i) { return layer * (parts + 2) + i; };  // 0: on the axis
    for (int layer = 0; layer <= layers; ++layer)
        for (int i = 0; i < parts + 2; ++i) {
            const double phi = angle * (i - 1) / parts;
            mesh.vertices.row(id(layer, i)) << (i > 0) * std::cos(phi), (i > 0) * std::sin(phi), layer;
        }
    for (int layer = 0, t = 0; layer < layers; ++layer)
        for (int i = 1; i <= parts; ++i, t += 3) {
            const int a = id(layer, 0), b = id(layer, i), c = id(layer, i + 1);
            const int up = parts + 2;
            mesh.tets.row(t) << a, b, c, c + up;
            mesh.tets.row(t + 1) << a, b, c + up, b + up;
            mesh.tets.row(t + 2) << a, b + up, c + up, a + up;
        }
    EXPECT_GT(tet_volumes(mesh).minCoeff(), 0);
    return mesh;
}

// The field turns with the polar angle so that n hexahedra fit round the axis, whatever angle the sector has. On the
// axis the frame sees one.
TEST(BoundaryMeshability, CountsTheTurnOfTheFieldRoundTheEdgeToo) {
    for (const int n : {-1, 0, 1, 2, 3}) {
        const double angle = 100 * degree, rate = 1 - n * 90 * degree / angle;
        const TetMesh mesh = sector(angle, 10, 3);
        const BoundaryMeshability found = check_field(mesh, sample(mesh, [&](const Vector3& x) {
                                                          return frames::exp({0, 0, rate * std::atan2(x.y(), x.x())});
                                                      }));
        int seen = 0;
        for (const FeatureWedge& w : found.wedges)
            if (mesh.vertices.row(w.a).head<2>().norm() + mesh.vertices.row(w.b).head<2>().norm() < 1e-9) {
                ++seen;
                EXPECT_NEAR(w.angle, angle, 1e-9);
                EXPECT_EQ(w.around, n);
                EXPECT_EQ(w.hexahedra_a, 1);
                EXPECT_TRUE(w.meshable);
            }
        EXPECT_EQ(seen, 3);
    }
}

// Four faces meet at the tip of a pyramid: with one hexahedron at each of its edges none fills the tip.
TEST(BoundaryMeshability, OfAPyramidTheTipHasNoHexMesh) {
    TetMesh mesh{Points(6, 3), Tets(4, 4)};
    mesh.vertices << 1, 0, 0, 0, 1, 0, -1, 0, 0, 0, -1, 0, 0, 0, 1, 0, 0, 0;
    mesh.tets << 5, 0, 1, 4, 5, 1, 2, 4, 5, 2, 3, 4, 5, 3, 0, 4;
    const Quaternion q = frames::exp({0, 0, 45 * degree});  // on the edges of the base
    const BoundaryMeshability found = check_field(mesh, constant(mesh, q));
    int tips = 0;
    for (const SurfaceCorner& c : found.corners)
        if (c.vertex == 4) {
            ++tips;
            EXPECT_EQ(c.feature_edges, 4);
            EXPECT_FALSE(c.meshable);
        }
    EXPECT_EQ(tips, 1);
    EXPECT_GE(found.non_meshable_corners, 1);
}

// A box without features: its normals change their axis along every edge that goes round a corner of it.
TEST(BoundaryMeshability, FindsSingularEdgesOnASurfaceWithoutFeatures) {
    for (const bool step : {false, true}) {
        // A quarter of a ring of square section, 30 degrees at a time, in which a constant field does not turn.
        TetMesh mesh = kuhn_grid(12, 2, 2, 0.25);
        for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
            const double phi = 30 * degree * 4 * mesh.vertices(v, 0), r = 2 + mesh.vertices(v, 1);
            mesh.vertices.row(v) << r * std::sin(phi), r * std::cos(phi), mesh.vertices(v, 2);
        }
        ASSERT_GT(tet_volumes(mesh).minCoeff(), 0);
        const auto field = step ? constant(mesh) : sample(mesh, [](const Vector3& x) {
            return frames::exp({0, 0, std::atan2(x.y(), x.x())});
        });
        const BoundaryMeshability found = check_field(mesh, field);
        EXPECT_EQ(found.crossings.empty(), !step);
        std::map<int, int> numbers;
        for (const SurfaceCrossing& c : found.crossings) {
            const Vector3 middle = (mesh.vertices.row(c.a) + mesh.vertices.row(c.b)).transpose() / 2;
            EXPECT_TRUE(c.hexahedra == (middle.head<2>().norm() > 2.2 ? 1 : 3)) << c.hexahedra;
            ++numbers[c.hexahedra];
        }
        EXPECT_EQ(numbers[1] > 0, step);
        EXPECT_EQ(numbers[1], numbers[3]);  // as many on the outside as on the inside
        EXPECT_EQ(found.non_meshable_crossings, 0);
    }
}

TEST(BoundaryMeshability, AreTheSameForEquivalentFramesAndAnyThreadCount) {
    const TetMesh mesh = testing::kuhn_cube(5);
    const Quaternions field = sample(mesh, [](const Vector3& x) { return frames::exp(0.4 * x); });
    Quaternions equivalent = field;
    for (Eigen::Index v = 0; v < field.rows(); ++v)
        equivalent.row(v) =
            frames::to_wxyz(frames::from_wxyz(field.row(v)) * frames::binary_octahedral_group()[(5 * v) % 48])
                .transpose();
    const BoundarySurface boundary = boundary_surface(mesh);
    const TetDomain domain(mesh, {}, surface::detect_features(boundary.mesh));
    const auto one = boundary_meshability(domain, field, 1);
    for (const auto& other : {boundary_meshability(domain, field, 4), boundary_meshability(domain, equivalent)}) {
        ASSERT_EQ(one.wedges.size(), other.wedges.size());
        for (std::size_t i = 0; i < one.wedges.size(); ++i) {
            EXPECT_EQ(one.wedges[i].hexahedra_a, other.wedges[i].hexahedra_a);
            EXPECT_EQ(one.wedges[i].around, other.wedges[i].around);
        }
        ASSERT_EQ(one.corners.size(), other.corners.size());
        ASSERT_EQ(one.crossings.size(), other.crossings.size());
        for (std::size_t i = 0; i < one.corners.size(); ++i) EXPECT_EQ(one.corners[i].inside, other.corners[i].inside);
    }
}

TEST(BoundaryMeshability, OfInterfacesCountsTheWedgesOnAllSides) {
    const TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions;
    for (const auto& tet : mesh.tets.rowwise()) {
        Vector3 centre = Vector3::Zero();
        for (const Index v : tet) centre += mesh.vertices.row(v).transpose() / 4;
        regions.push_back(centre.maxCoeff() < 0.5);  // a cube in the corner of a cube
    }
    const TetDomain domain(mesh, regions);
    const BoundarySurface& surface = domain.surface();
    Edges edges(2, 2);
    const auto id = [&](double x, double y, double z) {
        for (std::size_t b = 0; b < surface.vertex_map.size(); ++b)
            if ((mesh.vertices.row(surface.vertex_map[b]) - Eigen::RowVector3d(x, y, z)).norm() < 1e-9)
                return static_cast<Index>(b);
        return Index{-1};
    };
    edges << id(0.5, 0.5, 0.25), id(0.5, 0.5, 0.5), id(0.5, 0, 0.25), id(0.5, 0, 0.5);
    const auto features = surface::feature_graph(surface.mesh, edges);
    const auto found = boundary_meshability(domain.with_features(features), constant(mesh));
    std::multiset<int> numbers;
    for (const FeatureWedge& w : found.wedges) numbers.insert(w.hexahedra_a);
    EXPECT_EQ(numbers, (std::multiset<int>{1, 3, 1, 1}));  // inside and outside the small cube; both sides on a face
}

TEST(BoundaryMeshability, RefusesWhatDoesNotFit) {
    const TetMesh mesh = testing::kuhn_cube(2);
    EXPECT_THROW(boundary_meshability(mesh, Quaternions(2, 4)), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
