// Closed streamlines that others wind towards, which no finite quad mesh follows, and their removal (L. Simons, UC
// Davis 2024, sections 4.2 and 4.5).
//
// A closed streamline carries a width round (size_families.hpp): its flux, the integral of grad alpha . (J t) ds, is by
// what ln width has grown when it comes back. 0 for regular ones; a limit cycle has another.
#pragma once

#include "octafield/progress.hpp"
#include "octafield/surface/streamlines.hpp"

namespace octafield::surface {

struct LimitCycle {
    Streamline line;  // closed
    double flux = 0;  // by what the logarithm of the width grows
    bool crosses_itself = false;
};

struct LimitCycleOptions {
    int seeds = 64;          // triangles spread over the surface, from which lines of both families are traced; >= 1
    double max_length = 0;   // of a line each way, input unit; 0: 20 times shape_size
    double tolerance = 0.1;  // closed lines with a smaller flux are regular; > 0
    double band_width = 0;   // of the band in which the field is turned, input unit; 0: 8 mean edge lengths
    int most_removed = 16;   // >= 0
};

// Each found once, in the order of the seeds. Lines that are still going at max_length lead to them. Throws
// InvalidInput: kinds "wrong_symmetry", "bad_option", and what streamlines throws; Cancelled.
std::vector<LimitCycle> limit_cycles(const DirectionField& field, const SurfaceSingularities& singularities,
                                     const LimitCycleOptions& options = {}, const Progress& progress = {});

// The field turned by b pi / 2 in a band round the cycle, b smoothly from 0 to 1 across it, against the sense in which
// the field turns there: outside nothing changes, the families are exchanged across the band, and no singular point is
// added. Throws InvalidInput (kind "band_blocked") where the cycle crosses itself, or the band reaches the boundary, a
// feature or a singular point.
DirectionField without_limit_cycle(const DirectionField& field, const SurfaceSingularities& singularities,
                                   const LimitCycle& cycle, const LimitCycleOptions& options = {});

struct UnwoundField {
    DirectionField field;
    std::vector<LimitCycle> removed;
    // Those that are left: forced by the singular points and the surface (a torus with one point of valence 3 and one
    // of valence 5 has some whatever is done), or their bands are blocked.
    std::vector<LimitCycle> left;
};

// One after the other, as long as each removal leaves fewer.
UnwoundField without_limit_cycles(const DirectionField& field, const LimitCycleOptions& options = {},
                                  const Progress& progress = {});

}  // namespace octafield::surface
