#include "gil.hpp"

#include <cxxabi.h>
#include <unistd.h>

namespace octafield::bindings {

void stop_for_good() {
    for (;;) pause();
}

InterruptsElsewhere::InterruptsElsewhere(bool really) {
    if (!really) return;
    sigset_t interrupt;
    sigemptyset(&interrupt);
    sigaddset(&interrupt, SIGINT);
    pthread_sigmask(SIG_BLOCK, &interrupt, &before_.emplace());
}

InterruptsElsewhere::~InterruptsElsewhere() {
    if (before_) pthread_sigmask(SIG_SETMASK, &*before_, nullptr);
}

WithoutGil::WithoutGil() : state_(PyEval_SaveThread()), interrupts_(gettid() != getpid()) {}

WithoutGil::~WithoutGil() {
    try {
        PyEval_RestoreThread(state_);
    } catch (abi::__forced_unwind&) {
        stop_for_good();
    }
}

WithGil::WithGil() {
    try {
        gil_.emplace();
    } catch (abi::__forced_unwind&) {
        stop_for_good();
    }
}

// Nothing to destroy between the catch and Python: it would touch Python's objects without the lock.
static PyObject* called(PyObject* callable, PyObject* arguments) {
    try {
        return PyObject_CallObject(callable, arguments);
    } catch (abi::__forced_unwind&) {
        stop_for_good();
    }
}

py::object call_python(const py::object& callable, const py::tuple& arguments) {
    PyObject* answer = called(callable.ptr(), arguments.ptr());
    if (answer == nullptr) throw py::error_already_set();
    return py::reinterpret_steal<py::object>(answer);
}

}  // namespace octafield::bindings
