// Exact signs in the coordinates of a periodic map, which are integers below 2^31.
#pragma once

#include <array>
#include <cstdint>

#include "octafield/volume/periodic_map.hpp"

namespace octafield::volume {

__extension__ typedef __int128 Wide;

using Coordinate = std::array<std::int64_t, 3>;  // in units of the map

inline Coordinate operator-(const Coordinate& a, const Coordinate& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

inline Wide determinant(const Coordinate& a, const Coordinate& b, const Coordinate& c) {
    const auto minor = [&](int i, int j) { return Wide(b[i]) * c[j] - Wide(b[j]) * c[i]; };
    return a[0] * minor(1, 2) - a[1] * minor(0, 2) + a[2] * minor(0, 1);
}

// Six times the volume of a, b, c, d.
inline Wide orientation(const Coordinate& a, const Coordinate& b, const Coordinate& c, const Coordinate& d) {
    return determinant(b - a, c - a, d - a);
}

inline int sign(Wide value) { return value > 0 ? 1 : value < 0 ? -1 : 0; }

using TetCoordinates = std::array<Coordinate, 4>;

inline TetCoordinates coordinates_of(const PeriodicMap& map, Index tet) {
    TetCoordinates corners;
    for (int c = 0; c < 4; ++c)
        for (int i = 0; i < 3; ++i) corners[c][i] = map.coordinates(tet, 3 * c + i);
    return corners;
}

// Barycentric coordinates of a point, times six volumes of the tet.
inline std::array<Wide, 4> barycentric(const TetCoordinates& t, const Coordinate& x) {
    return {orientation(x, t[1], t[2], t[3]), orientation(t[0], x, t[2], t[3]), orientation(t[0], t[1], x, t[3]),
            orientation(t[0], t[1], t[2], x)};
}

}  // namespace octafield::volume
