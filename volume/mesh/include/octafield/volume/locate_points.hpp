// Which tet holds a point, and points spread over a tet mesh.
#pragma once

#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct LocatedPoints {
    std::vector<Index> tet;   // -1: outside the mesh
    Rows<double, 4> weights;  // barycentric in the tet, >= 0, sum 1; 0 outside
};

// The tet that holds each point: of several, the one it lies deepest in. Points within 1e-9 of a tet's heights count
// as inside. Linear in the tets for points that are spread. The same at any thread count.
LocatedPoints locate_points(const TetDomain& domain, const Points& points, int threads = 0);

// Centres of at most `count` tets, at random (the same at every call) but none nearer than a certain distance to
// another, so that they fill the mesh evenly (Poisson disk sampling). Throws InvalidInput for a negative count.
Points spread_points(const TetDomain& domain, int count);

}  // namespace octafield::volume
