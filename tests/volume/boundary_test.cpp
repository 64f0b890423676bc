#include "octafield/volume/boundary.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <numeric>

#include "../surface/mesh_fixtures.hpp"
#include "alignment.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "surface_constraints.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using surface::FeatureGraph;
using surface::TriangleMesh;
using testing::degree;

// Boundary vertices are the tet mesh's vertices: enough where no tets are needed.
BoundarySurface as_boundary(const TriangleMesh& mesh) {
    BoundarySurface boundary{mesh, std::vector<Index>(mesh.vertices.rows())};
    std::iota(boundary.vertex_map.begin(), boundary.vertex_map.end(), 0);
    return boundary;
}

// The same unit vector everywhere, as a stand-in for a cross field.
Points everywhere(const BoundarySurface& boundary, const Vector3& direction) {
    return direction.normalized().transpose().replicate(boundary.mesh.vertices.rows(), 1);
}

Quaternion frame_at(const BoundaryConstraints& c, Index v) { return frames::from_wxyz(c.frames.row(v)); }

struct CubeBoundary {
    TetMesh tets = testing::kuhn_cube(4);
    BoundarySurface boundary = boundary_surface(tets);
    FeatureGraph features = surface::detect_features(boundary.mesh);
    TetDomain domain = TetDomain(tets).with_features(features);

    int planes(Index b) const {  // of how many sides of the cube the boundary vertex is part
        int count = 0;
        for (int k = 0; k < 3; ++k) count += boundary.mesh.vertices(b, k) == 0 || boundary.mesh.vertices(b, k) == 1;
        return count;
    }
};

TEST(SectorNormals, OfACubeAreItsSidesNormals) {
    const CubeBoundary cube;
    const SectorNormals normals = sector_normals(cube.domain);
    std::vector<int> count(cube.boundary.mesh.vertices.rows(), 0);
    for (std::size_t i = 0; i < normals.vertex.size(); ++i) {
        ++count[normals.vertex[i]];
        const Vector3 n = normals.normal.row(i).transpose();
        EXPECT_NEAR(n.cwiseAbs().maxCoeff(), 1, 1e-14);
        const Vector3 outside = cube.boundary.mesh.vertices.row(normals.vertex[i]).transpose() + 0.1 * n;
        EXPECT_TRUE(outside.maxCoeff() > 1 || outside.minCoeff() < 0);
    }
    for (Index b = 0; b < static_cast<Index>(count.size()); ++b) EXPECT_EQ(count[b], cube.planes(b));
    EXPECT_TRUE(std::is_sorted(normals.vertex.begin(), normals.vertex.end()));
}

TEST(SectorNormals, WithoutFeaturesThereIsOnePerVertex) {
    const BoundarySurface ball = as_boundary(surface::testing::icosphere(2));
    const SectorNormals normals = sector_normals_of(ball.mesh, {});
    ASSERT_EQ(normals.vertex.size(), static_cast<std::size_t>(ball.mesh.vertices.rows()));
    for (std::size_t i = 0; i < normals.vertex.size(); ++i)
        EXPECT_LT((normals.normal.row(i) - ball.mesh.vertices.row(normals.vertex[i])).norm(), 2 * degree);
}

TEST(BoundaryConstraints, OfACubeFixTheEdgesAndLeaveTheSidesTheirTwist) {
    const CubeBoundary cube;
    const Points directions = everywhere(cube.boundary, {0.3, 0.5, 0.8});
    const auto c = boundary_constraints(cube.domain, directions);
    EXPECT_TRUE(c.released_corners.empty());
    EXPECT_EQ(std::accumulate(c.on_boundary.begin(), c.on_boundary.end(), 0), cube.boundary.mesh.vertices.rows());
    for (Index b = 0; b < cube.boundary.mesh.vertices.rows(); ++b) {
        const Index v = cube.boundary.vertex_map[b];
        if (cube.planes(b) >= 2) {
            EXPECT_EQ(c.kind[v], VertexConstraint::fixed);
            EXPECT_LT(frames::distance(frame_at(c, v), Quaternion::Identity()), 1e-7);
            EXPECT_EQ(c.axis.row(v).norm(), 0);
        } else {
            EXPECT_EQ(c.kind[v], VertexConstraint::axis);
            EXPECT_NEAR(c.axis.row(v).cwiseAbs().maxCoeff(), 1, 1e-14);
            EXPECT_TRUE((frame_at(c, v) * Vector3::UnitZ()).isApprox(c.axis.row(v).transpose(), 1e-12));
        }
    }
    for (Eigen::Index v = 0; v < cube.tets.vertices.rows(); ++v)
        if (!c.on_boundary[v]) {
            EXPECT_EQ(c.kind[v], VertexConstraint::free);
            EXPECT_TRUE(frame_at(c, static_cast<Index>(v)).isApprox(Quaternion::Identity()));
        }
    EXPECT_LT(alignment_angles(cube.domain, c.frames).maxCoeff(), 1e-7);
}

