// Sides of a layout by their lengths on the surface.
#pragma once

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

// The layout with parameters of sides that are lengths, as the domain measures it, and parameter_area its area. What
// takes steps of parameters makes quads as long as one another then, whatever the field's sizes are.
QuadLayout with_lengths_for_parameters(const QuadLayout& layout);

}  // namespace octafield::surface::detail
