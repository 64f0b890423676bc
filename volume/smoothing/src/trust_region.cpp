#include "trust_region.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <vector>

#include "array_model.hpp"
#include "field_model.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/volume/operators.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using frames::Vector4;

constexpr int inner_iterations = 200;  // of the conjugate gradients of one step
constexpr int inner_between_reports = 16;
constexpr double first_radius = 0.05;  // radians, root mean square over the sites
constexpr double largest_radius = 3;
constexpr double least_radius = 1e-12;
constexpr double least_cut = 1.0 / 64;  // of the radius at once
constexpr std::size_t slow_steps = 5;   // so many in a row may, on average, gain less than the tolerance

struct Step {
    double decrease = 0;  // of the quadratic model
    double length = 0;
    bool at_edge = false;  // of the trust region
    bool cancelled = false;
};

// What a model is for the solver: the energy and, at the field last linearised, its gradient (world rotation vectors,
// one per site), Hessian and preconditioner within what the constraints allow (field_model.hpp, array_model.hpp).
template <class M>
concept Model = requires(M& model, const M& at, const Quaternions& frames, Tangents& y, const Tangents& w, Index v,
                         const Tangent& turn) {
    { model.evaluate(frames) } -> std::same_as<double>;
    model.linearise(frames);
    { at.gradient() } -> std::same_as<const Rows<double, 3>&>;
    { at.precondition(v, turn) } -> std::same_as<Tangent>;
    model.turn(v, turn);  // of w, before hessian_times
    { at.hessian_times(w, y) } -> std::same_as<double>;
    { at.turns() } -> std::same_as<const ConstraintTurns&>;
    { at.radian() } -> std::same_as<double>;
    { at.no_gradient() } -> std::same_as<double>;
    { M::is_sh4 } -> std::convertible_to<bool>;
};

template <Model M>
class Solver {
public:
    Solver(const Sampling& sampling, M& model, const SmoothOptions& options, const Progress& progress)
        : sampling_(sampling), model_(model), options_(options), progress_(progress) {
        for (Tangents* w : {&step_, &residual_, &direction_, &image_}) w->setZero(sampling.count(), 3);
    }

    SmoothResult run(const Quaternions& start);

private:
    bool go_on() { return report(progress_, "smooth", fraction_, energy_); }
    Step conjugate_gradients(double radius, double forcing);
    Quaternions turned(const Quaternions& frames) const;
    double gradient_norm() const {
        return std::sqrt(sum([&](Index v) { return model_.gradient().row(v).squaredNorm(); }));
    }
    // Along the step, from both energies and the slope at the start: where a parabola through them is lowest.
    double lowest_along_step(double change) const {
        const double slope =
            sum([&](Index v) { return model_.gradient().row(v).dot(step_.row(v).template cast<double>()); });
        return -slope / (2 * (change - slope));
    }
    template <class Body>
    double sum(const Body& body) const {
        return block_sum(sampling_.count(), options_.threads, [&](std::int64_t first, std::int64_t last) {
            double total = 0;
            for (std::int64_t v = first; v < last; ++v) total += body(static_cast<Index>(v));
            return total;
        });
    }

    // Of sh4, as every history has it.
    double sh4_energy(const Quaternions& frames) const {
        return M::is_sh4 ? energy_ : dirichlet_energy(sampling_, frames, options_.threads);
    }

    const Sampling& sampling_;
    M& model_;
    const SmoothOptions& options_;
    const Progress& progress_;
    double energy_ = 0, fraction_ = 0;
    Tangents step_, residual_, direction_, image_;
};

// Minimises the model within `radius` until the preconditioned residual falls to `forcing` of its start. The first
// direction of negative curvature is followed to the edge. Lengths are those of the preconditioner's metric, which its
// recurrences give (Conn, Gould, Toint 2000, section 7.5.1).
template <Model M>
Step Solver<M>::conjugate_gradients(double radius, double forcing) {
    double squared = sum([&](Index v) {
        const Tangent r = -model_.gradient().row(v).transpose().template cast<float>(), z = model_.precondition(v, r);
        step_.row(v).setZero();
        residual_.row(v) = r.transpose();
        direction_.row(v) = z.transpose();
        model_.turn(v, z);
        return r.dot(z);
    });
    const double wanted = forcing * forcing * squared;
    Step result;
    double length = 0, along = 0, reach = squared;  // |s|^2, s.d, |d|^2
    for (int k = 1; k <= inner_iterations && squared > wanted; ++k) {
        if (k % inner_between_reports == 0 && !go_on()) {
            result.cancelled = true;
            break;
        }
        const double curvature = model_.hessian_times(direction_, image_);
        double t = curvature > 0 ? squared / curvature : 0;
        if (curvature <= 0 || length + 2 * t * along + t * t * reach > radius * radius) {
            t = (-along + std::sqrt(along * along + reach * (radius * radius - length))) / reach;
            result.at_edge = true;
        }
        const float factor = static_cast<float>(t);
        const double next = sum([&](Index v) {
            step_.row(v) += factor * direction_.row(v);
            residual_.row(v) -= factor * image_.row(v);
            const Tangent r = residual_.row(v).transpose();
            return r.dot(model_.precondition(v, r));
        });
        result.decrease += t * squared - t * t * curvature / 2;
        length += 2 * t * along + t * t * reach;
        if (result.at_edge) break;
        const double ratio = next / squared;
        sum([&](Index v) {
            const Tangent d = model_.precondition(v, residual_.row(v).transpose()) +
                              static_cast<float>(ratio) * direction_.row(v).transpose();
            direction_.row(v) = d.transpose();
            model_.turn(v, d);
            return 0.0;
        });
        along = ratio * (along + t * reach);
        reach = next + ratio * ratio * reach;
        squared = next;
    }
    result.length = std::sqrt(length);
    return result;
}

