#include "interruptible.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>

namespace octafield::bindings {

namespace {

std::atomic<int> abandoned_workers{0};

// Static destructors must not run under a worker that is still at it: leave the process as it is. Python has flushed by
// then.
void exit_past_abandoned_workers(int status, void*) {
    if (abandoned_workers.load() == 0) return;
    std::fflush(nullptr);
    _exit(status);
}

// Handlers registered last run first, hence at the first abandonment and not when the module loads.
void register_exit_handler() {
    static const int registered = on_exit(exit_past_abandoned_workers, nullptr);
    static_cast<void>(registered);
}

}  // namespace

Progress Job::progress() {
    return [this](std::string_view phase, double fraction, double merit) {
        return !cancelled() && (!has_callback_ || call_back(phase, fraction, merit));
    };
}

bool Job::call_back(std::string_view phase, double fraction, double merit) {
    const py::gil_scoped_acquire gil;
    if (cancelled()) return false;  // while this thread waited for the GIL
    try {
        const ProgressCallable callback = *callback_;  // an abandoning caller drops its own reference
        const py::object answer = callback(py::str(phase.data(), phase.size()), fraction, merit);
        const int goes_on = answer.is_none() ? 1 : PyObject_IsTrue(answer.ptr());
        if (goes_on < 0) throw py::error_already_set();
        if (goes_on == 0) cancelled_ = true;
    } catch (...) {
        callback_error_ = std::current_exception();
        cancelled_ = true;
    }
    return !cancelled();
}

void Job::finish(std::exception_ptr error) noexcept {
    const std::lock_guard lock(mutex_);
    error_ = std::move(error);
    finished_ = true;
    if (abandoned_) --abandoned_workers;
    ended_.notify_all();
}

template <class Duration>
bool Job::finished_within(Duration time) {
    std::unique_lock lock(mutex_);
    return ended_.wait_for(lock, time, [this] { return finished_; });
}

// The exception of a signal handler (KeyboardInterrupt), or null when the work ended. Called without the GIL.
std::exception_ptr Job::wait_for_end_or_signal() {
    while (!finished_within(std::chrono::milliseconds(50))) {
        const py::gil_scoped_acquire gil;
        if (PyErr_CheckSignals() != 0) return std::make_exception_ptr(py::error_already_set());
    }
    return nullptr;
}

void Job::wait(std::thread worker) {
    std::exception_ptr signal;
    bool finished = true;
    {
        const py::gil_scoped_release release;
        signal = wait_for_end_or_signal();
        if (signal) {
            cancelled_ = true;
            finished = finished_within(std::chrono::milliseconds(500));
        }
        if (!finished) {
            const std::lock_guard lock(mutex_);
            finished = finished_;
            if (!finished) {
                abandoned_ = true;
                ++abandoned_workers;
            }
        }
        finished ? worker.join() : worker.detach();
    }
    if (!finished) register_exit_handler();
    callback_.reset();
    if (!signal && PyErr_CheckSignals() != 0)
        throw py::error_already_set();  // a signal that ended the work from within
    if (signal) std::rethrow_exception(signal);
    if (callback_error_) std::rethrow_exception(std::exchange(callback_error_, nullptr));
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

}  // namespace octafield::bindings
