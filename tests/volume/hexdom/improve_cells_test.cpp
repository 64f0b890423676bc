#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "improve_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using Vector = Eigen::Vector3d;
using Kind = VertexSupport::Kind;

double lowest(const MixedMesh& mesh) { return scaled_jacobians(mesh).minCoeff(); }
double mean(const MixedMesh& mesh) { return scaled_jacobians(mesh).mean(); }
int inverted(const MixedMesh& mesh) { return static_cast<int>((scaled_jacobians(mesh).array() <= 0).count()); }

// Vertices on faces and edges of the box have kept the coordinates of those to the bit, and left none of them.
void expect_on_box(const ImproveCase& start, const MixedMesh& mesh, int n) {
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        for (int axis = 0; axis < 3; ++axis) {
            const double before = start.mesh.vertices(v, axis), after = mesh.vertices(v, axis);
            EXPECT_TRUE(after == before || (before != 0 && before != n)) << v;
            EXPECT_GE(after, 0);
            EXPECT_LE(after, n);
        }
}

// Distance from the nearest triangle, each looked at.
double distance(const surface::TriangleMesh& surface, const Vector& p) {
    double least = std::numeric_limits<double>::infinity();
    for (const auto t : surface.triangles.rowwise()) {
        const Vector a = surface.vertices.row(t[0]), b = surface.vertices.row(t[1]), c = surface.vertices.row(t[2]);
        const Vector normal = (b - a).cross(c - a).normalized();
        const Vector flat = p - (p - a).dot(normal) * normal;
        const auto inner = [&](const Vector& from, const Vector& to) {
            return (to - from).cross(flat - from).dot(normal) >= 0;
        };
        if (inner(a, b) && inner(b, c) && inner(c, a)) least = std::min(least, (flat - p).norm());
        for (const auto& [from, to] : {std::pair(a, b), std::pair(b, c), std::pair(c, a)}) {
            const double share = std::clamp((p - from).dot(to - from) / (to - from).squaredNorm(), 0.0, 1.0);
            least = std::min(least, (from + share * (to - from) - p).norm());
        }
    }
    return least;
}

// Of the vertices of kind surface.
double farthest_from_surface(const ImproveCase& start, const MixedMesh& mesh) {
    double most = 0;
    for (Index v = 0; v < mesh.vertices.rows(); ++v)
        if (start.support.kind[v] == Kind::surface)
            most = std::max(most, distance(start.surface, mesh.vertices.row(v)));
    return most;
}

TEST(ImproveCells, AShakenLatticeGetsRegularAndKeepsToItsBox) {
    const ImproveCase box = box_of_hexahedra(6, 0.25);
    const MixedMesh better = box.improved();
    EXPECT_LT(lowest(box.mesh), 0.4);
    EXPECT_LT(mean(box.mesh), 0.85);
    EXPECT_GT(lowest(better), 0.99);
    expect_on_box(box, better, 6);
    EXPECT_EQ(better.hexahedra, box.mesh.hexahedra);
    EXPECT_NEAR(cell_volumes(better).sum(), 216, 1e-10);
}

TEST(ImproveCells, InvertedCellsAreUntangled) {
    for (const unsigned seed : {1u, 2u, 3u}) {
        const ImproveCase box = box_of_hexahedra(6, 0.4, seed), both = box_of_both(6, 0.4, seed);
        for (const ImproveCase* start : {&box, &both}) {
            const MixedMesh better = start->improved();
            EXPECT_GT(inverted(start->mesh), 4);
            EXPECT_GT(lowest(better), 0.3);
            const auto proven = proven_positive(better);
            EXPECT_EQ(std::ranges::count(proven, 1), better.cell_count());
            expect_on_box(*start, better, 6);
        }
    }
}

TEST(ImproveCells, TheLowestQualityNeverFalls) {
    int positive = 0;
    for (unsigned seed = 0; seed < 60; ++seed) {
        const double amount = 0.05 + 0.005 * seed;
        const ImproveCase start = seed % 2 ? box_of_hexahedra(3, amount, seed) : box_of_both(3, amount / 2, seed);
        const double before = lowest(start.mesh);
        positive += before > 0;
        for (const int sweeps : {1, 20}) {
            ImproveOptions options;
            options.sweeps = sweeps;
            options.good = seed % 3 * 0.5;
            const double after = lowest(start.improved(options));
            EXPECT_GE(after, before - 1e-12) << seed;
            EXPECT_GT(after, before > 0.95 ? 0.95 : before) << seed;
        }
    }
    EXPECT_GT(positive, 30);
}

