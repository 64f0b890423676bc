// Private parts of improve_cells: what it knows of the cells round a vertex, and of the surface.
#include "vertex_star.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <limits>
#include <random>

#include "improve_fixtures.hpp"
#include "octafield/error.hpp"
#include "surface_guide.hpp"

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;

// One cell of each kind, nearly regular, without common vertices.
MixedMesh shaken_cells(double amount, std::mt19937& random) {
    MixedMesh mesh;
    mesh.vertices.resize(23, 3);
    const double h = std::sqrt(3.0) / 2;
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0.5, h, 0, 0.5, h / 3, std::sqrt(2 / 3.0),  // tet
        0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1,    // hexahedron
        0, 0, 0, 1, 0, 0, 0.5, h, 0, 0, 0, 1, 1, 0, 1, 0.5, h, 1,                  // wedge
        0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 0.5, 0.5, std::sqrt(0.5);              // pyramid
    append(mesh.tets, {0, 1, 2, 3});
    append(mesh.hexahedra, {4, 5, 6, 7, 8, 9, 10, 11});
    append(mesh.wedges, {12, 13, 14, 15, 16, 17});
    append(mesh.pyramids, {18, 19, 20, 21, 22});
    std::uniform_real_distribution<double> move(-amount, amount);
    for (double& x : mesh.vertices.reshaped()) x += move(random);
    return mesh;
}

TEST(VertexStar, TheLeastOfACellsVerticesIsItsScaledJacobian) {
    std::mt19937 random(1);
    for (int trial = 0; trial < 200; ++trial) {
        const MixedMesh mesh = shaken_cells(0.2, random);
        const Eigen::VectorXd wanted = scaled_jacobians(mesh);
        const VertexCells cells(mesh);
        Eigen::VectorXd found = Eigen::VectorXd::Constant(4, 2);
        VertexStar star;
        for (Index v = 0; v < mesh.vertices.rows(); ++v) {
            star.set(mesh, cells, v);
            double& least = found[cells.of(v)[0].cell];
            least = std::min(least, star.lowest(Vector::Zero()));
        }
        for (Index c = 0; c < 4; ++c)
            if (wanted[c] > 0 && (c < 3 || found[c] < 1)) {  // of pyramids, values above 1 are folded back
                EXPECT_NEAR(found[c], wanted[c], 1e-14);
            } else {
                EXPECT_TRUE(c == 3 || found[c] <= 0);
            }
    }
}

// It is lower than all corners in mirrored cells only, as far as random ones tell.
TEST(VertexStar, TheMiddleOfAHexahedronCounts) {
    std::mt19937 random(6);
    int lower = 0;
    for (int trial = 0; trial < 200; ++trial) {
        MixedMesh mesh = shaken_cells(0.2, random);
        mesh.vertices.col(2) *= -1;
        const double wanted = scaled_jacobians(mesh)[1];
        double corners = 2;  // their least, which the definition gives without the middle
        for (int k = 0; k < 8; ++k) {
            const auto edge = [&](int to) -> Vector { return mesh.vertices.row(4 + to) - mesh.vertices.row(4 + k); };
            const Vector a = edge(k / 4 * 4 + (k + 1) % 4), b = edge(k / 4 * 4 + (k + 3) % 4), c = edge((k + 4) % 8);
            corners = std::min(corners, (k < 4 ? 1 : -1) * a.cross(b).dot(c) / (a.norm() * b.norm() * c.norm()));
        }
        if (wanted > corners - 1e-9) continue;
        ++lower;
        const VertexCells cells(mesh);
        VertexStar star;
        star.set(mesh, cells, 4);
        EXPECT_NEAR(star.lowest(Vector::Zero()), wanted, 1e-14);
    }
    EXPECT_GT(lower, 3);
}

TEST(VertexStar, ADisplacementIsWhatMovingTheVertexIs) {
    std::mt19937 random(2);
    std::uniform_real_distribution<double> move(-0.2, 0.2);
    for (int trial = 0; trial < 50; ++trial) {
        MixedMesh mesh = shaken_cells(0.1, random);
        const VertexCells cells(mesh);
        VertexStar star, moved;
        for (Index v = 0; v < mesh.vertices.rows(); ++v) {
            const Vector x(move(random), move(random), move(random));
            star.set(mesh, cells, v);
            MixedMesh other = mesh;
            other.vertices.row(v) += x.transpose();
            moved.set(other, cells, v);
            EXPECT_NEAR(star.lowest(x), moved.lowest(Vector::Zero()), 1e-13);
            const double energy = star.energy(x);
            EXPECT_TRUE(!std::isfinite(energy) || std::abs(energy / moved.energy(Vector::Zero()) - 1) < 1e-11);
            const double cube = std::pow(moved.size() / star.size(), 3);
            EXPECT_NEAR(star.lowest_determinant(x), moved.lowest_determinant(Vector::Zero()) * cube, 1e-13);
        }
    }
}

