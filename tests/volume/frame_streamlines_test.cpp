#include <gtest/gtest.h>

#include <numbers>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/streamlines.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::jittered_cube;
using testing::kuhn_cube;
using testing::kuhn_grid;
using testing::sample;
using testing::smooth_field;
using End = FrameStreamlineEnd;

Points one_row(const Vector3& p) { return p.transpose(); }

// A ring of square section round the z axis, |x|, |y| between 1/3 and 1, with (e_r, e_phi, e_z) turned about e_r.
struct Ring {
    explicit Ring(int n, double pitch)
        : mesh(kuhn_grid(6 * n, 6 * n, 3 * n, 1.0 / (3 * n), Vector3(-1, -1, -0.5),
                         [n](int i, int j, int) { return i < 2 * n || i >= 4 * n || j < 2 * n || j >= 4 * n; })),
          frames(sample(mesh, [pitch](const Vector3& x) {
              return frames::exp({0, 0, std::atan2(x.y(), x.x())}) * frames::exp({pitch, 0, 0});
          })) {}
    TetMesh mesh;
    Quaternions frames;
};

TEST(FrameStreamlines, OfAConstantFieldAreStraightToTheBoundary) {
    const TetMesh mesh = jittered_cube(6, 0.3, 5);
    const Quaternion q = frames::exp({0.3, -0.2, 0.5});
    const Quaternions constant = sample(mesh, [&](const Vector3&) { return q; });
    const Points points = spread_points(mesh, 20);
    const auto lines = frame_streamlines(mesh, constant, axis_seeds_at(mesh, constant, points));
    ASSERT_EQ(lines.size(), static_cast<std::size_t>(3 * points.rows()));
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const Vector3 axis = q * Vector3::Unit(i % 3), seed = points.row(i / 3).transpose();
        EXPECT_EQ(lines[i].first_end, End::boundary);
        EXPECT_EQ(lines[i].last_end, End::boundary);
        double back = 1e9, ahead = 1e9;  // to the faces of the cube
        for (int c = 0; c < 3; ++c) {
            ahead = std::min(ahead, ((axis[c] > 0 ? 1 : 0) - seed[c]) / axis[c]);
            back = std::min(back, ((axis[c] > 0 ? 0 : 1) - seed[c]) / -axis[c]);
        }
        EXPECT_NEAR(lines[i].length, ahead + back, 1e-7);
        for (const auto& p : lines[i].points.rowwise()) EXPECT_LT((p.transpose() - seed).cross(axis).norm(), 1e-7);
        EXPECT_LT((lines[i].points.bottomRows(1).transpose() - (seed + ahead * axis)).norm(), 1e-7);
    }
}

// Along edges, face diagonals and through vertices of the grid.
TEST(FrameStreamlines, PassEdgesAndVerticesOfTheMesh) {
    const TetMesh mesh = kuhn_cube(4);
    const Quaternions constant = sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
    Points points(3, 3);
    points << 0.5, 0.5, 0.5, 0.5, 0.5, 0.125, 0.25, 0.375, 0.3;
    for (const FrameStreamline& line : frame_streamlines(mesh, constant, axis_seeds_at(mesh, constant, points))) {
        EXPECT_NEAR(line.length, 1, 1e-7);
        EXPECT_EQ(line.first_end, End::boundary);
        EXPECT_EQ(line.last_end, End::boundary);
    }
    const Quaternions diagonal = sample(mesh, [](const Vector3&) {
        return frames::frame_from_axes({1, -1, 0}, {1, 1, 1});
    });
    const auto seeds = seeds_at(mesh, one_row({0.5, 0.5, 0.5}), one_row({1, 1, 1}));
    EXPECT_NEAR(frame_streamlines(mesh, diagonal, seeds)[0].length, std::sqrt(3.0), 1e-7);
}