TEST(BoundaryConstraints, FixedModeHoldsTheCrossFieldToo) {
    const BoundarySurface ball = as_boundary(surface::testing::icosphere(2));
    const Points directions = everywhere(ball, {0.3, 0.5, 0.8});
    const auto c = constraints_on_surface(static_cast<Index>(ball.mesh.vertices.rows()), ball, {}, directions,
                                          {.mode = BoundaryMode::fixed});
    const SectorNormals normals = sector_normals_of(ball.mesh, {});
    for (Index v = 0; v < ball.mesh.vertices.rows(); ++v) {
        EXPECT_EQ(c.kind[v], VertexConstraint::fixed);
        const Vector3 n = normals.normal.row(v).transpose(), d = directions.row(v).transpose();
        EXPECT_TRUE((frame_at(c, v) * Vector3::UnitX()).isApprox((d - d.dot(n) * n).normalized(), 1e-10));
        EXPECT_TRUE((frame_at(c, v) * Vector3::UnitZ()).isApprox(n, 1e-12));
    }
}

TEST(BoundaryConstraints, ModeNoneConstrainsNothingButKeepsTheStart) {
    const CubeBoundary cube;
    const Points directions = everywhere(cube.boundary, {0.3, 0.5, 0.8});
    const auto none = boundary_constraints(cube.domain, directions, {.mode = BoundaryMode::none});
    const auto aligned = boundary_constraints(cube.domain, directions);
    EXPECT_EQ(none.frames, aligned.frames);
    EXPECT_EQ(none.on_boundary, aligned.on_boundary);
    EXPECT_TRUE(none.axis.isZero(0));
    EXPECT_TRUE(std::all_of(none.kind.begin(), none.kind.end(), [](auto k) { return k == VertexConstraint::free; }));
}

// An upright prism over a regular polygon: `levels` rings of `sides` vertices, then the two centres. Features: its
// vertical edges and the rims.
struct Prism {
    Prism(int sides, int levels) {
        std::vector<Vector3> points;
        std::vector<Eigen::Vector3i> triangles;
        std::vector<std::pair<int, int>> edges;
        const auto id = [&](int level, int i) { return level * sides + i % sides; };
        for (int level = 0; level < levels; ++level)
            for (int i = 0; i < sides; ++i) {
                const double angle = 2 * std::numbers::pi * i / sides;
                points.emplace_back(std::cos(angle), std::sin(angle), level);
                if (level == 0 || level == levels - 1) edges.push_back(std::minmax(id(level, i), id(level, i + 1)));
                if (level + 1 == levels) continue;
                edges.emplace_back(id(level, i), id(level + 1, i));
                triangles.emplace_back(id(level, i), id(level, i + 1), id(level + 1, i + 1));
                triangles.emplace_back(id(level, i), id(level + 1, i + 1), id(level + 1, i));
            }
        const int bottom = static_cast<int>(points.size()), top = bottom + 1;
        points.emplace_back(0, 0, 0);
        points.emplace_back(0, 0, levels - 1);
        for (int i = 0; i < sides; ++i) {
            triangles.emplace_back(bottom, id(0, i + 1), id(0, i));
            triangles.emplace_back(top, id(levels - 1, i), id(levels - 1, i + 1));
        }
        boundary = as_boundary(surface::testing::make_mesh(points, triangles));
        features.edges.resize(edges.size(), 2);
        for (std::size_t e = 0; e < edges.size(); ++e) features.edges.row(e) << edges[e].first, edges[e].second;
        for (int i = 0; i < sides; ++i) features.corners.push_back(id(0, i));
        for (int i = 0; i < sides; ++i) features.corners.push_back(id(levels - 1, i));
    }
    BoundaryConstraints constraints(const BoundaryOptions& options = {}) const {
        return constraints_on_surface(static_cast<Index>(boundary.mesh.vertices.rows()), boundary, features,
                                      everywhere(boundary, {1, 0, 0}), options);
    }
    BoundarySurface boundary;
    FeatureGraph features;
};

TEST(BoundaryConstraints, WhereNoFrameFitsACurveKeepsItsTangentAndCornersAreReleased) {
    const Prism octagon(8, 3);  // normals 45 degrees apart: every frame misses one by at least 22.5
    const auto c = octagon.constraints();
    for (Index v = 8; v < 16; ++v) {
        EXPECT_EQ(c.kind[v], VertexConstraint::axis);
        EXPECT_NEAR(std::abs(c.axis(v, 2)), 1, 1e-12);
        EXPECT_NEAR(std::abs((frame_at(c, v) * Vector3::UnitZ()).z()), 1, 1e-12);
    }
    std::vector<Index> corners = octagon.features.corners;
    EXPECT_EQ(c.released_corners, corners);
    for (const Index v : corners) EXPECT_EQ(c.kind[v], VertexConstraint::free);
}

