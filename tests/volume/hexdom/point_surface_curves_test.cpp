#include <gtest/gtest.h>

#include "patched_surfaces.hpp"
#include "surface_facts.hpp"

namespace octafield::volume {
namespace {

using testing::found;
using testing::one_group;
using namespace testing;

surface::FeatureGraph box_features(const Patched& p) { return surface::detect_features(p.mesh); }

void keep_points(Patched& p, const std::function<bool(const Eigen::Vector3d&)>& wanted) {
    std::vector<Index> kept, triangle;
    for (Index i = 0; i < p.exact.rows(); ++i)
        if (wanted(p.exact.row(i))) kept.push_back(i), triangle.push_back(p.points.triangle[i]);
    p.points = {triangle, Points(p.points.weights(kept, Eigen::all))};
    p.exact = Points(p.exact(kept, Eigen::all));
    p.quads.resize(0, 4);
}

std::map<std::pair<Index, Index>, int> triangles_at_edges(const surface::TriangleMesh& mesh) {
    std::map<std::pair<Index, Index>, int> result;
    for (const auto& [edge, runs] : edge_runs(mesh)) result[edge] = runs.first + runs.second;
    return result;
}

double length_of_edges_with(const surface::TriangleMesh& mesh, int triangles) {
    double sum = 0;
    for (const auto& [edge, count] : triangles_at_edges(mesh))
        if (count == triangles) sum += (mesh.vertices.row(edge.first) - mesh.vertices.row(edge.second)).norm();
    return sum;
}

double area_of_group(const surface::TriangleMesh& mesh, const std::vector<Index>& groups, Index group) {
    double sum = 0;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (groups[t] == group) sum += normal_of(mesh, t).norm() / 2;
    return sum;
}

std::vector<Index> groups_of(const PointSurface& s, const std::vector<Index>& old) {
    std::vector<Index> result;
    for (const Index t : s.triangle) result.push_back(old.at(t));
    return result;
}

TEST(PointSurfaceCurves, features_of_a_box_stay_with_their_corners_whether_points_are_on_them_or_not) {
    for (const bool on_edges : {true, false}) {
        Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {9, 7});
        if (!on_edges)
            keep_points(
                p, [](const Eigen::Vector3d& x) { return (x.array() > 1e-9 && x.array() < 1 - 1e-9).count() == 2; });
        const PointSurface s = point_surface(p.mesh, box_features(p), one_group(p), p.points, p.quads, 1.0 / 7);
        EXPECT_NEAR(length_of(s.mesh, s.features.edges), 12, 1e-12);
        ASSERT_EQ(s.features.corners.size(), 8u);
        for (const Index v : s.features.corners)
            for (int k = 0; k < 3; ++k) EXPECT_EQ(s.mesh.vertices(v, k) * (1 - s.mesh.vertices(v, k)), 0);
        const auto edges = triangles_at_edges(s.mesh);
        for (const auto e : s.features.edges.rowwise()) {
            EXPECT_LT(e[0], e[1]);
            EXPECT_TRUE(edges.count({e[0], e[1]}));
        }
        EXPECT_TRUE(std::is_sorted(s.features.corners.begin(), s.features.corners.end()));
        EXPECT_NEAR(volume_inside(s.mesh), 1, 1e-12);
        EXPECT_NEAR(area_of(s.mesh), 6, 1e-12);
        if (!on_edges) {
            EXPECT_LT(s.features.edges.rows(), 12 * 9);
        }
    }
}

TEST(PointSurfaceCurves, a_curve_becomes_the_chain_of_the_points_on_it) {
    const Patched p = patched_surface(cylinder_maps(), {12, 5});
    const surface::FeatureGraph rims = surface::detect_features(p.mesh);
    ASSERT_EQ(rims.corners.size(), 0u);
    const PointSurface s = point_surface(p.mesh, rims, one_group(p), p.points, p.quads, 0.3);
    std::set<Index> on_rim;
    for (Index i = 0; i < p.exact.rows(); ++i)
        if (p.exact.row(i).head<2>().norm() > 1 - 1e-9 && (p.exact(i, 2) == 0 || p.exact(i, 2) == 2)) on_rim.insert(i);
    ASSERT_EQ(on_rim.size(), 2u * 4 * 5);
    EXPECT_EQ(std::set<Index>(s.features.edges.data(), s.features.edges.data() + s.features.edges.size()), on_rim);
    EXPECT_EQ(s.features.edges.rows(), 40);
    std::map<Index, int> degree;
    for (const auto e : s.features.edges.rowwise()) ++degree[e[0]], ++degree[e[1]];
    for (const auto& [v, d] : degree) EXPECT_EQ(d, 2) << v;
}

TEST(PointSurfaceCurves, a_circle_without_points_keeps_turning_by_less_than_60_degrees_from_itself) {
    Patched p = patched_surface(cylinder_maps(), {12, 1});
    keep_points(p, [](const Eigen::Vector3d&) { return false; });
    const PointSurface s = point_surface(p.mesh, surface::detect_features(p.mesh), one_group(p), p.points, p.quads, 10);
    EXPECT_GE(s.features.edges.rows(), 2 * 4);  // a chord of an arc of 120 degrees turns by 60 at its ends
    EXPECT_LT(s.features.edges.rows(), 2 * 12);
    EXPECT_EQ(euler(s.mesh), 2);
    EXPECT_TRUE(closed_and_oriented(s.mesh));
}

// Groups without features: their borders are kept all the same.
TEST(PointSurfaceCurves, groups_are_not_mixed) {
    for (const int lattice : {5, 8, 16}) {
        const Patched p = patched_surface(box_maps({0, 0, 0}, {1, 1, 1}), {8, lattice});
        const PointSurface s = point_surface(p.mesh, {}, p.groups, p.points, p.quads, 1.0 / lattice);
        const std::vector<Index> groups = groups_of(s, p.groups);
        for (Index g = 0; g < 6; ++g) EXPECT_NEAR(area_of_group(s.mesh, groups, g), 1, 1e-12);
        EXPECT_EQ(found(s), p.quads.rows());
        EXPECT_EQ(s.features.edges.rows(), 0);
    }
}

std::vector<Map> two_boxes() {
    std::vector<Map> maps = box_maps({0, 0, 0}, {1, 1, 1});  // side 1, at x = 1, is the wall
    for (const Map& side : box_maps({1, 0, 0}, {2, 1, 1}, {0})) maps.push_back(side);
    return maps;
}

TEST(PointSurfaceCurves, a_wall_between_two_boxes_keeps_its_edges_of_three_triangles) {
    for (const bool grouped : {false, true})
        for (const int lattice : {4, 8, 9, 17}) {
            SCOPED_TRACE(lattice);
            const Patched p = patched_surface(two_boxes(), {8, lattice});
            Edges sharp(
                0, 2);  // kept as edges of three triangles are; the others of the boxes are groups' borders or not kept
            const PointSurface s =
                point_surface(p.mesh, {sharp, {}}, grouped ? p.groups : one_group(p), p.points, p.quads, 1.0 / lattice);
            EXPECT_NEAR(length_of_edges_with(s.mesh, 3), 4, 1e-12);
            for (const auto& [edge, count] : triangles_at_edges(s.mesh)) EXPECT_TRUE(count == 2 || count == 3);
            EXPECT_EQ(euler(s.mesh), euler(p.mesh));
            EXPECT_GE(found(s), (grouped ? 1 : 0.9) * static_cast<double>(p.quads.rows()));
            if (!grouped) continue;
            const std::vector<Index> groups = groups_of(s, p.groups);
            for (Index g = 0; g < 11; ++g) EXPECT_NEAR(area_of_group(s.mesh, groups, g), 1, 1e-12) << g;
        }
}

TEST(PointSurfaceCurves, a_wall_without_points_is_thinned_with_its_edges_of_three_triangles) {
    Patched p = patched_surface(two_boxes(), {8, 2});
    keep_points(p, [](const Eigen::Vector3d&) { return false; });
    const PointSurface s = point_surface(p.mesh, {}, p.groups, p.points, p.quads, 10);
    EXPECT_NEAR(length_of_edges_with(s.mesh, 3), 4, 1e-12);
    EXPECT_EQ(s.mesh.vertices.rows(), 12);
    EXPECT_EQ(s.mesh.triangles.rows(), 22);
    EXPECT_EQ(euler(s.mesh), 3);
}

TEST(PointSurfaceCurves, holes_and_borders_stay) {
    std::vector<Map> tube = cylinder_maps();  // without its caps: an annulus
    const std::vector<Map> sides{tube[0], tube[3], tube[6], tube[9]};
    for (const int lattice : {3, 10, 20}) {
        const Patched p = patched_surface(sides, {10, lattice});
        const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 1.3 / lattice);
        EXPECT_EQ(euler(s.mesh), 0);
        EXPECT_EQ(found(s), p.quads.rows());
        double chords = 0;  // along the old edges where the lattice is finer than them
        for (const double z : {0.0, 2.0})
            chords += z >= 0 ? 2 * 4 * lattice * std::sin(std::numbers::pi / 4 / lattice) : 0;
        EXPECT_NEAR(length_of_edges_with(s.mesh, 1), chords, 4 * std::numbers::pi * 0.004);
    }
}