TEST(ImproveCells, SmoothingAloneRaisesTheMeanOfHexahedra) {
    const ImproveCase box = box_of_hexahedra(5, 0.2);
    ImproveOptions options;
    options.good = 0;  // nothing is raised first
    const MixedMesh better = box.improved(options);
    EXPECT_GT(mean(better), 0.999);
}

// One vertex inside cells of one kind, all of whose other vertices are those of a regular arrangement about the origin.
ImproveCase about_origin(const std::vector<Vector>& ring, const Vector& start) {
    ImproveCase about;
    about.mesh.vertices.resize(static_cast<Eigen::Index>(ring.size()) + 1, 3);
    about.mesh.vertices.row(0) = start;
    for (std::size_t k = 0; k < ring.size(); ++k) about.mesh.vertices.row(static_cast<Eigen::Index>(k) + 1) = ring[k];
    about.support.kind.assign(ring.size() + 1, Kind::fixed);
    about.support.kind[0] = Kind::inside;
    return about;
}

std::vector<Vector> cube_corners() {
    return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}};
}

ImproveCase pyramids_in_cube(const Vector& start) {
    ImproveCase about = about_origin(cube_corners(), start);
    for (const std::vector<Index>& base : std::vector<std::vector<Index>>{
             {1, 2, 3, 4}, {8, 7, 6, 5}, {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}})
        append(about.mesh.pyramids, {base[0], base[1], base[2], base[3], 0});
    return about;
}

ImproveCase tets_in_octahedron(const Vector& start) {
    ImproveCase about = about_origin({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}}, start);
    for (Index k = 0; k < 4; ++k) {
        append(about.mesh.tets, {0, 1 + k, 1 + (k + 1) % 4, 5});
        append(about.mesh.tets, {0, 1 + (k + 1) % 4, 1 + k, 6});
    }
    return about;
}

// Two layers of six prisms round a vertex.
ImproveCase wedges_in_hexagon(const Vector& start) {
    std::vector<Vector> ring{{0, 0, -1}, {0, 0, 1}};
    for (const double z : {0., -1., 1.})
        for (int k = 0; k < 6; ++k)
            ring.emplace_back(std::cos(k * std::acos(-1.0) / 3), std::sin(k * std::acos(-1.0) / 3), z);
    ImproveCase about = about_origin(ring, start);
    for (Index k = 0; k < 6; ++k) {
        const Index next = (k + 1) % 6;
        append(about.mesh.wedges, {1, 9 + k, 9 + next, 0, 3 + k, 3 + next});
        append(about.mesh.wedges, {0, 3 + k, 3 + next, 2, 15 + k, 15 + next});
    }
    return about;
}

TEST(ImproveCells, OneVertexGoesToTheMiddleOfRegularCellsOfAnyKind) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> move(-0.25, 0.25);
    for (const auto& make : {pyramids_in_cube, tets_in_octahedron, wedges_in_hexagon}) {
        EXPECT_TRUE(find_cell_defects(make(Vector::Zero()).mesh).empty());
        for (int trial = 0; trial < 10; ++trial) {
            const Vector start(move(random), move(random), move(random));
            const MixedMesh better = make(start).improved();
            EXPECT_LT(better.vertices.row(0).norm(), 2e-3);
            // From outside, where cells are inverted.
            const ImproveCase tangled = make(start + Vector(1.5, 0.2, 0.3));
            EXPECT_GT(inverted(tangled.mesh), 0);
            EXPECT_LT(tangled.improved().vertices.row(0).norm(), 2e-3);
        }
    }
}

// The best place of one vertex, by a search over a grid and finer ones round what it finds.
double best_lowest(ImproveCase about) {
    Vector best = Vector::Zero();
    double most = -1;
    for (double step = 0.1; step > 1e-4; step /= 4) {
        const Vector middle = best;
        for (int i = -5; i <= 5; ++i)
            for (int j = -5; j <= 5; ++j)
                for (int k = -5; k <= 5; ++k) {
                    about.mesh.vertices.row(0) = middle + step * Vector(i, j, k);
                    const double found = lowest(about.mesh);
                    if (found > most) most = found, best = about.mesh.vertices.row(0);
                }
    }
    return most;
}

TEST(ImproveCells, WhatIsBelowGoodIsRaisedAsFarAsItGoes) {
    std::mt19937 random(8);
    std::normal_distribution<double> move(0, 0.3);
    int gained = 0;
    for (const auto& make : {pyramids_in_cube, tets_in_octahedron, wedges_in_hexagon})
        for (int trial = 0; trial < 12; ++trial) {
            ImproveCase about = make(Vector::Zero());
            for (Index v = 1; v < about.mesh.vertices.rows(); ++v)
                about.mesh.vertices.row(v) += Eigen::RowVector3d(move(random), move(random), move(random));
            const double best = best_lowest(about);
            if (best < 0.05) continue;
            ImproveOptions none, all;
            none.good = 0;
            all.good = 1;
            const double smoothed = lowest(about.improved(none)), raised = lowest(about.improved(all));
            EXPECT_GT(raised, 0.93 * best);
            EXPECT_GE(raised, smoothed - 1e-9);
            gained += raised > smoothed + 0.02;
        }
    EXPECT_GT(gained, 8);
}

