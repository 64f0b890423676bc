#include "continuation.hpp"

#include <algorithm>
#include <cmath>

namespace octafield::surface::detail {

constexpr double continuation_ratio = 5;  // at most

std::vector<Eigen::VectorXd> continuation(const Eigen::VectorXd& epsilon, double first, const Components& components) {
    const double widest = *std::max_element(components.sizes.begin(), components.sizes.end()) / 10;
    if (first == 0 || first > widest) first = widest;
    const double fall = first / epsilon.minCoeff();
    const int steps = fall > 1 ? static_cast<int>(std::ceil(std::log(fall) / std::log(continuation_ratio) - 1e-9)) : 0;
    std::vector<Eigen::VectorXd> stages;
    for (int i = 0; i < steps; ++i) {
        const double least = first * std::pow(fall, -static_cast<double>(i) / steps);
        stages.push_back(epsilon);
        for (Eigen::Index e = 0; e < epsilon.size(); ++e)
            stages.back()[e] = std::max(epsilon[e], std::min(least, components.sizes[components.of_edge[e]] / 10));
    }
    stages.push_back(epsilon);
    return stages;
}

void narrow_cores(Eigen::VectorXcd& values, const std::vector<bool>& is_held, const Eigen::VectorXd& from,
                  const Eigen::VectorXd& to) {
    for (Eigen::Index e = 0; e < values.size(); ++e) {
        const double q = from[e] / to[e], square = std::min(1.0, std::norm(values[e]));
        if (!is_held[e]) values[e] *= q / std::sqrt(1 + (q * q - 1) * square);
    }
}

}  // namespace octafield::surface::detail
