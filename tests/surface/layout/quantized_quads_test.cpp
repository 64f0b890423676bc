// Quads of T-meshes.
#include "octafield/surface/quantized_quads.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

void show(const char* name, const ImposedField& field, LayoutCurveOptions curves = {}) {
    for (const bool coarsest : {false, true}) {
    const QuadLayout layout = motorcycle_graph(field, curves);
    QuantizedQuadsOptions options;
    options.quad_count = 1000;
    options.coarsest = coarsest;
    const QuantizedQuads q = quantized_quads(layout, options);
    std::printf("%s: tiles %zu T %d quads %zd blocks %zd irregular %zu sj %.3f dev %.3f bound %.3f opt %d mv %d\n", name, layout.patches.size(), q.t_joints, q.mesh.quads.rows(),
                q.patch_sizes.rows(), q.irregular.size(), q.least_scaled_jacobian, q.deviation, q.bound, q.optimal, q.mean_value_patches);
    }
}

TEST(QuantizedQuads, Try) {
    show("disk", disk_field(26, four_in_disk(0.5, {0, 90, 180, 270})));
    show("L", l_shape_field(8));
    show("holed", holed_field(12));
    LayoutCurveOptions options;
    options.end_tolerance = 0.004;
    show("kite", disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})), options);
    show("kite2", disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})));
    show("annulus", impose_singular_points(SurfaceDomain(annulus(0.3, 64, 12)), {}));
}

}  // namespace
}  // namespace octafield::surface