template <Model M>
Quaternions Solver<M>::turned(const Quaternions& frames) const {
    Quaternions result(frames.rows(), 4);
    parallel_for(frames.rows(), options_.threads, [&](std::int64_t v) {
        const frames::Quaternion q = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        // A step in single precision is beside what is allowed by its rounding.
        const Vector3 w = step_.row(v).transpose().template cast<double>();
        result.row(v) = frames::to_wxyz(model_.turns().turned(v, q, w)).transpose();
    });
    return result;
}

template <Model M>
SmoothResult Solver<M>::run(const Quaternions& start) {
    SmoothResult result;
    result.frames = start;
    energy_ = model_.evaluate(result.frames);
    model_.linearise(result.frames);
    result.objective_history.push_back(energy_);
    result.energy_history.push_back(sh4_energy(result.frames));
    result.message = "max_iterations reached";

    const double first_gradient = gradient_norm(), no_gradient = model_.no_gradient(), radian = model_.radian();
    double radius = first_radius * radian;
    std::vector<double> accepted{energy_};
    const auto are_slow = [&](const std::vector<double>& energies) {
        if (energies.size() <= slow_steps) return false;
        const double before = energies[energies.size() - 1 - slow_steps];
        return before - energies.back() < slow_steps * options_.tolerance * energies.back();
    };
    bool at_minimum = false, cancelled = false;
    while (result.iterations < options_.max_iterations) {
        fraction_ = double(result.iterations) / options_.max_iterations;
        cancelled = !go_on();
        const double gradient = gradient_norm();
        at_minimum = gradient <= no_gradient || radius < least_radius * radian;
        if (at_minimum || cancelled) break;
        // Superlinear convergence (Dembo, Eisenstat, Steihaug 1982).
        const Step step = conjugate_gradients(radius, std::min(0.1, std::sqrt(gradient / first_gradient)));
        cancelled = step.cancelled;
        if (cancelled) break;
        ++result.iterations;
        const Quaternions next = turned(result.frames);
        const double energy = model_.evaluate(next);
        const double ratio = (energy_ - energy) / step.decrease;
        if (ratio < 0.25) radius = step.length * std::clamp(lowest_along_step(energy - energy_), least_cut, 0.25);
        if (ratio > 0.75 && step.at_edge) radius = std::min(2 * radius, largest_radius * radian);
        const bool small = !step.at_edge && step.decrease < options_.tolerance * energy_;
        const bool better = energy < energy_ && ratio > 0.05;
        if (better) {
            result.frames = next;
            energy_ = energy;
            model_.linearise(result.frames);
            accepted.push_back(energy);
        }
        result.objective_history.push_back(energy_);
        result.energy_history.push_back(better ? sh4_energy(result.frames) : result.energy_history.back());
        at_minimum = small || are_slow(accepted);
        if (at_minimum) break;
    }
    if (at_minimum) result.message = "steps lower the energy by less than the tolerance";
    if (cancelled) result.message = "cancelled";
    result.converged = at_minimum && !cancelled;
    result.objective = energy_;
    return result;
}

}  // namespace

SmoothResult trust_region(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                          const SmoothOptions& options, const Progress& progress) {
    SmoothResult result;
    frames::with_representation(options.representation, [&]<frames::Representation R>() {
        const BlockLaplacian laplacian(sampling);
        FieldModel<R> model(laplacian, constraints, options.threads);
        result = Solver(sampling, model, options, progress).run(start);
    });
    return result;
}

SmoothResult trust_region(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                          const ArrayScheme& scheme, const SmoothOptions& options, const Progress& progress) {
    if (scheme.embed) {
        ArrayEmbeddingModel model(scheme, sampling, constraints, options.threads);
        return Solver(sampling, model, options, progress).run(start);
    }
    ArrayResidualModel model(scheme, sampling, constraints, options.threads);
    return Solver(sampling, model, options, progress).run(start);
}

}  // namespace octafield::volume
