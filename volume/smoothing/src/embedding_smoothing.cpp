#include "embedding_smoothing.hpp"

#include "ceres_smoothing.hpp"
#include "dirichlet_costs.hpp"
#include "embedded_field.hpp"
#include "octafield/frames/registry.hpp"
#include "trust_region.hpp"

namespace octafield::volume {
namespace {

template <frames::Representation R>
SmoothResult smooth_with_ceres(const Sampling& sampling, const BoundaryConstraints& constraints,
                               const Quaternions& start, const SmoothOptions& options, const Progress& progress) {
    // The energy grows like a length: solved at unit size, so that no tolerance depends on the input's unit.
    const double length = sampling.size;
    EmbeddedField<R> field(start, options.threads);
    Manifolds<> manifolds;
    ceres::Problem problem(problem_options(field));
    add_dirichlet_costs(problem, field, dirichlet_blocks(sampling), 1 / length);
    set_manifolds(problem, field.quaternions(), constraints, manifolds);
    return solve_with_ceres(
        problem, [&]() -> const Quaternions& { return field.quaternions(); }, sampling, options, progress);
}

}  // namespace

SmoothResult smooth_embedding(const Sampling& sampling, const BoundaryConstraints& constraints,
                              const Quaternions& start, const SmoothOptions& options, const Progress& progress) {
    if (options.solver == SmoothSolver::trust_region)
        return trust_region(sampling, constraints, start, options, progress);
    SmoothResult result;
    frames::with_representation(options.representation, [&]<frames::Representation R>() {
        result = smooth_with_ceres<R>(sampling, constraints, start, options, progress);
    });
    return result;
}

}  // namespace octafield::volume