// Largest distance from the helix of the exact field over one turn, and the drift of the radius at its end.
TEST(FrameStreamlines, OfACylinderFieldAreHelicesToSecondOrder) {
    constexpr double radius = 0.7, pitch = 0.1;
    std::vector<double> errors;
    for (const int n : {2, 4, 8}) {
        const Ring ring(n, pitch);
        const Vector3 start(radius, 0.011, -0.3);
        const auto seeds = seeds_at(ring.mesh, one_row(start), one_row({0, std::cos(pitch), std::sin(pitch)}));
        const double length = 2 * std::numbers::pi * radius;
        const auto line =
            frame_streamlines(ring.mesh, ring.frames, seeds, {.max_length = length, .both_ways = false})[0];
        ASSERT_EQ(line.last_end, End::length);
        EXPECT_NEAR(line.length, length, 1e-9);
        const double r = start.head<2>().norm();
        double error = 0, run = 0;
        for (Eigen::Index i = 0; i < line.points.rows(); ++i) {
            if (i > 0) run += (line.points.row(i) - line.points.row(i - 1)).norm();
            const double phi = std::atan2(start.y(), start.x()) + run * std::cos(pitch) / r;
            const Vector3 exact(r * std::cos(phi), r * std::sin(phi), start.z() + run * std::sin(pitch));
            error = std::max(error, (line.points.row(i).transpose() - exact).norm());
        }
        errors.push_back(error);
    }
    RecordProperty("errors", ::testing::PrintToString(errors));
    EXPECT_LT(errors[0], 0.1);
    for (std::size_t k = 1; k < errors.size(); ++k) EXPECT_GT(std::log2(errors[k - 1] / errors[k]), 1.6) << errors[k];
}

TEST(FrameStreamlines, OfACylinderFieldAlongTheCirclesClose) {
    const Ring ring(8, 0);
    const auto seeds = seeds_at(ring.mesh, one_row({0.7, 0.01, 0.02}), one_row({0, 1, 0}));
    const auto line = frame_streamlines(ring.mesh, ring.frames, seeds)[0];
    EXPECT_EQ(line.first_end, End::closed);
    EXPECT_EQ(line.last_end, End::closed);
    EXPECT_EQ(line.points.row(0), line.points.bottomRows(1));
    EXPECT_NEAR(line.length, 2 * std::numbers::pi * 0.7, 0.01);
}

TEST(FrameStreamlines, EndBeforeASingularCurveThatTurnsThemAndFollowOneThatDoesNot) {
    const double h = 1.0 / 10;
    const TetMesh mesh = kuhn_grid(10, 10, 10, h, Vector3(-0.5 + 0.137 * h, -0.5 + 0.071 * h, -0.5));
    const Quaternions turned = sample(mesh, [](const Vector3& x) {
        return frames::exp({0, 0, std::atan2(x.y(), x.x()) / 4});
    });
    Points points(2, 3), directions(2, 3);
    points << 0.3, 0, 0.01, 0, 0, 0.01;
    directions << -1, 0, 0, 0, 0, 1;
    const auto lines = frame_streamlines(mesh, turned, seeds_at(mesh, points, directions));
    EXPECT_EQ(lines[0].last_end, End::singular);
    EXPECT_EQ(lines[0].first_end, End::boundary);
    EXPECT_LT(lines[0].points.bottomRows(1).leftCols<2>().norm(), std::sqrt(3.0) * h);
    EXPECT_EQ(lines[1].last_end, End::boundary);
    EXPECT_NEAR(lines[1].length, 1, 1e-7);
    directions.row(1) << 1, 0, 0;
    const auto inside = frame_streamlines(mesh, turned, seeds_at(mesh, points, directions))[1];
    EXPECT_EQ(inside.points.rows(), 1);
    EXPECT_EQ(inside.length, 0);
    EXPECT_EQ(inside.last_end, End::singular);
}

TEST(FrameStreamlines, AreTheSameForEquivalentFramesAndAnyThreadCount) {
    const TetMesh mesh = jittered_cube(8, 0.3, 3);
    const Quaternions field = smooth_field(mesh);
    Quaternions equivalent = field;
    for (Eigen::Index v = 0; v < field.rows(); ++v)
        equivalent.row(v) =
            frames::to_wxyz(frames::from_wxyz(field.row(v)) * frames::binary_octahedral_group()[(7 * v) % 48])
                .transpose();
    const auto seeds = axis_seeds_at(mesh, field, spread_points(mesh, 30));
    const auto lines = frame_streamlines(mesh, field, seeds, {}, 1);
    const auto threaded = frame_streamlines(mesh, field, seeds, {}, 5);
    const auto same = frame_streamlines(mesh, equivalent, seeds);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        ASSERT_EQ(lines[i].points, threaded[i].points);
        EXPECT_EQ(lines[i].tets, threaded[i].tets);
        ASSERT_EQ(lines[i].points.rows(), same[i].points.rows());
        EXPECT_LT((lines[i].points - same[i].points).norm(), 1e-9);
        EXPECT_EQ(lines[i].last_end, same[i].last_end);
        EXPECT_EQ(static_cast<Eigen::Index>(lines[i].tets.size()), lines[i].points.rows() - 1);
    }
}

