// Python's lock, taken and given up so that a thread may be at it while Python ends.
//
// Python ends a thread that waits for the lock by pthread_exit (before 3.14), which unwinds the stack: through a destructor or a
// handler of ours that is the end of the process. Here such a thread stops for good instead, as Python 3.14 has it.
#pragma once

#include <pybind11/pybind11.h>

#include <csignal>
#include <optional>

namespace octafield::bindings {

namespace py = pybind11;

[[noreturn]] void stop_for_good();  // the calling thread, which must not hold the lock

// Keeps Ctrl-C from the calling thread, and from those it starts, while it lives. Python waits for it in its main thread; the
// system may give it to any thread that takes it, and a main thread that waits for a lock (Thread.join) then never wakes.
// Programs that a callback starts in such a thread do not take it either.
class InterruptsElsewhere {
public:
    explicit InterruptsElsewhere(bool really = true);
    ~InterruptsElsewhere();
    InterruptsElsewhere(const InterruptsElsewhere&) = delete;
    InterruptsElsewhere& operator=(const InterruptsElsewhere&) = delete;

private:
    std::optional<sigset_t> before_;
};

// Gives the lock up while it lives. For threads of Python; there is no way on once Python has ended.
class WithoutGil {
public:
    WithoutGil();
    ~WithoutGil();
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;

private:
    PyThreadState* state_;
    InterruptsElsewhere interrupts_;
};

// Holds the lock while it lives. For threads of ours.
class WithGil {
public:
    WithGil();
    WithGil(const WithGil&) = delete;
    WithGil& operator=(const WithGil&) = delete;

private:
    std::optional<py::gil_scoped_acquire> gil_;
};

// callable(*arguments); throws what it raised.
py::object call_python(const py::object& callable, const py::tuple& arguments);

void bind_end();  // registers with Python what its end does to work in progress (interruptible.cpp)

}  // namespace octafield::bindings
