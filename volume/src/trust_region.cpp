#include "trust_region.hpp"

#include <algorithm>
#include <cmath>

#include "field_model.hpp"
#include "octafield/frames/registry.hpp"

namespace octafield::volume {
namespace {

using frames::Vector3;
using frames::Vector4;

constexpr int inner_iterations = 200;  // of the conjugate gradients of one step
constexpr int inner_between_reports = 16;
constexpr double first_radius = 0.5;  // radians, root mean square over the vertices
constexpr double largest_radius = 3;
constexpr double least_radius = 1e-12;

struct Step {
    double decrease = 0;   // of the quadratic model
    bool at_edge = false;  // of the trust region
    bool cancelled = false;
};

template <frames::Representation R>
class Solver {
public:
    Solver(const Sampling& sampling, const BoundaryConstraints& constraints, const SmoothOptions& options,
           const Progress& progress)
        : laplacian_(sampling),
          model_(laplacian_, constraints, options.threads),
          options_(options),
          progress_(progress),
          root_(std::sqrt(double(laplacian_.rows()))) {
        const Index n = laplacian_.rows();
        for (Tangents* w : {&step_, &residual_, &direction_, &image_}) w->setZero(n, 3);
    }

    SmoothResult run(const Quaternions& start);

private:
    bool go_on() { return report(progress_, "smooth", fraction_, energy_); }
    Step conjugate_gradients(double radius, double forcing);
    Quaternions turned(const Quaternions& frames) const;
    double norm(const Tangents& w) const { return std::sqrt(dot(w, w)); }
    double dot(const Tangents& a, const Tangents& b) const {
        return sum([&](Index v) { return a.row(v).dot(b.row(v)); });
    }
    template <class Body>
    double sum(const Body& body) const {
        return block_sum(laplacian_.rows(), options_.threads, [&](std::int64_t first, std::int64_t last) {
            double total = 0;
            for (std::int64_t v = first; v < last; ++v) total += body(static_cast<Index>(v));
            return total;
        });
    }

    BlockLaplacian laplacian_;
    FieldModel<R> model_;
    const SmoothOptions& options_;
    const Progress& progress_;
    const double root_;  // of the number of vertices: norms per vertex are norms of fields over it
    double energy_ = 0, fraction_ = 0;
    Tangents step_, residual_, direction_, image_;
};

// Minimises the model within `radius` until the preconditioned residual falls to `forcing` of its start. The first
// direction of negative curvature is followed to the edge.
template <frames::Representation R>
Step Solver<R>::conjugate_gradients(double radius, double forcing) {
    double squared = sum([&](Index v) {
        const Vector3 g = model_.gradient().row(v).transpose(), z = model_.precondition(v, -g);
        step_.row(v).setZero();
        residual_.row(v) = -g.transpose();
        direction_.row(v) = z.transpose();
        return -g.dot(z);
    });
    const double wanted = forcing * forcing * squared;
    Step result;
    double length = 0, along = 0, reach = squared > 0 ? dot(direction_, direction_) : 0;  // |s|^2, s.d, |d|^2
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
        const double next = sum([&](Index v) {
            step_.row(v) += t * direction_.row(v);
            residual_.row(v) -= t * image_.row(v);
            const Vector3 r = residual_.row(v).transpose();
            return r.dot(model_.precondition(v, r));
        });
        result.decrease += t * squared - t * t * curvature / 2;
        if (result.at_edge) break;
        length = dot(step_, step_);
        sum([&](Index v) {
            const Vector3 z = model_.precondition(v, residual_.row(v).transpose());
            direction_.row(v) = z.transpose() + next / squared * direction_.row(v);
            return 0.0;
        });
        along = dot(step_, direction_);
        reach = dot(direction_, direction_);
        squared = next;
    }
    return result;
}

template <frames::Representation R>
Quaternions Solver<R>::turned(const Quaternions& frames) const {
    Quaternions result(frames.rows(), 4);
    parallel_for(frames.rows(), options_.threads, [&](std::int64_t v) {
        const Vector3 w = step_.row(v).transpose();
        // An unmoved frame keeps its bits.
        if (w.isZero(0)) {
            result.row(v) = frames.row(v);
            return;
        }
        const frames::Quaternion q = frames::from_wxyz(Vector4(frames.row(v).transpose()));
        result.row(v) = frames::to_wxyz((frames::exp(w) * q).normalized()).transpose();
    });
    return result;
}

template <frames::Representation R>
SmoothResult Solver<R>::run(const Quaternions& start) {
    SmoothResult result;
    result.frames = start;
    energy_ = model_.evaluate(result.frames);
    model_.linearise(result.frames);
    result.energy_history.push_back(energy_);
    result.message = "max_iterations reached";

    const double first_gradient = norm(model_.gradient());
    // What rounding leaves of the gradient of a field without energy.
    const double no_gradient =
        1e-14 * laplacian_.diagonal().norm() * R::differential(frames::Quaternion::Identity()).squaredNorm();
    double radius = first_radius * root_;
    bool at_minimum = false, cancelled = false;
    while (result.iterations < options_.max_iterations) {
        fraction_ = double(result.iterations) / options_.max_iterations;
        cancelled = !go_on();
        const double gradient = norm(model_.gradient());
        at_minimum = gradient <= no_gradient || radius < least_radius * root_;
        if (at_minimum || cancelled) break;
        // Superlinear convergence (Dembo, Eisenstat, Steihaug 1982).
        const Step step = conjugate_gradients(radius, std::min(0.1, std::sqrt(gradient / first_gradient)));
        cancelled = step.cancelled;
        if (cancelled) break;
        ++result.iterations;
        const Quaternions next = turned(result.frames);
        const double energy = model_.evaluate(next);
        const double ratio = (energy_ - energy) / step.decrease;
        const double length = norm(step_);
        if (ratio < 0.25) radius = length / 4;
        if (ratio > 0.75 && step.at_edge) radius = std::min(2 * radius, largest_radius * root_);
        const bool small = !step.at_edge && step.decrease < options_.tolerance * energy_;
        if (energy < energy_ && ratio > 0.05) {
            result.frames = next;
            energy_ = energy;
            model_.linearise(result.frames);
        }
        result.energy_history.push_back(energy_);
        at_minimum = small;
        if (at_minimum) break;
    }
    if (at_minimum) result.message = "the next step would lower the energy by less than the tolerance";
    if (cancelled) result.message = "cancelled";
    result.converged = at_minimum && !cancelled;
    result.objective = energy_;
    return result;
}

}  // namespace

template <frames::Representation R>
SmoothResult trust_region(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                          const SmoothOptions& options, const Progress& progress) {
    return Solver<R>(sampling, constraints, options, progress).run(start);
}

#define OCTAFIELD_INSTANTIATE(R)                                                                                  \
    template SmoothResult trust_region<frames::R>(const Sampling&, const BoundaryConstraints&, const Quaternions&, \
                                                  const SmoothOptions&, const Progress&);
OCTAFIELD_INSTANTIATE(Sh4)
OCTAFIELD_INSTANTIATE(Tensor4)
OCTAFIELD_INSTANTIATE(Su2)
OCTAFIELD_INSTANTIATE(Odeco)
OCTAFIELD_INSTANTIATE(Sh469)
#undef OCTAFIELD_INSTANTIATE

}  // namespace octafield::volume
