// The eigenvector of the least eigenvalue by inverse iteration, several independent ones at once.
#pragma once

#include <Eigen/Core>

namespace octafield::surface::detail {

// values <- solve(values), then scale(values), which makes them of unit norm part by part and returns the norms
// before: estimates of 1 / eigenvalue. Until these change by no more than `tolerance` of themselves; `go_on` false ends
// it, too. Returns the rounds; `settled`: whether the estimates came to rest.
template <class Solve, class Scale, class GoOn>
int inverse_iteration(Eigen::VectorXcd& values, const Solve& solve, const Scale& scale, int most_rounds,
                      double tolerance, const GoOn& go_on, bool& settled) {
    settled = false;
    Eigen::ArrayXd growth = scale(values);
    for (int round = 0; round < most_rounds; ++round) {
        if (!go_on()) return round;
        values = solve(values);
        const Eigen::ArrayXd before = growth;
        growth = scale(values);
        settled = round > 0 && ((growth - before).abs() <= tolerance * growth).all();
        if (settled) return round + 1;
    }
    return most_rounds;
}

}  // namespace octafield::surface::detail
