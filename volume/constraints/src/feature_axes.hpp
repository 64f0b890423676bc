// The three directions that hexahedra along feature edges ask of a frame.
#pragma once

#include <vector>

#include "octafield/frames/quaternion.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::volume {

struct FeatureAxes {
    Index vertex;          // of the surface
    frames::Matrix3 axes;  // unit columns, of any signs
};

// At corners of three curves the directions of these; along curves the tangent, and in each of the two faces beside it
// the direction whose angle from the tangent goes linearly by length between those that the ends ask for: that of the
// face's other edge where its corner has one or three quads, else (and on closed curves) a right angle. Only where all
// edges have one or three hexahedra, and all faces at a corner one or three quads. corner_angle: of AxesStretchOptions,
// radians. Ascending vertices.
std::vector<FeatureAxes> feature_axes(const surface::TriangleMesh& surface, const surface::FeatureGraph& features,
                                      double corner_angle);

}  // namespace octafield::volume
