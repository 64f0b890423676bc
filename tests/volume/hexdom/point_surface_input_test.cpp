#include <gtest/gtest.h>

#include <limits>

#include "octafield/error.hpp"
#include "patched_surfaces.hpp"
#include "surface_facts.hpp"

namespace octafield::volume {
namespace {

using testing::one_group;
using namespace testing;

Patched without_points(const std::vector<Map>& maps, int cells) {
    Patched p = patched_surface(maps, {cells, 1});
    p.points = {{}, Points(0, 3)};
    p.quads.resize(0, 4);
    return p;
}

double longest_edge(const surface::TriangleMesh& mesh) {
    double longest = 0;
    for (const auto& [edge, runs] : edge_runs(mesh))
        longest = std::max(longest, (mesh.vertices.row(edge.first) - mesh.vertices.row(edge.second)).norm());
    return longest;
}

void expect_sound(const surface::TriangleMesh& mesh, int characteristic) {
    EXPECT_TRUE(closed_and_oriented(mesh));
    EXPECT_TRUE(one_fan_at_each_vertex(mesh));
    EXPECT_EQ(euler(mesh), characteristic);
}

TEST(PointSurfaceInput, without_points_is_thinned_to_edges_of_no_more_than_1_6_edge_length) {
    const Patched p = without_points(sphere_maps(), 20);
    const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.25);
    expect_sound(s.mesh, 2);
    EXPECT_LT(longest_edge(s.mesh), 1.6 * 0.25);
    // An equilateral triangle of edge 0.25 has an area of 0.027, two are had by each vertex: 230 on the sphere.
    EXPECT_LT(s.mesh.vertices.rows(), 300);
    EXPECT_GT(s.mesh.vertices.rows(), 120);
    EXPECT_LT(greatest_distance(p.mesh, s.mesh), 0.03);
    for (std::size_t v = 0; v < s.source.size(); ++v)
        EXPECT_EQ(p.mesh.vertices.row(s.source[v]), s.mesh.vertices.row(static_cast<Index>(v)));
}

TEST(PointSurfaceInput, without_points_and_bound_keeps_its_topology) {
    const Patched torus = without_points(torus_maps(), 8);
    const PointSurface s = point_surface(torus.mesh, {}, one_group(torus), torus.points, torus.quads, 100);
    expect_sound(s.mesh, 0);
    EXPECT_LT(s.mesh.vertices.rows(), 60);
    EXPECT_GT(volume_inside(s.mesh), 0.6 * volume_inside(torus.mesh));
    const Patched sphere = without_points(sphere_maps(), 8);
    expect_sound(point_surface(sphere.mesh, {}, one_group(sphere), sphere.points, sphere.quads, 100).mesh, 2);
}

TEST(PointSurfaceInput, random_points_are_all_vertices) {
    Patched p = without_points(torus_maps(), 6);
    std::mt19937 random(5);
    const Index count = 3000;
    p.points.weights.resize(count, 3);
    for (Index i = 0; i < count; ++i) {
        p.points.triangle.push_back(static_cast<Index>(random() % p.mesh.triangles.rows()));
        for (int k = 0; k < 3; ++k) p.points.weights(i, k) = random() / 4294967296.0;
        if (i % 3 == 0) p.points.weights(i, static_cast<int>(random() % 3)) = 0;
        p.points.weights.row(i) /= p.points.weights.row(i).sum();
    }
    const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.1);
    expect_sound(s.mesh, 0);
    const std::set<Index> used(s.mesh.triangles.data(), s.mesh.triangles.data() + s.mesh.triangles.size());
    EXPECT_EQ(static_cast<Index>(used.size()), s.mesh.vertices.rows());
    EXPECT_NEAR(volume_inside(s.mesh) / volume_inside(p.mesh), 1, 0.02);
}

