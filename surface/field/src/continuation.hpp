// Continuation in the coherence length: wide cores move freely, narrow ones are where they belong.
#pragma once

#include <vector>

#include "components.hpp"

namespace octafield::surface::detail {

// Coherence lengths, one (E) array after the other, the last as given. first: see DirectionFieldOptions::first_epsilon.
std::vector<Eigen::VectorXd> continuation(const Eigen::VectorXd& epsilon, double first, const Components& components);

// Narrows the cores of singular points to a smaller epsilon: their profile is about |f| = s / sqrt(s^2 + c) with s the
// distance in epsilons and some constant c, so s times q makes it q |f| / sqrt(1 + (q^2 - 1) |f|^2).
void narrow_cores(Eigen::VectorXcd& values, const std::vector<bool>& is_held, const Eigen::VectorXd& from,
                  const Eigen::VectorXd& to);

}  // namespace octafield::surface::detail
