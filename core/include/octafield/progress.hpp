// Progress and cancellation of long work.
#pragma once

#include <functional>
#include <string_view>

#include "octafield/error.hpp"

namespace octafield {

// Called with the phase's name, the fraction done in [0, 1] (negative: unknown) and a figure of merit (an energy or a
// residual; NaN when there is none). Returning false cancels: the callee stops soon, keeps its best state where its
// documentation says so, and otherwise throws Cancelled. Called from one thread at a time.
using Progress = std::function<bool(std::string_view phase, double fraction, double merit)>;

// True to go on. An empty callback always goes on.
inline bool report(const Progress& progress, std::string_view phase, double fraction, double merit) {
    return !progress || progress(phase, fraction, merit);
}

// As report, but throws Cancelled where there is no state worth keeping.
inline void report_or_throw(const Progress& progress, std::string_view phase, double fraction, double merit) {
    if (!report(progress, phase, fraction, merit)) throw Cancelled("cancelled during " + std::string(phase));
}

}  // namespace octafield
