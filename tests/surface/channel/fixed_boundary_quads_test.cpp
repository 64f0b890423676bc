// Quads of regions whose boundary is kept, counted and measured here anew.
#include "octafield/surface/fixed_boundary_quads.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

#include "inside_mesh.hpp"
#include "octafield/error.hpp"
#include "segment_search.hpp"

namespace octafield::surface {
namespace {

using Curve = std::vector<std::array<double, 2>>;

PlanarOutline outline_of(const std::vector<Curve>& loops, const std::vector<Curve>& lines = {}) {
    std::map<std::array<double, 2>, Index> number;
    std::vector<std::array<Index, 2>> segments[2];
    std::vector<std::array<double, 2>> points;
    const auto id = [&](const std::array<double, 2>& p) {
        const auto [at, added] = number.try_emplace(p, static_cast<Index>(points.size()));
        if (added) points.push_back(p);
        return at->second;
    };
    for (const Curve& loop : loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
            segments[0].push_back({id(loop[i]), id(loop[(i + 1) % loop.size()])});
    for (const Curve& line : lines)
        for (std::size_t i = 0; i + 1 < line.size(); ++i) segments[1].push_back({id(line[i]), id(line[i + 1])});
    PlanarOutline result{PlanePoints(points.size(), 2), Edges(segments[0].size(), 2), Edges(segments[1].size(), 2)};
    for (std::size_t i = 0; i < points.size(); ++i) result.points.row(i) << points[i][0], points[i][1];
    for (std::size_t i = 0; i < segments[0].size(); ++i) result.loops.row(i) << segments[0][i][0], segments[0][i][1];
    for (std::size_t i = 0; i < segments[1].size(); ++i) result.lines.row(i) << segments[1][i][0], segments[1][i][1];
    return result;
}

// Each side of a polygon divided evenly.
Curve divided(const Curve& corners, double length) {
    Curve result;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const auto &a = corners[i], &b = corners[(i + 1) % corners.size()];
        const int parts = std::max(1, static_cast<int>(std::lround(std::hypot(b[0] - a[0], b[1] - a[1]) / length)));
        for (int k = 0; k < parts; ++k) {
            const double t = static_cast<double>(k) / parts;
            result.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
        }
    }
    return result;
}

Curve circle(double x, double y, double radius, int count) {
    Curve result;
    for (int i = 0; i < count; ++i) {
        const double angle = 2 * std::numbers::pi * i / count;
        result.push_back({x + radius * std::cos(angle), y + radius * std::sin(angle)});
    }
    return result;
}

const Curve unit_square{{0, 0}, {1, 0}, {1, 1}, {0, 1}};

double area(const PlanarOutline& outline) {  // of loops that run counter-clockwise, holes clockwise
    double sum = 0;
    for (Index s = 0; s < outline.loops.rows(); ++s) {
        const auto a = outline.points.row(outline.loops(s, 0)), b = outline.points.row(outline.loops(s, 1));
        sum += (a[0] * b[1] - a[1] * b[0]) / 2;
    }
    return sum;
}

// Conforming, convex, with the outline's segments as edges and nothing else open, and the region's area.
void require_mesh_of(const PlanarOutline& outline, const FixedBoundaryQuads& made, double wanted_area) {
    const QuadMesh& mesh = made.mesh;
    ASSERT_GT(mesh.quads.rows(), 0);
    require_valid(mesh, false);
    EXPECT_GT(scaled_jacobians(mesh).minCoeff(), 0);
    double sum = 0;
    std::set<std::pair<Index, Index>> sides;
    for (Index q = 0; q < mesh.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) {
            const Index a = mesh.quads(q, k), b = mesh.quads(q, (k + 1) % 4);
            EXPECT_TRUE(sides.insert({a, b}).second);
            sum += (mesh.vertices(a, 0) * mesh.vertices(b, 1) - mesh.vertices(a, 1) * mesh.vertices(b, 0)) / 2;
        }
    EXPECT_NEAR(sum, wanted_area, 1e-9 * std::abs(wanted_area));
    std::set<std::pair<Index, Index>> open, boundary;
    for (const auto& [a, b] : sides)
        if (!sides.contains({b, a})) open.insert(std::minmax(a, b));
    for (Index s = 0; s < made.boundary.rows(); ++s)
        boundary.insert(std::minmax(made.boundary(s, 0), made.boundary(s, 1)));
    EXPECT_EQ(open, boundary);
    for (Index s = 0; s < made.lines.rows(); ++s)
        EXPECT_TRUE(sides.contains({made.lines(s, 0), made.lines(s, 1)}) &&
                    sides.contains({made.lines(s, 1), made.lines(s, 0)}));
    EXPECT_EQ(mesh.vertices.topRows(outline.points.rows()).leftCols<2>(), outline.points);
}

FixedBoundaryQuads quads_of(const PlanarOutline& outline, double edge_length = 0, OddLoops odd = OddLoops::refuse) {
    FixedBoundaryOptions options;
    options.edge_length = edge_length;
    options.odd_loops = odd;
    return fixed_boundary_quads(outline, {}, options);
}

std::string kind_of(const PlanarOutline& outline, const FixedBoundaryOptions& options = {},
                    const QuadMesh& inside = {}) {
    try {
        fixed_boundary_quads(outline, inside, options);
    } catch (const Error& error) {
        return error.kind();
    }
    return "";
}

TEST(FixedBoundaryQuads, LeaveASquareOfFourSegmentsAsOneQuad) {
    const PlanarOutline outline = outline_of({unit_square});
    const FixedBoundaryQuads made = quads_of(outline);
    require_mesh_of(outline, made, 1);
    EXPECT_EQ(made.mesh.quads.rows(), 1);
    EXPECT_TRUE(made.interior.empty());
}

TEST(FixedBoundaryQuads, AreTheGridWhereItFits) {
    const PlanarOutline square = outline_of({divided(unit_square, 0.1)});
    const FixedBoundaryQuads made = quads_of(square);
    require_mesh_of(square, made, 1);
    EXPECT_EQ(made.mesh.quads.rows(), 100);
    EXPECT_NEAR(scaled_jacobians(made.mesh).minCoeff(), 1, 1e-6);
    const PlanarOutline shape = outline_of({divided({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.1)});
    const FixedBoundaryQuads quads = quads_of(shape);
    require_mesh_of(shape, quads, 3);
    EXPECT_EQ(quads.mesh.quads.rows(), 300);
}

TEST(FixedBoundaryQuads, KeepTheirBoundaryWhateverTheTurnOfTheGrid) {
    const PlanarOutline outline = outline_of({divided({{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, 0.1)});
    FixedBoundaryOptions options;
    for (int turn = 0; turn < 6; ++turn) {
        options.rotation = turn * std::numbers::pi / 12;
        options.offset_x = 0.3 * turn;
        options.offset_y = 0.7 * turn;
        const FixedBoundaryQuads made = fixed_boundary_quads(outline, {}, options);
        require_mesh_of(outline, made, 3);
        EXPECT_GT(scaled_jacobians(made.mesh).minCoeff(), 0.4) << turn;
    }
}

TEST(FixedBoundaryQuads, GoRoundHolesAndIslandsInThem) {
    Curve hole = circle(0, 0, 0.6, 36), island = circle(0, 0, 0.3, 18);
    std::reverse(hole.begin(), hole.end());
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 60), hole, island});
    require_mesh_of(outline, quads_of(outline), area(outline));
}

TEST(FixedBoundaryQuads, FillANarrowRingWithoutSquares) {
    Curve hole = circle(0, 0, 0.9, 58);
    std::reverse(hole.begin(), hole.end());
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 60), hole});
    const FixedBoundaryQuads made = quads_of(outline);
    EXPECT_TRUE(made.interior.empty());
    require_mesh_of(outline, made, area(outline));
}