// Both from the one triangle and from the other, in no order.
TEST(PointSurfaceInput, points_crowded_on_one_edge_become_its_chain) {
    Patched p = without_points(box_maps({0, 0, 0}, {1, 1, 1}), 3);
    const surface::FeatureGraph features = surface::detect_features(p.mesh);
    const Index a = features.edges(0, 0), b = features.edges(0, 1), count = 400;
    std::vector<std::pair<Index, int>> sides;  // triangle, corner from which it runs the edge
    for (Index t = 0; t < p.mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            if (std::minmax({p.mesh.triangles(t, k), p.mesh.triangles(t, (k + 1) % 3)}) == std::pair(a, b))
                sides.emplace_back(t, k);
    ASSERT_EQ(sides.size(), 2u);
    p.points.weights.setZero(count, 3);
    for (Index i = 0; i < count; ++i) {
        const auto [t, k] = sides[i % 2];
        const Index place = (i * 147) % count;
        const double part = 1e-6 * std::pow(1e6, (place + 0.5) / (count + 1));  // denser and denser towards a
        p.points.triangle.push_back(t);
        p.points.weights(i, k) = p.mesh.triangles(t, k) == a ? 1 - part : part;
        p.points.weights(i, (k + 1) % 3) = p.mesh.triangles(t, k) == a ? part : 1 - part;
    }
    const PointSurface s = point_surface(p.mesh, features, one_group(p), p.points, p.quads, 0.3);
    expect_sound(s.mesh, 2);
    EXPECT_NEAR(volume_inside(s.mesh), 1, 1e-12);
    EXPECT_NEAR(length_of(s.mesh, s.features.edges), 12, 1e-9);
    std::map<Index, int> degree;
    for (const auto e : s.features.edges.rowwise()) ++degree[e[0]], ++degree[e[1]];
    for (Index i = 0; i < count; ++i) EXPECT_EQ(degree[i], 2) << i;
}

// A box of needles: cells of 1 by 1/60, whose triangles have angles of a degree.
TEST(PointSurfaceInput, needles_are_replaced_by_a_lattice) {
    std::vector<Map> maps = box_maps({0, 0, 0}, {1, 1, 60});
    Patched p = patched_surface(maps, {5, 6});
    p.mesh.vertices.col(2) /= 60;
    const PointSurface s =
        point_surface(p.mesh, surface::detect_features(p.mesh), one_group(p), p.points, p.quads, 1.0 / 6);
    EXPECT_EQ(std::count(s.quad_found.begin(), s.quad_found.end(), 1), p.quads.rows());
    // Squeezed: a box of 1 by 1 by 60 with the same triangles, the lattice of needles too.
    p.mesh.vertices.col(2) *= 60;
    const PointSurface t =
        point_surface(p.mesh, surface::detect_features(p.mesh), one_group(p), p.points, p.quads, 1.0 / 6);
    EXPECT_EQ(std::count(t.quad_found.begin(), t.quad_found.end(), 1), p.quads.rows());
    expect_sound(t.mesh, 2);
}

// A vertex 1e-7 beside an edge makes two slivers, the one turned over by noise.
TEST(PointSurfaceInput, slivers_turned_over_do_not_block_what_is_round_them) {
    Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {6, 5});
    const surface::FeatureGraph features = surface::detect_features(p.mesh);
    std::vector<std::array<Index, 3>> triangles;
    Index split = -1;  // a triangle inside a side
    std::vector<Index> inner(p.mesh.vertices.rows(), 1);
    for (const auto e : features.edges.rowwise()) inner[e[0]] = inner[e[1]] = 0;
    for (Index t = 0; t < p.mesh.triangles.rows() && split < 0; ++t)
        if (inner[p.mesh.triangles(t, 0)] && inner[p.mesh.triangles(t, 1)] && inner[p.mesh.triangles(t, 2)] &&
            std::find(p.points.triangle.begin(), p.points.triangle.end(), t) == p.points.triangle.end())
            split = t;
    ASSERT_GE(split, 0);
    const Eigen::RowVector3i c = p.mesh.triangles.row(split);
    const Eigen::RowVector3d a = p.mesh.vertices.row(c[0]), b = p.mesh.vertices.row(c[1]),
                             d = p.mesh.vertices.row(c[2]);
    const Index v = static_cast<Index>(p.mesh.vertices.rows()), n = static_cast<Index>(p.mesh.triangles.rows());
    p.mesh.vertices.conservativeResize(v + 1, 3);
    p.mesh.vertices.row(v) = (a + b) / 2 - 1e-7 * (d - (a + b) / 2);
    p.mesh.triangles.conservativeResize(n + 2, 3);
    p.mesh.triangles.row(split) << c[0], c[1], v;
    p.mesh.triangles.row(n) << c[1], c[2], v;
    p.mesh.triangles.row(n + 1) << c[2], c[0], v;
    const PointSurface s = point_surface(p.mesh, features, std::vector<Index>(n + 2, 0), p.points, p.quads, 0.2);
    EXPECT_EQ(std::count(s.quad_found.begin(), s.quad_found.end(), 1), p.quads.rows());
    EXPECT_EQ(s.mesh.vertices.rows(), p.exact.rows());
}

struct Arguments {
    Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {2, 3});
    surface::FeatureGraph features = surface::detect_features(p.mesh);
    std::vector<Index> groups = one_group(p);
    double edge_length = 0.3;
};

template <class Kind = InvalidInput>
void expect_error(const std::string& kind, const std::vector<Index>& elements,
                  const std::function<void(Arguments&)>& damage) {
    SCOPED_TRACE(kind);
    Arguments x;
    EXPECT_NO_THROW(point_surface(x.p.mesh, x.features, x.groups, x.p.points, x.p.quads, x.edge_length));
    damage(x);
    try {
        point_surface(x.p.mesh, x.features, x.groups, x.p.points, x.p.quads, x.edge_length);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const Kind& e) {
        EXPECT_EQ(e.kind(), kind) << e.what();
        EXPECT_EQ(e.elements(), elements) << e.what();
    }
}

