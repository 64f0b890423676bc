#include "octafield/surface/disk_parameterization.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../mesh_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

// n x n squares of the unit square, each cut from its lower left to its upper right corner.
TriangleMesh square(int n) {
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= n; ++j)
        for (int i = 0; i <= n; ++i) points.emplace_back(Eigen::Vector3d(i, j, 0) / n);
    for (int j = 0; j < n; ++j)
        for (int i = 0; i < n; ++i) {
            const int a = j * (n + 1) + i, b = a + 1, c = b + n + 1, d = c - 1;
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    return testing::make_mesh(points, triangles);
}

TriangleMesh without(const TriangleMesh& mesh, const std::vector<Index>& triangles) {
    TriangleMesh rest = mesh;
    Eigen::Index kept = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (std::find(triangles.begin(), triangles.end(), t) == triangles.end())
            rest.triangles.row(kept++) = mesh.triangles.row(t);
    rest.triangles.conservativeResize(kept, 3);
    return rest;
}

std::string kind_of(const TriangleMesh& mesh, const DiskOptions& options = {}) {
    try {
        parameterize_disk(mesh, options);
    } catch (const Error& error) {
        return error.kind();
    }
    return "";
}

TEST(MeanValueWeights, OfAStructuredMeshAreThoseOfTheThesis) {
    const int n = 8;
    const double h = 1.0 / n;
    const auto weights = mean_value_weights(square(n));
    const int middle = 4 * (n + 1) + 4;
    for (const int axis : {1, -1, n + 1, -n - 1})
        EXPECT_NEAR(weights.coeff(middle, middle + axis), std::sqrt(2.0) / h, 1e-12 / h);
    for (const int diagonal : {n + 2, -n - 2})
        EXPECT_NEAR(weights.coeff(middle, middle + diagonal), (2 - std::sqrt(2.0)) / h, 1e-12 / h);
    EXPECT_EQ(weights.row(middle).nonZeros(), 6);
}

TEST(MeanValueWeights, AreExactForLinearFunctionsInThePlane) {
    TriangleMesh mesh = testing::disk(6);
    for (Index v = 1; v < 60; ++v) mesh.vertices(v, 0) += 0.05 * std::sin(7.0 * v);  // inner rings
    const auto weights = mean_value_weights(mesh);
    for (Index v = 0; v < 60; ++v) {
        Eigen::RowVector3d sum = Eigen::RowVector3d::Zero();
        for (Eigen::SparseMatrix<double, Eigen::RowMajor>::InnerIterator at(weights, v); at; ++at) {
            EXPECT_GT(at.value(), 0);
            sum += at.value() * (mesh.vertices.row(at.col()) - mesh.vertices.row(v));
        }
        EXPECT_LT(sum.norm(), 1e-10);
    }
}

TEST(ParameterizeDisk, OfADiskIsTheDiskUpToAnAngle) {
    const TriangleMesh mesh = testing::disk(10);
    const DiskParameterization map = parameterize_disk(mesh);
    ASSERT_EQ(map.loops.size(), 1u);
    EXPECT_EQ(map.loops[0].size(), 60u);
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        EXPECT_LT((map.uv.row(v) - mesh.vertices.row(v).leftCols(2)).norm(), 1e-9) << v;
}

TEST(ParameterizeDisk, IsOneToOneOnASphereWithASmallHole) {
    const TriangleMesh mesh = without(testing::icosphere(3), {0});
    const DiskParameterization map = parameterize_disk(mesh);
    EXPECT_TRUE(not_positive(map.uv, mesh.triangles).empty());
    EXPECT_LE(map.uv.rowwise().norm().maxCoeff(), 1 + 1e-12);
}