TEST(PointSurfaceCurves, a_border_of_a_plane_without_points_becomes_its_corners) {
    std::vector<Map> square{[](double u, double v) { return Eigen::Vector3d(u, v, 0); }};
    Patched p = patched_surface(square, {8, 2});
    keep_points(p, [](const Eigen::Vector3d&) { return false; });
    const surface::FeatureGraph border = surface::detect_features(p.mesh);
    ASSERT_EQ(border.corners.size(), 4u);
    for (const bool named : {true, false}) {
        const PointSurface s =
            point_surface(p.mesh, named ? border : surface::FeatureGraph{}, one_group(p), p.points, p.quads, 10);
        EXPECT_EQ(s.mesh.vertices.rows(), 4);
        EXPECT_EQ(s.mesh.triangles.rows(), 2);
        EXPECT_NEAR(area_of(s.mesh), 1, 1e-12);
    }
}

// The plane's square, its border kept as edges of one triangle are.
Patched flat_square(int cells) {
    Patched p = patched_surface({[](double u, double v) { return Eigen::Vector3d(u, v, 0); }}, {cells, 2});
    keep_points(p, [](const Eigen::Vector3d&) { return false; });
    return p;
}

TEST(PointSurfaceCurves, a_border_in_a_plane_keeps_its_shape) {
    Patched p = flat_square(16);
    for (Index v = 0; v < p.mesh.vertices.rows(); ++v) {  // the square to a disc
        const double x = 2 * p.mesh.vertices(v, 0) - 1, y = 2 * p.mesh.vertices(v, 1) - 1;
        p.mesh.vertices.row(v) << x * std::sqrt(1 - y * y / 2), y * std::sqrt(1 - x * x / 2), 0;
    }
    const PointSurface s = point_surface(p.mesh, {}, one_group(p), p.points, p.quads, 10);
    EXPECT_GE(s.mesh.vertices.rows(), 4);  // a triangle would turn by 60 degrees from the circle
    EXPECT_GT(area_of(s.mesh), 1.5);       // of pi; that of a triangle is 1.3
}

