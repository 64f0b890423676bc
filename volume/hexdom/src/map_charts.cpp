#include "map_charts.hpp"

#include "axis_numbers.hpp"

namespace octafield::volume {

MapCharts::MapCharts(const TetDomain& domain, const PeriodicMap& map)
    : domain_(domain), map_(map), face_(domain.triangles().triangles.rows(), -1), interface_(face_.size(), 0) {
    Index f = 0;
    for (std::size_t row = 0; row < face_.size(); ++row)
        if (domain.triangles().sides(row, 1) >= 0) face_[row] = f++;
    for (std::size_t s = 0; s < domain.surface_rows().size(); ++s)
        if (domain.sides()(s, 1) >= 0) interface_[domain.surface_rows()[s]] = 1;
}

Index MapCharts::beside(Index tet, int corner) const {
    const Index f = face_[domain_.triangles().tet_triangles(tet, corner)];
    if (f < 0 || !map_.joined[f]) return -1;
    return map_.faces.tets(f, map_.faces.tets(f, 0) == tet);
}

Index MapCharts::across(Index tet, int corner) const {
    return interface_[domain_.triangles().tet_triangles(tet, corner)] ? -1 : beside(tet, corner);
}

ChartChange MapCharts::change(Index tet, int corner) const {
    const Index f = face_[domain_.triangles().tet_triangles(tet, corner)];
    ChartChange forth;  // y_i = sign_i x_axis_i + shift_i
    for (int i = 0; i < 3; ++i) {
        const int axis = turned_axis(map_.faces.matching[f], i);
        forth.axis[i] = static_cast<std::int8_t>(axis % 3);
        forth.sign[i] = axis < 3 ? 1 : -1;
        forth.shift[i] = std::int64_t(map_.translation(f, i)) * periodic_unit;
    }
    if (map_.faces.tets(f, 0) == tet) return forth;
    ChartChange back;  // x_axis_i = sign_i (y_i - shift_i)
    for (int i = 0; i < 3; ++i) {
        back.axis[forth.axis[i]] = static_cast<std::int8_t>(i);
        back.sign[forth.axis[i]] = forth.sign[i];
        back.shift[forth.axis[i]] = -forth.sign[i] * forth.shift[i];
    }
    return back;
}

bool MapCharts::on_surface(Index tet, int corner) const {
    const Index row = domain_.triangles().tet_triangles(tet, corner);
    return face_[row] < 0 || interface_[row];
}

Walk walk(const MapCharts& charts, Index tet, Coordinate from, Coordinate to, Coordinate carried) {
    constexpr int most_steps = 1000;
    int entered = -1;  // corner opposite the triangle through which the way came
    const auto ends = [&](WalkEnd end) { return Walk{end, {tet, to}, carried}; };
    for (int step = 0; step < most_steps; ++step) {
        const TetCoordinates corners = coordinates_of(charts.map(), tet);
        const std::array<Wide, 4> inside = barycentric(corners, to);
        if (inside[0] >= 0 && inside[1] >= 0 && inside[2] >= 0 && inside[3] >= 0) return ends(WalkEnd::reached);
        int exit = -1;
        for (int k = 0; k < 4 && exit < 0; ++k) {
            if (k == entered || inside[k] >= 0) continue;
            const auto& [a, b, c] = tet_face[k];
            const int one = sign(orientation(from, to, corners[a], corners[b])),
                      two = sign(orientation(from, to, corners[b], corners[c])),
                      three = sign(orientation(from, to, corners[c], corners[a]));
            const bool through = one * two >= 0 && two * three >= 0 && three * one >= 0;
            if (through && (one == 0 || two == 0 || three == 0)) return ends(WalkEnd::edge);
            if (through) exit = k;
        }
        if (exit < 0) return ends(WalkEnd::edge);
        const Index next = charts.across(tet, exit);
        if (next < 0) return ends(charts.on_surface(tet, exit) ? WalkEnd::surface : WalkEnd::unusable);
        const ChartChange change = charts.change(tet, exit);
        from = change(from);
        to = change(to);
        carried = change(carried);
        const Index row = charts.domain().triangles().tet_triangles(tet, exit);
        for (int k = 0; k < 4; ++k)
            if (charts.domain().triangles().tet_triangles(next, k) == row) entered = k;
        tet = next;
    }
    return ends(WalkEnd::unusable);
}

}  // namespace octafield::volume
