// Where the coordinates of a periodic map are held on integers.
#pragma once

#include <cstdint>
#include <vector>

#include "edge_fans.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

class IntegerConstraints {
public:
    IntegerConstraints(const TetDomain& domain, const Quaternions& of_tets, double angle);

    // Per row of the triangle table: the axis of the tet on its first side that is normal to the surface there, or -1.
    const std::vector<std::int8_t>& normal_axis() const { return normal_axis_; }
    bool corner(Index vertex) const { return corner_[vertex]; }
    // Along the edge of the fan these axes of the first tet keep their integer: bit i for axis i. Normals of the
    // surface's triangles at the edge, and what is across a feature's direction.
    int fixed_axes(const EdgeFan& fan) const;

private:
    int across_feature(const EdgeFan& fan) const;

    const TetDomain& domain_;
    const Quaternions& of_tets_;
    double cosine_;
    std::vector<std::int8_t> normal_axis_;
    std::vector<std::uint8_t> corner_;
    std::vector<std::pair<Index, Index>> features_;  // tet-mesh vertices, sorted
};

}  // namespace octafield::volume