TEST(FixedBoundaryQuads, HaveLinesThatEndInsideOrDivideTheRegion) {
    Curve dangling, across;
    for (int i = 0; i < 9; ++i) dangling.push_back({0.23 + 0.05 * i, 0.3 + 0.03 * i});
    for (int i = 0; i <= 20; ++i) across.push_back({0.05 * i, 0.75 + (i % 20 ? 0.02 * std::sin(i) : 0)});
    const PlanarOutline outline = outline_of({divided(unit_square, 0.05)}, {dangling, across});
    require_mesh_of(outline, quads_of(outline, 0.05), 1);
}

TEST(FixedBoundaryQuads, KeepLinesAcrossWhichGroupsWouldBeBetter) {
    Curve line;  // a sharp wedge with the boundary
    for (int i = 0; i < 9; ++i) line.push_back({0.1 * i, 0.02 * i});
    const PlanarOutline outline = outline_of({divided(unit_square, 0.1)}, {line});
    FixedBoundaryOptions options;
    for (int turn = 0; turn < 4; ++turn) {
        options.rotation = 0.4 * turn;
        require_mesh_of(outline, fixed_boundary_quads(outline, {}, options), 1);
    }
}

TEST(FixedBoundaryQuads, HaveLonePointsAsVertices) {
    PlanarOutline outline = outline_of({divided(unit_square, 0.1)});
    outline.points.conservativeResize(outline.points.rows() + 1, 2);
    outline.points.bottomRows(1) << 0.41, 0.57;
    const FixedBoundaryQuads made = quads_of(outline);
    require_mesh_of(outline, made, 1);
    EXPECT_TRUE((made.mesh.quads.array() == outline.points.rows() - 1).any());
}

