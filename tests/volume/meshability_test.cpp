#include "octafield/volume/meshability.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "sphere_triangulations.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;
using testing::kuhn_grid;
using testing::sample;

TEST(HexVertices, AreTheTriangulationsOfTheSphereWithTheirDegrees) {
    constexpr std::array<std::size_t, 7> known_numbers{1, 1, 2, 5, 14, 50, 233};  // OEIS A000109
    std::set<std::array<int, 3>> types;
    for (int corners = 4; corners <= 10; ++corners) {
        const auto all = testing::all_triangulations(corners);
        ASSERT_EQ(all.size(), known_numbers[corners - 4]);
        for (const auto& triangulation : all) {
            const auto degrees = triangulation.degrees();
            const auto number = [&](int d) { return static_cast<int>(std::count(degrees.begin(), degrees.end(), d)); };
            if (number(3) + number(4) + number(5) + number(6) == corners)
                types.insert({number(3), number(5), number(6)});
        }
    }
    for (int v3 = 0; v3 <= 12; ++v3)
        for (int v5 = 0; v5 <= 12; ++v5)
            for (int v6 = 0; v6 <= 12; ++v6) {
                const int twice_regular = 12 - 3 * v3 - v5;
                if (twice_regular < 0 || twice_regular % 2 != 0) {
                    EXPECT_FALSE(hex_vertex_exists(v3, v5, v6));
                } else if (v3 + v5 + v6 + twice_regular / 2 <= 10) {
                    EXPECT_EQ(hex_vertex_exists(v3, v5, v6), types.contains({v3, v5, v6}))
                        << v3 << ' ' << v5 << ' ' << v6;
                }
            }
}

// Liu et al. 2018 and Zhang et al. 2022: the regular vertex, two curves passing, and eight nodes.
TEST(HexVertices, OfValencesThreeToFiveAreElevenTypes) {
    std::set<std::pair<int, int>> types;
    for (int v3 = 0; v3 <= 12; ++v3)
        for (int v5 = 0; v5 <= 12; ++v5)
            if (hex_vertex_exists(v3, v5, 0)) types.insert({v3, v5});
    EXPECT_EQ(types, (std::set<std::pair<int, int>>{
                         {0, 0}, {2, 0}, {0, 2}, {4, 0}, {2, 2}, {1, 3}, {2, 6}, {0, 4}, {0, 6}, {0, 8}, {0, 12}}));
    EXPECT_THROW(hex_vertex_exists(-1, 0, 0), InvalidInput);
}

Meshability check_field(const TetMesh& mesh, const Quaternions& frames) {
    return local_meshability(mesh, frames, singular_graph(mesh, frames));
}

// [-1/2, 1/2]^3, moved a little so that lines along z through `lines` meet no vertex, edge or diagonal.
TetMesh cube(int n) { return kuhn_grid(n, n, n, 1.0 / n, Vector3(-0.5 + 0.137 / n, -0.5 + 0.071 / n, -0.5)); }

// A field in the plane, the same at every z: a quarter turn round each point, in the sense of its sign.
Quaternions extruded(const TetMesh& mesh, const std::vector<Vector3>& points_and_signs) {
    return sample(mesh, [&](const Vector3& x) {
        double angle = 0;
        for (const Vector3& p : points_and_signs) angle += p.z() * std::atan2(x.y() - p.y(), x.x() - p.x()) / 4;
        return frames::exp({0, 0, angle});
    });
}

TEST(Meshability, OfAnExtrudedFieldEveryLineEndsTwiceAtASingularPointOfTheSurface) {
    const TetMesh mesh = cube(12);
    const Meshability found =
        check_field(mesh, extruded(mesh, {{0.25, 0.25, 1}, {-0.25, 0.25, 1}, {-0.25, -0.25, 1}, {0.25, -0.25, -1}}));
    ASSERT_EQ(found.vertices.size(), 8u);
    EXPECT_EQ(found.boundary_ends, 8);
    EXPECT_EQ(found.boundary_ends_about_normal, 8);
    EXPECT_EQ(found.non_meshable_vertices, 0);
    EXPECT_EQ(found.non_meshable_junctions, 0);
    EXPECT_EQ(found.closed_curves, 0);
    ASSERT_EQ(found.ends.size(), 8u);
    for (std::size_t e = 0; e < found.ends.size(); ++e) {
        const SingularEnd& end = found.ends[e];
        EXPECT_EQ(end.vertex, static_cast<Index>(e));
        EXPECT_NEAR(std::abs(end.axis.z()), 1, 1e-12);
        EXPECT_LT(end.angle, 0.5);
    }
    EXPECT_EQ(found.non_meshable_curves, 0);
    int valence3 = 0, valence5 = 0;
    for (const SingularVertex& v : found.vertices) {
        EXPECT_EQ(v.kind, SingularVertexKind::boundary_end);
        valence3 += v.valence3, valence5 += v.valence5;
    }
    EXPECT_EQ(valence3, 6);
    EXPECT_EQ(valence5, 2);
    for (Eigen::Index c = 0; c < found.curve_ends.rows(); ++c) {
        EXPECT_GE(found.curve_ends(c, 0), 0);
        EXPECT_NE(found.curve_ends(c, 0), found.curve_ends(c, 1));
    }
}

