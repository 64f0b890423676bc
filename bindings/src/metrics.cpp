// Distances of frames by name: the dictionary `metrics`.

#include <string>

#include "bind.hpp"
#include "octafield/frames/registry.hpp"
#include "rows.hpp"

namespace octafield::bindings {

using namespace frames;
using py::literals::operator""_a;

void bind_metrics(py::module_& m) {
    py::class_<Metric>(m, "Metric", "A way to measure how far two frames are from each other.")
        .def_property_readonly(
            "name", [](const Metric& metric) { return std::string(metric.name); },
            "Its word, for example \"geodesic\".")
        .def_property_readonly(
            "description", [](const Metric& metric) { return std::string(metric.description); }, "What it measures.")
        .def_property_readonly(
            "speed",
            [](const Metric& metric) { return metric.speed > 0 ? py::object(py::float_(metric.speed)) : py::none(); },
            "Ratio to the angle in radians at small angles; None where it depends on frame and direction.")
        .def(
            "distance",
            [](const Metric& metric, const ArrayLike& q1, const ArrayLike& q2, int threads) {
                const auto [a, b] = broadcast(read_quaternions(q1, "q1"), read_quaternions(q2, "q2"), "q1", "q2");
                return map_pairs<>(a, b, threads, [distance = metric.distance](const auto& x, const auto& y, auto out) {
                    out[0] = distance(from_wxyz(x), from_wxyz(y));
                });
            },
            "q1"_a, "q2"_a, py::kw_only(), "threads"_a = 0, "(n,) distances of (n, 4) frames.")
        .def("__repr__", [](const Metric& metric) {
            return "Metric(" + std::string(metric.name) + ": " + std::string(metric.description) + ")";
        });
    py::dict all;
    for (const Metric& each : metrics())
        all[py::str(std::string(each.name))] = py::cast(&each, py::return_value_policy::reference);
    m.attr("metrics") = all;
}

}  // namespace octafield::bindings
