// Imposed fields that were put together by hand.
#pragma once

#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

// Throws InvalidInput (kind "bad_field") for what impose_singular_points would not give.
void require_field(const ImposedField& field);

}  // namespace octafield::surface::detail
