// Longest-edge bisection: smaller triangles, the same geometry.
#pragma once

#include <vector>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

struct BisectedEdges {
    SurfaceDomain domain;        // first the input's vertices, then midpoints of edges; its features are the input's
    std::vector<Index> parents;  // (F) the triangle of the input that each is part of
};

// Edges longer than `longest`, (F) > 0, of one of their triangles are halved, the longest first, with the triangles
// beside them, until none is left; parts of a triangle have its `longest`. Throws InvalidInput (kind "bad_option":
// lengths that are no numbers above 0; "too_many": above most_triangles, elements: none).
BisectedEdges bisected_edges(const SurfaceDomain& domain, const Eigen::VectorXd& longest,
                             Index most_triangles = 50000000);

}  // namespace octafield::surface
