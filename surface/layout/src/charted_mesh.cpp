#include "charted_mesh.hpp"

#include <algorithm>
#include <cmath>

namespace octafield::surface::detail {

constexpr double same_place = 1e-9;  // of a seam's length

Index ChartedMesh::halve(Index side, Index middle, double fraction) {
    const Index t = side / 3, after = next(side), last = before(side);
    const auto added = static_cast<Index>(triangles.size());
    const auto corners = triangles[t];
    const Index b = corners[after % 3], c = corners[last % 3];
    // t keeps the side's start; the new triangle is (middle, b, c).
    triangles.push_back({middle, b, c});
    origins.push_back(origins[t]);
    triangles[t][after % 3] = middle;
    mates.insert(mates.end(), {mates[side], mates[after], after});
    across.insert(across.end(), {across[side], across[after], QuarterTurn{}});
    const Vector2 place = (1 - fraction) * start[side] + fraction * start[after];
    start.insert(start.end(), {place, start[after], start[last]});
    start[after] = place;
    on_seams.insert(on_seams.end(), {on_seams[side], on_seams[after], OnSeam{}});
    if (mates[after] >= 0) mates[mates[after]] = 3 * added + 1;
    if (on_seams[after].twin >= 0) on_seams[on_seams[after].twin].twin = 3 * added + 1;
    mates[after] = 3 * added + 2;
    across[after] = {};
    on_seams[after] = {};
    if (on_seams[side].seam >= 0) {
        const double at = (1 - fraction) * on_seams[side].from + fraction * on_seams[side].to;
        on_seams[side].to = on_seams[3 * added].from = at;
    }
    for (Fixed& f : fixed)
        if (f.corner == after) f.corner = 3 * added + 1;
    return 3 * added;
}

void ChartedMesh::split_here(Index side, double fraction) {
    const Index a = from(side), b = from(next(side));
    const auto middle = static_cast<Index>(positions.size());
    positions.emplace_back((1 - fraction) * positions[a] + fraction * positions[b]);
    const Index mate = mates[side];
    const Index second = halve(side, middle, fraction);
    if (mate < 0) return;
    const Index mates_second = halve(mate, middle, 1 - fraction);
    // The mate's first half lies along the second half here.
    mates[second] = mate;
    mates[mate] = second;
    mates[side] = mates_second;
    mates[mates_second] = side;
}

void ChartedMesh::split(Index side, double fraction) {
    const Index twin = on_seams[side].twin;
    const auto second = static_cast<Index>(side_count());
    split_here(side, fraction);
    if (twin < 0) return;
    const auto twins_second = static_cast<Index>(side_count());
    split_here(twin, 1 - fraction);
    on_seams[second].twin = twin;
    on_seams[twin].twin = second;
    on_seams[side].twin = twins_second;
    on_seams[twins_second].twin = side;
}

std::vector<Index> ChartedMesh::corners_round(Index side) const {
    Index first = side;
    while (mates[first] >= 0) {
        first = next(mates[first]);
        if (first == side) break;
    }
    std::vector<Index> result = {first};
    for (;;) {
        const Index after = mates[before(result.back())];
        if (after < 0 || after == first) return result;
        result.push_back(after);
    }
}

void ChartedMesh::match_seams() {
    std::vector<std::array<std::vector<Index>, 2>> sides(seams.size());
    const auto is_down = [&](Index s) { return on_seams[s].from > on_seams[s].to; };
    const auto low = [&](Index s) { return std::min(on_seams[s].from, on_seams[s].to); };
    const auto high = [&](Index s) { return std::max(on_seams[s].from, on_seams[s].to); };
    for (Index s = 0; s < side_count(); ++s)
        if (on_seams[s].seam >= 0) sides[on_seams[s].seam][is_down(s)].push_back(s);
    for (std::size_t n = 0; n < sides.size(); ++n) {
        auto& both = sides[n];
        const double apart = same_place * seams[n].length;
        for (auto& one : both) std::sort(one.begin(), one.end(), [&](Index a, Index b) { return low(a) < low(b); });
        for (std::size_t i = 0, j = 0; i < both[0].size() && j < both[1].size(); ++i, ++j)
            for (;;) {
                const Index a = both[0][i], b = both[1][j];
                const double off = high(a) - high(b);
                if (std::abs(off) < apart) {
                    on_seams[a].twin = b;
                    on_seams[b].twin = a;
                    break;
                }
                const bool first = off > 0;  // is longer
                const Index longer = first ? a : b;
                const double fraction = (high(first ? b : a) - low(longer)) / (high(longer) - low(longer));
                split(longer, is_down(longer) ? 1 - fraction : fraction);
                // The side keeps its start; what is new comes last.
                const Index added = side_count() - 3;
                auto& list = both[!first];
                const auto place = list.begin() + static_cast<std::ptrdiff_t>(first ? i : j);
                list.insert(place + (is_down(longer) ? 0 : 1), added);
            }
    }
}

}  // namespace octafield::surface::detail
