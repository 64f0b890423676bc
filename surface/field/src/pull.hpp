// The quadratic terms of the functional: what the field should follow without being held.
#pragma once

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

// sum_e 1/2 sum_k c_ek |f_e - g_ek|^2 = sum_e (1/2 weights_e |f_e|^2 - Re(conj(targets_e) f_e)) + constant, |g_ek| = 1.
struct Pull {
    explicit Pull(Eigen::Index edges = 0)
        : weights(Eigen::VectorXd::Zero(edges)), targets(Eigen::VectorXcd::Zero(edges)) {}

    void add(Index edge, double weight, Complex value) {
        weights[edge] += weight;
        targets[edge] += weight * value;
        constant += weight / 2;
    }
    double energy(const Eigen::VectorXcd& values) const {
        return weights.dot(values.cwiseAbs2()) / 2 - targets.dot(values).real() + constant;
    }

    Eigen::VectorXd weights;   // (E), sums of c
    Eigen::VectorXcd targets;  // (E), sums of c g
    double constant = 0;
};

}  // namespace octafield::surface::detail
