// Principal curvatures and directions of a triangle mesh.
#pragma once

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

struct PrincipalDirections {
    Points directions;           // (F, 3) unit, in the triangle's plane: of the curvature that is larger in size
    Rows<double, 2> curvatures;  // (F, 2) |first| >= |second|, the first one along `directions`; 1 / input unit,
                                 // positive where the surface bends away from its normal (a sphere seen from outside)
    // (F) in [0, 1]: |k1 - k2| / (|k1| + |k2| + 1 / shape_size): 0 where the surface is flat or bends
    // alike in all directions and the direction means nothing, near 1 on thin cylinders and saddles.
    Eigen::VectorXd anisotropy;
};

// Shape operator of each triangle from the change of the vertex normals along its edges (Rusinkiewicz 2004, normals
// weighted as by Max 1999, which is exact on spheres), averaged over the triangles round its vertices. Neither normals
// nor averages reach across features, so both sides of a sharp edge keep their own curvature. At the boundary and along
// features the normals are one-sided: curvatures there come from the next triangles inside as far as there are any.
PrincipalDirections principal_directions(const SurfaceDomain& domain);

}  // namespace octafield::surface
