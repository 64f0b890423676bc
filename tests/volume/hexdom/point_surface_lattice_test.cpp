#include <gtest/gtest.h>

#include "patched_surfaces.hpp"
#include "surface_facts.hpp"

namespace octafield::volume {
namespace {

using testing::found;
using testing::one_group;
using namespace testing;

std::set<std::set<Index>> triangle_sets(const surface::TriangleMesh& mesh) {
    std::set<std::set<Index>> sets;
    for (const auto t : mesh.triangles.rowwise()) sets.insert({t[0], t[1], t[2]});
    return sets;
}

int quads_of_two_triangles(const surface::TriangleMesh& mesh, const Quads& quads) {
    const auto sets = triangle_sets(mesh);
    int count = 0;
    for (const auto q : quads.rowwise())
        count += (sets.count({q[0], q[1], q[2]}) && sets.count({q[0], q[2], q[3]})) ||
                 (sets.count({q[1], q[2], q[3]}) && sets.count({q[1], q[3], q[0]}));
    return count;
}

struct Shape {
    const char* name;
    std::vector<Map> maps;
    double edge_length;  // of a lattice of one cell along each square
    bool features;
};

std::vector<Shape> shapes() {
    return {{"box", box_maps({0, 0, 0}, {1, 1, 1}), 1, true},
            {"sphere", sphere_maps(), 1.2, false},
            {"torus", torus_maps(), 1, false},
            {"cylinder", cylinder_maps(), 1.3, true}};
}

surface::FeatureGraph features_of(const Shape& shape, const Patched& p) {
    return shape.features ? surface::detect_features(p.mesh) : surface::FeatureGraph{};
}

// Triangles of 1/12 of a square; spacings of 12/5, 1 or nearly, and less than 1/2 of that.
TEST(PointSurface, is_made_of_all_quads_of_a_lattice_at_any_spacing_and_of_nothing_else) {
    for (const Shape& shape : shapes())
        for (const int lattice : {5, 6, 11, 12, 24, 25}) {
            SCOPED_TRACE(std::string(shape.name) + ", lattice " + std::to_string(lattice));
            const Patched p = patched_surface(shape.maps, {12, lattice});
            const PointSurface s = point_surface(p.mesh, features_of(shape, p), one_group(p), p.points, p.quads,
                                                 shape.edge_length / lattice);
            EXPECT_EQ(found(s), p.quads.rows());
            EXPECT_EQ(quads_of_two_triangles(s.mesh, p.quads), p.quads.rows());
            EXPECT_EQ(s.mesh.triangles.rows(), 2 * p.quads.rows());
            EXPECT_EQ(s.mesh.vertices.rows(), p.exact.rows());
            EXPECT_TRUE(closed_and_oriented(s.mesh));
            EXPECT_TRUE(one_fan_at_each_vertex(s.mesh));
            EXPECT_EQ(euler(s.mesh), euler(p.mesh));
            const double coarse = 1.0 / (lattice * lattice) + 1.0 / 144;
            EXPECT_NEAR(volume_inside(s.mesh) / volume_inside(p.mesh), 1, 1.5 * coarse);
        }
}

// Quads whose sides are no edges of a Delaunay triangulation: they are made, and stay through all flips for better
// angles.
TEST(PointSurface, is_made_of_sheared_quads) {
    for (const double shear : {1.0, 2.0, 3.0})
        for (const int lattice : {6, 17}) {
            SCOPED_TRACE(std::to_string(shear) + ", lattice " + std::to_string(lattice));
            const Patched p = patched_surface(
                {[shear](double u, double v) { return Eigen::Vector3d(u + shear * v, v, 0); }}, {12, lattice});
            const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 1.0 / lattice);
            EXPECT_EQ(found(s), p.quads.rows());
            EXPECT_NEAR(area_of(s.mesh), 1, 1e-12);
        }
}

TEST(PointSurface, has_the_points_first_where_their_weights_put_them) {
    const Patched p = patched_surface(sphere_maps(), {8, 9});
    const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.15);
    for (Index i = 0; i < p.points.weights.rows(); ++i) {
        Eigen::Vector3d place = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k)
            place +=
                p.points.weights(i, k) * p.mesh.vertices.row(p.mesh.triangles(p.points.triangle[i], k)).transpose();
        ASSERT_LT((s.mesh.vertices.row(i).transpose() - place).norm(), 1e-15) << i;
    }
}

TEST(PointSurface, says_which_old_vertex_a_vertex_is) {
    const Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {4, 4, 0.2, 2, 0.5});
    const PointSurface s =
        point_surface(p.mesh, surface::detect_features(p.mesh), one_group(p), p.points, p.quads, 0.25);
    ASSERT_EQ(s.source.size(), static_cast<std::size_t>(s.mesh.vertices.rows()));
    int named = 0;
    for (Index v = 0; v < s.mesh.vertices.rows(); ++v) {
        bool there = false;
        for (const auto old : p.mesh.vertices.rowwise()) there = there || old == s.mesh.vertices.row(v);
        EXPECT_EQ(s.source[v] >= 0, there) << v;
        if (s.source[v] < 0) continue;
        EXPECT_EQ(p.mesh.vertices.row(s.source[v]), s.mesh.vertices.row(v));
        ++named;
    }
    EXPECT_GE(named, 8 + 12 * 3);  // lattice points along the edges of the box are vertices of it
}

