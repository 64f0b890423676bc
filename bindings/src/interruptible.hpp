// Long C++ work that Ctrl-C in Python stops within a second.
//
// The work runs in its own thread and owns everything it touches; the calling thread waits without the GIL and looks
// for signals every 50 ms. On a signal the work is asked to stop through its progress callback; if it does not within
// half a second it is abandoned: it runs on by itself, touches nothing of Python, and its memory goes when it ends.
// When Python ends, what daemon threads compute is cancelled or abandoned likewise.
#pragma once

#include <pybind11/pybind11.h>

#include <atomic>
#include <condition_variable>
#include <exception>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>

#include "arrays.hpp"
#include "gil.hpp"
#include "octafield/progress.hpp"

namespace octafield::bindings {

namespace py = pybind11;

// What the caller and the worker share. `callback` and `callback_error` are touched under the GIL only.
class Job {
public:
    explicit Job(std::optional<ProgressCallable> callback = {})
        : has_callback_(callback.has_value()), callback_(std::move(callback)) {}
    Job(const Job&) = delete;
    Job& operator=(const Job&) = delete;

    bool cancelled() const noexcept { return cancelled_.load(std::memory_order_relaxed); }

    // For the worker: calls the Python callback under the GIL; false once the job is cancelled. Valid as long as the
    // job.
    Progress progress();

protected:
    void finish(std::exception_ptr error) noexcept;  // by the worker, last thing it does
    void wait(std::thread worker);                   // by the caller, with the GIL; throws what ended the work

private:
    bool call_back(std::string_view phase, double fraction, double merit);
    std::exception_ptr wait_for_end_or_signal();
    template <class Duration>
    bool finished_within(Duration time);

    const bool has_callback_;
    std::optional<ProgressCallable> callback_;
    std::exception_ptr callback_error_;
    std::atomic<bool> cancelled_{false};
    std::mutex mutex_;
    std::condition_variable ended_;
    bool finished_ = false;
    std::exception_ptr error_;
};

// Returns work(job), a value. `work` must own all it uses (capture by value) and hold no Python object.
template <class Work>
auto run_interruptible(Work work, std::optional<ProgressCallable> callback = {}) {
    using Result = std::invoke_result_t<Work&, Job&>;
    struct State : Job {
        State(Work w, std::optional<ProgressCallable> c) : Job(std::move(c)), work(std::move(w)) {}
        void run() noexcept {
            const InterruptsElsewhere interrupts;
            try {
                result.emplace(work(static_cast<Job&>(*this)));
                finish(nullptr);
            } catch (...) {
                finish(std::current_exception());
            }
        }
        using Job::wait;
        Work work;
        std::optional<Result> result;
    };
    const auto state = std::make_shared<State>(std::move(work), std::move(callback));
    state->wait(std::thread([state] { state->run(); }));
    return std::move(*state->result);
}

}  // namespace octafield::bindings
