// Motorcycle graphs: T-meshes of rectangles, whatever the separatrices do.
#include "octafield/surface/motorcycle_graph.hpp"
#include "layout_fixtures.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

void show(const char* name, const QuadLayout& layout) {
    int t = 0, quads = 0;
    for (const auto& v : layout.vertices) t += v.kind == LayoutVertexKind::t_joint;
    for (const auto& p : layout.patches) quads += p.kind == PatchKind::quad;
    std::printf("%s: V %zu E %zu F %zu quads %d T %d mismatch %g\n", name, layout.vertices.size(), layout.sides.size(),
                layout.patches.size(), quads, t, layout.largest_mismatch);
}

TEST(MotorcycleGraph, Try) {
    show("disk", motorcycle_graph(disk_field(26, four_in_disk(0.5, {0, 90, 180, 270}))));
    show("L", motorcycle_graph(l_shape_field(8)));
    show("holed", motorcycle_graph(holed_field(12)));
    LayoutCurveOptions options;
    options.end_tolerance = 0.004;
    show("kite", motorcycle_graph(disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275})), options));
    show("kite2", motorcycle_graph(disk_field(26, four_in_disk(0.85009, {0, 85, 180, 275}))));
    show("annulus", motorcycle_graph(impose_singular_points(SurfaceDomain(annulus(0.3, 64, 12)), {})));
}

}  // namespace
}  // namespace octafield::surface