TEST(ImproveCells, WhatIsPerfectStaysToTheBit) {
    for (const int n : {1, 4}) {
        const ImproveCase box = box_of_hexahedra(n, 0);
        EXPECT_EQ(box.improved().vertices, box.mesh.vertices);
        ImproveOptions options;
        options.fit_surface = true;
        options.tolerance = 0.1;
        EXPECT_EQ(box.improved(options).vertices, box.mesh.vertices);
    }
}

TEST(ImproveCells, WhatLiesOnACurveStaysThereWhateverItIsCalled) {
    ImproveCase box = box_of_hexahedra(5, 0.3);
    for (Kind& kind : box.support.kind)
        if (kind != Kind::inside) kind = Kind::surface;
    const MixedMesh better = box.improved();
    expect_on_box(box, better, 5);
    EXPECT_GT(lowest(better), 0.98);
}

TEST(ImproveCells, VerticesSlideOnACurvedSurface) {
    ImproveCase ball = ball_of_hexahedra(4, 2);
    std::mt19937 random(3);
    std::normal_distribution<double> move(0, 0.04);
    for (Index v = 0; v < ball.mesh.vertices.rows(); ++v) {
        ball.mesh.vertices.row(v) += Eigen::RowVector3d(move(random), move(random), move(random));
        if (ball.support.kind[v] == Kind::surface) ball.mesh.vertices.row(v).normalize();
    }
    const MixedMesh better = ball.improved();
    EXPECT_GT(lowest(better), lowest(ball.mesh) + 0.1);
    EXPECT_GT(mean(better), mean(ball.mesh) + 0.02);
    EXPECT_LT(farthest_from_surface(ball, better), 1e-14);
    int moved = 0;
    for (Index v = 0; v < better.vertices.rows(); ++v)
        moved += ball.support.kind[v] == Kind::surface && better.vertices.row(v) != ball.mesh.vertices.row(v);
    EXPECT_GT(moved, 90);
}

TEST(ImproveCells, FittingTheSurfaceBalancesTheVolume) {
    const ImproveCase ball = ball_of_hexahedra(4, 2);
    const double wanted = surface::signed_volume(ball.surface);
    const auto error = [&](const MixedMesh& mesh) { return cell_volumes(mesh).sum() / wanted - 1; };
    ImproveOptions options;
    const MixedMesh plain = ball.improved(options);
    options.fit_surface = true;
    options.tolerance = 0.03;
    const MixedMesh fitted = ball.improved(options);
    EXPECT_LT(error(plain), -0.03);
    EXPECT_LT(std::abs(error(fitted)), 0.002);
    EXPECT_GT(lowest(fitted), lowest(plain) - 0.1);
    EXPECT_LE(farthest_from_surface(ball, fitted), 0.03);
    EXPECT_GT(farthest_from_surface(ball, fitted), 0.01);
    options.tolerance = 0.002;  // as far as it goes
    const MixedMesh less = ball.improved(options);
    EXPECT_LT(error(less), error(fitted));
    EXPECT_GT(error(less), error(plain));
    EXPECT_NEAR(farthest_from_surface(ball, less), 0.002, 1e-4);
}

TEST(ImproveCells, VerticesOffTheSurfaceAreBroughtThere) {
    ImproveCase ball = ball_of_hexahedra(4, 2);
    for (Index v = 0; v < ball.mesh.vertices.rows(); ++v)
        if (ball.support.kind[v] == Kind::surface) ball.mesh.vertices.row(v) *= v % 2 ? 0.93 : 1.06;
    EXPECT_LT(farthest_from_surface(ball, ball.improved()), 1e-14);
}

TEST(ImproveCells, TheSameBitsAtAnyThreadCountAndInEveryRun) {
    ImproveCase both = box_of_both(10, 0.35);
    ImproveOptions one, two;
    one.threads = 1;
    two.threads = 2;
    const Points first = both.improved(one).vertices;
    EXPECT_EQ(first, both.improved(two).vertices);
    EXPECT_EQ(first, both.improved(one).vertices);
    one.fit_surface = two.fit_surface = true;
    one.tolerance = two.tolerance = 0.03;
    const ImproveCase ball = ball_of_hexahedra(6, 3);
    EXPECT_EQ(ball.improved(one).vertices, ball.improved(two).vertices);
}