TEST(Meshability, ALineTurningAboutAnAxisAlongTheSurfaceEndsAtNoSurfaceSingularity) {
    const TetMesh mesh = cube(8);
    const Vector3 axis(std::sqrt(0.75), 0, 0.5);  // 60 degrees from the line; another axis is always nearer to it
    const Quaternion base = frames::frame_from_axes({0, 0, 1}, axis);
    const Meshability found = check_field(
        mesh, sample(mesh, [&](const Vector3& x) { return frames::exp(std::atan2(x.y(), x.x()) / 4 * axis) * base; }));
    EXPECT_EQ(found.boundary_ends, 2);
    EXPECT_EQ(found.boundary_ends_about_normal, 0);
    EXPECT_GE(found.non_meshable_vertices, 2);
}

TEST(Meshability, ARingEndsNowhere) {
    // As (e_r, e_phi, e_z) in a ring round the z axis, turned about e_phi by a quarter of the angle round its core.
    const double h = 1.0 / 12;
    const TetMesh mesh = kuhn_grid(24, 24, 12, h, Vector3(-1 + 0.013 * h, -1 + 0.029 * h, -0.5 + 0.17 * h),
                                   [](int i, int j, int) { return i < 8 || i >= 16 || j < 8 || j >= 16; });
    const Meshability found =
        check_field(mesh, sample(mesh, [](const Vector3& x) {
                        const double psi = std::atan2(x.z(), std::hypot(x.x(), x.y()) - 0.7);
                        return frames::exp({0, 0, std::atan2(x.y(), x.x())}) * frames::exp({0, -psi / 4, 0});
                    }));
    EXPECT_EQ(found.closed_curves, 1);
    EXPECT_TRUE(found.vertices.empty());
    EXPECT_EQ(found.curve_ends(0, 0), -1);
    EXPECT_EQ(found.non_meshable_vertices, 0);
}

// A tetrahedron cut into four hexahedra has a frame per corner, and a curve of valence 3 from the centre through each
// face.
TEST(Meshability, FourCurvesOfValenceThreeMeetInATetrahedronCutIntoHexahedra) {
    TetMesh mesh{Points(4, 3), Tets(1, 4)};
    mesh.vertices << 1, 1, 1, 1, -1, -1, -1, -1, 1, -1, 1, -1;
    mesh.tets << 0, 1, 2, 3;
    ASSERT_GT(tet_volumes(mesh)[0], 0);
    // The hexahedron at a corner has its axes as near as can be to the three edges there: of a cube standing on its
    // corner, the third turn about the corner's direction taking each to the next.
    const Quaternions frames = sample(mesh, [&](const Vector3& corner) {
        Eigen::Matrix3d axes;
        int column = 0;
        const Vector3 up = corner.normalized();
        for (int k = 0; k < 4; ++k) {
            const Vector3 edge = corner - Vector3(mesh.vertices.row(k));
            if (edge.norm() < 1e-9) continue;
            const Vector3 flat = (edge - up * up.dot(edge)).normalized();
            axes.col(column++) = std::sqrt(1.0 / 3) * up + std::sqrt(2.0 / 3) * flat;
        }
        if (axes.determinant() < 0) axes.col(0).swap(axes.col(1));
        return Quaternion(axes);
    });
    const SingularGraph graph = singular_graph(mesh, frames);
    ASSERT_EQ(graph.nodes.size(), 1u);
    const Meshability found = local_meshability(mesh, frames, graph);
    ASSERT_EQ(found.vertices.size(), 5u);
    const SingularVertex& node = found.vertices.back();
    EXPECT_EQ(node.kind, SingularVertexKind::node);
    EXPECT_EQ(node.valence3, 4);
    EXPECT_EQ(node.valence5 + node.valence6 + node.complex, 0);
    EXPECT_EQ(found.boundary_ends_about_normal, 4);
    EXPECT_EQ(found.non_meshable_vertices, 0);
}

