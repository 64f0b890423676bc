#include "octafield/volume/frame_field.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "constraints.hpp"
#include "octafield/frames/quaternion.hpp"
#include "octafield/frames/sh4.hpp"
#include "reordering.hpp"
#include "smooth_options.hpp"

namespace octafield::volume {
namespace {

// Of the polish in all rounds but the last: what comes after diffuses again.
constexpr double rough_tolerance = 1e-3;
// Of diffusions from a random start, over those from the linear one: what is left of the noise's longest waves would
// choose the curves of thin shapes at random.
constexpr double random_start_time = 5;
constexpr double rounding = 1e-9;  // of one energy summed in two ways

void require_sound(const FrameFieldOptions& options) {
    if (options.rounds < 0) throw InvalidInput("rounds is negative; give 0 or more", "bad_option");
    if (!(options.round_time > 0)) throw InvalidInput("round_time must be positive", "bad_option");
}

// Passes progress on as part of [begin, end] of the whole.
Progress part(const Progress& progress, double begin, double end) {
    if (!progress) return {};
    return [&progress, begin, end](std::string_view phase, double fraction, double merit) {
        return progress(phase, fraction < 0 ? fraction : begin + (end - begin) * fraction, merit);
    };
}

bool minimises_sh4_to_second_order(const SmoothOptions& options) {
    return !options.own_scheme && options.representation == frames::Sh4::name &&
           (options.solver == SmoothSolver::default_ || options.solver == SmoothSolver::trust_region);
}

}  // namespace

FrameFieldResult frame_field(const Sampling& sampling, const BoundaryConstraints& constraints,
                             const FrameFieldOptions& options, const Progress& progress) {
    require_sound(options);
    require_sound(options.smooth);
    require_fitting(sampling, constraints);
    // Rounds visit neighbours all the time: meshers scatter them over the memory.
    const std::vector<Index> order = breadth_first_order(sampling.stiffness);
    const Sampling near = reordered(sampling, order);
    const BoundaryConstraints held = reordered(constraints, order);
    DiffuseOptions diffusion = options.diffuse;
    SmoothOptions last = options.smooth, polish;
    diffusion.threads = last.threads = polish.threads = options.threads;
    polish.max_iterations = last.max_iterations;

    const bool second_order = minimises_sh4_to_second_order(last);
    const double parts = options.rounds + (second_order ? 0 : 1);
    FrameFieldResult result;
    SmoothResult& best = result.smooth;
    best.frames = options.seed == 0 ? initial_frames(near, held, options.start, options.threads)
                                    : frames::random_rotations(sampling.count(), options.seed);
    best.energy = std::numeric_limits<double>::infinity();
    if (options.seed != 0) diffusion.first_time *= random_start_time;
    std::vector<double> history;
    int iterations = 0;
    // False when cancelled.
    const auto keep = [&](const SmoothResult& next) {
        // Each begins with the energy that the one before ended with.
        history.insert(history.end(), next.energy_history.begin() + (history.empty() ? 0 : 1),
                       next.energy_history.end());
        iterations += next.iterations;
        if (next.energy < best.energy) best = next;
        return next.message != "cancelled";
    };
    // After a round that ended above an earlier one.
    const auto return_to_best = [&] {
        if (!history.empty() && history.back() > best.energy * (1 + rounding)) history.push_back(best.energy);
    };
    bool going = true;
    for (int round = 0; round < options.rounds && going; ++round) {
        const double begin = round / parts, end = (round + 1) / parts, middle = 0.6 * begin + 0.4 * end;
        const SmoothResult diffused = diffuse(near, held, best.frames, diffusion, part(progress, begin, middle));
        result.diffusion_steps += diffused.iterations;
        going = keep(diffused);
        if (!going) break;
        const bool is_last = second_order && round + 1 == options.rounds;
        polish.tolerance = is_last ? last.tolerance : std::max(rough_tolerance, last.tolerance);
        going = keep(smooth(near, held, diffused.frames, polish, part(progress, middle, end)));
        diffusion.first_time *= options.round_time;
        diffusion.keep_best = false;
    }
    best.frames = reordered(best.frames, inverse_order(order));
    const bool own_objective = going && (!second_order || options.rounds == 0);
    if (own_objective) {
        SmoothResult final =
            smooth(sampling, constraints, best.frames, last, part(progress, options.rounds / parts, 1));
        return_to_best();
        best.energy = std::numeric_limits<double>::infinity();  // its own objective decides
        keep(final);
    } else if (!going) {
        best.converged = false;
        best.message = "cancelled";
    }
    if (!own_objective) return_to_best();
    best.iterations = iterations;
    if (!own_objective) best.objective_history = history;
    best.energy_history = std::move(history);
    return result;
}

}  // namespace octafield::volume
