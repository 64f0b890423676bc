#include "edge_matchings.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

#include "cylinder_field.hpp"
#include "field_fixtures.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

// Singular triangles and all triangles at each edge inside the mesh.
std::map<std::pair<Index, Index>, std::pair<int, int>> round_edges(const TetDomain& domain,
                                                                   const EdgeMatchings& matchings) {
    std::map<std::pair<Index, Index>, std::pair<int, int>> result;
    std::set<std::pair<Index, Index>> outside;
    const TriangleTable& table = domain.triangles();
    for (Index row = 0; row < table.triangles.rows(); ++row)
        for (int k = 0; k < 3; ++k) {
            const auto edge = std::minmax(table.triangles(row, k), table.triangles(row, (k + 1) % 3));
            result[edge].first += matchings.holonomy(row) != 0;
            ++result[edge].second;
            if (table.sides(row, 1) < 0) outside.insert(edge);
        }
    for (const auto& edge : outside) result.erase(edge);
    return result;
}

int singular_triangles(const TetDomain& domain, const EdgeMatchings& matchings, bool boundary) {
    int count = 0;
    for (Index row = 0; row < domain.triangles().triangles.rows(); ++row)
        count += (domain.triangles().sides(row, 1) < 0) == boundary && matchings.holonomy(row) != 0;
    return count;
}

TEST(EdgeMatchings, NoCurveIsLeftThatGoesRoundMoreThanHalfOfAnEdge) {
    const TetMesh mesh = testing::cylinder(9, 4);
    const TetDomain domain(mesh);
    Quaternions frames = testing::four_curves(mesh);
    std::mt19937_64 random(1);
    for (Index v = 0; v < frames.rows(); ++v) {  // inside, turned along the axis at random: crooked curves
        const double turn = 0.3 * (2 * std::generate_canonical<double, 53>(random) - 1);
        if (mesh.vertices.row(v).head<2>().norm() > 0.95) continue;
        const auto q = testing::row(frames, v) * frames::Quaternion(std::cos(turn), 0, 0, std::sin(turn));
        frames.row(v) = frames::to_wxyz(q).transpose();
    }
    EdgeMatchings matchings(domain, frames);
    const int before = singular_triangles(domain, matchings, false), ends = singular_triangles(domain, matchings, true);
    const auto far_round = [&] {
        int count = 0;
        for (const auto& [edge, triangles] : round_edges(domain, matchings))
            count += 2 * triangles.first > triangles.second;
        return count;
    };
    EXPECT_GT(far_round(), 0);
    EXPECT_GT(matchings.shorten_curves(), 0);
    EXPECT_EQ(far_round(), 0);
    EXPECT_LT(singular_triangles(domain, matchings, false), before);
    EXPECT_EQ(singular_triangles(domain, matchings, true), ends);  // on the surface curves end where they did
    EXPECT_EQ(matchings.shorten_curves(), 0);
}

TEST(EdgeMatchings, GoBothWaysAndFollowHowFramesAreWritten) {
    const TetMesh mesh = testing::kuhn_cube(2);
    const Quaternions frames = testing::mixed_representatives(testing::smooth_field(mesh));
    const TetDomain domain(mesh);
    const EdgeMatchings matchings(domain, frames);
    for (const auto tet : mesh.tets.rowwise())
        for (int k = 1; k < 4; ++k) {
            const auto q = [&](Index v) { return testing::row(frames, v); };
            const Index a = tet[0], b = tet[k];
            EXPECT_EQ(matchings(a, b), frames::octahedral_inverse(matchings(b, a)));
            const auto carried = q(a) * frames::octahedral_group()[matchings(a, b)];
            EXPECT_NEAR(std::abs(carried.dot(q(b))), std::cos(frames::distance(q(a), q(b)) / 2), 1e-9);
        }
}

}  // namespace
}  // namespace octafield::volume::detail
