// The conditions on whole numbers of a T-mesh's arcs.
#pragma once

#include "arc_counts.hpp"
#include "octafield/surface/quantized_quads.hpp"
#include "quad_rows.hpp"

namespace octafield::surface::detail {

// Equal sums on opposite sides; least: 1, but 2 for arcs between the same two vertices, and 3 for one from a vertex to
// itself, so that edges of the mesh are different. Behind the arcs the parts of seams, 0 at least, whose sums the arcs
// on them are, then the seams, 1 at least, 2 between the same two nodes, 3 if closed. set_size:
// wanted and weights, of parts a quarter, of seams and of what is behind them 0.
ArcProblem arc_problem(const QuadLayout& layout, const Seams& seams);
ArcProblem arc_problem(const std::vector<const QuadLayout*>& layouts, const Seams& seams);  // of parts, in turn
void set_size(ArcProblem& problem, const QuadLayout& layout, const Seams& seams, double size, ArcWeights weights);
void set_size(ArcProblem& problem, const std::vector<const QuadLayout*>& layouts, const Seams& seams, double size,
              ArcWeights weights);

// Seams that bend get 2 at least where they are as long as the size, so that there is a vertex to be held.
void require_bends(ArcProblem& problem, const QuadLayout& layout, const Seams& seams, double size);

// The problem in the splits of rows of quads, >= 1, behind the rest.
ArcProblem split_problem(const QuadRows& rows, const ArcProblem& arcs);

double total_quads(const QuadLayout& layout, const std::vector<int>& counts);

// Their number near those counts, linear in what counts differ by: a factor for each side, and what is added.
struct QuadsNear {
    std::vector<double> factors;
    double constant;
};
QuadsNear quads_near(const QuadLayout& layout, const std::vector<int>& counts);

// Root of the mean square, over quads and their two directions, of the logarithm of steps of parameters over the size.
double unevenness(const QuadLayout& layout, const std::vector<int>& counts, double size);

}  // namespace octafield::surface::detail