TEST(ImproveCells, TheSameInAnyUnit) {
    const ImproveCase box = box_of_both(4, 0.3);
    const Points plain = box.improved().vertices;
    for (const double scale : {std::ldexp(1, -20), std::ldexp(1, 20)}) {  // powers of 2: nothing is rounded otherwise
        ImproveCase scaled = box;
        scaled.mesh.vertices *= scale;
        scaled.surface.vertices *= scale;
        EXPECT_EQ(scaled.improved().vertices, plain * scale);
    }
}

TEST(ImproveCells, EmptyMeshesAndVerticesWithoutCellsStay) {
    EXPECT_EQ(improve_cells({}, {}, {}, {}).cell_count(), 0);
    ImproveCase box = box_of_hexahedra(3, 0.2);
    const Index n = static_cast<Index>(box.mesh.vertices.rows());
    box.mesh.vertices.conservativeResize(n + 2, 3);
    box.mesh.vertices.bottomRows(2) << 1.5, 1.5, 1.5, 7, 8, 9;
    box.support.kind.push_back(Kind::inside);
    box.support.kind.push_back(Kind::surface);
    const MixedMesh better = box.improved();
    EXPECT_EQ(better.vertices.bottomRows(2), box.mesh.vertices.bottomRows(2));
    EXPECT_NE(better.vertices, box.mesh.vertices);
    ImproveOptions none;
    none.sweeps = 0;
    EXPECT_EQ(box.improved(none).vertices, box.mesh.vertices);
}

// Collapsed cells cannot be divided by, and where nothing is free nothing can be helped.
TEST(ImproveCells, CellsOfNoSizeAreEndured) {
    ImproveCase box = box_of_hexahedra(3, 0.1);
    box.mesh.vertices.row(21) = box.mesh.vertices.row(22);
    const MixedMesh better = box.improved();
    EXPECT_TRUE(better.vertices.allFinite());
    EXPECT_GT(lowest(better), 0.5);
    for (Index v = 0; v < box.mesh.vertices.rows(); ++v) box.mesh.vertices.row(v) << 1, 1, 1;
    std::ranges::fill(box.support.kind, Kind::inside);
    EXPECT_EQ(box.improved().vertices, box.mesh.vertices);
    ImproveCase fixed = box_of_hexahedra(3, 0.6);
    std::ranges::fill(fixed.support.kind, Kind::fixed);
    EXPECT_EQ(fixed.improved().vertices, fixed.mesh.vertices);
}

template <class Spoil>
std::pair<std::string, std::vector<Index>> refusal(const Spoil& spoil) {
    ImproveCase box = box_of_hexahedra(3, 0.1);
    ImproveOptions options;
    spoil(box, options);
    try {
        box.improved(options);
    } catch (const InvalidInput& error) {
        return {error.kind(), error.elements()};
    } catch (const GeometryError& error) {
        return {"geometry " + error.kind(), error.elements()};
    }
    return {};
}

TEST(ImproveCells, UnusableInputIsNamed) {
    using Found = std::pair<std::string, std::vector<Index>>;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(refusal([](ImproveCase&, ImproveOptions&) {}), Found());
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.support.kind.pop_back(); }).first, "wrong_size");
    EXPECT_EQ(refusal([&](ImproveCase& box, ImproveOptions&) { box.mesh.vertices(5, 1) = nan; }),
              Found("non_finite_vertex", {5}));
    EXPECT_EQ(refusal([&](ImproveCase& box, ImproveOptions&) { box.surface.vertices(2, 1) = nan; }),
              Found("non_finite_vertex", {2}));
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.surface.triangles(4, 1) = 8; }),
              Found("index_out_of_range", {4}));
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.features.edges(3, 0) = -1; }),
              Found("index_out_of_range", {3}));
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.features.corners[1] = 99; }),
              Found("index_out_of_range", {1}));
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.mesh.hexahedra(7, 2) = 64; }),
              Found("geometry index_out_of_range", {7}));
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.surface = {}, box.features = {}; }).first,
              "no_surface");
    EXPECT_EQ(refusal([](ImproveCase& box, ImproveOptions&) { box.features = {}; }).first, "no_features");
    EXPECT_EQ(refusal([](ImproveCase&, ImproveOptions& o) { o.sweeps = -1; }).first, "option_out_of_range");
    EXPECT_EQ(refusal([](ImproveCase&, ImproveOptions& o) { o.good = 1.5; }).first, "option_out_of_range");
    EXPECT_EQ(refusal([&](ImproveCase&, ImproveOptions& o) { o.tolerance = nan; }).first, "option_out_of_range");
}

}  // namespace
}  // namespace octafield::volume