// Of the ideal cells every corner counts 1, and no move of one vertex lowers the sum.
TEST(VertexStar, IdealCellsHaveTheLeastEnergy) {
    std::mt19937 random(3);
    const MixedMesh mesh = shaken_cells(0, random);
    const VertexCells cells(mesh);
    VertexStar star;
    const auto corners = [](Index v) { return v < 4 ? 1 : v < 12 ? 4 : v < 18 ? 4 : v < 22 ? 3 : 4; };
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        star.set(mesh, cells, v);
        Vector gradient;
        Eigen::Matrix3d hessian;
        EXPECT_NEAR(star.energy(Vector::Zero(), gradient, hessian), corners(v), 1e-13) << v;
        EXPECT_LT(gradient.norm(), 1e-13) << v;
        EXPECT_GT(hessian.determinant(), 0.1);
        EXPECT_NEAR(star.size(), 1, v >= 18 && v < 22 ? 0.1 : 1e-12);  // of pyramids, the base's diagonals count, too
        EXPECT_NEAR(star.lowest(Vector::Zero()), 1, 1e-14);
    }
}

TEST(VertexStar, GradientsAreThoseOfDifferences) {
    std::mt19937 random(4);
    const double step = 1e-6;
    for (int trial = 0; trial < 20; ++trial) {
        const MixedMesh mesh = shaken_cells(0.12, random);
        const VertexCells cells(mesh);
        VertexStar star;
        for (Index v = 0; v < mesh.vertices.rows(); ++v) {
            star.set(mesh, cells, v);
            std::vector<double> values, ahead, behind;
            std::vector<Vector> gradients, unused;
            Vector gradient, gradient_ahead, gradient_behind;
            Eigen::Matrix3d hessian, ignored;
            const double energy = star.energy(Vector::Zero(), gradient, hessian);
            if (!std::isfinite(energy)) continue;
            EXPECT_NEAR(energy, star.energy(Vector::Zero()), 1e-12 * energy);
            for (int axis = 0; axis < 3; ++axis) {
                const Vector x = step * Vector::Unit(axis);
                star.energy(x, gradient_ahead, ignored);
                star.energy(-x, gradient_behind, ignored);
                EXPECT_NEAR(gradient[axis], (star.energy(x) - star.energy(-x)) / (2 * step), 1e-4 * energy);
                EXPECT_LT(((gradient_ahead - gradient_behind) / (2 * step) - hessian.col(axis)).norm(),
                          1e-4 * hessian.norm());
                for (const bool linear : {false, true}) {
                    const auto fill = [&](const Vector& at, std::vector<double>& found, std::vector<Vector>& slopes) {
                        linear ? star.determinants(at, found, slopes) : star.qualities(at, found, slopes);
                    };
                    fill(Vector::Zero(), values, gradients);
                    fill(x, ahead, unused);
                    fill(-x, behind, unused);
                    EXPECT_NEAR(*std::min_element(values.begin(), values.end()),
                                linear ? star.lowest_determinant(Vector::Zero()) : star.lowest(Vector::Zero()), 1e-14);
                    for (std::size_t i = 0; i < values.size(); ++i)
                        EXPECT_NEAR(gradients[i][axis], (ahead[i] - behind[i]) / (2 * step), 1e-7);
                }
            }
        }
    }
}

// A roof: two slopes that meet in a ridge along y, 4 long, open elsewhere; the ridge and the rim are features.
struct Roof {
    Roof() {
        mesh.vertices.resize(6, 3);
        mesh.vertices << -2, 0, 0, 0, 0, 2, 2, 0, 0, -2, 4, 0, 0, 4, 2, 2, 4, 0;
        mesh.triangles.resize(4, 3);
        mesh.triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4;
        features = surface::detect_features(mesh);
    }
    surface::TriangleMesh mesh;
    surface::FeatureGraph features;
};

