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

// The same of each connected part; part_of: of each vertex.
std::vector<double> parameter_areas(const ImposedField& field, const std::vector<Index>& part_of, Index parts);

}  // namespace octafield::surface::detail
