#include "unzipped_curves.hpp"

#include <gtest/gtest.h>

#include <map>

#include "axis_numbers.hpp"
#include "curve_ribbon.hpp"
#include "field_fixtures.hpp"
#include "octafield/frames/octahedral_group.hpp"
#include "turning_curves.hpp"

namespace octafield::volume::detail {
namespace {

using Eigen::Vector3d;

constexpr double plane = 0.513, left = 0.31, right = 0.68, low = 0.29, high = 0.71;  // off all planes of the grid

Ribbon upright_ribbon() {
    return straight_ribbon({{left, plane, low}, {right, plane, low}}, {{left, plane, high}, {right, plane, high}}, 0.1);
}

Quaternions equal_frames(const TetDomain& domain) {
    Quaternions frames = Quaternions::Zero(domain.vertex_count(), 4);
    frames.col(0).setOnes();
    return frames;
}

// One closed curve: up along z with five hexahedra round it, across, down with three, and back.
void make_zipper(const TetDomain& domain, EdgeMatchings& matchings) {
    for (const EdgeCrossing& c : ribbon_crossings(domain, upright_ribbon())) {
        const int quarter = quarter_turn_about(2);
        matchings.turn(c.from, c.to, c.times > 0 ? quarter : frames::octahedral_inverse(quarter));
    }
}

TEST(Ribbon, EdgesThatCrossItAreThoseThatCrossItsRectangle) {
    const TetDomain domain(testing::kuhn_cube(6));
    std::map<std::pair<Index, Index>, int> expected, found;
    for (const auto tet : domain.mesh().tets.rowwise())
        for (int k = 0; k < 4; ++k)
            for (int l = 0; l < k; ++l) {
                const Index a = std::min(tet[k], tet[l]), b = std::max(tet[k], tet[l]);
                const Vector3d p = domain.mesh().vertices.row(a), q = domain.mesh().vertices.row(b);
                if ((p[1] < plane) == (q[1] < plane)) continue;
                const Vector3d at = p + (plane - p[1]) / (q[1] - p[1]) * (q - p);
                if (at[0] < left || at[0] > right || at[2] < low || at[2] > high) continue;
                expected[{a, b}] = q[1] < p[1] ? 1 : -1;  // x times z is -y
            }
    for (const EdgeCrossing& c : ribbon_crossings(domain, upright_ribbon())) {
        found[{c.from, c.to}] = c.times;
        EXPECT_LT((c.along - Vector3d::UnitZ()).norm(), 1e-12);
    }
    EXPECT_GT(found.size(), 20);
    EXPECT_EQ(found, expected);
}

TEST(UnzippedCurves, AClosedCurveOfTwoTypesBecomesTwoThatEndOnTheSurface) {
    const TetDomain domain(testing::kuhn_cube(8));
    Quaternions frames = equal_frames(domain);
    EdgeMatchings matchings(domain, frames);
    make_zipper(domain, matchings);
    const auto turns = [&] {
        std::size_t sum = 0;
        for (const CurveChain& chain : curve_chains(domain, frames, matchings))
            sum += curve_turns(domain, chain, 0.1).size();
        return sum;
    };
    ASSERT_EQ(curve_chains(domain, frames, matchings).size(), 1);
    EXPECT_TRUE(curve_chains(domain, frames, matchings)[0].closed);
    EXPECT_EQ(turns(), 2);

    const UnzippedCurves told = unzip_curves(domain, frames, matchings);
    EXPECT_EQ(told.turns, 2);
    EXPECT_EQ(told.mended, told.turns);
    EXPECT_TRUE(told.near.empty());
    EXPECT_EQ(turns(), 0);
    const auto chains = curve_chains(domain, frames, matchings);
    ASSERT_EQ(chains.size(), 2);
    const auto height = [&](Index row) {
        double sum = 0;
        for (const Index v : domain.triangles().triangles.row(row)) sum += domain.mesh().vertices(v, 2) / 3;
        return sum;
    };
    std::vector<double> types;
    for (const CurveChain& chain : chains) {
        EXPECT_FALSE(chain.closed);
        const double first = height(chain.rows.front()), last = height(chain.rows.back());
        EXPECT_NEAR(std::abs(last - first), 1, 1e-12);  // from the bottom to the top
        types.push_back(chain.axes.front()[2] * (last - first));
    }
    EXPECT_NEAR(types[0] * types[1], -1, 1e-6);  // one of each
}

TEST(UnzippedCurves, CurvesOfOneTypeStayAsTheyAre) {
    const TetDomain domain(testing::kuhn_cube(8));
    Quaternions frames = equal_frames(domain);
    EdgeMatchings matchings(domain, frames);
    for (const EdgeCrossing& c :
         ribbon_crossings(domain, straight_ribbon({{left, plane, -0.1}, {right, plane, -0.1}},
                                                  {{left, plane, 1.1}, {right, plane, 1.1}}, 0.1)))
        matchings.turn(c.from, c.to,
                       c.times > 0 ? quarter_turn_about(2) : frames::octahedral_inverse(quarter_turn_about(2)));
    ASSERT_EQ(curve_chains(domain, frames, matchings).size(), 2);
    const Quaternions before = frames;
    EXPECT_EQ(unzip_curves(domain, frames, matchings).turns, 0);
    EXPECT_EQ(frames, before);
}

}  // namespace
}  // namespace octafield::volume::detail
