#include "octafield/volume/diffuse.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "constraints.hpp"
#include "field_projector.hpp"
#include "heat_solver.hpp"
#include "site_descent.hpp"

namespace octafield::volume {
namespace {

// Of one step; they end far earlier unless the mesh has degenerate tets.
constexpr int linear_iterations = 1000;
constexpr int sweeps = 8;  // after the last step, site by site

void require_sound(const DiffuseOptions& options) {
    const auto require_positive = [](double value, const char* name) {
        if (!(value > 0)) throw InvalidInput(std::string(name) + " must be positive", "bad_option");
    };
    require_positive(options.first_time, "first_time");
    require_positive(options.last_time, "last_time");
    require_positive(options.time_exponent, "time_exponent");
    require_positive(options.linear_tolerance, "linear_tolerance");
    if (options.max_steps < 0) throw InvalidInput("max_steps is negative; give 0 or more", "bad_option");
}

// Times of the steps, input length squared.
struct Schedule {
    double first, exponent;
    int steps;

    Schedule(const Sampling& sampling, const DiffuseOptions& options) : exponent(options.time_exponent) {
        first = options.first_time * sampling.body_radius * sampling.body_radius;
        const double ratio = first / (options.last_time * std::pow(sampling.edge_length, 2));
        const double wanted = ratio > 1 ? std::ceil(std::pow(ratio, 1 / exponent)) : 1;
        steps = static_cast<int>(std::min<double>(wanted, options.max_steps));
        if (steps < wanted && steps > 1) exponent = std::log(ratio) / std::log(steps);
    }
    double time(int k) const { return first / std::pow(k, exponent); }
};

}  // namespace

SmoothResult diffuse(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                     const DiffuseOptions& options, const Progress& progress) {
    require_fitting(sampling, constraints, start);
    require_sound(options);

    const Schedule schedule(sampling, options);
    const BlockLaplacian laplacian(sampling);
    Quaternions frames = constrained_start(constraints, start);
    const ConstraintSpaces spaces(constraints, frames, laplacian);
    const FieldProjector projector(spaces, options.threads);
    HeatSolver heat(laplacian, spaces, options.threads);
    Sh4Field field = embedded(frames, options.threads), best = field, before;
    Quaternions next;

    SmoothResult result;
    result.energy = laplacian.multiply(field, before, options.threads) / 2;
    result.frames = frames;
    result.converged = true;
    result.message = "the step's time reached the mesh size";
    const auto record = [&](double energy, Sh4Field& state) {
        result.energy_history.push_back(energy);
        if (energy >= result.energy && options.keep_best) return;
        result.energy = energy;
        result.frames = frames;
        best.swap(state);
    };
    for (int k = 1; k <= schedule.steps; ++k) {
        if (!report(progress, "diffuse", double(k - 1) / schedule.steps, result.energy)) {
            result.converged = false;
            result.message = "cancelled";
            break;
        }
        before = field;
        const HeatSolution solution = heat.step(schedule.time(k), field, options.linear_tolerance, linear_iterations);
        next = frames;
        projector.project(field, before, next);
        record(solution.energy, before);
        frames.swap(next);
        result.iterations = k;
    }
    if (result.converged) {
        const SiteDescent descent(laplacian, spaces, projector, options.threads);
        for (int k = 0; k < sweeps; ++k) descent.sweep(field, frames);
    }
    record(laplacian.multiply(field, before, options.threads) / 2, field);
    projector.write_frames(best, result.frames);
    result.objective_history = result.energy_history;
    return result;
}

}  // namespace octafield::volume
