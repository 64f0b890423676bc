// Renormalised energies of the critical points of direction fields.
#include "octafield/surface/renormalised_energy.hpp"

#include "arrays.hpp"
#include "bind.hpp"
#include "checks.hpp"
#include "interruptible.hpp"

namespace octafield::bindings {

using namespace surface;
using py::literals::operator""_a;

namespace {

void def_of_points(py::module_& m, const char* name, double (*energy)(const Points&), const char* doc) {
    m.def(
        name,
        [energy](const ArrayLike& points) {
            return run_interruptible([rows = from_python<Points>(points, "points"), energy](Job&) {
                check_vectors(rows, rows.rows(), "points", "point");
                return energy(rows);
            });
        },
        "points"_a, doc);
}

}  // namespace

void bind_renormalised_energy(py::module_& m) {
    m.attr("core_energy") = core_energy;
    m.def(
        "disk_renormalised_energy",
        [](const ArrayLike& points) {
            return run_interruptible([values = from_python<Eigen::VectorXcd>(points, "points")](Job&) {
                return disk_renormalised_energy({values.data(), static_cast<std::size_t>(values.size())});
            });
        },
        "points"_a,
        "W of d critical points in the unit disk, complex numbers inside it, of a d-direction field tangent to its "
        "circle: -pi sum_{i != j} log|a_i - a_j| - pi sum_{i, j} log|1 - a_i conj(a_j)|.");
    m.def(
        "disk_polygon_energy", [](int d, double r) { return disk_polygon_energy(d, r); }, "d"_a, "r"_a,
        "W of the corners of a regular polygon of d critical points at radius r in (0, 1) of the unit disk.");
    m.def(
        "disk_polygon_radius", [](int d) { return disk_polygon_radius(d); }, "d"_a,
        "The radius that makes disk_polygon_energy least: r^(2 d) = (d - 1) / (3 d - 1).");
    def_of_points(m, "logarithmic_energy", logarithmic_energy,
                  "-sum over pairs i < j of log|x_i - x_j|, of (n, 3) different points.");
    def_of_points(m, "sphere_renormalised_energy", sphere_renormalised_energy,
                  "W of the n = 2 N critical points of an N-direction field on the unit sphere, (n, 3), n even: "
                  "2 pi logarithmic_energy + pi n^2 (log 2 - 1/2).");
    m.def(
        "asymptotic_energy",
        [](int points, double renormalised_energy, double epsilon) {
            return asymptotic_energy(points, finite(renormalised_energy, "renormalised_energy"), epsilon);
        },
        "points"_a, "renormalised_energy"_a, "epsilon"_a,
        "Ginzburg-Landau energy for a small coherence length epsilon in (0, 1), domain of size 1: "
        "pi n |log epsilon| + W + n core_energy.");
}

}  // namespace octafield::bindings
