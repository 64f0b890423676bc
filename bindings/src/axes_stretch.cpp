// Frames whose axes are not at right angles.
#include "stretch.hpp"

#include "bind.hpp"
#include "domain.hpp"
#include "interruptible.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace volume;
using py::literals::operator""_a;

void check(const AxesStretchOptions& options) {
    finite(options.corner_angle, "corner_angle");
    finite(options.least_deviation, "least_deviation");
}

void bind_axes_stretch(py::module_& m) {
    Record<AxesStretchOptions>(m, "AxesStretchOptions", "Which edges stretch space round them; see axes_stretch.")
        .field("corner_angle", &AxesStretchOptions::corner_angle,
               "radians in (0, pi/2): an edge has one hexahedron up to an interior angle of pi less this, two up to pi "
               "and this, three up to 2 pi less this, four beyond; quads in corners of faces likewise.")
        .field("least_deviation", &AxesStretchOptions::least_deviation,
               "radians in [0, pi/2]: where no edge and no corner is off its right angles by more, nothing is "
               "stretched.")
        .finish([](const AxesStretchOptions& o) {
            return "corner_angle=" + number(o.corner_angle) + ", least_deviation=" + number(o.least_deviation);
        });
    Record<AxesStretch>(m, "AxesStretch", "The stretch S of frames with axes S Q, Q orthonormal, per vertex.")
        .field("values", &AxesStretch::values,
               "(n, 6) float64: xx, yy, zz, yz, xz, xy of the symmetric positive definite S at each vertex.")
        .field("followed", &AxesStretch::followed,
               "(k,) int32 vertices on features whose edges and faces give S, ascending.")
        .field("sharp", &AxesStretch::sharp, "(k,) int32: those off right angles by more than least_deviation.")
        .field("needles", &AxesStretch::needles,
               "(k,) int32: vertices on features with an angle of less than a degree, not followed.")
        .finish([](const AxesStretch& s) {
            return count(static_cast<std::ptrdiff_t>(s.sharp.size()), "sharp vertex", "sharp vertices");
        });

    m.def(
        "axes_stretch",
        [](const DomainOrMesh& mesh, const py::kwargs& given) {
            const auto [options] = options_of<AxesStretchOptions>("axes_stretch", given);
            return run_interruptible(
                [mesh, options = options](Job&) { return axes_stretch(domain_of(mesh), options); });
        },
        "domain"_a,
        "The stretch of a TetDomain with features, as an AxesStretch: at corners of three edges and along edges with "
        "one or three hexahedra the axes S Q follow edges and both faces, at whatever angle; elsewhere log S is "
        "harmonic. boundary_constraints(..., stretch=...) asks the surface's alignment of Q, and any solver and "
        "representation finds it; stretched_axes gives the axes. Raises InvalidInput, SolverError.");
    list_options<AxesStretchOptions>(m, "axes_stretch");
    m.def(
        "stretched_axes",
        [](const ArrayLike& frames, const ArrayLike& stretch) {
            const auto rows = from_python<Quaternions>(frames, "frames");
            const Rows<double, 9> axes = stretched_axes(rows, from_python<Stretches>(stretch, "stretch"));
            return py::array_t<double>(std::vector<py::ssize_t>{axes.rows(), 3, 3}, axes.data());
        },
        "frames"_a, "stretch"_a,
        "(n, 3, 3): row i of element v is axis i of S Q at vertex v, not of unit length. frames: (n, 4) unit "
        "quaternions w x y z; stretch: (n, 6) as AxesStretch has it. Raises InvalidInput.");
}

}  // namespace octafield::bindings
