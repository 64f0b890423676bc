// How near triangles are to equilateral ones.
#pragma once

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// (F) 2 inscribed over circumscribed radius of each triangle (Gmsh's gamma), in [0, 1]: 1 for equilateral ones, 0
// without area; 8 sin(A/2) sin(B/2) sin(C/2) of the angles.
Eigen::VectorXd triangle_qualities(const TriangleMesh& mesh);

}  // namespace octafield::surface