TEST(ParameterizeDisk, ImagesOfFreeHolesAreConvexAndFilledOnesKeepTheirShapeBetter) {
    // An L of squares is left out of the square.
    std::vector<Index> left_out;
    for (int j = 3; j < 9; ++j)
        for (int i = 3; i < 9; ++i)
            if (i < 5 || j < 5) left_out.insert(left_out.end(), {2 * (12 * j + i), 2 * (12 * j + i) + 1});
    const TriangleMesh mesh = without(square(12), left_out);
    const auto least_turn = [&](bool fill) {
        const DiskParameterization map = parameterize_disk(mesh, {.fill_holes = fill});
        const auto& hole = map.loops.at(1);  // clockwise round the hole
        double least = 1;
        for (std::size_t i = 0; i < hole.size(); ++i) {
            const auto at = [&](std::size_t k) { return map.uv.row(hole[(i + k) % hole.size()]); };
            const Eigen::RowVector2d a = at(1) - at(0), b = at(2) - at(1);
            least = std::min(least, -(a[0] * b[1] - a[1] * b[0]) / (a.norm() * b.norm()));
        }
        return least;
    };
    EXPECT_GT(least_turn(false), -1e-9);
    EXPECT_LT(least_turn(true), -0.1);
}

TEST(ParameterizeDisk, NamesWhatIsNoDisk) {
    EXPECT_EQ(kind_of(testing::icosphere(1)), "closed");
    EXPECT_EQ(kind_of(without(testing::torus(12, 8, 1, 0.4), {0})), "not_planar");
    EXPECT_EQ(kind_of({}), "empty");
    TriangleMesh two =
        testing::make_mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {3, 0, 0}, {4, 0, 0}, {3, 1, 0}}, {{0, 1, 2}, {3, 4, 5}});
    EXPECT_EQ(kind_of(two), "not_connected");
    two.triangles(1, 0) = 0;
    EXPECT_EQ(kind_of(two), "non_manifold_vertex");
}

TEST(ParameterizeDisk, SaysWhereDoublesShowNoPositiveTriangles) {
    // A tube 40 times as long as it is round shrinks by exp(-2 pi 40 / pi).
    std::vector<Eigen::Vector3d> points;
    std::vector<Eigen::Vector3i> triangles;
    const int around = 12, along = 160;
    for (int j = 0; j <= along; ++j)
        for (int i = 0; i < around; ++i) {
            const double angle = 2 * std::numbers::pi * i / around;
            points.emplace_back(std::cos(angle) / 2, std::sin(angle) / 2, 0.25 * j);
        }
    for (int j = 0; j < along; ++j)
        for (int i = 0; i < around; ++i) {
            const int a = j * around + i, b = j * around + (i + 1) % around, c = b + around, d = a + around;
            triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
        }
    EXPECT_EQ(kind_of(testing::make_mesh(points, triangles)), "not_one_to_one");
}

TEST(NotPositive, IsExactWhereDoublesAreNot) {
    // Of three points on the line y = x only what the last bits say decides.
    PlanePoints uv(4, 2);
    uv << 0.5, 0.5, 12, 12, 24, 24, std::nextafter(24.0, 30), 24;
    Triangles triangles(3, 3);
    triangles << 0, 1, 2, 0, 3, 1, 0, 1, 3;
    EXPECT_EQ(not_positive(uv, triangles), (std::vector<Index>{0, 2}));
}

TEST(MapDistortion, OfALinearMapHasItsSingularValues) {
    const TriangleMesh mesh = square(3);
    PlanePoints uv(mesh.vertices.rows(), 2);
    for (Index v = 0; v < uv.rows(); ++v) uv.row(v) << mesh.vertices(v, 0) / 4, mesh.vertices(v, 1) / 2;
    const MapDistortion found = map_distortion(mesh, uv, mesh.triangles);
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        EXPECT_NEAR(found.singular_values(t, 0), 4, 1e-12);
        EXPECT_NEAR(found.singular_values(t, 1), 2, 1e-12);
        EXPECT_NEAR(found.conformity[t], 0.5, 1e-12);
        EXPECT_LT((plane_metric(mesh, uv, mesh.triangles, 0.5).row(t) - Eigen::RowVector3d(64, 0, 16)).norm(), 1e-10);
    }
    uv.setZero();
    EXPECT_EQ(map_distortion(mesh, uv, mesh.triangles).conformity.maxCoeff(), 0);
    EXPECT_THROW(map_distortion(mesh, uv.topRows(3), mesh.triangles), InvalidInput);
    EXPECT_THROW(map_distortion(mesh, uv, mesh.triangles.topRows(3)), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
