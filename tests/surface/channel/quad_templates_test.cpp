// All quads of polygons, beside an enumeration made elsewhere.
#include "octafield/surface/quad_templates.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "octafield/error.hpp"
#include "patch_filler.hpp"

namespace octafield::surface {
namespace {

using Ids = std::vector<std::vector<int>>;  // rows of vertex ids

// One quad per group, vertices inside a, b, c, d: made independently of this code.
const std::map<std::pair<int, int>, std::vector<const char*>> published{
    {{6, 0}, {"0123 3450"}},
    {{6, 1}, {"01a5 123a 345a"}},
    {{6, 2}, {"01a5 12ba 234b 45ab"}},
    {{6, 3}, {"01a5 12ba 23cb 345c 5abc"}},
    {{8, 0}, {"0123 3456 6703", "0123 3470 4567"}},
    {{8, 1}, {"0123 34a0 456a 670a", "01a7 123a 345a 567a"}},
    {{8, 2},
     {"0123 34a0 45ba 567b 70ab", "0123 345a 56ba 670b 03ab", "01a7 123a 34ba 456b 67ab", "01a7 123a 345b 567b 7a3b"}},
    {{8, 3},
     {"0123 34a0 45ba 56cb 670c 0abc", "0123 34a0 456b 67cb 70ac a4bc", "0123 345a 567b 70cb 03ac a5bc",
      "01a7 123a 34ba 45cb 567c 7abc", "01a7 123a 34bc 456b 67cb 7a3c", "01a7 12ba 234b 45cb 567c 7abc",
      "01a7 12ba 23cb 345c 56bc 67ab"}},
    {{8, 4}, {"0123 3456 67ab 70ca 03dc 36bd bacd", "0123 3450 56ab 67ca 70dc 05bd bacd",
              "0123 3470 45ab 56ca 67dc 74bd bacd", "0123 34a0 45ba 56cb 67dc 70ad abcd",
              "0123 34a0 45ba 567c 70dc 0abd b5cd", "0123 34a0 456b 670c 0adc a4bd b6cd",
              "0123 34a0 45bc 567b 70ad a4cd cb7d", "0123 345a 56ba 67cb 70dc 03ad abcd",
              "0123 345a 56ba 670c 03dc 3abd b6cd", "0123 34ab 4567 70cd 03bc badc a47d",
              "0123 34ab 456a 67ca 70dc 03bd bacd", "01a7 123a 34ba 45cb 56dc 67ad abcd",
              "01a7 123a 34ba 456c 67dc 7abd b4cd", "01a7 123a 345b 56cb 67dc 7a3d 3bcd",
              "01a7 123a 345b 567c 7adc a3bd b5cd", "01a7 12ba 234b 45cb 56dc 67ad abcd",
              "01a7 12ba 234b 456c 67dc 7abd b4cd", "01a7 12ba 23cb 345c 56dc 67ad abcd",
              "01a7 12ba 23cb 345c 567d 7abd bc5d", "01a7 12ba 23cb 34dc 456d 67ab bcd6",
              "01a7 12ba 23cd 345c 56dc 67ab b2d6"}}};

Ids parsed(const char* text, int sides) {
    Ids result;
    std::istringstream words(text);
    for (std::string word; words >> word;) {
        result.emplace_back();
        for (const char c : word) result.back().push_back(c >= 'a' ? sides + c - 'a' : c - '0');
    }
    return result;
}

// The least list of sorted quads over all rotations, reflections and names of the vertices inside: by brute force.
std::set<std::set<int>> least(const Ids& quads, int sides, int interior) {
    std::set<std::set<int>> best;
    std::vector<int> names(interior);
    for (int k = 0; k < interior; ++k) names[k] = sides + k;
    do {
        for (int shift = 0; shift < sides; ++shift)
            for (const int sense : {1, -1}) {
                std::set<std::set<int>> renamed;
                for (const auto& quad : quads) {
                    std::set<int> ids;
                    for (const int v : quad)
                        ids.insert(v < sides ? (sense * v + shift + sides) % sides : names[v - sides]);
                    renamed.insert(ids);
                }
                if (best.empty() || renamed < best) best = renamed;
            }
    } while (std::next_permutation(names.begin(), names.end()));
    return best;
}

TEST(QuadTemplates, AreThoseOfTheTable) {
    for (const auto& [of, texts] : published) {
        const auto [sides, interior] = of;
        std::set<std::set<std::set<int>>> wanted, found;
        for (const char* text : texts) wanted.insert(least(parsed(text, sides), sides, interior));
        for (const QuadTemplate& each : quad_templates(sides, interior)) {
            Ids quads;
            for (const auto& quad : each.quads) quads.emplace_back(quad.begin(), quad.end());
            found.insert(least(quads, sides, interior));
        }
        EXPECT_EQ(found, wanted) << sides << " sides, " << interior << " inside";
        EXPECT_EQ(quad_templates(sides, interior).size(), texts.size());
    }
}

TEST(QuadTemplates, AreFourOfTheHexagonAndThirtySixOfTheOctagon) {
    std::size_t hexagons = 0, octagons = 0;
    for (int k = 0; k <= 3; ++k) hexagons += quad_templates(6, k).size();
    for (int k = 0; k <= 4; ++k) octagons += quad_templates(8, k).size();
    EXPECT_EQ(hexagons, 4U);
    EXPECT_EQ(octagons, 36U);
    EXPECT_EQ(quad_templates(4, 0).size(), 1U);
    EXPECT_EQ(quad_templates(4, 4).size(), 1U);  // a square in a square
}

TEST(QuadTemplates, HaveEachSideOfThePolygonOnceAndOtherEdgesInBothSenses) {
    for (int sides = 4; sides <= 10; sides += 2)
        for (int interior = 0; interior <= 3; ++interior)
            for (const QuadTemplate& each : quad_templates(sides, interior)) {
                EXPECT_EQ(each.quads.size(), static_cast<std::size_t>(sides / 2 - 1 + interior));
                std::set<std::pair<int, int>> directed;
                for (const auto& quad : each.quads)
                    for (int k = 0; k < 4; ++k) EXPECT_TRUE(directed.insert({quad[k], quad[(k + 1) % 4]}).second);
                for (const auto& [a, b] : directed)
                    EXPECT_NE(directed.contains({b, a}), a < sides && b == (a + 1) % sides);
            }
}

TEST(QuadTemplates, RefuseOtherPolygons) {
    for (const auto& [sides, interior] : std::vector<std::pair<int, int>>{{5, 0}, {2, 0}, {12, 0}, {6, -1}, {6, 5}})
        try {
            quad_templates(sides, interior);
            ADD_FAILURE() << sides << ", " << interior;
        } catch (const InvalidInput& error) {
            EXPECT_EQ(error.kind(), "bad_template");
        }
}

TEST(PatchFiller, FillsARectangleOfTwoByOneWithTwoSquares) {
    detail::Patch patch{
        {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}}, std::vector<int>(6, 0), std::vector<int>(6, -1), {}};
    const detail::Filling filling = detail::PatchFiller().fill(patch, 1e9);
    EXPECT_EQ(filling.quads.size(), 2U);
    EXPECT_NEAR(filling.cost, 0, 1e-12);
}

TEST(PatchFiller, DividesATriangleWithMiddlesInThree) {
    detail::Patch patch{{}, std::vector<int>(6, 0), std::vector<int>(6, -1), {}};
    for (int i = 0; i < 6; ++i)
        patch.corners.push_back((i % 2 ? 0.5 : 1.0) * detail::Vector2(std::cos(i * M_PI / 3), std::sin(i * M_PI / 3)));
    const detail::Filling filling = detail::PatchFiller().fill(patch, 1e9);
    ASSERT_EQ(filling.interior.size(), 1U);
    EXPECT_NEAR(filling.interior[0].norm(), 0, 0.02);
}

TEST(PatchFiller, KeepsToWhatIsJoinedOutsideAndToTheQuadsACornerNeeds) {
    detail::Patch patch{{{0, 0}, {1, 0}, {2, 0}, {2, 1}, {1, 1}, {0, 1}},
                        std::vector<int>(6, 0),
                        std::vector<int>(6, -1),
                        std::vector<std::vector<char>>(6, std::vector<char>(6, false))};
    patch.joined[1][4] = true;
    for (const auto& quad : detail::PatchFiller().fill(patch, 1e9).quads)
        for (int k = 0; k < 4; ++k) EXPECT_NE(std::minmax(quad[k], quad[(k + 1) % 4]), std::minmax(1, 4));
    patch.joined.clear();
    patch.least_quads[0] = 2;
    int at_corner = 0;
    for (const auto& quad : detail::PatchFiller().fill(patch, 1e9).quads)
        at_corner += std::count(quad.begin(), quad.end(), 0);
    EXPECT_GE(at_corner, 2);
}

}  // namespace
}  // namespace octafield::surface
