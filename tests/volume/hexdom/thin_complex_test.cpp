// Of the parts: limits that point_surface does not set alone.
#include "thin_complex.hpp"

#include <gtest/gtest.h>

#include "patched_surfaces.hpp"
#include "place_points.hpp"
#include "surface_facts.hpp"

namespace octafield::volume {
namespace {

using namespace testing;
using detail::TriangleComplex;

surface::TriangleMesh mesh_of(const TriangleComplex& complex) {
    surface::TriangleMesh mesh{complex.at, Triangles(complex.triangles.size(), 3)};
    Index count = 0;
    for (const auto& t : complex.triangles)
        if (t[0] >= 0) mesh.triangles.row(count++) << t[0], t[1], t[2];
    mesh.triangles.conservativeResize(count, 3);
    return mesh;
}

// As far as it goes when nothing but topology is in the way.
surface::TriangleMesh thinned_without_geometry(const std::vector<Map>& maps, int cells) {
    const Patched p = patched_surface(maps, {cells, 1});
    auto placed = detail::place_points(p.mesh, {}, std::vector<Index>(p.groups.size(), 0), {{}, Points(0, 3)});
    const detail::LengthBound any{std::vector<double>(placed.source.size(), 1e300)};
    const std::vector<std::uint8_t> all(placed.source.size(), 1);
    for (int round = 0; round < 5; ++round) detail::thin(placed.complex, all, any, {-2, 1e-9, 0, round % 2 == 1});
    return mesh_of(placed.complex);
}

TEST(ThinComplex, topology_alone_keeps_a_sphere_and_a_torus) {
    const surface::TriangleMesh sphere = thinned_without_geometry(sphere_maps(), 8);
    EXPECT_TRUE(closed_and_oriented(sphere));
    EXPECT_TRUE(one_fan_at_each_vertex(sphere));
    EXPECT_EQ(euler(sphere), 2);
    EXPECT_LT(sphere.triangles.rows(), 30);
    const surface::TriangleMesh torus = thinned_without_geometry(torus_maps(), 6);
    EXPECT_TRUE(closed_and_oriented(torus));
    EXPECT_TRUE(one_fan_at_each_vertex(torus));
    EXPECT_EQ(euler(torus), 0);
    EXPECT_LT(torus.triangles.rows(), 60);
    EXPECT_GE(torus.triangles.rows(), 14);  // Moebius's torus has the fewest
}

TEST(ThinComplex, topology_alone_keeps_borders_and_edges_of_three_triangles) {
    std::vector<Map> tube = cylinder_maps();
    const surface::TriangleMesh ring = thinned_without_geometry({tube[0], tube[3], tube[6], tube[9]}, 8);
    EXPECT_EQ(euler(ring), 0);
    int border = 0, inner = 0;
    for (const auto& [edge, runs] : edge_runs(ring)) ++(runs == std::pair(1, 1) ? inner : border);
    EXPECT_EQ(border, 6);
    EXPECT_EQ(ring.triangles.rows(), 6);

    std::vector<Map> boxes = box_maps({0, 0, 0}, {1, 1, 1});
    for (const Map& side : box_maps({1, 0, 0}, {2, 1, 1}, {0})) boxes.push_back(side);
    const surface::TriangleMesh wall = thinned_without_geometry(boxes, 6);
    EXPECT_EQ(euler(wall), 3);
    std::map<int, int> edges;  // of how many triangles
    std::set<std::set<Index>> triangles;
    for (const auto& [edge, runs] : edge_runs(wall)) ++edges[runs.first + runs.second];
    for (const auto t : wall.triangles.rowwise()) EXPECT_TRUE(triangles.insert({t[0], t[1], t[2]}).second);
    EXPECT_EQ(edges[3], 3);  // the rim
    EXPECT_EQ(edges.size(), 2u);
    EXPECT_LT(wall.triangles.rows(), 40);
}

TEST(ThinComplex, surfaces_that_touch_at_a_vertex_go_on_touching) {
    std::vector<Map> boxes = box_maps({0, 0, 0}, {1, 1, 1});
    for (const Map& side : box_maps({1, 1, 1}, {2, 2, 2})) boxes.push_back(side);
    const surface::TriangleMesh both = thinned_without_geometry(boxes, 5);
    EXPECT_EQ(euler(both), 3);
    EXPECT_TRUE(closed_and_oriented(both));
    const std::set<Index> used(both.triangles.data(), both.triangles.data() + both.triangles.size());
    EXPECT_LT(used.size(), 20u);
    EXPECT_EQ(std::count_if(used.begin(), used.end(),
                            [&](Index v) { return both.vertices.row(v) == Eigen::RowVector3d(1, 1, 1); }),
              1);
}

// A vertex in the middle of a polygon in the plane, which alone may go.
TriangleComplex wheel(const std::vector<Eigen::Vector2d>& ring, const Eigen::Vector2d& middle) {
    const Index n = static_cast<Index>(ring.size());
    Points places(n + 1, 3);
    for (Index i = 0; i < n; ++i) places.row(i) << ring[i].transpose(), 0;
    places.row(n) << middle.transpose(), 0;
    TriangleComplex complex(places);
    for (Index i = 0; i < n; ++i) complex.add({n, i, (i + 1) % n}, 0, i, {0, 0, 1});
    for (Index i = 0; i < n; ++i) complex.add_curve_edge(i, (i + 1) % n, true, Eigen::Vector3d::UnitX());
    return complex;
}

Index thin_middle(TriangleComplex& complex, double longest, const detail::ThinLimits& limits) {
    std::vector<std::uint8_t> removable(complex.star.size(), 0);
    removable.back() = 1;
    return detail::thin(complex, removable, {std::vector<double>(complex.star.size(), longest)}, limits);
}

double area(const TriangleComplex& complex) {
    const surface::TriangleMesh mesh = mesh_of(complex);
    double sum = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        EXPECT_GT(normal_of(mesh, t)[2], 0);
        sum += normal_of(mesh, t)[2] / 2;
    }
    return sum;
}

TEST(ThinComplex, a_star_none_of_whose_corners_sees_all_is_filled_by_ears) {
    std::vector<Eigen::Vector2d> star;
    for (int i = 0; i < 10; ++i) {
        const double angle = i * std::numbers::pi / 5, radius = i % 2 ? 0.3 : 1;
        star.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
    }
    TriangleComplex complex = wheel(star, {0, 0});
    const double before = area(complex);
    EXPECT_EQ(thin_middle(complex, 10, {0.5, 0.02, 0, false}), 0);
    EXPECT_EQ(thin_middle(complex, 10, {0.5, 0.02, 0, true}), 1);
    EXPECT_EQ(mesh_of(complex).triangles.rows(), 8);
    EXPECT_NEAR(area(complex), before, 1e-12);
}

TEST(ThinComplex, a_hub_of_many_triangles_stays_while_it_has_so_many) {
    for (const auto& [corners, goes] : {std::pair(64, 1), {65, 0}}) {
        std::vector<Eigen::Vector2d> ring;
        for (int i = 0; i < corners; ++i) {
            const double angle = 6.283185307179586 * i / corners;
            ring.emplace_back(std::cos(angle), std::sin(angle));
        }
        TriangleComplex complex = wheel(ring, {0, 0});
        EXPECT_EQ(thin_middle(complex, 1e300, {-2, 1e-9, 0, true}), goes) << corners;
    }
}

TEST(ThinComplex, a_vertex_goes_where_no_new_edge_is_too_long_or_another_is_too_near) {
    const std::vector<Eigen::Vector2d> square{{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
    for (const auto& [longest, crowded, place, goes] : {std::tuple(2.01, 0.0, 0.0, 1),
                                                        {1.9, 0.0, 0.0, 0},
                                                        {1.9, 0.3, 0.0, 0},
                                                        {1.9, 0.3, 0.8, 1},
                                                        {1.3, 0.3, 0.8, 0}}) {
        TriangleComplex complex = wheel(square, {place, 0});
        EXPECT_EQ(thin_middle(complex, longest, {0.5, 0.02, crowded, false}), goes) << longest << ' ' << place;
    }
}

}  // namespace
}  // namespace octafield::volume
