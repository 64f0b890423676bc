// How many vertices triangles of wanted lengths, or of a wanted deviation, are going to have.
#pragma once

#include "octafield/surface/close_remesh.hpp"

namespace octafield::surface {

// lengths: (V) wanted at the vertices, linear between, input unit.
double vertices_at(const TriangleMesh& mesh, const Eigen::VectorXd& lengths);

// So that triangles are within `deviation` (input unit) of the input, whose features they follow: its other edges are
// cut off where triangles are larger than its own, and have short edges beside them where they are smaller.
double vertices_within(const TriangleMesh& mesh, const FeatureGraph& features, double deviation);

// Throws InvalidInput (kind too_many_cells, too_few_cells) where no such mesh can be made.
void require_possible(const TriangleMesh& mesh, const FeatureGraph& features, const Eigen::VectorXd& lengths,
                      const CloseRemeshOptions& options);

}  // namespace octafield::surface
