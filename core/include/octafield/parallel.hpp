// Data-parallel loops whose results do not depend on the number of threads.
#pragma once

#include <algorithm>
#include <cstdint>
#include <exception>
#include <system_error>
#include <thread>
#include <vector>

namespace octafield {

// Number of threads meant by an option value: 0 means all hardware threads.
inline int thread_count(int requested) {
    if (requested > 0) return requested;
    return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

// Runs body(i) for i in [0, n), each i exactly once, in contiguous blocks, one per thread. The body may write only to
// element i of its outputs; then the result has the same bits at any thread count. The first exception is rethrown.
// A thread is started for at least `grain` elements.
template <class Body>
void parallel_for(std::int64_t n, int threads, const Body& body, std::int64_t grain = 256) {
    const std::int64_t count =
        std::clamp<std::int64_t>(std::min<std::int64_t>(thread_count(threads), n / grain), 1, 256);
    if (count == 1) {
        for (std::int64_t i = 0; i < n; ++i) body(i);
        return;
    }
    std::vector<std::exception_ptr> errors(count);
    std::vector<std::thread> workers;
    workers.reserve(count);
    const auto run = [&](std::int64_t worker) {
        try {
            for (std::int64_t i = n * worker / count; i < n * (worker + 1) / count; ++i) body(i);
        } catch (...) {
            errors[worker] = std::current_exception();
        }
    };
    std::int64_t started = 1;
    try {
        for (; started < count; ++started) workers.emplace_back(run, started);
    } catch (const std::system_error&) {
        // No more threads to be had: the calling thread does the rest, with the same result.
    }
    run(0);
    for (std::int64_t worker = started; worker < count; ++worker) run(worker);
    for (auto& worker : workers) worker.join();
    for (const auto& error : errors)
        if (error) std::rethrow_exception(error);
}

}  // namespace octafield
