// What a direction field can be asked to follow beside its feature curves: single directions, and a guide field.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Directions given at edges and vertices. Vectors need no unit length; their part in the tangent plane counts (of an
// edge: the plane between its two triangles), which must be at least 1e-3 of them. They go before features and the mesh
// boundary: an edge named here follows this alone.
//
// Weights, one per direction, in (0, infinity]; no weights at all: infinity. Infinity holds f at the direction's value
// g; a finite weight w adds w/2 |f - g|^2 to the functional (dimensionless, as is the Dirichlet energy: 1 weighs as
// much as the stiffness of about a quarter of an edge).
struct DirectionConstraints {
    Edges edges{0, 2};               // (n, 2) vertex ids of mesh edges, in any order
    Points edge_directions{0, 3};    // (n, 3)
    Eigen::VectorXd edge_weights{};  // (n) or (0)
    // At a vertex the direction is transported (polar map, angles scaled to 2 pi) to the edges that meet there, except
    // those that `edges` or a feature holds; each of them gets the weight.
    std::vector<Index> vertices{};     // (m)
    Points vertex_directions{0, 3};    // (m, 3)
    Eigen::VectorXd vertex_weights{};  // (m) or (0)
};

// A direction in every triangle, principal directions for example, that the field follows as far as smoothness lets it:
// adds 1/2 int w |f - g|^2, w = weight / length^2 (Knoeppel et al. 2013, section 3.3, there with the one parameter t
// for both terms). Features of the guide larger than `length`, where its weight is 1, are followed; smaller ones are
// smoothed away.
struct DirectionGuide {
    Points directions{0, 3};  // (F, 3), projected into the triangles; or (0, 3): no guide
    Eigen::VectorXd
        weights{};      // (F), >= 0, 0 leaves a triangle alone (its direction may be zero); or (0): 1 everywhere
    double length = 0;  // input unit, > 0; 0: 1/10 of the size (shape_size)
};

}  // namespace octafield::surface
