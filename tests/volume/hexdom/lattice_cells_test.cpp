#include "octafield/volume/lattice_cells.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <map>
#include <set>

#include "axis_numbers.hpp"
#include "lattice_points.hpp"
#include "lattice_surface.hpp"
#include "map_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using Vector3 = Eigen::Vector3d;

// A domain and its map along `frame(x)`, cells of one length.
struct Mapped {
    TetDomain domain;
    PeriodicMap map;
    template <class Field>
    Mapped(TetDomain of, const Field& frame, double length)
        : domain(std::move(of)),
          map(periodic_map(domain, testing::renamed(testing::sample_in_tets(domain.mesh(), frame), 3),
                           Points::Constant(domain.tet_count(), 3, length))) {}
};

frames::Quaternion identity(const frames::Vector3&) { return frames::Quaternion::Identity(); }
frames::Quaternion quarter_turns(const frames::Vector3& x) {
    return frames::exp(frames::Vector3(0, 0, std::atan2(x.y() - 0.47, x.x() - 0.52) / 4));
}

Mapped unit_box(double length, int n = 3) {
    return {testing::with_detected_features(testing::jittered_cube(n, 0.2, 1)), identity, length};
}

TEST(LatticePoints, EachPointOfABoxIsFoundOnceWhateverTetsItIsIn) {
    const Mapped box = unit_box(0.25);
    const MapCharts charts(box.domain, box.map);
    EXPECT_EQ(LatticePoints(charts, 0).count(), 125);
    EXPECT_EQ(LatticePoints(charts, periodic_unit / 2).count(), 64);
}

TEST(LatticePoints, ArePlacedByWeightsAtTheIntegersOfTheMap) {
    for (const bool singular : {false, true}) {
        const Mapped box =
            singular ? Mapped(testing::with_detected_features(testing::jittered_cube(4, 0.2, 1)), quarter_turns, 0.2)
                     : unit_box(0.2);
        const LatticeCells cells = lattice_cells(box.domain, box.map);
        ASSERT_GT(cells.points.rows(), 50);
        std::set<std::vector<long>> places;
        for (Eigen::Index p = 0; p < cells.points.rows(); ++p) {
            const Index t = cells.tet[p];
            ASSERT_TRUE(box.map.usable[t]);
            const Eigen::RowVector4d w = cells.weights.row(p);
            EXPECT_GE(w.minCoeff(), 0);
            EXPECT_NEAR(w.sum(), 1, 1e-14);
            const Points corners = box.domain.mesh().vertices(box.domain.mesh().tets.row(t), Eigen::all);
            EXPECT_LT((w * corners - cells.points.row(p)).norm(), 1e-14);
            Eigen::RowVector3d at = Eigen::RowVector3d::Zero();
            for (int k = 0; k < 4; ++k)
                at += w[k] * box.map.coordinates.row(t).segment<3>(3 * k).cast<double>() / periodic_unit;
            EXPECT_LT((at - at.array().round().matrix()).norm(), 1e-9);
            const auto rounded = [&](int i) { return std::lround(1e7 * cells.points(p, i)); };
            EXPECT_TRUE(places.insert({rounded(0), rounded(1), rounded(2)}).second) << "two points in one place";
        }
    }
}

// All integers in a tet, by brute force, are points that LatticePoints finds there.
TEST(LatticePoints, FindEveryIntegerOfEveryUsableTet) {
    const Mapped box(testing::with_detected_features(testing::jittered_cube(3, 0.2, 1)), quarter_turns, 0.13);
    const MapCharts charts(box.domain, box.map);
    const LatticePoints points(charts, 0);
    std::vector<std::uint8_t> met(points.count(), 0);
    int outside = 0;
    for (Index t = 0; t < box.domain.tet_count(); ++t) {
        Eigen::Matrix4d corners;
        for (int k = 0; k < 4; ++k)
            corners.col(k) << box.map.coordinates.row(t).segment<3>(3 * k).cast<double>().transpose() / periodic_unit,
                1;
        const Eigen::Vector4d low = corners.rowwise().minCoeff(), high = corners.rowwise().maxCoeff();
        for (int x = std::floor(low[0]); x <= high[0] + 1; ++x)
            for (int y = std::floor(low[1]); y <= high[1] + 1; ++y)
                for (int z = std::floor(low[2]); z <= high[2] + 1; ++z) {
                    const Index found = points.find({t,
                                                     {std::int64_t(x) * periodic_unit, std::int64_t(y) * periodic_unit,
                                                      std::int64_t(z) * periodic_unit}});
                    if (!box.map.usable[t]) {
                        EXPECT_EQ(found, -1);
                        continue;
                    }
                    const double least = corners.fullPivLu().solve(Eigen::Vector4d(x, y, z, 1)).minCoeff();
                    if (least > 1e-7) {
                        ASSERT_GE(found, 0);
                    }
                    if (least < -1e-7) {
                        ASSERT_EQ(found, -1);
                    }
                    outside += least < -1e-7;
                    if (found < 0) continue;
                    met[found] = 1;
                    EXPECT_LE(points.place(found).tet, t);
                }
    }
    EXPECT_GT(outside, 100);
    EXPECT_EQ(std::count(met.begin(), met.end(), 0), 0);
}

