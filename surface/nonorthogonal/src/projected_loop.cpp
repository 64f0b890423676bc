#include "projected_loop.hpp"

#include <algorithm>
#include <cmath>

#include "limited_memory.hpp"

namespace octafield::surface::detail {
namespace {

constexpr std::size_t memory_size = 10;
constexpr int steps_per_round = 200;
constexpr double flat = 1e-7;  // gradient over that at the start of the first round
constexpr double armijo = 1e-4, least_length = 1e-10;

// The function of one round. Unknowns: real and imaginary part of u and v, those that are free.
class RoundEnergy {
public:
    RoundEnergy(const std::vector<VertexLink>& links, const BoundaryLines& boundary, const VertexCharts& charts,
                const NonOrthogonalFieldOptions& options, const std::vector<TwoLines>& lines)
        : links_(links), options_(options), values_(2 * lines.size()) {
        for (std::size_t v = 0; v < lines.size(); ++v) {
            const auto vertex = static_cast<Index>(v);
            values_[2 * v] = std::polar(1.0, 2 * lines[v].first);
            values_[2 * v + 1] = std::polar(1.0, 2 * lines[v].second);
            if (!charts.used(vertex)) continue;
            const bool inside = !charts.on_boundary(vertex);
            if (inside) free_.push_back(static_cast<Index>(2 * v));
            if (inside || (options.second_line == SecondLine::free && !boundary.is_held[v])) {
                free_.push_back(static_cast<Index>(2 * v + 1));
                if (!inside) penalised_.push_back(static_cast<Index>(2 * v + 1));
            }
        }
    }

    Eigen::VectorXd state() const {
        Eigen::VectorXd state(2 * free_.size());
        for (std::size_t i = 0; i < free_.size(); ++i) {
            state[2 * i] = values_[free_[i]].real();
            state[2 * i + 1] = values_[free_[i]].imag();
        }
        return state;
    }
    // What the next round holds on to: unit vectors.
    void settle(const Eigen::VectorXd& state) {
        set(state);
        before_ = state;
    }

    double operator()(const Eigen::VectorXd& state, Eigen::VectorXd& gradient) {
        set(state);
        std::vector<Complex> slope(values_.size(), 0);
        double energy = 0;
        for (const VertexLink& link : links_) add(link, slope, energy);
        for (const Index i : penalised_) {
            const double excess = std::norm(values_[i]) - 1;
            energy += options_.penalty * excess * excess;
            slope[i] += 4 * options_.penalty * excess * values_[i];
        }
        gradient = 2 * options_.inertia * (state - before_);
        energy += options_.inertia * (state - before_).squaredNorm();
        for (std::size_t i = 0; i < free_.size(); ++i) {
            gradient[2 * i] += slope[free_[i]].real();
            gradient[2 * i + 1] += slope[free_[i]].imag();
        }
        return energy;
    }

    Eigen::VectorXd scaled_to_one(Eigen::VectorXd state) const {
        for (Eigen::Index i = 0; i + 1 < state.size(); i += 2) {
            const double length = std::hypot(state[i], state[i + 1]);
            if (length > 0) state.segment<2>(i) /= length;
        }
        return state;
    }

    std::vector<TwoLines> lines() const {
        std::vector<TwoLines> lines(values_.size() / 2);
        for (std::size_t v = 0; v < lines.size(); ++v)
            lines[v] = {std::arg(values_[2 * v]) / 2, std::arg(values_[2 * v + 1]) / 2};
        return lines;
    }

private:
    void set(const Eigen::VectorXd& state) {
        for (std::size_t i = 0; i < free_.size(); ++i) values_[free_[i]] = {state[2 * i], state[2 * i + 1]};
    }

    // c2 = 4 (u + v), c4 = u^2 + v^2, homogeneous.
    void add(const VertexLink& link, std::vector<Complex>& slope, double& energy) const {
        const Complex ui = values_[2 * link.i], vi = values_[2 * link.i + 1], uj = values_[2 * link.j],
                      vj = values_[2 * link.j + 1];
        const Complex step2 = 4.0 * (uj + vj - link.turn * (ui + vi));
        const Complex step4 = uj * uj + vj * vj - link.turn * link.turn * (ui * ui + vi * vi);
        energy += link.weight * (options_.lambda * std::norm(step2) + std::norm(step4));
        const Complex back = std::conj(link.turn);
        const Complex by2 = 8 * link.weight * options_.lambda * step2, by4 = 4 * link.weight * step4;
        slope[2 * link.j] += by2 + std::conj(uj) * by4;
        slope[2 * link.j + 1] += by2 + std::conj(vj) * by4;
        slope[2 * link.i] -= back * by2 + std::conj(ui) * back * back * by4;
        slope[2 * link.i + 1] -= back * by2 + std::conj(vi) * back * back * by4;
    }

    const std::vector<VertexLink>& links_;
    const NonOrthogonalFieldOptions& options_;
    std::vector<Complex> values_;  // u and v of each vertex in turn
    std::vector<Index> free_, penalised_;
    Eigen::VectorXd before_;
};

// L-BFGS with backtracking.
void minimise(RoundEnergy& energy, Eigen::VectorXd& state, double& flat_gradient) {
    LimitedMemory memory(memory_size);
    Eigen::VectorXd gradient, next_gradient;
    double here = energy(state, gradient), scale = 1 / std::max(1.0, gradient.norm());
    if (flat_gradient < 0) flat_gradient = flat * gradient.norm();
    for (int step = 0; step < steps_per_round && gradient.norm() > flat_gradient; ++step) {
        Eigen::VectorXd direction =
            -memory.apply(gradient, [&](const Eigen::VectorXd& x) -> Eigen::VectorXd { return scale * x; });
        const double slope = direction.dot(gradient);
        bool lower = false;
        for (double length = 1; length > least_length && !lower; length /= 2) {
            const Eigen::VectorXd next = state + length * direction;
            const double there = energy(next, next_gradient);
            lower = there < here && there <= here + armijo * length * slope;
            if (!lower) continue;
            const Eigen::VectorXd change = next_gradient - gradient;
            const double product = length * direction.dot(change);
            if (product > 0) scale = product / change.squaredNorm();
            memory.add(length * direction, change);
            state = next;
            gradient = next_gradient;
            here = there;
        }
        if (!lower) return;
    }
}

}  // namespace

LoopResult projected_loop(const std::vector<VertexLink>& links, const BoundaryLines& boundary,
                          const VertexCharts& charts, const NonOrthogonalFieldOptions& options,
                          std::vector<TwoLines>& lines, const std::function<bool(double energy)>& told) {
    RoundEnergy energy(links, boundary, charts, options, lines);
    Eigen::VectorXd state = energy.state();
    double flat_gradient = -1;
    LoopResult result;
    while (!result.converged && result.rounds < options.max_iterations) {
        energy.settle(state);
        Eigen::VectorXd next = state;
        minimise(energy, next, flat_gradient);
        next = energy.scaled_to_one(next);
        result.converged = next.size() == 0 || (next - state).cwiseAbs().maxCoeff() <= options.tolerance;
        state = std::move(next);
        energy.settle(state);
        ++result.rounds;
        if (!told(lines_energy(links, energy.lines(), options.lambda))) break;
    }
    lines = energy.lines();
    return result;
}

}  // namespace octafield::surface::detail
