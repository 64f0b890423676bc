#include "interruptible.hpp"

#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "gil.hpp"

namespace octafield::bindings {

namespace {

// Jobs whose workers have not ended, and how Python's end reaches them.
struct Running {
    std::mutex mutex;
    std::condition_variable fewer;
    std::vector<std::pair<const Job*, std::atomic<bool>*>> jobs;  // with their flags that cancel
    int callbacks = 0;                                            // workers that are in Python or about to be
    std::optional<std::thread::id> ending;                        // the thread that ends Python

    bool ends_for_this_thread() const { return ending && *ending != std::this_thread::get_id(); }  // under the mutex
};

Running& running() {
    static auto* const all = new Running;  // never destroyed: workers outlive static objects
    return *all;
}

// Static destructors must not run under a worker that is still at it: leave the process as it is. Python has flushed by
// then.
void exit_past_workers(int status, void*) {
    {
        const std::lock_guard lock(running().mutex);
        if (running().jobs.empty()) return;
    }
    std::fflush(nullptr);
    _exit(status);
}

// Before Python takes itself apart: cancels what other threads compute, and waits a little for them. Who still computes
// then goes on until the process ends, and calls nothing of Python.
void end_jobs() {
    Running& all = running();
    const WithoutGil free;
    std::unique_lock lock(all.mutex);
    all.ending = std::this_thread::get_id();
    for (const auto& [job, flag] : all.jobs) *flag = true;
    all.fewer.wait_for(lock, std::chrono::milliseconds(500), [&] { return all.jobs.empty(); });
    all.fewer.wait_for(lock, std::chrono::seconds(2), [&] { return all.callbacks == 0; });
    on_exit(exit_past_workers, nullptr);  // handlers registered last run first
}

// A worker's leave to call Python: refused once Python ends.
class Callback {
public:
    explicit Callback(const Job& job) {
        const std::lock_guard lock(running().mutex);
        granted_ = !job.cancelled();
        running().callbacks += granted_;
    }
    ~Callback() {
        const std::lock_guard lock(running().mutex);
        running().callbacks -= granted_;
        running().fewer.notify_all();
    }
    Callback(const Callback&) = delete;
    Callback& operator=(const Callback&) = delete;
    bool granted() const { return granted_; }

private:
    bool granted_;
};

}  // namespace

Progress Job::progress() {
    return [this](std::string_view phase, double fraction, double merit) {
        return !cancelled() && (!has_callback_ || call_back(phase, fraction, merit));
    };
}

bool Job::call_back(std::string_view phase, double fraction, double merit) {
    const Callback leave(*this);
    if (!leave.granted()) return false;
    const WithGil gil;
    if (cancelled()) return false;  // while this thread waited for the GIL
    try {
        const ProgressCallable callback = *callback_;  // an abandoning caller drops its own reference
        const py::object answer =
            call_python(callback, py::make_tuple(py::str(phase.data(), phase.size()), fraction, merit));
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
    {
        const std::lock_guard lock(mutex_);
        error_ = std::move(error);
        finished_ = true;
        ended_.notify_all();
    }
    const std::lock_guard lock(running().mutex);
    std::erase_if(running().jobs, [this](const auto& entry) { return entry.first == this; });
    running().fewer.notify_all();
}

// Called with the GIL, waits without. Does not return where Python has begun to end in another thread: what would come is
// the message that the work was cancelled, which nobody asked for.
template <class Duration>
bool Job::finished_within(Duration time) {
    const WithoutGil free;
    bool finished;
    {
        std::unique_lock lock(mutex_);
        finished = ended_.wait_for(lock, time, [this] { return finished_; });
    }
    std::unique_lock lock(running().mutex);
    if (running().ends_for_this_thread()) {
        lock.unlock();
        stop_for_good();
    }
    return finished;
}

// The exception of a signal handler (KeyboardInterrupt), or null when the work ended.
std::exception_ptr Job::wait_for_end_or_signal() {
    while (!finished_within(std::chrono::milliseconds(50)))
        if (PyErr_CheckSignals() != 0) return std::make_exception_ptr(py::error_already_set());
    return nullptr;
}

void Job::wait(std::thread worker) {
    {
        const std::scoped_lock lock(mutex_, running().mutex);
        if (running().ends_for_this_thread()) cancelled_ = true;
        if (!finished_) running().jobs.emplace_back(this, &cancelled_);
    }
    const std::exception_ptr signal = wait_for_end_or_signal();
    bool finished = true;
    if (signal) {
        cancelled_ = true;
        finished = finished_within(std::chrono::milliseconds(500));
    }
    finished ? worker.join() : worker.detach();
    callback_.reset();
    if (!signal && PyErr_CheckSignals() != 0)
        throw py::error_already_set();  // a signal that ended the work from within
    if (signal) std::rethrow_exception(signal);
    if (callback_error_) std::rethrow_exception(std::exchange(callback_error_, nullptr));
    if (error_) std::rethrow_exception(std::exchange(error_, nullptr));
}

void bind_end() { py::module_::import("atexit").attr("register")(py::cpp_function(end_jobs)); }

}  // namespace octafield::bindings