// Graphs made by hand: only points, curves and nodes matter away from the boundary.
struct Drawing {
    TetMesh mesh = testing::kuhn_cube(1);
    Quaternions frames = sample(mesh, [](const Vector3&) { return Quaternion::Identity(); });
    SingularGraph graph;
    explicit Drawing(Index points) { graph.points = Points::Zero(points, 3); }
    void curve(std::vector<Index> points, int quarter_turns) {
        graph.curves.push_back(std::move(points));
        graph.curve_quarter_turns.push_back(quarter_turns);
    }
    Meshability check() const { return local_meshability(mesh, frames, graph); }
};

TEST(Meshability, ACurveThatChangesItsTypeHasNoHexMesh) {
    Drawing drawing(4);
    drawing.curve({0, 1, 2}, 1);
    drawing.curve({2, 3, 0}, -1);
    const Meshability found = drawing.check();
    ASSERT_EQ(found.vertices.size(), 2u);
    EXPECT_EQ(found.vertices[0].kind, SingularVertexKind::change);
    EXPECT_EQ(found.non_meshable_vertices, 2);
    EXPECT_EQ(found.non_meshable_junctions, 2);
}

// Two nodes with a loop each and curves between them, of the given types.
Meshability two_nodes(int first, int second, const std::vector<int>& between) {
    Drawing drawing(6);
    drawing.graph.nodes = {4, 5};
    drawing.curve({4, 0, 1, 4}, first);
    drawing.curve({5, 2, 3, 5}, second);
    for (const int quarter_turns : between) drawing.curve({4, 5}, quarter_turns);
    return drawing.check();
}

TEST(Meshability, NodesJoinedByAComplexCurveAreJudgedTogetherToo) {
    const Meshability found = two_nodes(1, 1, {0});
    EXPECT_EQ(found.non_meshable_vertices, 2);
    ASSERT_EQ(found.junctions.size(), 1u);
    EXPECT_EQ(found.junctions[0].vertices, 2);
    EXPECT_EQ(found.junctions[0].valence3, 4);
    EXPECT_EQ(found.junctions[0].complex, 1);
    EXPECT_TRUE(found.junctions[0].meshable);
    EXPECT_EQ(found.non_meshable_junctions, 0);
    EXPECT_FALSE(two_nodes(1, 1, {0, 0}).junctions[0].meshable);   // shrinking a loop does not leave a ball
    EXPECT_FALSE(two_nodes(1, 1, {0, -1}).junctions[0].meshable);  // 3 v3 + v5 = 14 is more than 12
}

TEST(Meshability, AComplexCurveToTheBoundaryHasNoHexMesh) {
    TetMesh mesh{Points(4, 3), Tets(1, 4)};
    mesh.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.2, 1;
    mesh.tets << 0, 1, 2, 3;
    Quaternions field(4, 4);  // a third turn in three steps round the base, nothing at the apex
    for (int k = 0; k < 4; ++k)
        field.row(k) =
            frames::to_wxyz(frames::exp(k % 3 * 2 * std::numbers::pi / 9 * Vector3(1, 1, 1).normalized())).transpose();
    const Meshability found = check_field(mesh, field);
    EXPECT_EQ(found.non_meshable_vertices, 2);
    EXPECT_EQ(found.non_meshable_junctions, 1);
    EXPECT_EQ(found.boundary_ends, 2);
}

TEST(Meshability, OfSmoothFieldsThereIsNothingToCheck) {
    const TetMesh mesh = cube(4);
    const Meshability found = check_field(mesh, sample(mesh, [](const Vector3& x) { return frames::exp(0.9 * x); }));
    EXPECT_TRUE(found.vertices.empty());
    EXPECT_TRUE(found.junctions.empty());
    EXPECT_EQ(found.curve_ends.rows(), 0);
}

