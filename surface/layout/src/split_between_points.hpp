// Edges from one singular point or corner to another.
#pragma once

#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

// The same field with edges inside the surface that join two points or corners halved, as curves start and end in the
// triangles at a point and cross between. H and theta are the same functions on finer triangles. Domain, values, H,
// pattern, points and conditions are kept up; features and what leads back to the input are not.
ImposedField split_between_points(const ImposedField& field);

}  // namespace octafield::surface::detail