// In a box the place of a goal is known: the walk from tet to tet ends in a tet that has it, or outside.
TEST(Walk, EndsInATetThatHasTheGoalOrAtTheSurface) {
    const Mapped box = unit_box(0.25, 4);
    const MapCharts charts(box.domain, box.map);
    const TetMesh& mesh = box.domain.mesh();
    std::mt19937 random(2);
    int reached = 0, surface = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Index tet = static_cast<Index>(random() % mesh.tets.rows());
        const TetCoordinates corners = coordinates_of(box.map, tet);
        Coordinate from, to;
        for (int i = 0; i < 3; ++i) {
            from[i] = (corners[0][i] + corners[1][i] + corners[2][i] + corners[3][i]) / 4;
            to[i] = from[i] + static_cast<std::int64_t>(random() % (4 * periodic_unit)) - 2 * periodic_unit;
        }
        // Where the goal is in space, by the affine map of this tet.
        const auto in_space = [&](Index t, const Coordinate& at) {
            const TetCoordinates c = coordinates_of(box.map, t);
            Eigen::Matrix4d all;
            for (int k = 0; k < 4; ++k) all.col(k) << double(c[k][0]), double(c[k][1]), double(c[k][2]), 1;
            const Eigen::Vector4d w =
                all.fullPivLu().solve(Eigen::Vector4d(double(at[0]), double(at[1]), double(at[2]), 1));
            Vector3 x = Vector3::Zero();
            for (int k = 0; k < 4; ++k) x += w[k] * mesh.vertices.row(mesh.tets(t, k)).transpose();
            return std::pair(x, w.minCoeff());
        };
        const Vector3 goal = in_space(tet, to).first;
        const bool inside = goal.minCoeff() > 1e-3 && goal.maxCoeff() < 1 - 1e-3;
        const bool beyond = goal.minCoeff() < -1e-3 || goal.maxCoeff() > 1 + 1e-3;
        const Walk way = walk(charts, tet, from, to, from);
        if (way.end == WalkEnd::edge) continue;
        const auto [end, least] = in_space(way.place.tet, way.place.at);
        if (inside) {
            ASSERT_EQ(way.end, WalkEnd::reached);
        }
        if (beyond) {
            ASSERT_EQ(way.end, WalkEnd::surface);
        }
        EXPECT_LT((end - goal).norm(), 1e-3);  // exact but for the rounding of the map
        EXPECT_LT((in_space(way.place.tet, way.carried).first - in_space(tet, from).first).norm(), 1e-3);
        if (way.end == WalkEnd::reached) {
            EXPECT_GE(least, -1e-12);
        }
        reached += way.end == WalkEnd::reached;
        surface += way.end == WalkEnd::surface;
    }
    EXPECT_GT(reached, 500);
    EXPECT_GT(surface, 500);
}

TEST(MapCharts, ChangesAreInverseToOneAnotherAndFitTheVertices) {
    const Mapped box(testing::with_detected_features(testing::jittered_cube(4, 0.2, 1)), quarter_turns, 0.2);
    const MapCharts charts(box.domain, box.map);
    const TetMesh& mesh = box.domain.mesh();
    int crossed = 0;
    for (Index t = 0; t < box.domain.tet_count(); ++t)
        for (int k = 0; k < 4; ++k) {
            const Index other = charts.across(t, k);
            EXPECT_EQ(charts.on_surface(t, k),
                      box.domain.triangles().sides(box.domain.triangles().tet_triangles(t, k), 1) < 0);
            if (other < 0) continue;
            ++crossed;
            for (int c = 0; c < 4; ++c) {
                if (c == k) continue;
                for (int d = 0; d < 4; ++d)
                    if (mesh.tets(other, d) == mesh.tets(t, c)) {
                        EXPECT_EQ(charts.change(t, k)(coordinates_of(box.map, t)[c]),
                                  coordinates_of(box.map, other)[d]);
                    }
            }
        }
    EXPECT_GT(crossed, 500);
}

