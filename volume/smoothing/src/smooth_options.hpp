#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// Throws InvalidInput for values out of range, unknown names, and solvers that do not go with the representation.
void require_sound(const SmoothOptions& options);

}  // namespace octafield::volume