TEST(BoundaryConstraints, ToleranceDecidesWhatFits) {
    // Normals 360/7 degrees apart, 90 - 360/7 up to a quarter turn: the best frame misses both by half of that, 19.29
    // degrees.
    const Prism heptagon(7, 3);
    const auto loose = heptagon.constraints({.feature_tolerance = 19.3 * degree});
    EXPECT_TRUE(loose.released_corners.empty());
    for (Index v = 0; v < 21; ++v) EXPECT_EQ(loose.kind[v], VertexConstraint::fixed);
    const auto tight = heptagon.constraints({.feature_tolerance = 19.2 * degree});
    EXPECT_EQ(tight.released_corners.size(), 14u);
    for (Index v = 7; v < 14; ++v) EXPECT_EQ(tight.kind[v], VertexConstraint::axis);
}

TEST(BoundaryConstraints, FixedModeHoldsCurvesEvenWhereTheFitIsPoor) {
    const auto c = Prism(8, 3).constraints({.mode = BoundaryMode::fixed});
    for (Index v = 8; v < 16; ++v) EXPECT_EQ(c.kind[v], VertexConstraint::fixed);
    EXPECT_EQ(c.released_corners.size(), 16u);
}

TEST(BoundaryConstraints, AFrameOnACurveSharesTheMisfitOfItsTwoNormals) {
    const Prism pentagon(5, 3);  // normals 72 degrees apart: 9 degrees each
    const auto c = pentagon.constraints();
    const SectorNormals normals = sector_normals_of(pentagon.boundary.mesh, pentagon.features);
    const Eigen::VectorXd angles = angles_to_nearest_axis(pentagon.boundary, normals.vertex, normals.normal, c.frames);
    int checked = 0;
    for (std::size_t i = 0; i < normals.vertex.size(); ++i)
        if (normals.vertex[i] >= 5 && normals.vertex[i] < 10) {
            EXPECT_EQ(c.kind[normals.vertex[i]], VertexConstraint::fixed);
            EXPECT_NEAR(angles[i], 9 * degree, 1e-9);
            ++checked;
        }
    EXPECT_EQ(checked, 10);
}

// Where normals are not orthogonal, the frame on a curve is the one that follows them best, each weighted by the fourth
// power of its part across the tangent: no other twist has a larger sum of |d'|^4 cos 4 (angle to an axis).
TEST(BoundaryConstraints, AFrameOnACurveIsTheBestWeightedFitAboutItsTangent) {
    for (const double angle : {65.0, 75.0, 90.0, 110.0, 120.0}) {
        const double a = angle * degree;  // between the two sides of a roof that also slopes along its ridge
        std::vector<Vector3> points;
        std::vector<Eigen::Vector3i> triangles;
        for (int i = 0; i < 3; ++i) {
            points.emplace_back(i, 0, 0);
            points.emplace_back(i + 0.3, -std::cos(a / 2), -std::sin(a / 2));
            points.emplace_back(i - 0.2, std::cos(a / 2), -std::sin(a / 2));
        }
        for (int i = 0; i < 6; i += 3) {
            triangles.insert(triangles.end(), {{i, i + 1, i + 4}, {i, i + 4, i + 3}});
            triangles.insert(triangles.end(), {{i, i + 5, i + 2}, {i, i + 3, i + 5}});
        }
        const BoundarySurface roof = as_boundary(surface::testing::make_mesh(points, triangles));
        FeatureGraph features;
        features.edges.resize(2, 2);
        features.edges << 0, 3, 3, 6;
        const auto c =
            constraints_on_surface(9, roof, features, everywhere(roof, {1, 0, 0}), {.feature_tolerance = 0.7});
        ASSERT_EQ(c.kind[3], VertexConstraint::fixed);
        const auto merit = [&](const Quaternion& q) {
            const SectorNormals normals = sector_normals_of(roof.mesh, features);
            double sum = 0;
            for (std::size_t i = 0; i < normals.vertex.size(); ++i)
                if (normals.vertex[i] == 3)
                    sum += (q.conjugate() * Vector3(normals.normal.row(i).transpose())).array().pow(4).sum();
            return sum;
        };
        const Quaternion frame = frame_at(c, 3);
        EXPECT_NEAR((frame.toRotationMatrix().transpose() * Vector3::UnitX()).cwiseAbs().maxCoeff(), 1, 1e-14);
        for (int i = 0; i < 360; ++i)
            EXPECT_LE(merit(frames::exp(Vector3(i * degree, 0, 0)) * frame), merit(frame) + 1e-12);
    }
}

