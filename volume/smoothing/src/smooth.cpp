#include "octafield/volume/smooth.hpp"

#include <algorithm>
#include <string>

#include "constraints.hpp"
#include "octafield/volume/operators.hpp"
#include "scheme_table.hpp"
#include "smooth_options.hpp"
#include "trust_region.hpp"

namespace octafield::volume {
namespace {

const char* what_it_is(SchemeSort sort) {
    switch (sort) {
        case SchemeSort::embedding:
            return "an embedding";
        case SchemeSort::embedding_with_lengths:
            return "has lengths too";
        default:
            return "is a metric";
    }
}

void require_sound(const ArrayScheme& scheme, SmoothSolver solver) {
    if (bool(scheme.embed) == bool(scheme.residual) || scheme.dimension < 1)
        throw InvalidInput("scheme '" + scheme.name + "' needs one of embed and residual, and a dimension of 1 or more",
                           "bad_scheme");
    if (solver != SmoothSolver::default_ && solver != SmoothSolver::trust_region)
        throw InvalidInput(
            "scheme '" + scheme.name +
                "' is given by functions on arrays, which the trust region alone minimises: choose solver "
                "default or trust_region",
            "bad_option");
}

}  // namespace

void require_sound(const SmoothOptions& options) {
    if (options.max_iterations < 0) throw InvalidInput("max_iterations is negative; give 0 or more", "bad_option");
    if (!(options.tolerance >= 0)) throw InvalidInput("tolerance must not be negative", "bad_option");
    if (!(options.midpoint_limit > 0)) throw InvalidInput("midpoint_limit must be positive", "bad_option");
    if (options.own_scheme) return require_sound(*options.own_scheme, options.solver);
    const Scheme& what = scheme(options.representation);
    const auto is_asked = [&](const SchemeSolver& each) { return each.solver == options.solver; };
    if (options.solver != SmoothSolver::default_ && std::none_of(what.solvers.begin(), what.solvers.end(), is_asked))
        throw InvalidInput("the trust region minimises embeddings of frames only; representation '" +
                               options.representation + "' " + what_it_is(what.sort) +
                               ": choose solver default, levenberg_marquardt or lbfgs",
                           "bad_option");
}

SmoothResult smooth(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                    const SmoothOptions& options, const Progress& progress) {
    require_sound(options);
    require_fitting(sampling, constraints, start);
    const Quaternions on_constraints = constrained_start(constraints, start);
    SmoothResult result;
    if (options.own_scheme) {
        result = trust_region(sampling, constraints, on_constraints, *options.own_scheme, options, progress);
    } else {
        SmoothOptions chosen = options;
        if (options.solver == SmoothSolver::default_)
            chosen.solver = scheme(options.representation).solvers.front().solver;
        result = minimise_of(options.representation)(sampling, constraints, on_constraints, chosen, progress);
    }
    result.energy = dirichlet_energy(sampling, result.frames, options.threads);
    return result;
}

}  // namespace octafield::volume
