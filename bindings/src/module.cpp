// octafield._core: entry point and exceptions.
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include "bind.hpp"
#include "gil.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/operators.hpp"

namespace py = pybind11;

namespace octafield::bindings {

namespace {

// Sets the Python error of class `name` of octafield.errors, with the same message, kind and elements.
void set_error(const char* name, const Error& error) {
    const py::object type = py::module_::import("octafield.errors").attr(name);
    const py::object exception = type(error.what(), error.kind(), error.elements());
    PyErr_SetObject(type.ptr(), exception.ptr());
}

void translate(std::exception_ptr pointer) {
    try {
        if (pointer) std::rethrow_exception(pointer);
    } catch (const InvalidInput& error) {
        set_error("InvalidInput", error);
    } catch (const GeometryError& error) {
        set_error("GeometryError", error);
    } catch (const SolverError& error) {
        set_error("SolverError", error);
    } catch (const IoError& error) {
        set_error("IoError", error);
    } catch (const Cancelled& error) {
        set_error("Cancelled", error);
    } catch (const Error& error) {
        set_error("Error", error);
    }
}

}  // namespace

}  // namespace octafield::bindings

PYBIND11_MODULE(_core, module) {
    using namespace octafield::bindings;
    module.doc() = "Hexahedral frame fields: the compiled part of octafield. Use it through the package octafield.";
    module.attr("__version__") = OCTAFIELD_VERSION;
    module.attr("__libraries__") = OCTAFIELD_LIBRARIES;  // "CGAL 5.5.1,Eigen 3.4.0": what it was built with
    module.attr("unit_speed_factor") = octafield::volume::unit_speed_factor;
    py::register_local_exception_translator(translate);
    bind_frames(module);
    bind_surface_types(module);
    bind_option_types(module);
    bind_surface(module);
    bind_remeshing(module);
    bind_volume_types(module);
    bind_field_analysis_types(module);
    bind_parameterization_types(module);
    bind_hexdom_types(module);
    bind_frame_streamline_types(module);
    bind_sampling_types(module);
    bind_volume_input_types(module);
    bind_domain(module);
    bind_volume(module);
    bind_axes_stretch(module);
    bind_sampling(module);
    bind_schemes(module);
    bind_array_schemes(module);
    bind_smoothing(module);
    bind_field_analysis(module);
    bind_parameterization(module);
    bind_frame_streamlines(module);
    bind_volume_input(module);
    bind_recipe(module);
    bind_cells(module);
    bind_quad_layout_types(module);
    bind_quad_layouts(module);
    bind_t_mesh_types(module);
    bind_t_meshes(module);
    bind_fixed_boundary(module);
    bind_hexdom(module);
    bind_hexmesh(module);
    bind_end();
    add_examples(module);
}
