// Sites in an order that keeps neighbours together in memory.
#pragma once

#include <vector>

#include "octafield/volume/boundary.hpp"
#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

// Sites breadth first from an end of each component of the matrix's graph (Cuthill, McKee 1969).
std::vector<Index> breadth_first_order(const SparseMatrix& matrix);

// Site i of the results is site order[i] of the arguments; without the mesh (Sampling::elements).
Sampling reordered(const Sampling& sampling, const std::vector<Index>& order);
BoundaryConstraints reordered(const BoundaryConstraints& constraints, const std::vector<Index>& order);
Quaternions reordered(const Quaternions& frames, const std::vector<Index>& order);

std::vector<Index> inverse_order(const std::vector<Index>& order);

}  // namespace octafield::volume