TEST(Meshability, CountsOfRandomFieldsAgreeWithTheirLists) {
    const TetMesh mesh = testing::kuhn_cube(5);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 4);
    const SingularGraph graph = singular_graph(mesh, field);
    const Meshability found = local_meshability(mesh, field, graph);
    std::size_t ends = 0, inside = 0;
    for (const SingularVertex& v : found.vertices) {
        const int here = v.valence2 + v.valence3 + v.valence5 + v.valence6 + v.complex;
        ends += here;
        EXPECT_EQ(here, v.kind == SingularVertexKind::boundary_end ? 1
                        : v.kind == SingularVertexKind::change     ? 2
                                                                   : here);
        EXPECT_GE(v.junction, 0);
        if (v.kind == SingularVertexKind::node && here == 3) {
            EXPECT_FALSE(v.meshable && v.valence6 < 3);  // no hex-mesh vertex has three singular edges, but all of 6
        }
    }
    for (const SingularJunction& j : found.junctions) inside += j.vertices;
    EXPECT_EQ(inside, found.vertices.size());
    EXPECT_EQ(ends, 2 * (graph.curves.size() - found.closed_curves));
    ASSERT_EQ(ends, found.ends.size());
    for (const SingularEnd& end : found.ends) {
        EXPECT_EQ(end.quarter_turns, graph.curve_quarter_turns[end.curve]);
        EXPECT_NEAR(end.axis.norm(), end.quarter_turns == 0 ? 0 : 1, 1e-12);
        EXPECT_EQ(found.curve_ends(end.curve, 0) == end.vertex || found.curve_ends(end.curve, 1) == end.vertex, true);
    }
    int bad_curves = 0;
    for (const int turns : graph.curve_quarter_turns) bad_curves += turns == 0 || turns == 2;
    EXPECT_EQ(found.non_meshable_curves, bad_curves);
    EXPECT_GT(found.non_meshable_vertices, found.non_meshable_junctions);
}

// Four curves that all turn about one axis are two that pass; one of valence 3 with three of valence 5 cannot be,
// though a hex-mesh vertex has such edges.
TEST(Meshability, NodesAboutOneAxisAreCurvesThatPassEachOther) {
    int seen = 0, seen_odd = 0;
    for (int seed = 0; seed < 6; ++seed) {
        const TetMesh mesh = testing::kuhn_cube(14);
        const Meshability found = check_field(mesh, frames::random_rotations(mesh.vertices.rows(), seed));
        for (const SingularVertex& v : found.vertices) {
            if (v.kind != SingularVertexKind::node || v.complex > 0) {
                EXPECT_FALSE(v.one_axis && v.complex > 0);
                continue;
            }
            if (!v.one_axis) {
                EXPECT_EQ(v.meshable, v.valence2 == 0 && hex_vertex_exists(v.valence3, v.valence5, v.valence6));
            } else if (v.valence3 % 2 == 1) {
                EXPECT_FALSE(v.meshable);
                ++seen_odd;
            }
            seen += v.one_axis && v.meshable;
        }
    }
    EXPECT_GT(seen, 0);
    EXPECT_GT(seen_odd, 0);
}

// The mirror keeps the valences: the turn and the way round the curve change their sense together.
TEST(Meshability, OfTheMirroredFieldIsTheSame) {
    const TetMesh mesh = testing::jittered_cube(6, 0.2, 7);
    const Quaternions field = frames::random_rotations(mesh.vertices.rows(), 3);
    TetMesh mirrored = mesh;
    mirrored.vertices.col(0) *= -1;
    mirrored.tets.col(0).swap(mirrored.tets.col(1));
    Quaternions other = field;
    other.rightCols(2) *= -1;
    const SingularGraph graph = singular_graph(mesh, field), graph_m = singular_graph(mirrored, other);
    for (std::size_t i = 0; i < graph.triangles.size(); ++i)
        EXPECT_EQ(graph.triangles[i].quarter_turns, graph_m.triangles[i].quarter_turns);
    const Meshability found = local_meshability(mesh, field, graph);
    const Meshability mirror = local_meshability(mirrored, other, graph_m);
    EXPECT_EQ(found.non_meshable_vertices, mirror.non_meshable_vertices);
    ASSERT_EQ(found.ends.size(), mirror.ends.size());
    const auto sorted_angles = [](const Meshability& of) {
        std::vector<double> angles;
        for (const SingularEnd& end : of.ends) angles.push_back(end.angle);
        std::sort(angles.begin(), angles.end());
        return angles;
    };
    const auto angles = sorted_angles(found), mirrored_angles = sorted_angles(mirror);
    for (std::size_t e = 0; e < angles.size(); ++e) EXPECT_NEAR(angles[e], mirrored_angles[e], 1e-9);
}

TEST(Meshability, GraphsOfOtherMeshesAreRefused) {
    Drawing drawing(3);
    drawing.curve({0, 7}, 1);
    EXPECT_THROW(drawing.check(), InvalidInput);
    drawing.graph.curves = {{0}};
    EXPECT_THROW(drawing.check(), InvalidInput);
    drawing.graph.curves = {};
    EXPECT_THROW(drawing.check(), InvalidInput);
}

}  // namespace
}  // namespace octafield::volume