TEST(FixedBoundaryQuads, RefuseOddLoopsAndNameASegmentThatPutsThemRight) {
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 41)});
    try {
        quads_of(outline);
        FAIL();
    } catch (const GeometryError& error) {
        EXPECT_EQ(error.kind(), "odd_boundary");
        EXPECT_EQ(error.elements().size(), 1U);
    }
    const FixedBoundaryQuads one = quads_of(outline, 0, OddLoops::split_one);
    EXPECT_EQ(one.split.size(), 1U);
    EXPECT_EQ(one.boundary.rows(), 42);
    require_mesh_of(outline, one, area(outline));
    const FixedBoundaryQuads all = quads_of(outline, 0, OddLoops::split_all);
    EXPECT_EQ(all.boundary.rows(), 82);
    require_mesh_of(outline, all, area(outline));
}

TEST(FixedBoundaryQuads, SplitOneLoopOfTwoOddOnesThatTheMeshInsideParts) {
    Curve hole = circle(0, 0, 0.2, 13);
    std::reverse(hole.begin(), hole.end());
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 61), hole});
    EXPECT_EQ(kind_of(outline), "odd_boundary");
    const FixedBoundaryQuads made = quads_of(outline, 0, OddLoops::split_one);
    EXPECT_EQ(made.split.size(), 2U);
    require_mesh_of(outline, made, area(outline));
}

TEST(FixedBoundaryQuads, SplitOneSegmentBetweenTwoOddRegions) {
    Curve ring = circle(0.5, 0.5, 0.2, 9);
    ring.push_back(ring.front());
    const PlanarOutline outline = outline_of({divided(unit_square, 0.1)}, {ring});
    const FixedBoundaryQuads made = quads_of(outline, 0, OddLoops::split_one);
    require_mesh_of(outline, made, 1);
    ASSERT_EQ(made.split.size(), 1U);
    EXPECT_GE(made.split[0], outline.loops.rows());
    EXPECT_EQ(made.lines.rows(), 10);
}

