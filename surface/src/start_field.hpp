// Fields to start the descent from: harmonic where edges are held, the smoothest eigenvector elsewhere.
#pragma once

#include <cstdint>
#include <vector>

#include "crouzeix_raviart.hpp"
#include "free_system.hpp"
#include "octafield/progress.hpp"

namespace octafield::surface::detail {

// Per edge, the number of the connected component of its triangles: 0, 1, ... by lowest edge.
std::vector<Index> edge_components(const std::vector<CornerLink>& links, Eigen::Index edges);

// Values with |f| = 1. `held` (E) holds the values of the held edges and anything elsewhere. Components with held edges
// get the harmonic extension (K f = 0); the others the eigenvector of K f = lambda M f with the smallest lambda
// (Knoeppel et al. 2013), by inverse iteration from a random field. `masses` (E): the diagonal of M; their unit does
// not matter. False from progress stops the iteration.
Eigen::VectorXcd start_field(const std::vector<CornerLink>& links, const FreeSystem& system,
                             const Eigen::VectorXd& masses, const std::vector<bool>& is_held,
                             const Eigen::VectorXcd& held, std::uint64_t seed, const Progress& progress);

}  // namespace octafield::surface::detail