TEST(SurfaceGuide, PlacesStayOnTheirPatchesAndCurves) {
    const Roof roof;
    const SurfaceGuide guide(roof.mesh, roof.features);
    const auto left = guide.nearest_on_surface({-1, 1, 1.1});
    EXPECT_LT((left.point - Vector(-0.95, 1, 1.05)).norm(), 1e-14);
    EXPECT_LT(left.element, 2);
    // Though the right slope is nearer, to the ridge and no farther.
    const auto clamped = guide.nearest_in_patch({1, 2, 1}, left);
    EXPECT_LT((clamped.point - Vector(0, 2, 2)).norm(), 1e-14);
    EXPECT_EQ(clamped.piece, left.piece);
    EXPECT_NE(guide.nearest_on_surface({1, 2, 1}).piece, left.piece);
    EXPECT_NEAR(guide.normal(left.element).dot(Vector(-1, 0, 1).normalized()), 1, 1e-14);
    const auto ridge = guide.nearest_on_curves({0.1, 1, 2});
    EXPECT_EQ(ridge.point, Vector(0, 1, 2));
    EXPECT_EQ(guide.nearest_in_curve({2, 3, 0}, ridge).point, Vector(0, 3, 2));
    EXPECT_EQ(guide.nearest_in_curve({2, 9, 0}, ridge).point, Vector(0, 4, 2));
    EXPECT_NEAR(std::abs(guide.tangent(ridge.element)[1]), 1, 1e-14);
}

// A wall that stands on a floor, whose triangles meet along it: three patches, if no edge is a feature.
TEST(SurfaceGuide, AnInterfaceIsAPatchOfItsOwn) {
    surface::TriangleMesh mesh;
    mesh.vertices.resize(8, 3);
    mesh.vertices << -1, 0, 0, 0, 0, 0, 1, 0, 0, -1, 1, 0, 0, 1, 0, 1, 1, 0, 0, 0, 1, 0, 1, 1;
    mesh.triangles.resize(6, 3);
    mesh.triangles << 0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4, 1, 4, 7, 1, 7, 6;
    const SurfaceGuide guide(mesh, {});
    const auto wall = guide.nearest_on_surface({0.1, 0.5, 0.5}), left = guide.nearest_on_surface({-0.5, 0.5, 0.1}),
               right = guide.nearest_on_surface({0.5, 0.5, 0.1});
    EXPECT_NE(wall.piece, left.piece);
    EXPECT_NE(wall.piece, right.piece);
    EXPECT_NE(left.piece, right.piece);
    EXPECT_LT((guide.nearest_in_patch({0.5, 0.5, 0.1}, wall).point - Vector(0, 0.5, 0.1)).norm(), 1e-15);
}

TEST(SurfaceGuide, NearestPlacesAreThoseOfAllTriangles) {
    const ImproveCase ball = ball_of_hexahedra(1, 1);  // for its surface: one patch
    const SurfaceGuide guide(ball.surface, ball.features);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> coordinate(-1.2, 1.2);
    auto last = guide.nearest_on_surface({1, 0, 0});
    for (int trial = 0; trial < 200; ++trial) {
        const Vector p(coordinate(random), coordinate(random), coordinate(random));
        // Over each triangle by golden-section search in barycentric coordinates would be slow: by its points on a fine
        // grid.
        double least = std::numeric_limits<double>::infinity();
        for (const auto t : ball.surface.triangles.rowwise())
            for (int i = 0; i <= 6; ++i)
                for (int j = 0; i + j <= 6; ++j) {
                    const Vector q = (i * ball.surface.vertices.row(t[0]) + j * ball.surface.vertices.row(t[1]) +
                                      (6 - i - j) * ball.surface.vertices.row(t[2])) /
                                     6;
                    least = std::min(least, (q - p).norm());
                }
        const auto fresh = guide.nearest_on_surface(p), known = guide.nearest_in_patch(p, last);
        EXPECT_LE((fresh.point - p).norm(), least + 1e-12);
        EXPECT_GE((fresh.point - p).norm(), least - 0.01);
        EXPECT_NEAR((known.point - p).norm(), (fresh.point - p).norm(), 1e-14);
        last = known;
    }
}

TEST(SurfaceGuide, TrianglesWithoutAreaAreLeftOut) {
    Roof roof;
    roof.mesh.triangles.conservativeResize(6, 3);
    roof.mesh.triangles.bottomRows(2) << 0, 0, 3, 2, 2, 2;
    const SurfaceGuide guide(roof.mesh, roof.features);
    EXPECT_TRUE(guide.nearest_on_surface({-2, 1, 0}).point.allFinite());
    EXPECT_LT(guide.nearest_on_surface({2, 0, 0}).element, 4);
    const SurfaceGuide none(surface::TriangleMesh{}, surface::FeatureGraph{});
    EXPECT_FALSE(none.has_triangles());
    EXPECT_FALSE(none.has_edges());
}

}  // namespace
}  // namespace octafield::volume::detail
