// The convex problem for the factors of lines.
#pragma once

#include <functional>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface::detail {

// One term (2 sinh(a / 2))^(4 power), a = offset + x[one] - x[other].
struct RatioTerm {
    Index one, other;
    double offset;
};

struct LogFactors {
    Eigen::VectorXd x;        // (unknowns), 0 for the lowest of each connected part
    std::vector<Index> part;  // (unknowns) the lowest unknown connected with each
    double objective = 0;
    int iterations = 0;
    bool converged = true;
};

// Newton's method with line search from the least squares solution in a. `go_on` false ends it (not converged).
LogFactors least_log_factors(const std::vector<RatioTerm>& terms, Index unknowns, int power, int max_iterations,
                             const std::function<bool(double)>& go_on);

}  // namespace octafield::surface::detail
