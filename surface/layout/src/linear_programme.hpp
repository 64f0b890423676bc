// Linear programmes over numbers >= 0.
#pragma once

#include <limits>
#include <map>
#include <optional>
#include <vector>

#include "octafield/arrays.hpp"

namespace octafield::surface::detail {

struct LinearSum {
    std::map<Index, double> factors;  // by number
    double constant = 0;

    LinearSum& add(const LinearSum& other, double times = 1) {
        for (const auto& [number, factor] : other.factors) factors[number] += times * factor;
        constant += times * other.constant;
        return *this;
    }
};

struct LinearProgramme {
    std::vector<double> most;       // of each number
    std::vector<LinearSum> none;    // sums that are 0
    std::vector<LinearSum> enough;  // sums that are >= 0

    Index add(double at_most = std::numeric_limits<double>::infinity()) {
        most.push_back(at_most);
        return static_cast<Index>(most.size()) - 1;
    }
    // Numbers for which the sum is least; none if there are none or the solver fails.
    std::optional<std::vector<double>> least(const LinearSum& sum) const;
};

}  // namespace octafield::surface::detail
