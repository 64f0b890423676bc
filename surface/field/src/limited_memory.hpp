// The two-loop recursion of L-BFGS (Nocedal, Wright: Numerical Optimization, algorithm 7.4).
#pragma once

#include <Eigen/Core>
#include <deque>
#include <vector>

namespace octafield::surface::detail {

class LimitedMemory {
public:
    explicit LimitedMemory(std::size_t most) : most_(most) {}

    void clear() { pairs_.clear(); }

    // One step and the change of the gradient along it.
    void add(Eigen::VectorXd step, Eigen::VectorXd change) {
        const double product = step.dot(change);
        if (!(product > 0)) return;
        if (pairs_.size() == most_) pairs_.pop_front();
        pairs_.push_back({std::move(step), std::move(change), product});
    }

    // The approximate inverse Hessian applied to `vector`; `solve` applies the one it starts from.
    template <class Solve>
    Eigen::VectorXd apply(Eigen::VectorXd vector, const Solve& solve) const {
        std::vector<double> alpha(pairs_.size());
        for (std::size_t i = pairs_.size(); i-- > 0;) {
            alpha[i] = pairs_[i].step.dot(vector) / pairs_[i].product;
            vector -= alpha[i] * pairs_[i].change;
        }
        Eigen::VectorXd result = solve(vector);
        for (std::size_t i = 0; i < pairs_.size(); ++i)
            result += (alpha[i] - pairs_[i].change.dot(result) / pairs_[i].product) * pairs_[i].step;
        return result;
    }

private:
    struct Pair {
        Eigen::VectorXd step, change;
        double product;
    };
    std::size_t most_;
    std::deque<Pair> pairs_;
};

}  // namespace octafield::surface::detail
