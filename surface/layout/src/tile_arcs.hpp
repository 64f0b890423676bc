// The conditions on whole numbers of a T-mesh's arcs.
#pragma once

#include "arc_counts.hpp"
#include "octafield/surface/quantized_quads.hpp"

namespace octafield::surface::detail {

// Equal sums on opposite sides; least: 1, but 2 for arcs between the same two vertices, and 3 for one from a vertex to
// itself, so that edges of the mesh are different. wanted and weights are for the size.
ArcProblem arc_problem(const QuadLayout& layout);
void set_size(ArcProblem& problem, const QuadLayout& layout, double size, ArcWeights weights);

// The arcs with the given counts, each of whose quads is to be split as all others in its row: a problem in those
// splits, >= 1, behind the arcs.
ArcProblem split_problem(const QuadLayout& layout, const ArcProblem& arcs, const std::vector<int>& counts);

double total_quads(const QuadLayout& layout, const std::vector<int>& counts);

}  // namespace octafield::surface::detail
