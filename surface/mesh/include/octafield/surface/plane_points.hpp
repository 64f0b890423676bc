// Points of a plane.
#pragma once

#include "octafield/arrays.hpp"

namespace octafield::surface {

using PlanePoints = Rows<double, 2>;  // (n, 2) x, y or u, v

}  // namespace octafield::surface
