#include "octafield/volume/field_map.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <random>

#include "cylinder_field.hpp"
#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using testing::cylinder;
using testing::four_curves;
using testing::kuhn_grid;
constexpr double pi = std::numbers::pi;

Quaternions along_axes(Index count) {
    Quaternions frames = Quaternions::Zero(count, 4);
    frames.col(0).setOnes();
    return frames;
}

Eigen::Vector3d corner(const SeamlessMap& map, Index t, int k) {
    return map.parameters.block<1, 3>(t, 3 * k).transpose();
}

double determinant(const SeamlessMap& map, Index t) {
    const Eigen::Vector3d p = corner(map, t, 0);
    return (corner(map, t, 1) - p).dot((corner(map, t, 2) - p).cross(corner(map, t, 3) - p));
}

double least_determinant(const SeamlessMap& map) {
    double least = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < map.mesh.tets.rows(); ++t) least = std::min(least, determinant(map, t));
    return least;
}

using Edge = std::pair<Index, Index>;

// Of the tets round each edge, in parameters, degrees.
std::map<Edge, double> angles(const SeamlessMap& map) {
    std::map<Edge, double> result;
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = 0; b < a; ++b) {
                std::array<Eigen::Vector3d, 2> across;
                const Eigen::Vector3d way = (corner(map, t, b) - corner(map, t, a)).normalized();
                for (int k = 0, n = 0; k < 4; ++k) {
                    if (k == a || k == b) continue;
                    const Eigen::Vector3d to = corner(map, t, k) - corner(map, t, a);
                    across[n++] = to - way * way.dot(to);
                }
                result[std::minmax(map.mesh.tets(t, a), map.mesh.tets(t, b))] +=
                    std::atan2(across[0].cross(across[1]).norm(), across[0].dot(across[1])) * 180 / pi;
            }
    return result;
}

// Triangles, with the differences of their corners' parameters in ascending order of vertices: by each tet at it.
std::map<std::array<Index, 3>, std::vector<Eigen::Matrix<double, 3, 2>>> triangle_ways(const SeamlessMap& map) {
    std::map<std::array<Index, 3>, std::vector<Eigen::Matrix<double, 3, 2>>> result;
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int off = 0; off < 4; ++off) {
            std::array<std::pair<Index, int>, 3> at;
            for (int k = 0, n = 0; k < 4; ++k)
                if (k != off) at[n++] = {map.mesh.tets(t, k), k};
            std::sort(at.begin(), at.end());
            Eigen::Matrix<double, 3, 2> ways;
            for (int k = 0; k < 2; ++k) ways.col(k) = corner(map, t, at[k + 1].second) - corner(map, t, at[0].second);
            result[{at[0].first, at[1].first, at[2].first}].push_back(ways);
        }
    return result;
}

// Over each triangle of two tets one of the 24 rotations takes the differences to the other tet's, to the last bit; at
// those of one tet a parameter is the same at all corners, to the last bit.
void expect_seamless(const SeamlessMap& map) {
    for (const auto& [triangle, ways] : triangle_ways(map)) {
        bool fits = false;
        if (ways.size() == 1)
            for (int i = 0; i < 3; ++i) fits |= ways[0].row(i).isZero(0);
        for (const frames::Quaternion& q : frames::octahedral_group()) {
            if (ways.size() == 1) break;
            const Eigen::Matrix3d r = q.toRotationMatrix().array().round();
            fits |= (r * ways[0]).eval() == ways[1];
        }
        EXPECT_TRUE(fits) << triangle[0] << " " << triangle[1] << " " << triangle[2];
    }
}

TEST(FieldMap, ACubeAlongItsAxesIsMappedByScaleAndTranslation) {
    const TetMesh cube = testing::kuhn_cube(3);
    const FieldMap made = field_map(cube, along_axes(static_cast<Index>(cube.vertices.rows())), {0.25});
    EXPECT_EQ(made.curves.rows(), 0);
    EXPECT_TRUE(made.flipped.empty());
    const SeamlessMap& map = made.map;
    const Eigen::Vector3d first = map.mesh.vertices.row(map.mesh.tets(0, 0));
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) {
            const Eigen::Vector3d at = map.mesh.vertices.row(map.mesh.tets(t, k));
            EXPECT_LT((corner(map, t, k) - (at - first) / 0.25 - corner(map, 0, 0)).norm(), 1e-7);
        }
    expect_seamless(map);
}

