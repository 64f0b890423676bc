// Separatrices of imposed fields against closed forms.
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

TEST(LayoutCurves, FourPointsInTheDiskGiveEightArcs) {
    const struct {
        double radius, crossing, a, b;
    } cases[] = {{0.5, 0.4000554, 1.571180408, 0.820325648}, {0.8500923, 0.6982677, 1.600959759, 0.280557937}};
    for (const auto& c : cases) {
        const auto sources = four_in_disk(c.radius, {0, 90, 180, 270});
        const ImposedField field = disk_field(40, sources);
        const LayoutCurves found = layout_curves(field);
        const double unit = unit_of(field, sources);
        EXPECT_EQ(found.traced, 12);
        ASSERT_EQ(found.curves.size(), 8u);
        int inner = 0;
        for (const LayoutCurve& curve : found.curves) {
            const double length = curve.points.back().length / unit;
            std::printf("length %.6f offset %.2e\n", length, curve.offset / unit);
            EXPECT_NEAR(length, curve.last_vertex >= 0 ? c.a : c.b, 0.01);
            if (curve.last_vertex < 0) continue;
            ++inner;
            for (std::size_t i = 0; i + 1 < curve.points.size(); ++i) {
                const Complex p = curve_point(field, curve.points[i]), q = curve_point(field, curve.points[i + 1]);
                const Complex ray = std::polar(1.0, (std::floor(std::arg(p) / (pi / 2)) + 0.5) * pi / 2);
                const double sp = (std::conj(ray) * p).imag(), sq = (std::conj(ray) * q).imag();
                if (sp * sq > 0) continue;
                const double at = std::abs(p + (q - p) * (sp / (sp - sq)));
                std::printf("crossing %.6f\n", at);
                EXPECT_NEAR(at, c.crossing, 2e-3);
            }
        }
        EXPECT_EQ(inner, 4);
    }
}

}  // namespace
}  // namespace octafield::surface
