// Option structs as Python classes; options.hpp makes keyword arguments of them. Meaning, units and ranges of each
// field are told where its struct is declared and, for the user, here.
#include <cmath>

#include "array_schemes.hpp"
#include "bind.hpp"
#include "octafield/surface/direction_field.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/remesh.hpp"
#include "octafield/volume/boundary.hpp"
#include "octafield/volume/frame_field.hpp"
#include "options.hpp"

namespace octafield::bindings {

using namespace volume;
using namespace surface;

void set_docstring(py::handle function, const std::string& text) {
    PyMethodDef* const method = reinterpret_cast<PyCFunctionObject*>(function.ptr())->m_ml;
    std::free(const_cast<char*>(method->ml_doc));  // as pybind11 does when an overload is added
    method->ml_doc = strdup(text.c_str());
}

void check(const DiffuseOptions& options) {
    finite(options.first_time, "first_time");
    finite(options.last_time, "last_time");
    finite(options.time_exponent, "time_exponent");
    finite(options.linear_tolerance, "linear_tolerance");
    threads_option(options.threads);
}

void check(const SmoothOptions& options) {
    if (std::isnan(options.midpoint_limit)) throw InvalidInput("midpoint_limit is not a number", "bad_option");
    finite(options.tolerance, "tolerance");
    threads_option(options.threads);
}

void check(const FrameFieldOptions& options) {
    finite(options.round_time, "round_time");
    threads_option(options.threads);
}

void check(const BoundaryOptions& options) { finite(options.feature_tolerance, "feature_tolerance"); }

void check(const DirectionFieldOptions& options) {
    finite(options.epsilon, "epsilon");
    finite(options.first_epsilon, "first_epsilon");
    finite(options.tolerance, "tolerance");
    finite(options.energy_tolerance, "energy_tolerance");
    finite(options.alignment_length, "alignment_length");
    finite(options.least_feature_angle, "least_feature_angle");
    finite(options.corner_tolerance, "corner_tolerance");
}

void check(const FeatureOptions& options) {
    finite(options.angle, "angle");
    finite(options.corner_angle, "corner_angle");
}

void check(const RemeshOptions& options) {
    finite(options.edge_length, "edge_length");
    finite(options.max_cells, "max_cells");
}

void check(const SizeFieldOptions& options) {
    finite(options.longest, "longest");
    finite(options.shortest, "shortest");
    finite(options.angle, "angle");
    finite(options.growth, "growth");
    finite(options.max_cells, "max_cells");
}

namespace {

void bind_of_surfaces(py::module_& m) {
    Record<FeatureOptions>(m, "FeatureOptions",
                           "Options of detect_features: its keyword arguments, with their defaults.")
        .field("angle", &FeatureOptions::angle, "Radians in (0, pi), between the normals at a feature edge.")
        .field("corner_angle", &FeatureOptions::corner_angle, "Radians: a turn of a feature curve that is a corner.")
        .finish([](const FeatureOptions& o) { return "angle=" + number(o.angle); });
    Record<RemeshOptions>(m, "RemeshOptions", "Options of remesh: its keyword arguments, with their defaults.")
        .field("edge_length", &RemeshOptions::edge_length, "Input unit; 0: lengths that fit the shape.")
        .field("iterations", &RemeshOptions::iterations, "Rounds, at least 1.")
        .field("max_cells", &RemeshOptions::max_cells, "Without a length: triangles and tets to be expected.")
        .finish([](const RemeshOptions& o) { return "edge_length=" + number(o.edge_length); });
    Record<SizeFieldOptions>(m, "SizeFieldOptions",
                             "Options of size_field: its keyword arguments, with their defaults.")
        .field("longest", &SizeFieldOptions::longest, "Input unit; 0: default_edge_length.")
        .field("shortest", &SizeFieldOptions::shortest, "Input unit; 0: 1/16 of longest.")
        .field("angle", &SizeFieldOptions::angle, "Radians: turn of the surface along one edge.")
        .field("growth", &SizeFieldOptions::growth, "Largest change of length per distance.")
        .field("max_cells", &SizeFieldOptions::max_cells, "Triangles, and tets inside, to be expected.")
        .finish([](const SizeFieldOptions& o) { return "longest=" + number(o.longest); });
    Record<DirectionFieldOptions>(m, "DirectionFieldOptions",
                                  "Options of direction_field: its keyword arguments, with their defaults.")
        .field("symmetry", &DirectionFieldOptions::symmetry, "N: 4 for crosses.")
        .field("method", &DirectionFieldOptions::method, "A key of direction_field_methods.")
        .field("epsilon", &DirectionFieldOptions::epsilon, "Coherence length, input unit; 0: from the edge length.")
        .field("edge_epsilon", &DirectionFieldOptions::edge_epsilon, "(E,) one per edge in its place, or none.")
        .field("first_epsilon", &DirectionFieldOptions::first_epsilon,
               "Where the continuation in epsilon starts; 0: a tenth of the size.")
        .field("max_iterations", &DirectionFieldOptions::max_iterations, "Of the descent, or of diffusions.")
        .field("tolerance", &DirectionFieldOptions::tolerance, "On the residual.")
        .field("energy_tolerance", &DirectionFieldOptions::energy_tolerance, "Relative decrease at which to stop.")
        .field("seed", &DirectionFieldOptions::seed, "Of random starts and disturbances.")
        .field("boundary_alignment", &DirectionFieldOptions::boundary_alignment,
               "How the field follows edges of one triangle: \"strong\", \"weak\" or \"none\".")
        .field("feature_alignment", &DirectionFieldOptions::feature_alignment,
               "How it follows feature edges inside: the same words.")
        .field("alignment_length", &DirectionFieldOptions::alignment_length,
               "Of the weak penalty, input unit; 0: epsilon.")
        .field("least_feature_angle", &DirectionFieldOptions::least_feature_angle,
               "Radians: feature edges that bend by less are ignored.")
        .field("corner_tolerance", &DirectionFieldOptions::corner_tolerance,
               "In [0, 1]: part of pi / N by which two edges may differ and be followed strongly.")
        .field("constraints", &DirectionFieldOptions::constraints, "DirectionConstraints.")
        .field("guide", &DirectionFieldOptions::guide, "DirectionGuide.")
        .finish([](const DirectionFieldOptions& o) {
            return "symmetry=" + std::to_string(o.symmetry) + ", method='" + o.method + "'";
        });
}

py::object minimised(const SmoothOptions& options) {
    return options.own_scheme ? python_scheme(*options.own_scheme) : py::str(options.representation);
}

void set_minimised(SmoothOptions& options, const py::handle& value) {
    options.own_scheme = is_array_scheme(value) ? array_scheme(value) : nullptr;
    if (options.own_scheme) return;
    if (!py::isinstance<py::str>(value))
        throw py::type_error(
            std::string("representation: a value of type ") + Py_TYPE(value.ptr())->tp_name +
            " does not fit; give a key of octafield.volume.schemes, an EmbeddingScheme or an EdgeScheme");
    options.representation = value.cast<std::string>();
}

void bind_of_volumes(py::module_& m) {
    Record<BoundaryOptions>(m, "BoundaryOptions",
                            "Options of boundary_constraints and tet_boundary_constraints: their keyword arguments.")
        .field("mode", &BoundaryOptions::mode,
               "\"aligned\" (one axis on the normal, twist free), \"fixed\" (whole frame) or \"none\".")
        .field("feature_tolerance", &BoundaryOptions::feature_tolerance,
               "Radians: how well one frame must fit a feature vertex to be kept whole.")
        .finish([](const BoundaryOptions& o) { return "mode='" + to_word(o.mode) + "'"; });
    Record<DiffuseOptions>(m, "DiffuseOptions", "Options of diffuse: its keyword arguments, with their defaults.")
        .field("first_time", &DiffuseOptions::first_time, "Of the first step, over the squared size of the body.")
        .field("last_time", &DiffuseOptions::last_time, "Of the last, over the squared mean boundary edge.")
        .field("time_exponent", &DiffuseOptions::time_exponent, "Step k lasts 1/k^time_exponent of the first.")
        .field("max_steps", &DiffuseOptions::max_steps, "The exponent is raised where more would be needed.")
        .field("linear_tolerance", &DiffuseOptions::linear_tolerance, "Of the linear solves.")
        .field("keep_best", &DiffuseOptions::keep_best, "The state of lowest energy met, or the last.")
        .field("threads", &DiffuseOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const DiffuseOptions& o) { return "first_time=" + number(o.first_time); });
    Record<SmoothOptions>(m, "SmoothOptions", "Options of smooth: its keyword arguments, with their defaults.")
        .field("representation", minimised, set_minimised,
               "What is minimised: a key of schemes, or an EmbeddingScheme or EdgeScheme of one's own.")
        .field("solver", &SmoothOptions::solver, "\"default\": the scheme's first.")
        .field("max_iterations", &SmoothOptions::max_iterations, "0 or more.")
        .field("tolerance", &SmoothOptions::tolerance, "Relative energy decrease at which to stop.")
        .field("linear_solver", &SmoothOptions::linear_solver,
               "Of levenberg_marquardt: \"default\" (cholesky up to 10,000 sites), \"cholesky\" or "
               "\"conjugate_gradients\".")
        .field("midpoint_limit", &SmoothOptions::midpoint_limit,
               "Of su2_midpoint, radians: beyond it edges are measured by the geodesic.")
        .field("threads", &SmoothOptions::threads, "0: all; the result does not depend on it.")
        .finish([](const SmoothOptions& o) {
            return "representation=" + py::repr(minimised(o)).cast<std::string>() + ", solver='" + to_word(o.solver) +
                   "'";
        });
    Record<FrameFieldOptions>(m, "FrameFieldOptions",
                              "Options of frame_field, with those of its parts: its keyword arguments.")
        .field("start", &FrameFieldOptions::start, "\"constraints\" or \"cross_field\": see initial_frames.")
        .field("seed", &FrameFieldOptions::seed, "Other than 0: a random start, with five times first_time.")
        .field("rounds", &FrameFieldOptions::rounds, "Of diffusion and polish.")
        .field("round_time", &FrameFieldOptions::round_time, "first_time of a round over that of the one before.")
        .field("diffuse", &FrameFieldOptions::diffuse, "DiffuseOptions.")
        .field("smooth", &FrameFieldOptions::smooth, "SmoothOptions.")
        .field("threads", &FrameFieldOptions::threads, "0: all; in place of those of the parts.")
        .finish([](const FrameFieldOptions& o) { return "rounds=" + std::to_string(o.rounds); });
}

}  // namespace

void bind_option_types(py::module_& m) {
    bind_of_surfaces(m);
    bind_of_volumes(m);
}

}  // namespace octafield::bindings
