// The sh4 vectors of the frames of a field.
#pragma once

#include "octafield/arrays.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::volume {

using Sh4Field = Rows<double, frames::Sh4::dimension>;

// (n, 9) of (n, 4) unit quaternions w x y z. The same bits at any thread count.
Sh4Field embedded(const Quaternions& frames, int threads);

}  // namespace octafield::volume
