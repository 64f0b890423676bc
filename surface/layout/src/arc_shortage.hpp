// Where no whole numbers fit the arcs of a T-mesh: which arcs stand in the way.
#pragma once

#include "arc_counts.hpp"

namespace octafield::surface::detail {

// Of each arc, by how much it is below its least number where all sums are equal and these shortages sum to the least
// (numbers need not be whole): all 0 where whole numbers fit. A linear programme. Throws SolverError (kind
// "solver_failed").
std::vector<double> arc_shortages(const ArcProblem& problem);

}  // namespace octafield::surface::detail
