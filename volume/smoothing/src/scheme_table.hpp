// The table of schemes (schemes.hpp) with the function that minimises each.
#pragma once

#include "octafield/progress.hpp"
#include "octafield/volume/schemes.hpp"

namespace octafield::volume {

// `start` is on the constraints; options.solver is one of the scheme's. All of the result but the sh4 energy.
using Minimise = SmoothResult (*)(const Sampling& sampling, const BoundaryConstraints& constraints,
                                  const Quaternions& start, const SmoothOptions& options, const Progress& progress);

// Of the scheme of that name. Throws InvalidInput that lists the names.
Minimise minimise_of(std::string_view name);

}  // namespace octafield::volume
