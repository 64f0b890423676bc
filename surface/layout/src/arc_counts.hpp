// Whole numbers for the arcs of a T-mesh.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface::detail {

// Of arcs on two sides; an arc may be named again.
struct EqualSums {
    std::vector<Index> left, right;
};

// Counts times factors, added up: within these limits. Arcs behind the last factor have 0.
struct BoundedSum {
    std::vector<double> factors;
    double low, high;
};

struct ArcProblem {
    std::vector<double> wanted;   // of each arc, >= 0
    std::vector<double> weights;  // >= 0
    std::vector<int> least;       // >= 0
    std::vector<EqualSums> sums;
    // Deviations that are large beside the number wanted count more: three times above 0.25 or below 0.2 of it, nine
    // times above 0.75 or below 0.45, so that none gives way by much where many can by a little.
    bool even = false;
    std::optional<BoundedSum> bounded = {};  // arcs with a factor are solved together
    // By Cbc, before it branches. Bounds that cross there may end the process in an assertion of Clp 1.17 (seen with
    // arcs of blocks in volumes), and nothing can catch that. Not seen with arcs of surfaces, where without it whole
    // numbers take half as long again (i05c of HexMe: 21 s of CPU time against 14) and end at the limit of nodes.
    bool preprocess = true;
};

struct ArcCounts {
    std::vector<int> counts;
    double deviation = 0;  // sum of weights |count - wanted|
    double bound = 0;      // that no choice is below
    bool optimal = true;   // proven; otherwise the limit of nodes was reached
};

// The least sum of weights |count - wanted|, by branch and bound (Cbc), stopped by a number of nodes and never by time.
// What shares no sum is solved apart. Throws GeometryError (kind "no_integers", elements: arcs) where there are no such
// numbers, and SolverError (kind "node_limit") where none are found.
ArcCounts integer_counts(const ArcProblem& problem, int most_nodes);

// That sum where numbers need not be whole, without arcs that share no sum: a bound of it. Infinite where none fit.
double least_deviation(const ArcProblem& problem);

}  // namespace octafield::surface::detail
