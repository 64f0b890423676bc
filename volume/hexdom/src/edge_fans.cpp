#include "edge_fans.hpp"

#include <algorithm>

#include "axis_numbers.hpp"

namespace octafield::volume {
namespace {

// The row of the triangle through which the way round enters.
Index entry_row(const TetAtEdge& at, const TriangleTable& table) {
    for (int k = 0; k < 4; ++k) {
        const Index row = table.tet_triangles(at.tet, k);
        const auto v = table.triangles.row(row);
        const auto has = [&](Index id) { return v[0] == id || v[1] == id || v[2] == id; };
        if (has(at.a) && has(at.b) && has(at.enter)) return row;
    }
    return -1;
}

CarriedAxes carried(const CarriedAxes& before, int matching) {
    CarriedAxes after;
    for (int i = 0; i < 3; ++i) {
        const int axis = turned_axis(matching, i);
        after[i] = static_cast<std::uint8_t>(axis < 3 ? before[axis] : opposite_axis(before[axis - 3]));
    }
    return after;
}

}  // namespace

void edge_fans(std::span<const TetAtEdge> tets, const TriangleTable& table, const std::vector<std::uint8_t>& matching,
               std::vector<EdgeFan>& fans) {
    std::vector<std::uint8_t> done(tets.size(), 0);
    const auto walk = [&](std::size_t first) {
        EdgeFan fan{tets[first].a, tets[first].b, {}, false, {0, 1, 2}};
        CarriedAxes axes{0, 1, 2};
        for (std::size_t i = first; !done[i];) {
            const TetAtEdge& at = tets[i];
            done[i] = 1;
            fan.tets.push_back({at.tet, axes, entry_row(at, table), at.triangle});
            if (table.sides(at.triangle, 1) < 0) break;
            const bool forward = table.sides(at.triangle, 0) / 4 == at.tet;
            const int m = matching[at.triangle];
            axes = carried(axes, forward ? m : frames::octahedral_inverse(m));
            i = std::find_if(tets.begin(), tets.end(), [&](const TetAtEdge& t) { return t.enter == at.leave; }) -
                tets.begin();
            if (i == tets.size()) break;
            if (i != first) continue;
            fan.closed = true;
            fan.round = axes;
        }
        fans.push_back(std::move(fan));
    };
    for (std::size_t i = 0; i < tets.size(); ++i)
        if (!done[i] && table.sides(entry_row(tets[i], table), 1) < 0) walk(i);
    for (std::size_t i = 0; i < tets.size(); ++i)
        if (!done[i]) walk(i);
}

}  // namespace octafield::volume
