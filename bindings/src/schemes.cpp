// What can be minimised: the dictionary `schemes`.
#include "octafield/volume/schemes.hpp"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <string>

#include "bind.hpp"
#include "words.hpp"

namespace octafield::bindings {

namespace py = pybind11;
using volume::Scheme;

void bind_schemes(py::module_& m) {
    py::class_<Scheme>(m, "Scheme", "What smoothing minimises, and what is known of it.")
        .def_readonly("name", &Scheme::name, "Its word: the option representation.")
        .def_property_readonly(
            "sort", [](const Scheme& scheme) { return to_word(scheme.sort); },
            "\"embedding\" (vectors of frames), \"embedding_with_lengths\" (axis lengths are unknowns too) or "
            "\"metric\" (a difference of frames for each edge).")
        .def_readonly("equation", &Scheme::equation, "What is minimised, one line.")
        .def_readonly("meaning", &Scheme::meaning, "What it is, one clause.")
        .def_readonly("consistent", &Scheme::consistent,
                      "Whether the harmonic field of the angle metric is its limit on refined meshes.")
        .def_readonly("descends", &Scheme::descends, "Whether no step raises what is minimised.")
        .def_property_readonly(
            "bytes_per_tet",
            [](const Scheme& scheme) {
                py::dict all;
                for (const auto& [solver, bytes] : scheme.solvers) all[py::str(to_word(solver))] = bytes;
                return all;
            },
            "Memory of a run beyond the mesh, by solver: those that go with it, the default first.")
        .def_readonly("seconds_per_million_tets", &Scheme::seconds_per_million_tets,
                      "CPU seconds of a field by the default solver; 0: not measured.")
        .def_readonly("colour", &Scheme::colour,
                      "In plots: \"#rrggbb\", \"text\" (the text's) or \"\" (one of those kept for others).")
        .def_readonly("compared", &Scheme::compared, "Whether a comparison takes it when not told which.")
        .def("__repr__",
             [](const Scheme& scheme) { return "Scheme(" + scheme.name + ": " + scheme.equation + ")"; });
    py::dict all;
    for (const Scheme& each : volume::schemes())
        all[py::str(each.name)] = py::cast(&each, py::return_value_policy::reference);
    m.attr("schemes") = all;
}

}  // namespace octafield::bindings