// Cells of the unit box: cubes whose corners come in the order of cell_arrays.hpp; faces on the surface are marked.
TEST(LatticeCells, AreTheCubesOfABox) {
    for (const int n : {1, 3, 5}) {
        const Mapped box = unit_box(1.0 / n);
        const LatticeCells cells = lattice_cells(box.domain, box.map);
        ASSERT_EQ(cells.hexahedra.rows(), n * n * n);
        EXPECT_EQ(cells.lost.outside + cells.lost.unusable + cells.lost.degenerate + cells.lost.poor, 0);
        std::set<std::vector<long>> middles;
        for (Eigen::Index k = 0; k < cells.hexahedra.rows(); ++k) {
            const Points p = cells.points(cells.hexahedra.row(k), Eigen::all) * n;
            for (const auto& edge : {std::array{0, 1},
                                     {1, 2},
                                     {2, 3},
                                     {3, 0},
                                     {4, 5},
                                     {5, 6},
                                     {6, 7},
                                     {7, 4},
                                     {0, 4},
                                     {1, 5},
                                     {2, 6},
                                     {3, 7}})
                EXPECT_NEAR((p.row(edge[0]) - p.row(edge[1])).norm(), 1, 1e-3);
            const Vector3 x = p.row(1) - p.row(0), y = p.row(3) - p.row(0), z = p.row(4) - p.row(0);
            EXPECT_NEAR(x.cross(y).dot(z), 1, 1e-2);
            const Eigen::RowVector3d middle = p.colwise().mean();
            middles.insert({std::lround(middle[0] - 0.5), std::lround(middle[1] - 0.5), std::lround(middle[2] - 0.5)});
            for (int f = 0; f < 6; ++f) {
                bool on_surface = false;
                for (int i = 0; i < 3; ++i)
                    for (const double side : {0.0, 1.0 * n}) {
                        bool all = true;
                        for (const int c : cell_face[f]) all &= std::abs(p(c, i) - side) < 1e-6;
                        on_surface |= all;
                    }
                EXPECT_EQ(bool(cells.on_surface[k] >> f & 1), on_surface);
            }
        }
        EXPECT_EQ(middles.size(), static_cast<std::size_t>(n * n * n));
    }
}

// Between two regions there is a wall: cells on both sides have it as a surface, and none goes across.
TEST(LatticeCells, InterfacesAreSurfacesOfTheCellsOnBothSides) {
    const TetMesh mesh = testing::kuhn_cube(4);
    std::vector<Index> regions;
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t) regions.push_back(testing::centroid(mesh, t).x() > 0.5);
    // Points at vertices, and points in triangles and on edges.
    for (const int n : {4, 6}) {
        const Mapped box(TetDomain(mesh, regions), identity, 1.0 / n);
        const LatticeCells cells = lattice_cells(box.domain, box.map);
        ASSERT_EQ(cells.hexahedra.rows(), n * n * n);
        EXPECT_EQ(cells.points.rows(), (n + 1) * (n + 1) * (n + 1));
        int marked = 0;
        for (Eigen::Index k = 0; k < cells.hexahedra.rows(); ++k) {
            const Points p = cells.points(cells.hexahedra.row(k), Eigen::all);
            for (int f = 0; f < 6; ++f) {
                bool on_wall = true;
                for (const int c : cell_face[f]) on_wall &= std::abs(p(c, 0) - 0.5) < 1e-6;
                if (on_wall) {
                    EXPECT_TRUE(cells.on_surface[k] >> f & 1);
                }
                marked += on_wall;
            }
        }
        EXPECT_EQ(marked, 2 * n * n);
        const LatticeSurface surface = lattice_surface(box.domain, cells, 1.0 / n);
        EXPECT_EQ(surface.quads.rows(), 7 * n * n);  // those of the wall once
    }
}