TEST(InsideMesh, HasAllSquaresWithTheClearanceAndNoOther) {
    const PlanarOutline region = outline_of({circle(0, 0, 1, 50)});
    FixedBoundaryOptions options;
    options.rotation = 0.3;
    const detail::InsideMesh all = detail::squares(region.points, 0.1, options);
    const auto clear = [&](const auto& place) {
        double least = 9;
        for (Index s = 0; s < region.loops.rows(); ++s)
            least = std::min(least, detail::distance(place, region.points.row(region.loops(s, 0)),
                                                     region.points.row(region.loops(s, 1))));
        return place.norm() < 1 && least >= 0.95 * 0.1;
    };
    Index wanted = 0;
    for (Index q = 0; q < all.quads.rows(); ++q) {
        bool kept = true;
        for (int k = 0; k < 4; ++k) kept = kept && clear(detail::Vector2(all.points.row(all.quads(q, k))));
        wanted += kept;
    }
    const detail::InsideMesh made =
        detail::trimmed(all, {region.points, region.loops, static_cast<Index>(region.loops.rows())}, 0.95);
    EXPECT_EQ(made.quads.rows(), wanted);
    for (Index v = 0; v < made.points.rows(); ++v) EXPECT_TRUE(clear(detail::Vector2(made.points.row(v))));
}

TEST(InsideMesh, HasNoLargeQuadRoundASmallIsland) {
    detail::InsideMesh mesh;  // a large quad in a narrow frame
    mesh.points.resize(8, 2);
    mesh.points << 0, 0, 4, 0, 4, 4, 0, 4, -0.1, -0.1, 4.1, -0.1, 4.1, 4.1, -0.1, 4.1;
    mesh.quads.resize(5, 4);
    mesh.quads << 0, 1, 2, 3, 4, 5, 1, 0, 5, 6, 2, 1, 6, 7, 3, 2, 7, 4, 0, 3;
    const auto kept = [&](const std::vector<Curve>& loops) {
        const PlanarOutline region = outline_of(loops);
        return detail::trimmed(mesh, {region.points, region.loops, static_cast<Index>(region.loops.rows())}, 0.95)
            .quads.rows();
    };
    EXPECT_EQ(kept({circle(2, 2, 20, 40)}), 5);
    EXPECT_EQ(kept({circle(2, 2, 20, 40), circle(2, 2, 0.1, 6)}), 4);
}

TEST(FixedBoundaryQuads, KeepTheQuadsOfAMeshOfOnesOwn) {
    QuadMesh inside;  // sheared, of half the clearance's size
    inside.vertices.resize(11 * 11, 3);
    inside.quads.resize(100, 4);
    for (Index i = 0; i < 121; ++i) inside.vertices.row(i) << 0.1 * (i % 11) + 0.02 * (i / 11), 0.1 * (i / 11), 0;
    for (Index q = 0; q < 100; ++q) {
        const Index v = q / 10 * 11 + q % 10;
        inside.quads.row(q) << v, v + 11, v + 12, v + 1;  // clockwise
    }
    const PlanarOutline outline = outline_of({circle(0.6, 0.5, 0.45, 28)});
    const FixedBoundaryQuads made = fixed_boundary_quads(outline, inside, {});
    require_mesh_of(outline, made, area(outline));
    EXPECT_GT(made.interior.size(), 15U);
    for (const Index q : made.interior)
        EXPECT_NEAR(made.mesh.vertices(made.mesh.quads(q, 0), 1), made.mesh.vertices(made.mesh.quads(q, 1), 1), 0.12);
}

TEST(FixedBoundaryQuads, AreTheSameEachRun) {
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 50)});
    const FixedBoundaryQuads a = quads_of(outline), b = quads_of(outline);
    EXPECT_EQ(a.mesh.quads, b.mesh.quads);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
}

// Star-shaped regions with random radii.
TEST(FixedBoundaryQuads, FillJaggedOutlines) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> radius(0.7, 1.2);
    for (int run = 0; run < 10; ++run) {
        Curve curve = circle(0, 0, 1, 40);
        for (auto& p : curve) {
            const double r = radius(random);
            p = {p[0] * r, p[1] * r};
        }
        const PlanarOutline outline = outline_of({curve});
        require_mesh_of(outline, quads_of(outline, 0.17), area(outline));
    }
}

TEST(FixedBoundaryQuads, ReformedGroupsMakeTheWorstQuadBetter) {
    const PlanarOutline outline = outline_of({circle(0, 0, 1, 60)});
    EXPECT_GT(scaled_jacobians(quads_of(outline).mesh).minCoeff(), 0.7);
    FixedBoundaryOptions options;
    options.rounds = 0;
    EXPECT_EQ(kind_of(outline, options), "inverted_quads");  // the first cover, as it is
}

