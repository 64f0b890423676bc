// Points of a front, and meshes on them.
#include "frontal_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

#include "../../surface/mesh_fixtures.hpp"
#include "hex_dominant_checks.hpp"
#include "map_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/computed_field.hpp"
#include "octafield/volume/integrability.hpp"
#include "octafield/volume/locate_points.hpp"
#include "octafield/volume/sample_frames.hpp"
#include "octafield/volume/tetrahedralize.hpp"
#include "point_front.hpp"
#include "tet_walk.hpp"

namespace octafield::volume {
namespace {

using testing::ball;
using testing::constant;
using Vector3 = Eigen::Vector3d;

LatticeCells points_of(const TetDomain& domain, const Quaternions& frames, double length, int threads = 0) {
    TetAxes axes{tet_frames(domain, frames), Points::Constant(domain.tet_count(), 3, length)};
    return frontal_points(domain, frames, axes, threads, {});
}

Index zeros(const LatticeCells& cells, Index point) {
    return static_cast<Index>((cells.weights.row(point).array() == 0).count());
}

// What a point is made of.
void expect_places(const TetDomain& domain, const LatticeCells& cells) {
    ASSERT_EQ(cells.points.rows(), cells.weights.rows());
    ASSERT_EQ(cells.tet.size(), static_cast<std::size_t>(cells.points.rows()));
    EXPECT_EQ(cells.hexahedra.rows(), 0);
    for (Index p = 0; p < cells.points.rows(); ++p) {
        EXPECT_NEAR(cells.weights.row(p).sum(), 1, 1e-12);
        EXPECT_GE(cells.weights.row(p).minCoeff(), 0);
        Vector3 at = Vector3::Zero();
        for (int k = 0; k < 4; ++k)
            at += cells.weights(p, k) * domain.mesh().vertices.row(domain.mesh().tets(cells.tet[p], k)).transpose();
        EXPECT_LT((at - cells.points.row(p).transpose()).norm(), 1e-12);
    }
}

// The least distance in the maximum norm of the axes at the one or the other.
double least_distance(const TetDomain& domain, const Quaternions& frames, const Points& points) {
    SampleOptions sampling;
    sampling.tolerance = 1;
    const Quaternions at = sample_frames(domain, frames, points, sampling).frames;
    double least = 1e9;
    for (Index p = 0; p < points.rows(); ++p)
        for (Index q = 0; q < points.rows(); ++q) {
            if (p == q) continue;
            const Vector3 way = (points.row(p) - points.row(q)).transpose();
            least = std::min(least, std::max((frames::from_wxyz(at.row(p)).conjugate() * way).cwiseAbs().maxCoeff(),
                                             (frames::from_wxyz(at.row(q)).conjugate() * way).cwiseAbs().maxCoeff()));
        }
    return least;
}

TEST(FrontalPoints, OfAFieldAlongABoxAreItsGrid) {
    const frames::Quaternion turn = frames::exp(frames::Vector3(0.5, -0.3, 0.2));
    const TetDomain domain = testing::with_detected_features(
        testing::moved_mesh(testing::jittered_box({1, 1.5, 0.75}, 4), [&](const Vector3& x) { return turn * x; }));
    const LatticeCells cells = points_of(domain, testing::renamed(constant(domain, turn), 2), 0.25);
    expect_places(domain, cells);
    ASSERT_EQ(cells.points.rows(), 5 * 7 * 4);
    std::set<std::array<int, 3>> seen;
    for (Index p = 0; p < cells.points.rows(); ++p) {
        const Vector3 at = turn.conjugate() * Vector3(cells.points.row(p).transpose()) / 0.25;
        std::array<int, 3> nearest;
        int on_faces = 0;
        for (int i = 0; i < 3; ++i) {
            nearest[i] = static_cast<int>(std::lround(at[i]));
            EXPECT_NEAR(at[i], nearest[i], 1e-6);
            on_faces += nearest[i] == 0 || nearest[i] == std::array{4, 6, 3}[i];
        }
        EXPECT_GE(zeros(cells, p), on_faces);
        EXPECT_EQ(zeros(cells, p) > 0, on_faces > 0);
        seen.insert(nearest);
    }
    EXPECT_EQ(seen.size(), 5u * 7 * 4);
}

TEST(FrontalPoints, FollowTheTurningOfTheAxes) {
    const TetDomain domain = testing::with_detected_features(testing::tube_quarter(8));
    const LatticeCells cells = points_of(domain, testing::sample(domain.mesh(), testing::along_cylinder), 0.2);
    expect_places(domain, cells);
    int inside = 0, on_circle = 0;
    for (Index p = 0; p < cells.points.rows(); ++p) {
        if (zeros(cells, p)) continue;
        ++inside;
        const double radius = cells.points.row(p).head<2>().norm(), rows = (radius - 1) / 0.2;
        on_circle += std::abs(rows - std::round(rows)) < 0.1;
    }
    EXPECT_GT(inside, 80);
    EXPECT_GT(on_circle, 0.9 * inside);
}

TEST(PointFront, AStepHasTheDirectionOfItsMiddle) {
    const TetDomain domain = testing::with_detected_features(testing::tube_quarter(8));
    const Quaternions frames = testing::sample(domain.mesh(), testing::along_cylinder);
    const TetAxes axes{tet_frames(domain, frames), Points::Constant(domain.tet_count(), 3, 0.4)};
    const FrontField field(domain, frames, axes, 1);
    const Vector3 seed(1.5 / std::numbers::sqrt2, 1.5 / std::numbers::sqrt2, 0.5);
    const LocatedPoints found = locate_points(domain, seed.transpose());
    struct Done {};
    int generations = 0;
    PointFront front(field, 1, [&] {
        if (++generations == 2) throw Done();
    });
    front.add({{found.tet[0], found.weights.row(0).transpose(), -1}});
    EXPECT_THROW(front.advance(TetWalker(domain), {0}), Done);
    ASSERT_EQ(front.count(), 3);  // walls are within 0.5 along the other two axes
    // A chord of the circle; the direction of the start would lead to sqrt(1.5^2 + 0.4^2) = 1.552.
    for (const Index p : {1, 2}) {
        const Vector3 at = field.position(front.places()[p]);
        EXPECT_NEAR(at.head<2>().norm(), 1.5, 0.005);
        EXPECT_NEAR((at - seed).norm(), 0.4, 1e-6);
    }
}

TEST(FrontalPoints, AreApartAndLeaveNoHoles) {
    const TetDomain round = ball();
    const TetDomain cube = testing::with_detected_features(testing::jittered_cube(4, 0.2, 6));
    const std::vector<std::pair<TetDomain, Quaternions>> fields{
        {round, computed_field(round).combed.frames},
        {round, testing::sample(round.mesh(), testing::along_cylinder)},
        {cube, testing::random_frames(cube.vertex_count(), 1)}};
    for (const auto& [domain, frames] : fields) {
        const double length = 0.25;
        const LatticeCells cells = points_of(domain, frames, length);
        expect_places(domain, cells);
        EXPECT_GT(least_distance(domain, frames, cells.points), 0.499 * length);
        const Points samples = spread_points(domain, 2000);
        for (const auto& sample : samples.rowwise())
            EXPECT_LT((cells.points.rowwise() - sample).rowwise().norm().minCoeff(), 1.5 * length);
    }
}

TEST(FrontalPoints, TheNumberOfThreadsChangesNoBit) {
    const TetDomain domain = ball();
    const Quaternions frames = testing::sample(domain.mesh(), testing::along_cylinder);
    const LatticeCells one = points_of(domain, frames, 0.12, 1), three = points_of(domain, frames, 0.12, 3);
    EXPECT_GT(one.points.rows(), 1000);
    EXPECT_EQ(one.points, three.points);
    EXPECT_EQ(one.tet, three.tet);
    EXPECT_EQ(one.weights, three.weights);
}

TEST(FrontalPoints, LieOnInterfacesOfRegions) {
    const TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(testing::centroid(mesh, t).x() > 0.25);
    const TetDomain domain = testing::with_detected_features(mesh, regions);
    const LatticeCells cells = points_of(domain, constant(domain), 0.1);
    int on_interface = 0;
    for (Index p = 0; p < cells.points.rows(); ++p) {
        const double x = cells.points(p, 0);
        EXPECT_TRUE(std::abs(x - 0.25) < 1e-12 || std::abs(x - 0.25) > 0.06) << x;
        on_interface += std::abs(x - 0.25) < 1e-12;
    }
    EXPECT_EQ(on_interface, 121);
}

HexDominantOptions frontal(double length) {
    HexDominantOptions options;
    options.edge_length = length;
    options.points = CellPoints::frontal;
    return options;
}

TEST(FrontalPoints, OfABoxBecomeHexahedra) {
    const TetDomain domain = testing::with_detected_features(testing::jittered_box({1, 1, 1.5}, 4));
    const HexDominantMesh result = hex_dominant(domain, constant(domain), frontal(0.25));
    testing::expect_mesh_of(domain, result, 1e-12);
    testing::expect_features_kept(domain, result);
    EXPECT_EQ(result.counts.lattice_hexahedra, 0);
    EXPECT_EQ(result.counts.tets, domain.tet_count());
    EXPECT_GT(result.mesh.hexahedra.rows(), 80);
}

// Of both, or of the one that there is.
TEST(FrontalPoints, AreKeptWhereTheyLeadToMoreHexahedra) {
    const TetDomain round = ball();
    const Quaternions frames = computed_field(round).combed.frames;
    const auto share = [](const HexDominantMesh& made) {
        const Eigen::VectorXd volumes = cell_volumes(made.mesh);
        return volumes.segment(made.mesh.tets.rows(), made.mesh.hexahedra.rows()).sum() / volumes.sum();
    };
    int fronts = 0;
    for (const double length : {0.5, 0.7, 0.9}) {
        HexDominantOptions options = frontal(length);
        options.refinements = 0;
        const HexDominantMesh front = hex_dominant(round, frames, options);
        options.points = CellPoints::periodic;
        const HexDominantMesh map = hex_dominant(round, frames, options);
        options.points = CellPoints::best;
        const HexDominantMesh best = hex_dominant(round, frames, options);
        EXPECT_LT(share(map), 0.98);
        const bool of_front = share(front) > share(map);
        fronts += of_front;
        EXPECT_EQ(best.points, of_front ? CellPoints::frontal : CellPoints::periodic);
        EXPECT_EQ(best.mesh.vertices, (of_front ? front : map).mesh.vertices);
    }
    EXPECT_EQ(fronts, 2);  // neither makes any of the longest
}

TEST(FrontalPoints, MakeValidMeshesOfAnyField) {
    const TetDomain round = ball();
    const Quaternions frames = computed_field(round).combed.frames;
    HexDominantOptions options = frontal(0.25);
    const HexDominantMesh mesh = hex_dominant(round, frames, options);
    testing::expect_mesh_of(round, mesh, 0.05);
    EXPECT_GT(mesh.mesh.hexahedra.rows(), 50);
    options.threads = 3;
    EXPECT_EQ(mesh.mesh.vertices, hex_dominant(round, frames, options).mesh.vertices);
    const TetDomain cube = testing::with_detected_features(testing::jittered_cube(4, 0.2, 6));
    const HexDominantMesh random = hex_dominant(cube, testing::random_frames(cube.vertex_count(), 1), frontal(0.2));
    testing::expect_mesh_of(cube, random, 1e-9);
    testing::expect_features_kept(cube, random);
}

TEST(FrontalPoints, MakeValidMeshesInRegionsAndOfSizesThatVary) {
    const TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(testing::centroid(mesh, t).x() > 0.25);
    const TetDomain two = testing::with_detected_features(mesh, regions);
    testing::expect_mesh_of(two, hex_dominant(two, constant(two), frontal(0.17)), 1e-12);

    const TetDomain box = testing::with_detected_features(testing::jittered_box({2, 1, 1}, 6, 0.1));
    HexDominantOptions options = frontal(0);
    options.sizes.resize(box.vertex_count());
    for (Index v = 0; v < box.vertex_count(); ++v) options.sizes[v] = 0.08 + 0.08 * box.mesh().vertices(v, 0);
    const HexDominantMesh graded = hex_dominant(box, constant(box), options);
    testing::expect_mesh_of(box, graded, 1e-9);
    int fine = 0, coarse = 0;
    for (const auto& at : graded.mesh.vertices.rowwise()) (at.x() < 0.5 ? fine : at.x() > 1.5 ? coarse : fine) += 1;
    EXPECT_GT(fine, 4 * coarse);
}

TEST(FrontalPoints, CellsLargerThanThePartLeaveAValidMesh) {
    const TetDomain box = testing::with_detected_features(testing::kuhn_cube(3));
    for (const double length : {3.0, 1e3})
        testing::expect_mesh_of(box, hex_dominant(box, constant(box), frontal(length)), 1e-9);
    const TetDomain round = ball();
    testing::expect_sound(hex_dominant(round, constant(round), frontal(10)).mesh, 0);
}

TEST(FrontalPoints, EndWhereProgressSaysSo) {
    const TetDomain domain = testing::with_detected_features(testing::kuhn_cube(2));
    int reports = 0;
    EXPECT_THROW(
        hex_dominant(domain, constant(domain), frontal(0.2),
                     [&](std::string_view phase, double, double) { return phase != "front" || ++reports < 3; }),
        Cancelled);
    EXPECT_EQ(reports, 3);
}

}  // namespace
}  // namespace octafield::volume
