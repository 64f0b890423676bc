// The recipe: linear start, then rounds of diffusion and second-order smoothing; the field of lowest energy.
#pragma once

#include <cstdint>

#include "octafield/volume/diffuse.hpp"

namespace octafield::volume {

struct FrameFieldOptions {
    Start start = Start::constraints;
    // Other than 0: a random start in place of `start`. Diffusions are then five times as long, to forget the noise.
    std::uint64_t seed = 0;
    DiffuseOptions diffuse{};
    SmoothOptions smooth{};
    // A round diffuses and polishes the best field so far; where singular curves are stuck, the next one's heat frees
    // them. The first diffusion's time is first_time, later ones' `round_time` times that of the one before.
    int rounds = 2;
    double round_time = 0.2;
    int threads = 0;  // 0: all; the result does not depend on it. Overrides those of `diffuse` and `smooth`
};

struct FrameFieldResult {
    // Of the last smoothing. Its iterations and energy_history are those of all rounds, and where one ended above an
    // earlier one, the energy of that, whose field was kept, follows. objective_history: where the last part minimises
    // something else than sh4's energy, of that part only (its steps are the last of energy_history); else the same.
    SmoothResult smooth;
    int diffusion_steps = 0;  // of all rounds
};

// Rounds polish in sh4 with the trust region, whatever options.smooth asks for; another representation or solver starts
// from the best of them, as do the schemes that need a start near their minimum. Cancelling keeps the best field.
// Throws InvalidInput, GeometryError (unsound mesh), SolverError.
FrameFieldResult frame_field(const Sampling& sampling, const BoundaryConstraints& constraints,
                             const FrameFieldOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