TEST(FrameStreamlines, ScaleWithTheMesh) {
    const TetMesh mesh = jittered_cube(5, 0.2, 9);
    const Quaternions field = smooth_field(mesh);
    const auto seeds = axis_seeds_at(mesh, field, spread_points(mesh, 10));
    const auto lines = frame_streamlines(mesh, field, seeds);
    for (const double scale : {1e-6, 1e6}) {
        TetMesh scaled = mesh;
        scaled.vertices *= scale;
        const auto other = frame_streamlines(scaled, field, seeds);
        for (std::size_t i = 0; i < lines.size(); ++i) {
            ASSERT_EQ(lines[i].points.rows(), other[i].points.rows());
            EXPECT_LT((scale * lines[i].points - other[i].points).norm(), 1e-7 * scale);
        }
    }
}

TEST(FrameStreamlines, RefuseBadSeedsAndOptions) {
    const TetMesh mesh = kuhn_cube(2);
    const Quaternions constant = sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
    const auto kind_of = [&](const std::vector<FrameStreamlineSeed>& seeds,
                             const FrameStreamlineOptions& options = {}) {
        try {
            frame_streamlines(mesh, constant, seeds, options);
        } catch (const InvalidInput& error) {
            return error.kind();
        }
        return std::string("none");
    };
    EXPECT_EQ(kind_of({{0, {1, 0, 0}}}), "none");
    EXPECT_EQ(kind_of({{48, {1, 0, 0}}}), "outside");
    EXPECT_EQ(kind_of({{-1, {1, 0, 0}}}), "outside");
    EXPECT_EQ(kind_of({{0, {1, 0, 0}, {0.5, 0.5, 0.5, -0.5}}}), "outside");
    EXPECT_EQ(kind_of({{0, {0, 0, 0}}}), "no_direction");
    EXPECT_EQ(kind_of({{0, {1, 0, 0}}}, {.max_length = -1}), "option_out_of_range");
    EXPECT_EQ(kind_of({{0, {1, 0, 0}}}, {.closing_distance = std::nan("")}), "option_out_of_range");
    try {
        Points points(2, 3);
        points << 0.5, 0.5, 0.5, 0.5, 0.5, 1.1;
        axis_seeds_at(mesh, constant, points);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "outside");
        EXPECT_EQ(error.elements(), std::vector<Index>{1});
    }
    EXPECT_THROW(frame_streamlines(mesh, Quaternions(3, 4), {}), InvalidInput);
    EXPECT_THROW(spread_points(mesh, -1), InvalidInput);
    EXPECT_TRUE(frame_streamlines(mesh, constant, {}).empty());
}

TEST(LocatedPoints, AreInTheirTetsWithTheirWeights) {
    const TetMesh mesh = jittered_cube(5, 0.3, 2);
    std::mt19937_64 generator(4);
    Points points(500, 3);
    for (double& x : points.reshaped()) x = 1.2 * frames::uniform01(generator) - 0.1;
    const LocatedPoints found = locate_points(mesh, points);
    for (Eigen::Index i = 0; i < points.rows(); ++i) {
        const bool inside = points.row(i).minCoeff() > 0 && points.row(i).maxCoeff() < 1;
        ASSERT_EQ(found.tet[i] >= 0, inside) << points.row(i);
        if (!inside) continue;
        Vector3 sum = Vector3::Zero();
        for (int k = 0; k < 4; ++k)
            sum += found.weights(i, k) * mesh.vertices.row(mesh.tets(found.tet[i], k)).transpose();
        EXPECT_LT((sum - points.row(i).transpose()).norm(), 1e-12);
        EXPECT_GE(found.weights.row(i).minCoeff(), 0);
    }
    const LocatedPoints corners = locate_points(mesh, mesh.vertices);
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v) {
        ASSERT_GE(corners.tet[v], 0);
        EXPECT_TRUE((mesh.tets.row(corners.tet[v]).array() == v).any());
    }
}

TEST(SpreadPoints, AreSoManyAndApart) {
    const TetMesh mesh = kuhn_cube(10);
    for (const int count : {0, 1, 10, 100, 1000}) {
        const Points points = spread_points(mesh, count);
        EXPECT_LE(points.rows(), count);
        EXPECT_GE(points.rows(), 0.6 * count - 1);
        double nearest = 1e9;
        for (Eigen::Index i = 0; i < points.rows(); ++i)
            for (Eigen::Index j = 0; j < i; ++j) nearest = std::min(nearest, (points.row(i) - points.row(j)).norm());
        EXPECT_GT(nearest, 0.7 * std::cbrt(0.73 / std::max(count, 1)));
    }
    EXPECT_EQ(spread_points(mesh, 50), spread_points(mesh, 50));
}

}  // namespace
}  // namespace octafield::volume
