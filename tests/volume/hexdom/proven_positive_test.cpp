#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "octafield/error.hpp"
#include "octafield/volume/cell_quality.hpp"

namespace octafield::volume {
namespace {

using Vector = Eigen::Vector3d;
using Corners = std::vector<Vector>;

enum class Kind { tet, hexahedron, wedge, pyramid };
const std::array<Kind, 4> kinds{Kind::tet, Kind::hexahedron, Kind::wedge, Kind::pyramid};

Corners regular(Kind kind) {
    if (kind == Kind::tet) return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    if (kind == Kind::wedge) return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    Corners base{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    if (kind == Kind::pyramid)
        base.emplace_back(0.5, 0.5, 0.8);
    else
        for (int k = 0; k < 4; ++k) base.emplace_back(base[k] + Vector(0, 0, 1));
    return base;
}

MixedMesh cell_of(Kind kind, const Corners& corners) {
    MixedMesh mesh;
    mesh.vertices.resize(static_cast<Eigen::Index>(corners.size()), 3);
    for (std::size_t k = 0; k < corners.size(); ++k) mesh.vertices.row(static_cast<Eigen::Index>(k)) = corners[k];
    const auto fill = [&](auto& rows) {
        rows.resize(1, rows.cols());
        for (Index k = 0; k < rows.cols(); ++k) rows(0, k) = k;
    };
    if (kind == Kind::tet) fill(mesh.tets);
    if (kind == Kind::hexahedron) fill(mesh.hexahedra);
    if (kind == Kind::wedge) fill(mesh.wedges);
    if (kind == Kind::pyramid) fill(mesh.pyramids);
    return mesh;
}

bool proven(Kind kind, const Corners& corners, int depth = 8) {
    return proven_positive(cell_of(kind, corners), depth)[0];
}

// The map of the reference cell by its shape functions, (u, v, w) in the unit cube: (u, v) over tets' and wedges'
// triangles with u + v <= 1.
Vector place(Kind kind, const Corners& p, double u, double v, double w) {
    const auto bilinear = [&](int k) -> Vector {
        return (1 - u) * (1 - v) * p[k] + u * (1 - v) * p[k + 1] + u * v * p[k + 2] + (1 - u) * v * p[k + 3];
    };
    const auto linear = [&](int k) -> Vector { return (1 - u - v) * p[k] + u * p[k + 1] + v * p[k + 2]; };
    if (kind == Kind::tet) return (1 - u - v - w) * p[0] + u * p[1] + v * p[2] + w * p[3];
    if (kind == Kind::hexahedron) return (1 - w) * bilinear(0) + w * bilinear(4);
    return kind == Kind::wedge ? (1 - w) * linear(0) + w * linear(3) : (1 - w) * bilinear(0) + w * p[4];
}

// The map is linear in each variable but for rounding, so differences over any step are its derivatives.
double jacobian(Kind kind, const Corners& p, double u, double v, double w) {
    Eigen::Matrix3d derivatives;
    const Vector at = place(kind, p, u, v, w);
    derivatives << (place(kind, p, u + 1, v, w) - at), (place(kind, p, u, v + 1, w) - at),
        (place(kind, p, u, v, w + 1) - at);
    return derivatives.determinant();
}

// Least over a grid of (n + 1)^3 points; of pyramids, without the factor (1 - w)^2, which is 0 at the apex.
double least_sampled(Kind kind, const Corners& p, int n = 16) {
    double least = std::numeric_limits<double>::infinity();
    for (int i = 0; i <= n; ++i)
        for (int j = 0; j <= n; ++j)
            for (int k = 0; k <= n; ++k) {
                if (kind == Kind::wedge && i + j > n) continue;
                if (kind == Kind::pyramid && k > 0) continue;
                least = std::min(least, jacobian(kind, p, double(i) / n, double(j) / n, double(k) / n));
            }
    return least;
}

double least_at_corners(Kind kind, const Corners& p) { return least_sampled(kind, p, 1); }

Corners perturbed(Corners corners, double amount, std::mt19937& random) {
    std::uniform_real_distribution<double> move(-amount, amount);
    for (Vector& corner : corners) corner += Vector(move(random), move(random), move(random));
    return corners;
}

// Gauss-Legendre of 3 points in each variable: exact for what is integrated. Duffy's map for triangles and tets.
double integral(Kind kind, const Corners& p) {
    const std::array<double, 3> at{0.5 - std::sqrt(0.15), 0.5, 0.5 + std::sqrt(0.15)},
        weight{5 / 18., 8 / 18., 5 / 18.};
    double sum = 0;
    for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j)
            for (int k = 0; k < 3; ++k) {
                double u = at[i], v = at[j], factor = weight[i] * weight[j] * weight[k];
                if (kind == Kind::wedge) factor *= 1 - u, v *= 1 - u;
                if (kind == Kind::tet) factor /= 6;
                sum += factor * jacobian(kind, p, u, v, kind == Kind::tet ? 0 : at[k]);
            }
    return sum;
}

// Not of the code tested, but of what it is held against below.
TEST(ProvenPositive, TheSampledJacobianIntegratesToTheVolume) {
    std::mt19937 random(1);
    for (const Kind kind : kinds)
        for (int trial = 0; trial < 20; ++trial) {
            const Corners corners = perturbed(regular(kind), 0.4, random);
            EXPECT_NEAR(integral(kind, corners), cell_volumes(cell_of(kind, corners))[0], 1e-13);
        }
}

TEST(ProvenPositive, RegularCellsAreProvenWithoutHalvings) {
    for (const Kind kind : kinds) EXPECT_TRUE(proven(kind, regular(kind), 0));
}

// Turned about the z axis in proportion to the height, up to `most` radians, and perturbed.
Corners twisted(Kind kind, double most, double amount, std::mt19937& random) {
    Corners corners = regular(kind);
    const double angle = std::uniform_real_distribution<double>(-most, most)(random);
    for (Vector& corner : corners) {
        const Vector axis(0.4, 0.4, 0);
        corner = axis + Eigen::AngleAxisd(angle * corner[2], Vector::UnitZ()) * (corner - axis);
    }
    return perturbed(corners, amount, random);
}

TEST(ProvenPositive, AgreesWithDenseSamplesOfRandomCells) {
    std::mt19937 random(2);
    for (const Kind kind : kinds) {
        int positive = 0, negative = 0, hidden = 0;
        for (int trial = 0; trial < 600; ++trial) {
            const Corners corners = twisted(kind, 3, kind == Kind::tet ? 0.9 : 0.4, random);
            const double least = least_sampled(kind, corners);
            const bool found = proven(kind, corners);
            EXPECT_FALSE(found && least <= 0) << least;
            EXPECT_TRUE(found || least < 1e-2) << least;  // nearer 0 the samples do not tell
            positive += found;
            negative += least <= 0;
            hidden += least <= 0 && least_at_corners(kind, corners) > 0;
        }
        EXPECT_GT(positive, 50);
        EXPECT_GT(negative, 50);
        EXPECT_EQ(hidden > 0, kind == Kind::hexahedron || kind == Kind::wedge) << hidden;
    }
}

// The top of a cube turned about its axis by a: level squares turn and shrink, their area, which is the Jacobian, is 1
// at the corners and cos^2(a / 2) half-way up.
TEST(ProvenPositive, ACubeWhoseTopTurnsIsPositiveUntilItIsAPoint) {
    const auto turned = [](double degrees) {
        Corners corners = regular(Kind::hexahedron);
        const Eigen::AngleAxisd turn(degrees * std::acos(-1.0) / 180, Vector::UnitZ());
        for (int k = 4; k < 8; ++k) corners[k] = Vector(0.5, 0.5, 0) + turn * (corners[k] - Vector(0.5, 0.5, 0));
        return corners;
    };
    for (const double degrees : {0., 60., 90., 150., 175., 179.}) {
        EXPECT_TRUE(proven(Kind::hexahedron, turned(degrees))) << degrees;
        EXPECT_TRUE(proven(Kind::hexahedron, turned(-degrees))) << degrees;
    }
    for (const double degrees : {180., 179.99999}) EXPECT_FALSE(proven(Kind::hexahedron, turned(degrees))) << degrees;
}

TEST(ProvenPositive, HalvingsProveWhatCoefficientsAloneDoNot) {
    std::mt19937 random(3);
    std::array<int, 4> count{};
    for (int trial = 0; trial < 400; ++trial) {
        const Corners corners = twisted(Kind::hexahedron, 2.5, 0.3, random);
        bool before = false;
        for (int k = 0; k < 4; ++k) {
            const bool found = proven(Kind::hexahedron, corners, std::array{0, 1, 2, 8}[k]);
            EXPECT_TRUE(found || !before);  // deeper proves no less
            count[k] += before = found;
        }
    }
    EXPECT_GT(count[1], count[0]);
    EXPECT_GT(count[3], count[1]);
}

// Rotations of each kind of cell, as orders of its corners: those that the given ones generate.
std::vector<std::vector<int>> rotations(Kind kind) {
    std::vector<std::vector<int>> generators;
    if (kind == Kind::tet) generators = {{1, 2, 0, 3}, {1, 0, 3, 2}};
    if (kind == Kind::hexahedron) generators = {{1, 2, 3, 0, 5, 6, 7, 4}, {1, 5, 6, 2, 0, 4, 7, 3}};
    if (kind == Kind::wedge) generators = {{1, 2, 0, 4, 5, 3}, {3, 5, 4, 0, 2, 1}};
    if (kind == Kind::pyramid) generators = {{1, 2, 3, 0, 4}};
    std::vector<int> identity;
    for (std::size_t k = 0; k < generators[0].size(); ++k) identity.push_back(static_cast<int>(k));
    std::vector<std::vector<int>> all{identity};
    for (std::size_t at = 0; at < all.size(); ++at)
        for (const auto& generator : generators) {
            std::vector<int> next;
            for (const int k : generator) next.push_back(all[at][k]);
            if (std::find(all.begin(), all.end(), next) == all.end()) all.push_back(next);
        }
    return all;
}

TEST(ProvenPositive, TheSameHoweverACellIsNumberedAndInAnyUnit) {
    EXPECT_EQ(rotations(Kind::hexahedron).size(), 24u);
    EXPECT_EQ(rotations(Kind::tet).size(), 12u);
    EXPECT_EQ(rotations(Kind::wedge).size(), 6u);
    std::mt19937 random(4);
    for (const Kind kind : kinds) {
        int positive = 0;
        for (int trial = 0; trial < 100; ++trial) {
            const Corners corners = twisted(kind, 3, kind == Kind::tet ? 0.9 : 0.45, random);
            const bool found = proven(kind, corners);
            positive += found;
            for (const auto& order : rotations(kind)) {
                Corners renumbered;
                for (const int k : order) renumbered.push_back(corners[k]);
                EXPECT_EQ(proven(kind, renumbered), found);
            }
            for (const double scale : {1e-6, 1e-3, 1e3, 1e6, 1e-120, 1e120}) {
                Corners scaled = corners;
                for (Vector& corner : scaled) corner *= scale;
                EXPECT_EQ(proven(kind, scaled), found) << scale;
            }
            Corners mirrored = corners;
            for (Vector& corner : mirrored) corner[2] = -corner[2];
            EXPECT_FALSE(found && proven(kind, mirrored));
        }
        EXPECT_GT(positive, 10);
        EXPECT_LT(positive, 95);
    }
}

// Coordinates are integers, so that determinants are exactly 0, while products of doubles are rounded.
TEST(ProvenPositive, NothingThatIsFlatIsProvenByRounding) {
    std::mt19937_64 random(5);
    std::uniform_int_distribution<std::int64_t> coordinate(-(1ll << 45), 1ll << 45);
    const auto any = [&] {
        return Vector(double(coordinate(random)), double(coordinate(random)), double(coordinate(random)));
    };
    int rounded_up = 0;
    for (int trial = 0; trial < 2000; ++trial) {
        const Vector at = any(), a = any(), b = any();
        rounded_up += a.cross(b).dot(a + b) > 0;
        EXPECT_FALSE(proven(Kind::tet, {at, at + a, at + b, at + a + b}));
        // The corner at `at` is flat, the others are those of a cell as sound as can be.
        for (const Kind kind : {Kind::hexahedron, Kind::wedge, Kind::pyramid}) {
            Corners corners = regular(kind);
            for (Vector& corner : corners) corner = at + 1024 * Vector((corner * 10).array().round());
            const int up = kind == Kind::hexahedron || kind == Kind::pyramid ? 4 : 3,
                      second = kind == Kind::wedge ? 2 : 3;
            corners[up] = corners[1] + corners[second] - corners[0];
            EXPECT_FALSE(proven(kind, corners));
        }
    }
    EXPECT_GT(rounded_up, 200);  // so the rounding does matter here
}

TEST(ProvenPositive, DamagedCellsAreNotProvenAndLostVerticesNamed) {
    EXPECT_TRUE(proven_positive(MixedMesh{}).empty());
    for (const Kind kind : kinds)
        for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
            for (std::size_t k = 0; k < regular(kind).size(); ++k) {
                Corners corners = regular(kind);
                corners[k][1] = bad;
                EXPECT_FALSE(proven(kind, corners));
                EXPECT_FALSE(proven(kind, Corners(corners.size(), Vector(1, 2, 3))));
            }
    MixedMesh mesh = cell_of(Kind::hexahedron, regular(Kind::hexahedron));
    EXPECT_THROW(proven_positive(mesh, -1), InvalidInput);
    mesh.hexahedra(0, 3) = 8;
    try {
        proven_positive(mesh);
        FAIL();
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "index_out_of_range");
        EXPECT_EQ(error.elements(), std::vector<Index>{0});
    }
}

TEST(ProvenPositive, CellsKeepTheirNumbersAtAnyThreadCount) {
    // A tet, hexahedra that alternate between sound and inverted, a wedge, an inverted pyramid.
    MixedMesh mesh = cell_of(Kind::hexahedron, regular(Kind::hexahedron));
    mesh.hexahedra.resize(1000, 8);
    for (Index i = 0; i < 1000; ++i)
        for (Index k = 0; k < 8; ++k) mesh.hexahedra(i, k) = i % 2 ? (k + 4) % 8 : k;
    mesh.tets.resize(1, 4);
    mesh.tets << 0, 1, 3, 4;
    mesh.wedges.resize(1, 6);
    mesh.wedges << 0, 1, 3, 4, 5, 7;
    mesh.pyramids.resize(1, 5);
    mesh.pyramids << 3, 2, 1, 0, 4;
    const auto one = proven_positive(mesh, 8, 1);
    EXPECT_EQ(one, proven_positive(mesh, 8, 2));
    ASSERT_EQ(one.size(), 1003u);
    EXPECT_TRUE(one[0]);
    for (int i = 0; i < 1000; ++i) EXPECT_EQ(one[1 + i], i % 2 == 0);
    EXPECT_TRUE(one[1001]);
    EXPECT_FALSE(one[1002]);
}

}  // namespace
}  // namespace octafield::volume
