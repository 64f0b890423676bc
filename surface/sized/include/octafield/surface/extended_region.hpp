// A plane region within a larger one, so that a field's singular points need not be where the region ends.
#pragma once

#include "octafield/surface/direction_field.hpp"

namespace octafield::surface {

struct ExtendedRegion {
    // The region's vertices and triangles first, as they are; then those round it and in its holes.
    TriangleMesh mesh;
    Index vertices = 0, triangles = 0;  // of the region
};

// The rectangle round the region that is `margin` larger on each side (input unit, > 0; 0: half the region's
// shape_size), in the region's plane: outside the region, and in its holes, triangles of a constrained Delaunay
// triangulation (CGAL) with circumcentres added, edges no longer than `longest` (0: margin / 4), angles of about 20
// degrees or more where the boundary allows. No edge of the region is split. Throws InvalidInput: kinds "not_plane"
// (elements: vertices), "bad_option"; GeometryError "empty".
ExtendedRegion extended_region(const SurfaceDomain& region, double margin = 0, double longest = 0);

// (V of the extended mesh) the sizes of the region, and outside it those whose logarithm is harmonic: they turn no
// field there, and are constant where they are constant along the boundary. Throws InvalidInput as wanted_sizes.
Eigen::VectorXd extended_sizes(const ExtendedRegion& region, const Eigen::VectorXd& lengths);

// A field of the extended mesh on the region alone, given as the domain it was extended from. Throws InvalidInput (kind
// "wrong_mesh") where its edges are not edges of the field's.
DirectionField restricted_field(const DirectionField& field, const SurfaceDomain& region);

}  // namespace octafield::surface
