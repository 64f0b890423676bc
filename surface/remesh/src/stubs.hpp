// Feature curves that noise makes.
#pragma once

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// Takes feature curves away that end inside the surface and are shorter than twice the lengths wanted there (V), again
// and again until there are none. Corners that no curve meets any more are none. (k, 2) the edges taken away.
Edges without_stubs(const TriangleMesh& mesh, FeatureGraph& features, const Eigen::VectorXd& lengths);

}  // namespace octafield::surface
