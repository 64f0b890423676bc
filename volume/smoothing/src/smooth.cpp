#include "octafield/volume/smooth.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "ceres_smoothing.hpp"
#include "constraints.hpp"
#include "dirichlet_costs.hpp"
#include "embedded_field.hpp"
#include "metric_smoothing.hpp"
#include "octafield/frames/registry.hpp"
#include "octafield/volume/operators.hpp"
#include "odeco_smoothing.hpp"
#include "smooth_options.hpp"
#include "trust_region.hpp"

namespace octafield::volume {
namespace {

constexpr std::array metric_names = {"geodesic", "su2_midpoint", "su2_geodesic", "su2_symmetric", "su2_frozen"};

bool is_metric(std::string_view name) {
    return std::find(metric_names.begin(), metric_names.end(), name) != metric_names.end();
}

// Of an embedding.
bool by_trust_region(const SmoothOptions& options) {
    return options.solver == SmoothSolver::automatic || options.solver == SmoothSolver::trust_region;
}

// `start` is on the constraints.
template <frames::Representation R>
SmoothResult smooth_with_ceres(const Sampling& sampling, const BoundaryConstraints& constraints,
                               const Quaternions& start, const SmoothOptions& options, const Progress& progress) {
    // The energy grows like a length: solved at unit size, so that no tolerance depends on the input's unit.
    const double length = sampling.size;
    EmbeddedField<R> field(start, options.threads);
    Manifolds manifolds;
    ceres::Problem problem(problem_options(field));
    add_dirichlet_costs(problem, field, dirichlet_blocks(sampling), 1 / length);
    set_manifolds(problem, field.quaternions(), constraints, manifolds);
    return solve_with_ceres(problem, field.quaternions(), sampling, options, progress);
}

}  // namespace

void require_sound(const SmoothOptions& options) {
    if (options.max_iterations < 0) throw InvalidInput("max_iterations is negative; give 0 or more", "bad_option");
    if (!(options.tolerance >= 0)) throw InvalidInput("tolerance must not be negative", "bad_option");
    if (!(options.midpoint_limit > 0)) throw InvalidInput("midpoint_limit must be positive", "bad_option");
    const auto names = smooth_representations();
    if (std::find(names.begin(), names.end(), options.representation) == names.end())
        frames::throw_unknown_name("representation", options.representation, names);
    const bool lengths = options.representation == odeco_lengths_name;
    if ((is_metric(options.representation) || lengths) && options.solver == SmoothSolver::trust_region)
        throw InvalidInput("the trust region minimises embeddings of frames only; representation '" +
                               options.representation + "' " + (lengths ? "has lengths too" : "is a metric") +
                               ": choose solver automatic, levenberg_marquardt or lbfgs",
                           "bad_option");
}

std::vector<std::string> smooth_representations() {
    std::vector<std::string> names = frames::Representations::names();
    names.emplace_back(odeco_lengths_name);
    names.insert(names.end(), metric_names.begin(), metric_names.end());
    return names;
}

SmoothResult smooth(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options, const Progress& progress) {
    require_sound(options);
    require_fitting(sampling, constraints, start);
    const Quaternions on_constraints = constrained_start(constraints, start);
    SmoothResult result;
    if (is_metric(options.representation)) {
        result = smooth_metric(sampling, constraints, on_constraints, options, progress);
    } else if (options.representation == odeco_lengths_name) {
        result = smooth_odeco_lengths(sampling, constraints, on_constraints, options, progress);
    } else {
        frames::with_representation(options.representation, [&]<frames::Representation R>() {
            result = by_trust_region(options)
                         ? trust_region<R>(sampling, constraints, on_constraints, options, progress)
                         : smooth_with_ceres<R>(sampling, constraints, on_constraints, options, progress);
        });
    }
    result.energy = dirichlet_energy(sampling, result.frames, options.threads);
    return result;
}

}  // namespace octafield::volume
