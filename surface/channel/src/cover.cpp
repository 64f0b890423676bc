#include "cover.hpp"

#include "channel.hpp"
#include "triangle_pairs.hpp"

namespace octafield::surface::detail {
PlaneQuads covered(const Outline& outline, const InsideMesh& inside, const PatchFiller& filler) {
    const Channel channel = channel_of(outline, inside);
    const Index first = static_cast<Index>(outline.points.rows());
    PlaneQuads quads;
    std::vector<char> held(inside.points.rows(), false);
    for (Index q = 0; q < inside.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) held[inside.quads(q, k)] = true;
    for (Index v = 0; v < channel.points.rows(); ++v)
        quads.add_vertex(channel.points.row(v),
                         v < first ? Hold::fixed : (held[v - first] ? Hold::inside : Hold::free));
    for (Index s = 0; s < outline.segments.rows(); ++s) quads.lock(outline.segments(s, 0), outline.segments(s, 1));
    for (Index q = 0; q < inside.quads.rows(); ++q) {
        Quad quad;
        for (int k = 0; k < 4; ++k) quad[k] = first + inside.quads(q, k);
        quads.add_quad(quad, true);
    }
    for (const std::vector<Index>& polygon : even_polygons(channel.made, channel.open, quads)) {
        Patch patch{{}, std::vector<int>(polygon.size(), 0), std::vector<int>(polygon.size(), -1), {}};
        for (const Index v : polygon) patch.corners.push_back(quads.point(v));
        const Filling filling = filler.fill(patch, std::numeric_limits<double>::infinity());
        std::vector<Index> names = polygon;
        for (const Vector2& at : filling.interior) names.push_back(quads.add_vertex(at, Hold::free));
        for (const auto& q : filling.quads) quads.add_quad({names[q[0]], names[q[1]], names[q[2]], names[q[3]]}, false);
    }
    return quads;
}

}  // namespace octafield::surface::detail
