// Whatever the pattern: valid quads, or an error that says what is in the way. Half of the layouts have hundreds of
// patches, as near misses are not joined.
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/surface/layout_quads.hpp"

namespace octafield::surface {
namespace {

TEST(RandomLayouts, PatternsInTheDiskGiveValidQuadsOrAreTold) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> unit(0, 1);
    int layouts = 0;
    for (int round = 0; round < 17; ++round) {
        std::vector<Source> sources;
        int sum = 0;
        const int extra = round % 4;
        for (int i = 0; i < 4 + 2 * extra; ++i) {
            const int t = i < 4 + extra ? 1 : -1;
            sources.push_back(
                {std::polar(0.25 + 0.6 * unit(random), 2 * pi * (i + 0.7 * unit(random)) / (4 + 2 * extra)), t});
            sum += t;
        }
        ASSERT_EQ(sum, 4);
        try {
            LayoutCurveOptions options;
            if (round % 2) options.end_tolerance = 0.002;
            const QuadLayout layout = quad_layout(disk_field(16, sources), options);
            LayoutQuadsOptions wanted;
            wanted.quad_count = 2000;
            const LayoutQuads quads = layout_quads(layout, wanted);
            require_valid(quads.mesh, false);
            ++layouts;
            EXPECT_GT(quads.least_scaled_jacobian, 0.5) << round;
        } catch (const GeometryError& error) {  // told, with what is in the way
            EXPECT_TRUE(error.kind() == "long_separatrix" || error.kind() == "no_quad_layout") << error.what();
            EXPECT_FALSE(error.elements().empty());
        }
    }
    EXPECT_GE(layouts, 14);
}

}  // namespace
}  // namespace octafield::surface