TEST(PointSurfaceInput, unusable_arguments_are_told_with_their_elements) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    expect_error("wrong_size", {}, [](Arguments& x) { x.groups.pop_back(); });
    expect_error("wrong_size", {}, [](Arguments& x) { x.p.points.triangle.pop_back(); });
    expect_error("index_out_of_range", {3}, [](Arguments& x) { x.p.mesh.triangles(3, 1) = 1000; });
    expect_error("index_out_of_range", {4}, [](Arguments& x) { x.p.points.triangle[4] = -1; });
    expect_error("index_out_of_range", {5}, [](Arguments& x) { x.p.points.triangle[5] = 48; });
    expect_error("index_out_of_range", {6}, [](Arguments& x) { x.p.quads(6, 3) = 56; });
    expect_error("index_out_of_range", {0}, [](Arguments& x) { x.features.edges(0, 1) = 1000; });
    expect_error("index_out_of_range", {2}, [](Arguments& x) { x.features.corners[2] = -1; });
    expect_error("not_an_edge", {0}, [](Arguments& x) { x.features.edges.row(0) << 0, 8; });
    expect_error("not_finite", {7}, [&](Arguments& x) { x.p.mesh.vertices(7, 1) = nan; });
    expect_error("invalid_weights", {8, 9}, [&](Arguments& x) {
        x.p.points.weights(8, 0) = nan;
        x.p.points.weights.row(9) << -0.25, 0.25, 1;
    });
    expect_error("invalid_weights", {1}, [](Arguments& x) { x.p.points.weights.row(1) << 0.5, 0.25, 0; });
    expect_error("repeated_vertex", {2}, [](Arguments& x) { x.p.quads(2, 2) = x.p.quads(2, 0); });
    for (const double length : {0.0, -1.0, nan})
        expect_error("invalid_option", {}, [&](Arguments& x) { x.edge_length = length; });
}

TEST(PointSurfaceInput, triangles_of_no_area_are_told) {
    expect_error<GeometryError>("degenerate_triangle", {3},
                                [](Arguments& x) { x.p.mesh.triangles(3, 1) = x.p.mesh.triangles(3, 0); });
    Arguments x;
    const Index a = x.p.mesh.triangles(0, 0), b = x.p.mesh.triangles(0, 1);
    std::vector<Index> bad;
    for (Index t = 0; t < x.p.mesh.triangles.rows(); ++t)
        if ((x.p.mesh.triangles.row(t).array() == a).any() && (x.p.mesh.triangles.row(t).array() == b).any())
            bad.push_back(t);
    expect_error<GeometryError>("degenerate_triangle", bad,
                                [&](Arguments& y) { y.p.mesh.vertices.row(a) = y.p.mesh.vertices.row(b); });
}

void expect_coincident(Index triangle, const Eigen::Vector3d& weights, Index other, const Eigen::Vector3d& there) {
    Arguments x;
    x.p.points.triangle = {0, triangle, other};
    x.p.points.weights.resize(3, 3);
    x.p.points.weights << 0.6, 0.3, 0.1, weights.transpose(), there.transpose();
    x.p.quads.resize(0, 4);
    try {
        point_surface(x.p.mesh, {}, x.groups, x.p.points, x.p.quads, x.edge_length);
        ADD_FAILURE() << "nothing was thrown";
    } catch (const InvalidInput& e) {
        EXPECT_EQ(e.kind(), "coincident_points");
        EXPECT_EQ(e.elements(), (std::vector<Index>{1, 2}));
    }
}

TEST(PointSurfaceInput, points_at_one_place_are_told_be_it_a_vertex_an_edge_or_a_face) {
    const Arguments x;
    const Triangles& t = x.p.mesh.triangles;
    const auto one = [](int k) { return Eigen::Vector3d::Unit(k); };
    for (Index other = 1; other < t.rows(); ++other)
        for (int k = 0; k < 3; ++k)
            for (int j = 0; j < 3; ++j) {
                if (t(0, k) != t(other, j)) continue;
                expect_coincident(0, one(k), other, one(j));
                const int next = (k + 1) % 3, before = (j + 2) % 3;
                if (t(0, next) == t(other, before))
                    expect_coincident(0, 0.3 * one(k) + 0.7 * one(next), other, 0.3 * one(j) + 0.7 * one(before));
            }
    expect_coincident(5, {0.2, 0.5, 0.3}, 5, {0.2, 0.5, 0.3});
    expect_coincident(5, {0.2, 0.8, 0}, 5, {0.2, 0.8, 1e-12});  // rounding off the edge
}

TEST(PointSurfaceInput, a_surface_of_nothing_gives_nothing) {
    const PointSurface s = point_surface({Points(0, 3), Triangles(0, 3)}, {}, {}, {{}, Points(0, 3)}, Quads(0, 4), 1);
    EXPECT_EQ(s.mesh.triangles.rows(), 0);
    EXPECT_EQ(s.mesh.vertices.rows(), 0);
}

}  // namespace
}  // namespace octafield::volume
