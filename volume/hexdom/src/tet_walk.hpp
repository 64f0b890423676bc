// Straight ways through a tet mesh.
#pragma once

#include <vector>

#include "front_field.hpp"

namespace octafield::volume {

// The end of a way and what became of its direction.
struct FrontStep {
    FrontPlace place;           // nowhere: something is in the way
    frames::Vector3 direction;  // unit, at the end
    frames::Vector3 up;         // what a direction at the start turns about: the triangle's normal; 0 inside
};

// Ways from any place: those from triangles, edges and vertices begin in the tet round it that they lead into.
class TetWalker {
public:
    explicit TetWalker(const TetDomain& domain);

    // The surface, interfaces included, is in the way. Places reached have weights above 0.
    FrontStep along(const FrontPlace& from, const frames::Vector3& way) const;

    // Whether nothing is in the way.
    bool free(const FrontPlace& from, const frames::Vector3& way) const { return along(from, way).place.tet >= 0; }

    // The direction at the start for which the way has `axis` at its middle.
    static frames::Vector3 corrected(const FrontStep&, const frames::Vector3&, const frames::Vector3& axis) {
        return axis;
    }

private:
    Index start(const FrontPlace& from, const frames::Vector3& way) const;
    Eigen::Vector4d weights(Index tet, const frames::Vector3& point) const;

    const TetDomain& domain_;
    std::vector<std::uint8_t> wall_;      // per triangle of domain.triangles()
    std::vector<Index> first_, tets_at_;  // tets at each vertex
};

}  // namespace octafield::volume
