#include "channel.hpp"

#include <numeric>

#include "plane_quads.hpp"

namespace octafield::surface::detail {
namespace {

// Edges of the mesh inside with a quad on their left only.
Edges rim_of(const InsideMesh& inside) {
    std::unordered_set<std::uint64_t> sides;
    for (Index q = 0; q < inside.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) sides.insert(key(inside.quads(q, k), inside.quads(q, (k + 1) % 4)));
    std::vector<std::array<Index, 2>> rim;
    for (Index q = 0; q < inside.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) {
            const Index a = inside.quads(q, k), b = inside.quads(q, (k + 1) % 4);
            if (!sides.contains(key(b, a))) rim.push_back({a, b});
        }
    Edges result(rim.size(), 2);
    for (std::size_t i = 0; i < rim.size(); ++i) result.row(i) << rim[i][0], rim[i][1];
    return result;
}

}  // namespace

// Vertices within the mesh inside are not among the channel's points; their ids stay, so that the triangulation's have
// to be named.
Channel channel_of(const Outline& outline, const InsideMesh& inside) {
    const Index first = static_cast<Index>(outline.points.rows());
    const Edges rim = rim_of(inside);
    std::vector<char> used(inside.points.rows(), true);  // loose vertices, too
    for (Index q = 0; q < inside.quads.rows(); ++q)
        for (int k = 0; k < 4; ++k) used[inside.quads(q, k)] = false;
    for (Index e = 0; e < rim.rows(); ++e) used[rim(e, 0)] = used[rim(e, 1)] = true;
    std::vector<Index> name(inside.points.rows(), -1), whole(first);
    std::iota(whole.begin(), whole.end(), 0);
    for (Index v = 0; v < inside.points.rows(); ++v)
        if (used[v]) {
            name[v] = static_cast<Index>(whole.size());
            whole.push_back(first + v);
        }
    Channel channel;
    channel.points.resize(first + inside.points.rows(), 2);
    channel.points << outline.points, inside.points;
    PlanePoints points(whole.size(), 2);
    for (std::size_t i = 0; i < whole.size(); ++i) points.row(i) = channel.points.row(whole[i]);
    Edges segments(outline.segments.rows() + rim.rows(), 2);
    segments.topRows(outline.segments.rows()) = outline.segments;
    for (Index e = 0; e < rim.rows(); ++e)
        segments.row(outline.segments.rows() + e) << name[rim(e, 0)], name[rim(e, 1)];
    channel.made = triangulate(points, segments);
    channel.open = inside_loops(channel.made, outline.loops);
    std::vector<char> all(channel.open.size(), true);
    Index count = 0;
    const std::vector<Index> part = parts_of(channel.made, all, count);
    std::vector<char> filled(count, false);
    for (Index t = 0; t < channel.made.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index e = channel.made.segments(t, k) - static_cast<Index>(outline.segments.rows());
            if (e >= 0 && channel.made.triangles(t, (k + 1) % 3) == name[rim(e, 0)]) filled[part[t]] = true;
        }
    for (std::size_t t = 0; t < channel.open.size(); ++t) channel.open[t] = channel.open[t] && !filled[part[t]];
    for (Index t = 0; t < channel.made.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) channel.made.triangles(t, k) = whole[channel.made.triangles(t, k)];
    return channel;
}

}  // namespace octafield::surface::detail