// Points left out: old vertices stay in the holes of the lattice, and the quads that are left are all made.
TEST(PointSurface, keeps_old_vertices_where_the_lattice_has_holes) {
    for (const int lattice : {8, 12, 24}) {
        const Patched p = patched_surface(torus_maps(), {12, lattice, 0.4, 7, 0.2});
        const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 1.0 / lattice);
        EXPECT_GE(found(s), 0.998 * static_cast<double>(p.quads.rows()));
        EXPECT_EQ(found(s), quads_of_two_triangles(s.mesh, p.quads));
        EXPECT_GT(s.mesh.vertices.rows(), p.exact.rows());
        EXPECT_TRUE(closed_and_oriented(s.mesh));
        EXPECT_TRUE(one_fan_at_each_vertex(s.mesh));
        EXPECT_EQ(euler(s.mesh), 0);
    }
}

// The nearest old triangle is searched among all, and those as near: none that counts is turned by less than the bound
// from the new one.
TEST(PointSurface, turns_no_triangle_by_60_degrees_from_the_surface_beneath) {
    for (const int lattice : {3, 12, 24}) {
        const Patched p = patched_surface(torus_maps(), {10, lattice, 0.4, 3, 0.3});
        const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 1.0 / lattice);
        const Index step = 1 + static_cast<Index>(s.mesh.triangles.rows() / 500);
        for (Index t = 0; t < s.mesh.triangles.rows(); t += step) {
            const auto corner = [&](int k) -> Eigen::Vector3d { return s.mesh.vertices.row(s.mesh.triangles(t, k)); };
            const Eigen::Vector3d middle = (corner(0) + corner(1) + corner(2)) / 3;
            double least = 1e300;
            Index nearest = -1;
            for (Index o = 0; o < p.mesh.triangles.rows(); ++o) {
                const auto old = [&](int k) -> Eigen::Vector3d { return p.mesh.vertices.row(p.mesh.triangles(o, k)); };
                if (const double d = distance_to_triangle(middle, old(0), old(1), old(2)); d < least)
                    least = d, nearest = o;
            }
            EXPECT_GT(normal_of(s.mesh, t).normalized().dot(normal_of(p.mesh, nearest).normalized()), 0.5) << t;
            EXPECT_LT(least, 0.3 / lattice);
        }
    }
}

TEST(PointSurface, stays_near_the_old_surface_both_ways) {
    const Patched p = patched_surface(sphere_maps(), {12, 6, 0.4, 3, 0.3});
    const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.2);
    // An edge of twice 1.6 * 0.2 on the unit sphere has a sagitta of 0.05.
    EXPECT_LT(greatest_distance(s.mesh, p.mesh), 1e-12);
    EXPECT_LT(greatest_distance(p.mesh, s.mesh), 0.05);
}

TEST(PointSurface, does_not_make_a_quad_across_a_feature_nor_one_that_is_no_quad_of_the_surface) {
    const Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {6, 4});
    const auto at = [&](double x, double y, double z) {
        for (Index i = 0; i < p.exact.rows(); ++i)
            if ((p.exact.row(i) - Eigen::RowVector3d(x, y, z)).norm() < 1e-9) return i;
        return Index(-1);
    };
    Quads quads(3, 4);
    quads.row(0) << at(0.25, 0.25, 1), at(0.75, 0.25, 1), at(0.75, 0.25, 0), at(0.25, 0.25, 0);  // through the box
    quads.row(1) << at(0.5, 0, 1), at(0.75, 0.25, 1), at(0.75, 0, 1), at(0.75, 0, 0.75);         // over an edge
    quads.row(2) << at(0.25, 0.5, 1), at(0.5, 0.5, 1), at(0.5, 0.75, 1), at(0.25, 0.75, 1);      // one that is
    ASSERT_GE(quads.minCoeff(), 0);
    const PointSurface s = point_surface(p.mesh, surface::detect_features(p.mesh), one_group(p), p.points, quads, 0.25);
    EXPECT_EQ(s.quad_found, (std::vector<std::uint8_t>{0, 0, 1}));
    EXPECT_NEAR(volume_inside(s.mesh), 1, 1e-12);
}

TEST(PointSurface, has_the_same_bits_each_time) {
    const Patched p = patched_surface(torus_maps(), {8, 9, 0.4, 3, 0.3});
    const PointSurface a = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.1);
    const PointSurface b = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 0.1);
    EXPECT_EQ(a.mesh.vertices, b.mesh.vertices);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.triangle, b.triangle);
    EXPECT_EQ(a.quad_found, b.quad_found);
}

}  // namespace
}  // namespace octafield::volume
