// Faces that end in a needle, where two feature curves meet at a tangent: a cross field turns by nearly a right angle
// across the few degrees there, which may be too much for any triangles.
#pragma once

#include <numbers>

#include "octafield/surface/surface_domain.hpp"

namespace octafield::surface {

struct BluntedFeatures {
    SurfaceDomain domain;     // with other features
    std::vector<Index> tips;  // ascending vertex ids
};

// Where two feature edges leave a vertex, a tip, at less than least_angle (radians), the sides opposite to it of the
// triangles between them become feature edges in place of the shorter of the two. The needle ends there, blunt, and its
// tip belongs to the face beside it; where just these two meet at the tip, both go, so that no curve ends inside a face.
// Done where none of the opposite sides is a feature already; and once for any vertex. Linear.
BluntedFeatures blunted_features(const SurfaceDomain& domain, double least_angle = 10 * std::numbers::pi / 180);

}  // namespace octafield::surface
