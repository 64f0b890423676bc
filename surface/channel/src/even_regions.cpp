#include "even_regions.hpp"

#include <algorithm>
#include <numeric>

#include "channel.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

struct Border {
    Index segment;
    Index beside[2];  // regions; the number of regions for the outside
    double length;
};

void require_inside(const std::vector<Border>& borders, Index loops, Index outside) {
    std::vector<Index> stray;
    for (const Border& border : borders)
        if (border.segment >= loops && border.beside[0] == outside && border.beside[1] == outside)
            stray.push_back(border.segment);
    if (!stray.empty())
        throw GeometryError("lines are outside of the region (segments " + first_few(stray) + "); remove them",
                            "outside_line", stray);
}

// One segment for each region to the next one nearer to the outside, the longest.
struct Way {
    Index to = -1;
    Index segment = -1;
};

// The segments whose splitting makes all regions even: odd ones hand their oddness on along a tree to the outside.
std::vector<Index> to_split(const std::vector<Border>& borders, std::vector<char> odd) {
    const Index regions = static_cast<Index>(odd.size()) - 1;
    std::vector<std::vector<const Border*>> round(regions + 1);
    for (const Border& border : borders)
        for (const Index region : border.beside) round[region].push_back(&border);
    std::vector<Way> way(regions + 1);
    std::vector<char> seen(regions + 1, false);
    std::vector<Index> result;
    for (Index root = regions; root >= 0; --root) {  // the outside, then what the mesh inside parts from it
        if (seen[root]) continue;
        seen[root] = true;
        std::vector<Index> order{root};
        for (std::size_t at = 0; at < order.size(); ++at) {
            std::stable_sort(round[order[at]].begin(), round[order[at]].end(),
                             [](const Border* a, const Border* b) { return a->length > b->length; });
            for (const Border* border : round[order[at]])
                for (const Index next : border->beside) {
                    if (seen[next]) continue;
                    seen[next] = true;
                    way[next] = {order[at], border->segment};
                    order.push_back(next);
                }
        }
        for (std::size_t at = order.size(); at-- > 1;) {
            const Index region = order[at];
            if (!odd[region]) continue;
            odd[way[region].to] = !odd[way[region].to];
            result.push_back(way[region].segment);
        }
        if (root != regions && odd[root])
            throw GeometryError("the mesh inside has a hole with an odd number of edges; choose another mesh inside",
                                "odd_interior");
    }
    std::sort(result.begin(), result.end());
    return result;
}

EvenOutline with_middles(const Outline& outline, std::vector<Index> split) {
    EvenOutline result;
    const Index added = static_cast<Index>(split.size()), first = static_cast<Index>(outline.points.rows());
    result.points.resize(first + added, 2);
    result.points.topRows(first) = outline.points;
    result.segments.resize(outline.segments.rows() + added, 2);
    result.loops = outline.loops;
    Index row = 0, next = 0;
    for (Index s = 0; s < outline.segments.rows(); ++s) {
        const Index a = outline.segments(s, 0), b = outline.segments(s, 1);
        if (next == added || split[next] != s) {
            result.segments.row(row++) << a, b;
            continue;
        }
        const Index middle = first + next++;
        result.points.row(middle) = (outline.points.row(a) + outline.points.row(b)) / 2;
        result.segments.row(row++) << a, middle;
        result.segments.row(row++) << middle, b;
        result.loops += s < outline.loops;
    }
    result.split = std::move(split);
    return result;
}

}  // namespace

EvenOutline make_even(const Outline& outline, const InsideMesh& inside, OddLoops odd_loops) {
    const Channel channel = channel_of(outline, inside);
    const PlaneTriangulation& made = channel.made;
    const Index count = static_cast<Index>(outline.segments.rows());
    Index regions = 0;
    const std::vector<Index> region = parts_of(made, channel.open, regions);
    std::vector<Border> borders(count);
    for (Index s = 0; s < count; ++s)
        borders[s] = {s,
                      {regions, regions},
                      (outline.points.row(outline.segments(s, 1)) - outline.points.row(outline.segments(s, 0))).norm()};
    std::vector<char> odd(regions + 1, false);
    for (Index t = 0; t < made.triangles.rows(); ++t) {
        if (!channel.open[t]) continue;
        odd[region[t]] = !odd[region[t]];  // as many triangles as sides, to an even number
        for (int k = 0; k < 3; ++k) {
            const Index s = made.segments(t, k);
            if (s < 0 || s >= count) continue;
            borders[s].beside[made.triangles(t, (k + 1) % 3) == outline.segments(s, 0) ? 0 : 1] = region[t];
        }
    }
    require_inside(borders, outline.loops, regions);
    std::vector<Index> split;
    if (odd_loops == OddLoops::split_all) {
        split.resize(count);
        std::iota(split.begin(), split.end(), 0);
    } else {
        split = to_split(borders, odd);
    }
    if (!split.empty() && odd_loops == OddLoops::refuse)
        throw GeometryError(
            "regions have an odd number of segments round them, and quads need an even one: split one "
            "segment of each loop, such as " +
                first_few(split) + " (loops first, then lines), or choose split_one or split_all for odd_loops",
            "odd_boundary", split);
    return with_middles(outline, std::move(split));
}

}  // namespace octafield::surface::detail