// A flat square grid in z = 0 of n x n cells, vertex (i, j) at j (n + 1) + i.
BoundarySurface flat_grid(int n) {
    std::vector<Vector3> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) {
            points.emplace_back(i, j, 0);
            const int v = j * (n + 1) + i;
            if (i < n && j < n) triangles.insert(triangles.end(), {{v, v + 1, v + n + 2}, {v, v + n + 2, v + n + 1}});
        }
    return as_boundary(surface::testing::make_mesh(points, triangles));
}

TEST(BoundaryConstraints, ACurveThatEndsInASmoothPatchGivesItsEndADirection) {
    const BoundarySurface grid = flat_grid(4);
    FeatureGraph features;
    features.edges.resize(1, 2);
    features.edges << 12, 18;  // (2, 2) to (3, 3)
    features.corners = {12, 18};
    const auto c = constraints_on_surface(25, grid, features, everywhere(grid, {1, 0, 0}), {});
    EXPECT_TRUE(c.released_corners.empty());
    for (const Index v : {12, 18}) {
        EXPECT_EQ(c.kind[v], VertexConstraint::axis);
        EXPECT_NEAR(std::abs((frame_at(c, v) * Vector3::UnitX()).dot(Vector3(1, 1, 0).normalized())), 1, 1e-12);
    }
    EXPECT_LT(frames::distance(frame_at(c, 6), Quaternion::Identity()), 1e-12);
}

TEST(BoundaryConstraints, AFlatCurveFixesTangentAndNormal) {
    const BoundarySurface grid = flat_grid(4);
    FeatureGraph features;
    features.edges.resize(2, 2);
    features.edges << 6, 12, 12, 18;  // along the diagonal
    features.corners = {6, 18};
    const auto c = constraints_on_surface(25, grid, features, everywhere(grid, {1, 0, 0}), {});
    EXPECT_EQ(c.kind[12], VertexConstraint::fixed);
    EXPECT_LT(frames::distance(frame_at(c, 12), frames::exp({0, 0, 45 * degree})), 1e-7);
}

TEST(BoundaryConstraints, DoNotDependOnTheSizeOfTheMesh) {
    const Prism prism(7, 4);
    const auto c = prism.constraints();
    for (const double scale : {1e-6, 1e6}) {
        Prism scaled = prism;
        scaled.boundary.mesh.vertices *= scale;
        const auto other = scaled.constraints();
        EXPECT_EQ(other.kind, c.kind);
        for (Eigen::Index v = 0; v < c.frames.rows(); ++v)  // as frames: any of the 48 quaternions will do
            EXPECT_LT(frames::distance(frames::from_wxyz(other.frames.row(v)), frames::from_wxyz(c.frames.row(v))),
                      1e-7);
    }
}

TEST(AlignmentAngles, AreExactForSmallAndLargeAngles) {
    const BoundarySurface grid = flat_grid(1);
    for (const double angle : {0.0, 1e-10, 1e-3, 0.7}) {
        const Quaternion q = frames::exp(Vector3(1, 0, 0) * angle);
        const Quaternions field = frames::to_wxyz(q).transpose().replicate(4, 1);
        const SectorNormals normals = sector_normals_of(grid.mesh, {});
        const Eigen::VectorXd angles = angles_to_nearest_axis(grid, normals.vertex, normals.normal, field);
        ASSERT_EQ(angles.size(), 4);
        for (const double a : angles) EXPECT_NEAR(a, angle, 1e-15 + 1e-12 * angle);
    }
}

TEST(BoundaryConstraints, BadInputIsRefusedWithItsKind) {
    const CubeBoundary cube;
    const Points directions = everywhere(cube.boundary, {1, 0, 0});
    const auto kind_of = [](const auto& call) -> std::string {
        try {
            call();
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return "no error";
    };
    EXPECT_EQ(kind_of([&] { boundary_constraints(cube.domain, directions.topRows(3)); }), "wrong_size");
    EXPECT_EQ(kind_of([&] { boundary_constraints(cube.domain, directions, {.feature_tolerance = 20}); }),
              "feature_tolerance");
    Points not_finite = directions;
    not_finite(4, 1) = std::nan("");
    EXPECT_EQ(kind_of([&] { boundary_constraints(cube.domain, not_finite); }), "not_finite");
    EXPECT_EQ(kind_of([&] { alignment_angles(cube.domain, Quaternions::Zero(4, 4)); }), "wrong_size");
}

}  // namespace
}  // namespace octafield::volume
