// How well a frame field follows feature curves. For normals: alignment_angles in boundary.hpp.
#pragma once

#include <vector>

#include "octafield/volume/boundary.hpp"

namespace octafield::volume {

// Directions of the feature curves at their vertices. On a curve (two feature edges, no corner): one, the mean of its
// edges. At corners and ends: one per feature edge.
struct FeatureTangents {
    std::vector<Index> vertex;  // boundary-mesh vertex id, ascending
    Points tangent;             // (k, 3) unit, sign arbitrary
};
// Throws InvalidInput where the features are not of this mesh.
FeatureTangents feature_tangents(const TetDomain& domain);

// Angle (radians, at most 0.9554, of the diagonal) between each feature tangent and the nearest axis of its vertex's
// frame, in the order of feature_tangents. frames: (n, 4) unit quaternions w x y z, one per tet-mesh vertex. Throws
// InvalidInput.
Eigen::VectorXd feature_alignment_angles(const TetDomain& domain,
                                         const Quaternions& frames);

}  // namespace octafield::volume
