#include "octafield/surface/patch_polygons.hpp"

#include "layout_pieces.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {

PatchPolygons patch_polygons(const QuadLayout& layout) {
    if (!layout.pieces) throw InvalidInput("the layout has no patches", "bad_option");
    const detail::CutSurface& cut = layout.pieces->cut;
    PatchPolygons result{cut.positions, cut.first, cut.nodes, std::vector<Index>(cut.polygon_count(), -1)};
    const auto& polygons = layout.pieces->patch_polygons;
    for (std::size_t patch = 0; patch < polygons.size(); ++patch)
        for (const Index polygon : polygons[patch]) result.patches[polygon] = static_cast<Index>(patch);
    return result;
}

}  // namespace octafield::surface
