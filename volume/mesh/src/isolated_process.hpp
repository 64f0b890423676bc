// Runs code that may crash in a copy of the process, so that the crash stays there.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "octafield/progress.hpp"

namespace octafield::volume {

struct IsolatedOutcome {
    bool finished = false;          // the work returned; else it threw, crashed or was killed
    bool out_of_time = false;       // it was ended by end_after
    std::vector<std::byte> result;  // what it handed over; empty unless finished
    std::string printed;            // what it wrote to standard output and error
};

// Runs `work` in a forked child and waits. The child owns a copy of everything the work reads; only the bytes it passes
// to `emit` come back. The work must not start threads or wait for any. `progress` is asked about 50 times a second
// (fraction unknown, no merit); when it returns false, or Ctrl-C reaches the child, throws Cancelled. Throws
// SolverError when no process can be started.
using Emit = std::function<void(const void* bytes, std::size_t count)>;
IsolatedOutcome run_isolated(const std::function<void(const Emit&)>& work, const std::string& phase,
                             const Progress& progress);

// For the work to call: it is killed when it has used so much processor time, in seconds.
void end_after(int seconds);

}  // namespace octafield::volume
