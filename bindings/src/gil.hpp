// Python's lock, taken and given up so that a thread may be at it while Python ends.
//
// Python ends a thread that waits for the lock by pthread_exit (before 3.14), which unwinds the stack: through a destructor or a
// handler of ours that is the end of the process. Here such a thread stops for good instead, as Python 3.14 has it.
#pragma once

#include <pybind11/pybind11.h>

#include <optional>

namespace octafield::bindings {

namespace py = pybind11;

[[noreturn]] void stop_for_good();  // the calling thread, which must not hold the lock

// Gives the lock up while it lives. For threads of Python; there is no way on once Python has ended.
class WithoutGil {
public:
    WithoutGil() : state_(PyEval_SaveThread()) {}
    ~WithoutGil();
    WithoutGil(const WithoutGil&) = delete;
    WithoutGil& operator=(const WithoutGil&) = delete;

private:
    PyThreadState* state_;
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