TEST(FixedBoundaryQuads, RefuseWhatIsNoOutline) {
    EXPECT_EQ(kind_of({}), "empty");
    EXPECT_EQ(kind_of(outline_of({{{0, 0}, {1, 1}, {1, 0}, {0, 1}}})), "crossing");
    EXPECT_EQ(kind_of(outline_of({{{0, 0}, {2, 0}, {2, 2}, {1, 0}}})), "crossing");  // a vertex on a segment
    EXPECT_EQ(kind_of(outline_of({unit_square, {{1, 1}, {2, 1}, {2, 2}, {1, 2}}})), "touching_loops");
    EXPECT_EQ(kind_of(outline_of({unit_square}, {{{0.5, 0.5}, {1, 0.5}}})), "crossing");
    EXPECT_EQ(kind_of(outline_of({unit_square}, {{{2, 2}, {3, 3}}})), "outside_line");
    EXPECT_EQ(kind_of(outline_of({unit_square}, {{{0, 0}, {1, 0}}})), "crossing");  // a line along the loop
    PlanarOutline outline = outline_of({unit_square});
    outline.loops.conservativeResize(3, 2);
    EXPECT_EQ(kind_of(outline), "open_loop");
    outline = outline_of({unit_square});
    outline.loops(0, 0) = 9;
    EXPECT_EQ(kind_of(outline), "index_out_of_range");
    outline = outline_of({unit_square});
    outline.points(2, 1) = std::nan("");
    EXPECT_EQ(kind_of(outline), "non_finite_vertex");
    outline = outline_of({unit_square});
    outline.points.conservativeResize(5, 2);
    outline.points.row(4) = outline.points.row(1);
    EXPECT_EQ(kind_of(outline), "repeated_point");
    outline = outline_of({unit_square});
    outline.lines.resize(1, 2);
    outline.lines << 1, 1;
    EXPECT_EQ(kind_of(outline), "no_length");
}

TEST(FixedBoundaryQuads, RefuseOptionsAndMeshesThatCannotBe) {
    const PlanarOutline outline = outline_of({unit_square});
    FixedBoundaryOptions options;
    options.clearance = 0.5;
    EXPECT_EQ(kind_of(outline, options), "bad_option");
    options = {};
    options.rounds = -1;
    EXPECT_EQ(kind_of(outline, options), "bad_option");
    options = {};
    options.edge_length = 1e-9;
    EXPECT_EQ(kind_of(outline, options), "too_many_quads");
    QuadMesh inside;
    inside.vertices.resize(4, 3);
    inside.vertices << 0, 0, 1, 1, 0, 1, 1, 1, 1, 0, 1, 1;
    inside.quads.resize(1, 4);
    inside.quads << 0, 1, 2, 3;
    EXPECT_EQ(kind_of(outline, {}, inside), "bad_inside_mesh");
}

TEST(OutlineOfGraph, TellsLoopsFromLinesByWhatIsOutside) {
    // A square with a square in it and a line between them.
    PlanePoints points(9, 2);
    points << 0, 0, 3, 0, 3, 3, 0, 3, 1, 1, 2, 1, 2, 2, 1, 2, 1.5, 1.5;
    Edges segments(9, 2);
    segments << 0, 1, 1, 2, 2, 3, 3, 0, 4, 5, 5, 6, 6, 7, 7, 4, 0, 4;
    const PlanarOutline whole = outline_of_graph(points.topRows(8), segments, PlanePoints(0, 2));
    EXPECT_EQ(whole.loops.rows(), 4);
    EXPECT_EQ(whole.lines.rows(), 5);
    const PlanarOutline holed = outline_of_graph(points.topRows(8), segments, points.bottomRows(1));
    EXPECT_EQ(holed.loops.rows(), 8);
    EXPECT_EQ(holed.lines.rows(), 1);
    EXPECT_THROW(outline_of_graph(points.topRows(8), segments.topRows(3), PlanePoints(0, 2)), InvalidInput);
}

}  // namespace
}  // namespace octafield::surface