TEST(LatticeCells, OfASingularFieldHaveTheQualityAskedForAndOneFaceInCommonAtMostTwice) {
    const Mapped box(testing::with_detected_features(testing::jittered_cube(5, 0.2, 1)), quarter_turns, 0.15);
    for (const double least : {0.1, 0.6}) {
        const LatticeCells cells = lattice_cells(box.domain, box.map, least);
        ASSERT_GT(cells.hexahedra.rows(), 20);
        std::map<std::vector<Index>, int> faces;
        for (const auto& cell : cells.hexahedra.rowwise()) {
            for (const auto& face : cell_face) {
                std::vector<Index> ids;
                for (const int c : face) ids.push_back(cell[c]);
                std::sort(ids.begin(), ids.end());
                EXPECT_LE(++faces[ids], 2);
            }
            // The corners' Jacobians, from their three edges.
            static constexpr int joined[8][3]{{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7},
                                              {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}};
            for (int c = 0; c < 8; ++c) {
                Eigen::Matrix3d edges;
                for (int i = 0; i < 3; ++i)
                    edges.col(i) = (cells.points.row(cell[joined[c][i]]) - cells.points.row(cell[c])).normalized();
                EXPECT_GE(edges.determinant(), least - 1e-12);
            }
        }
    }
    const LatticeCells all = lattice_cells(box.domain, box.map, 0.1), best = lattice_cells(box.domain, box.map, 0.9999);
    EXPECT_GT(best.lost.poor, all.lost.poor);
    EXPECT_EQ(best.lost.poor + best.hexahedra.rows(), all.lost.poor + all.hexahedra.rows());
}

TEST(LatticeCells, SameWithAnyNumberOfThreads) {
    const Mapped box(testing::with_detected_features(testing::jittered_cube(4, 0.2, 1)), quarter_turns, 0.12);
    const LatticeCells one = lattice_cells(box.domain, box.map, 0.3, 1),
                       two = lattice_cells(box.domain, box.map, 0.3, 2);
    EXPECT_EQ(one.hexahedra, two.hexahedra);
    EXPECT_EQ(one.points, two.points);
    EXPECT_EQ(one.on_surface, two.on_surface);
}

// 6 tets of 1000 cells a side: refused before a point of them is listed.
TEST(LatticeCells, MoreCellsThanThereIsRoomForAreRefused) {
    const Mapped box(testing::with_detected_features(testing::kuhn_cube(1)), identity, 1e-3);
    try {
        lattice_cells(box.domain, box.map);
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_EQ(error.kind(), "edge_length");
    }
}

// Of many cells in few tets each point is found without looking at all others of its tet.
TEST(LatticeCells, ManyInFewTets) {
    const Mapped box(testing::with_detected_features(testing::kuhn_cube(1)), identity, 1.0 / 32);
    EXPECT_EQ(lattice_cells(box.domain, box.map).hexahedra.rows(), 32 * 32 * 32);
}

TEST(LatticeSurface, PointsLieInTheirTrianglesAndQuadsAreFacesOnTheSurface) {
    const Mapped box = unit_box(0.25);
    const LatticeCells cells = lattice_cells(box.domain, box.map);
    const LatticeSurface surface = lattice_surface(box.domain, cells, 0.25);
    EXPECT_EQ(surface.lattice_point.size(), 125u - 27u);
    EXPECT_EQ(surface.quads.rows(), 6 * 16);
    const surface::TriangleMesh& mesh = box.domain.surface().mesh;
    for (std::size_t i = 0; i < surface.lattice_point.size(); ++i) {
        const Eigen::RowVector3d w = surface.points.weights.row(static_cast<Eigen::Index>(i));
        EXPECT_NEAR(w.sum(), 1, 1e-12);
        const Points corners = mesh.vertices(mesh.triangles.row(surface.points.triangle[i]), Eigen::all);
        EXPECT_LT((w * corners - cells.points.row(surface.lattice_point[i])).norm(), 1e-12);
    }
    std::set<std::vector<Index>> quads;
    for (const auto& quad : surface.quads.rowwise()) {
        std::vector<Index> ids(quad.begin(), quad.end());
        std::sort(ids.begin(), ids.end());
        EXPECT_TRUE(quads.insert(ids).second);
        const auto at = [&](int c) { return Vector3(cells.points.row(surface.lattice_point[quad[c]])); };
        // Outward of the box, as round as a square.
        const Vector3 normal = (at(2) - at(0)).cross(at(3) - at(1));
        EXPECT_GT(normal.dot(at(0) + at(2) - Vector3::Ones()), 0);
        EXPECT_NEAR(normal.norm(), 2.0 / 16, 1e-3);
    }
}

}  // namespace
}  // namespace octafield::volume
