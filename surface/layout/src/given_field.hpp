// What layouts ask of imposed fields, which may be put together by hand.
#pragma once

#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

// Throws InvalidInput (kind "bad_field") for what impose_singular_points would not give.
void require_field(const ImposedField& field);

// Throws InvalidInput (kind "rotated_field") where sizes disagree too much round a loop.
void require_parameters(const ImposedField& field);

// int exp(-2 H).
double parameter_area(const ImposedField& field);

}  // namespace octafield::surface::detail
