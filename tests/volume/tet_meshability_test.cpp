// Meshability of frames in the tets.

#include "octafield/volume/tet_meshability.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/features.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using testing::kuhn_grid;
using testing::sample_in_tets;

struct Judged {
    TetMesh mesh;
    TetDomain domain;
    Quaternions frames;
    SingularEdges singular;
    Meshability found;
    BoundaryMeshability at_boundary;

    template <class Field>
    Judged(TetMesh of, const Field& field)
        : mesh(std::move(of)),
          domain(mesh, {}, surface::detect_features(boundary_surface(mesh).mesh)),
          frames(sample_in_tets(mesh, field)),
          singular(singular_edges(mesh, frames)),
          found(tet_meshability(domain, frames, singular)),
          at_boundary(tet_boundary_meshability(domain, frames)) {}
};

const auto constant = [](const Vector3&) { return frames::Quaternion::Identity(); };

TEST(TetMeshability, AnAlignedCubeHasOneHexahedronAtItsEdgesAndCornersAndAllIsMeshable) {
    const Judged cube(kuhn_grid(3, 3, 3, 0.4, {1, -2, 3}), constant);
    EXPECT_TRUE(cube.found.vertices.empty());
    EXPECT_EQ(cube.at_boundary.wedges.size(), 12u * 3);
    for (const FeatureWedge& w : cube.at_boundary.wedges) {
        EXPECT_EQ(w.hexahedra_a, 1);
        EXPECT_TRUE(w.meshable);
        EXPECT_NEAR(w.angle, std::numbers::pi / 2, 1e-12);
    }
    ASSERT_EQ(cube.at_boundary.corners.size(), 8u);
    for (const SurfaceCorner& c : cube.at_boundary.corners) {
        EXPECT_EQ(c.inside, 0);
        EXPECT_EQ(c.sectors, 3);
        EXPECT_EQ(c.unclear_sectors, 0);
        EXPECT_TRUE(c.meshable);
    }
    EXPECT_TRUE(cube.at_boundary.crossings.empty());
}

TEST(TetMeshability, ANotchHasThreeHexahedraAtItsReentrantEdges) {
    const Judged part(kuhn_grid(4, 4, 2, 0.5, Vector3::Zero(), [](int i, int j, int) { return i < 2 || j < 2; }),
                      constant);
    int reentrant = 0;
    for (const FeatureWedge& w : part.at_boundary.wedges) {
        EXPECT_EQ(w.hexahedra_a, w.angle > 3 ? 3 : 1);
        reentrant += w.hexahedra_a == 3;
    }
    EXPECT_EQ(reentrant, 2);
    EXPECT_EQ(part.at_boundary.non_meshable_corners, 0);
}

// A cylinder in polar coordinates: frames turn with the angle, so a box cut by the planes phi = 0 and phi = pi / 2 of a
// field that turns by a quarter between them has no hexahedron left at their common edge.
TEST(TetMeshability, AnEdgeRoundWhichTheFieldTurnsAsMuchAsTheWedgeHasNoHexahedron) {
    const Judged quarter(kuhn_grid(4, 4, 2, 0.25), [](const Vector3& x) {
        return frames::exp({0, 0, std::atan2(x.y(), x.x())});
    });
    int empty = 0;
    for (const FeatureWedge& w : quarter.at_boundary.wedges)
        if (quarter.mesh.vertices.row(w.a).head(2).isZero(0) && quarter.mesh.vertices.row(w.b).head(2).isZero(0)) {
            EXPECT_EQ(w.hexahedra_a, 0);
            EXPECT_FALSE(w.meshable);
            ++empty;
        }
    EXPECT_EQ(empty, 2);
}

class CurveThrough : public ::testing::TestWithParam<int> {};

// A curve along z through a box: it ends on the top and the bottom, about their normals.
TEST_P(CurveThrough, EndsOnTheSurfaceAboutItsNormal) {
    const int n = 7;
    const Judged box(kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5)),
                     [](const Vector3& x) {
                         return frames::exp({0, 0, GetParam() * std::atan2(x.y(), x.x()) / 4});
                     });
    ASSERT_EQ(box.singular.graph.curves.size(), 1u);
    ASSERT_EQ(box.found.vertices.size(), 2u);
    for (const SingularVertex& v : box.found.vertices) {
        EXPECT_EQ(v.kind, SingularVertexKind::boundary_end);
        EXPECT_TRUE(v.about_normal);
        EXPECT_TRUE(v.meshable);
        EXPECT_EQ(GetParam() == 1 ? v.valence3 : v.valence5, 1);
    }
    EXPECT_EQ(box.found.boundary_ends_about_normal, 2);
    EXPECT_EQ(box.found.non_meshable_curves, 0);
    ASSERT_EQ(box.found.ends.size(), 2u);
    for (const SingularEnd& e : box.found.ends) EXPECT_NEAR(std::abs(e.axis.z()), 1, 1e-12);
}

// Tilted by more than 45 degrees, the axis of its turn is no longer the one on the normal.
TEST_P(CurveThrough, IsNotMeshableWhereItTurnsAboutATangent) {
    const int n = 7;
    const Judged box(
        kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5)), [](const Vector3& x) {
            return frames::exp({1.0, 0, 0}) * frames::exp({0, 0, GetParam() * std::atan2(x.y(), x.x()) / 4});
        });
    EXPECT_EQ(box.found.boundary_ends, 2);
    EXPECT_EQ(box.found.boundary_ends_about_normal, 0);
    EXPECT_EQ(box.found.non_meshable_vertices, 2);
}

INSTANTIATE_TEST_SUITE_P(QuarterTurns, CurveThrough, ::testing::Values(1, -1));

TEST(TetMeshability, OfRandomFieldsHasEveryCurveEndAtAVertexAndNeedsTheEdgesOfTheField) {
    const TetMesh mesh = testing::jittered_cube(4, 0.2, 3);
    const Quaternions frames = frames::random_rotations(mesh.tets.rows(), 8);
    const TetDomain domain(mesh, {}, surface::detect_features(boundary_surface(mesh).mesh));
    const SingularEdges singular = singular_edges(mesh, frames);
    const Meshability found = tet_meshability(domain, frames, singular);
    EXPECT_EQ(found.curve_ends.rows(), static_cast<Eigen::Index>(singular.graph.curves.size()));
    EXPECT_GT(found.non_meshable_vertices, 20);
    int ends = 0;
    for (const SingularVertex& v : found.vertices)
        ends += v.valence1 + v.valence2 + v.valence3 + v.valence5 + v.valence6 + v.valence7 + v.valence8 + v.complex;
    EXPECT_EQ(ends, static_cast<int>(found.ends.size()));
    EXPECT_EQ(ends, 2 * (static_cast<int>(singular.graph.curves.size()) - found.closed_curves));
    SingularEdges wrong = singular;
    wrong.edges.erase(wrong.edges.begin(), wrong.edges.begin() + static_cast<std::ptrdiff_t>(wrong.edges.size() / 2));
    EXPECT_THROW(tet_meshability(domain, frames, wrong), InvalidInput);
    wrong.vertices.pop_back();
    EXPECT_THROW(tet_meshability(domain, frames, wrong), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
