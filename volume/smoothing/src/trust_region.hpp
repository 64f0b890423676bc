// Riemannian trust region for the Dirichlet energy of an embedded frame field (after Palmer, Bommes, Solomon 2020,
// section 5): Newton steps with the exact Hessian, solved by truncated conjugate gradients (Steihaug 1983).
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

// Of options.representation, one of frames/registry.hpp. `start` is on the constraints.
SmoothResult trust_region(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                          const SmoothOptions& options, const Progress& progress);

// Of a scheme of the user's. Throws InvalidInput (what its functions give), and what they throw.
SmoothResult trust_region(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                          const ArrayScheme& scheme, const SmoothOptions& options, const Progress& progress);

}  // namespace octafield::volume
