// From tet to tet in a periodic map.
#pragma once

#include <vector>

#include "exact_coordinates.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// A rotation of the cube and a translation: coordinates in one tet from those in another.
struct ChartChange {
    std::array<std::int8_t, 3> axis{0, 1, 2};  // of the old coordinates
    std::array<std::int8_t, 3> sign{1, 1, 1};
    Coordinate shift{0, 0, 0};
    Coordinate operator()(const Coordinate& x) const {
        return {sign[0] * x[axis[0]] + shift[0], sign[1] * x[axis[1]] + shift[1], sign[2] * x[axis[2]] + shift[2]};
    }
};

class MapCharts {
public:
    MapCharts(const TetDomain& domain, const PeriodicMap& map);

    const PeriodicMap& map() const { return map_; }
    const TetDomain& domain() const { return domain_; }
    // The tet across the triangle opposite a corner; -1: none, or the map does not join them.
    Index joined(Index tet, int corner) const;
    // The same, and -1 between regions: cells lie in one.
    Index across(Index tet, int corner) const;
    ChartChange change(Index tet, int corner) const;  // where joined() is a tet
    bool on_surface(Index tet, int corner) const;     // of the mesh, or between regions

private:
    const TetDomain& domain_;
    const PeriodicMap& map_;
    std::vector<Index> face_;              // per row of the triangle table: of map.faces, or -1
    std::vector<std::uint8_t> interface_;  // per row: between regions
};

// A point of the tet, in the coordinates of the tet that it is in.
struct Place {
    Index tet = -1;
    Coordinate at{};
};

enum class WalkEnd {
    reached,
    surface,   // of the mesh or between regions, in the way
    unusable,  // a tet or triangle of no use in the way
    edge       // the way meets an edge: start elsewhere
};

struct Walk {
    WalkEnd end;
    Place place;         // the goal; of others the tet reached, and the goal in its coordinates
    Coordinate carried;  // a second point in the coordinates of that tet
};

// Goes straight from a point inside a tet to another point in the coordinates of that tet.
Walk walk(const MapCharts& charts, Index tet, Coordinate from, Coordinate to, Coordinate carried = {});

}  // namespace octafield::volume
