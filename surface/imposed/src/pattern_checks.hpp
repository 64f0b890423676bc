// What a caller asks to be imposed, checked.
#pragma once

#include "built_field.hpp"
#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface::detail {

// Throws what impose_singular_points says of patterns, but for "coincident_points" and "inadmissible_pattern".
Imposed checked_pattern(const SurfaceDomain& domain, const Structure& structure, const SingularPattern& pattern,
                        const ImposedFieldOptions& options);

}  // namespace octafield::surface::detail