TEST(FieldMap, HowFramesAreWrittenDoesNotMatter) {
    const TetMesh cube = testing::jittered_cube(3, 0.1, 5);
    const Index count = static_cast<Index>(cube.vertices.rows());
    const FieldMap plain = field_map(cube, along_axes(count));
    const FieldMap mixed = field_map(cube, testing::mixed_representatives(along_axes(count)));
    EXPECT_EQ(mixed.curves.rows(), 0);
    ASSERT_EQ(plain.map.mesh.tets, mixed.map.mesh.tets);
    for (Index t = 0; t < plain.map.mesh.tets.rows(); ++t)
        EXPECT_NEAR(determinant(plain.map, t), determinant(mixed.map, t), 1e-6);
    expect_seamless(mixed.map);
}

TEST(FieldMap, SingularCurvesOfACylinderBecomeEdgesWithThreeQuartersRoundThem) {
    const TetMesh mesh = cylinder(9, 3);
    const FieldMap made = field_map(mesh, four_curves(mesh));
    EXPECT_TRUE(made.locked.empty());
    EXPECT_TRUE(made.flipped.empty());
    EXPECT_GT(least_determinant(made.map), 0);
    expect_seamless(made.map);
    std::map<Edge, bool> singular;
    std::map<Index, int> ends;
    for (const auto e : made.curves.rowwise()) {
        singular[{e[0], e[1]}] = true;
        ++ends[e[0]];
        ++ends[e[1]];
    }
    EXPECT_EQ(std::count_if(ends.begin(), ends.end(), [](const auto& end) { return end.second == 1; }), 8);
    std::map<Edge, bool> outside;
    for (const auto& [triangle, ways] : triangle_ways(made.map))
        if (ways.size() == 1)
            for (int k = 0; k < 3; ++k) outside[std::minmax(triangle[k], triangle[(k + 1) % 3])] = true;
    for (const auto& [edge, angle] : angles(made.map))
        if (!outside.contains(edge)) {
            EXPECT_NEAR(angle, singular.contains(edge) ? 270 : 360, 1e-3);
        }
}

TEST(FieldMap, ResultsDoNotDependOnThreads) {
    const TetMesh mesh = cylinder(7, 2);
    const FieldMap one = field_map(mesh, four_curves(mesh), {0, 1}), two = field_map(mesh, four_curves(mesh), {0, 2});
    EXPECT_EQ(one.map.parameters, two.map.parameters);
}

// Two boundary triangles of one tet that keep one parameter would flatten it; so would edges from curve to curve.
TEST(FieldMap, ACoarseMeshGetsRoom) {
    const TetMesh mesh = kuhn_grid(1, 1, 1, 1.0);
    const FieldMap made = field_map(mesh, along_axes(8));
    EXPECT_GT(made.added_vertices, 0);
    EXPECT_TRUE(made.locked.empty());
    EXPECT_GT(least_determinant(made.map), 0);
}

TEST(FieldMap, RefusesWhatIsNoFieldOrLength) {
    const TetMesh cube = testing::kuhn_cube(2);
    const auto kind_of = [&](const Quaternions& frames, double length) -> std::string {
        try {
            field_map(cube, frames, {length});
        } catch (const InvalidInput& error) {
            return error.kind().empty() ? "invalid" : error.kind();
        }
        return "none";
    };
    EXPECT_EQ(kind_of(along_axes(27), -1), "option_out_of_range");
    EXPECT_EQ(kind_of(along_axes(27), std::nan("")), "option_out_of_range");
    EXPECT_NE(kind_of(along_axes(26), 0), "none");
    EXPECT_EQ(kind_of(along_axes(27), 1), "none");
}

TEST(FieldMap, CanBeCancelled) {
    const TetMesh mesh = cylinder(7, 2);
    const Progress stop = [](std::string_view phase, double, double) { return phase != "unfold"; };
    EXPECT_THROW(field_map(mesh, four_curves(mesh), {}, stop), Cancelled);
}

}  // namespace
}  // namespace octafield::volume