TEST(PointSurfaceCurves, corners_stay_even_where_nothing_turns) {
    const Patched p = flat_square(8);
    std::vector<Index> corners;
    for (Index v = 0; v < p.mesh.vertices.rows(); ++v)
        if (v % 7 == 3) corners.push_back(v);
    const PointSurface s = point_surface(p.mesh, {Edges(0, 2), corners}, one_group(p), p.points, p.quads, 10);
    ASSERT_EQ(s.features.corners.size(), corners.size());
    for (std::size_t i = 0; i < corners.size(); ++i) EXPECT_EQ(s.source[s.features.corners[i]], corners[i]);
}

// A feature that ends where nobody named a corner, on a border of groups that goes on.
TEST(PointSurfaceCurves, a_feature_ends_where_it_did_along_a_border_of_groups) {
    Patched p = flat_square(8);
    std::vector<Index> groups;
    for (const auto t : p.mesh.triangles.rowwise()) {
        const Eigen::RowVector3d middle =
            (p.mesh.vertices.row(t[0]) + p.mesh.vertices.row(t[1]) + p.mesh.vertices.row(t[2])) / 3;
        groups.push_back(middle[0] > 0.5);
    }
    std::vector<std::pair<Index, Index>> along;  // the border of the groups, below y = 0.6
    double all = 0, below = 0;
    std::map<std::pair<Index, Index>, std::set<Index>> groups_at;
    for (Index t = 0; t < p.mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            groups_at[std::minmax({p.mesh.triangles(t, k), p.mesh.triangles(t, (k + 1) % 3)})].insert(groups[t]);
    for (const auto& [edge, there] : groups_at) {
        if (there.size() < 2) continue;
        const Eigen::RowVector3d a = p.mesh.vertices.row(edge.first), b = p.mesh.vertices.row(edge.second);
        all += (a - b).norm();
        if (std::max(a[1], b[1]) > 0.6) continue;
        below += (a - b).norm();
        along.push_back(edge);
    }
    Edges edges(along.size(), 2);
    for (std::size_t i = 0; i < along.size(); ++i) edges.row(i) << along[i].first, along[i].second;
    const PointSurface s = point_surface(p.mesh, {edges, {}}, groups, p.points, p.quads, 0.3);
    EXPECT_LT(length_of(s.mesh, s.features.edges), below + 1e-12);
    EXPECT_GT(length_of(s.mesh, s.features.edges), 0.5 * below);
    double highest = 0, old_highest = 0;  // where the feature ends
    for (const auto e : s.features.edges.rowwise())
        for (const Index v : e) highest = std::max(highest, s.mesh.vertices(v, 1));
    for (const auto e : edges.rowwise())
        for (const Index v : e) old_highest = std::max(old_highest, p.mesh.vertices(v, 1));
    EXPECT_EQ(highest, old_highest);
    EXPECT_GT(all, 1);
    int border = 0;  // jagged, without being kept for its turns
    const std::vector<Index> new_groups = groups_of(s, groups);
    std::map<std::pair<Index, Index>, std::set<Index>> new_groups_at;
    for (Index t = 0; t < s.mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k)
            new_groups_at[std::minmax({s.mesh.triangles(t, k), s.mesh.triangles(t, (k + 1) % 3)})].insert(
                new_groups[t]);
    for (const auto& [edge, there] : new_groups_at) border += there.size() == 2;
    EXPECT_LT(border, 8);
}

TEST(PointSurfaceCurves, edges_that_both_triangles_run_alike_stay) {
    Patched p = flat_square(8);
    const surface::FeatureGraph border = surface::detect_features(p.mesh);
    for (auto t : p.mesh.triangles.rowwise())
        if (p.mesh.vertices(t[0], 0) + p.mesh.vertices(t[1], 0) + p.mesh.vertices(t[2], 0) > 1.5) std::swap(t[0], t[1]);
    const auto alike = [](const surface::TriangleMesh& mesh) {
        double sum = 0;
        for (const auto& [edge, runs] : edge_runs(mesh))
            if (runs.first == 2 || runs.second == 2)
                sum += (mesh.vertices.row(edge.first) - mesh.vertices.row(edge.second)).norm();
        return sum;
    };
    const PointSurface s = point_surface(p.mesh, border, one_group(p), p.points, p.quads, 0.3);
    EXPECT_LT(s.mesh.triangles.rows(), p.mesh.triangles.rows() / 2);
    EXPECT_GT(alike(p.mesh), 1);
    EXPECT_GT(alike(s.mesh), 0.8 * alike(p.mesh));  // corners of the zigzag cut
    EXPECT_NEAR(area_of(s.mesh), 1, 1e-12);
}

}  // namespace
}  // namespace octafield::volume
