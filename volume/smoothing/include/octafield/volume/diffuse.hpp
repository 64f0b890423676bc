// Diffusion of a frame field: implicit heat flow of the sh4 vectors alternating with projection onto frames
// (modified MBO of Palmer, Bommes, Solomon 2020, section 5; after Viertel, Osting 2019). At the end some sweeps set
// each frame in turn to the best for its neighbours.
#pragma once

#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

struct DiffuseOptions {
    // Time of the first step over l^2, l = 3 volume / boundary area (the radius, for a ball).
    double first_time = 20;
    // Time of the last step over the square of the mean boundary edge.
    double last_time = 0.25;
    // Step k lasts 1/k^time_exponent of the first, and steps end when last_time is reached. Palmer et al. take 3: fewer
    // steps, higher energies (docs/frame_fields.md).
    double time_exponent = 2;
    int max_steps = 60;  // where more would be needed, the exponent is raised instead
    // Of the linear solves: relative residual in the preconditioned norm. Steps are projected anyway.
    double linear_tolerance = 0.1;
    bool keep_best = true;  // return the state of lowest energy met, the start included; false: the last state
    int threads = 0;        // 0: all; the result does not depend on it
};

// From `start` (unit quaternions, (n, 4)) to frames of lower energy; singular curves move freely, unlike under smooth,
// which is best applied to the result. Vertices with a fixed axis diffuse in the plane of their twist (the constraint
// is kept by the linear solve, not only by projection), fixed ones hold. energy_history has the energy at the start and
// after each step, the last one's with the sweeps; converged is true unless cancelled. Throws InvalidInput,
// GeometryError (unsound mesh), SolverError.
SmoothResult diffuse(const Sampling& sampling, const BoundaryConstraints& constraints, const Quaternions& start,
                     const DiffuseOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
