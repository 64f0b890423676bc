// One function per part of the module; each adds its names to `module`.
#pragma once

#include <pybind11/pybind11.h>

namespace octafield::bindings {

void bind_frames(pybind11::module_& module);
void bind_harmonics(pybind11::module_& module);
void bind_representations(pybind11::module_& module);
void bind_tensors(pybind11::module_& module);
void bind_su2(pybind11::module_& module);
void bind_metrics(pybind11::module_& module);
void bind_surface_types(pybind11::module_& module);
void bind_surface_domain(pybind11::module_& module);
void bind_surface(pybind11::module_& module);
void bind_remeshing(pybind11::module_& module);
void bind_direction_field_types(pybind11::module_& module);
void bind_direction_fields(pybind11::module_& module);
void bind_non_orthogonal_types(pybind11::module_& module);
void bind_non_orthogonal(pybind11::module_& module);
void bind_streamlines(pybind11::module_& module);
void bind_imposed_field_types(pybind11::module_& module);
void bind_imposed_fields(pybind11::module_& module);
void bind_sized_field_types(pybind11::module_& module);
void bind_sized_fields(pybind11::module_& module);
void bind_size_family_types(pybind11::module_& module);
void bind_size_families(pybind11::module_& module);
void bind_atlas_types(pybind11::module_& module);
void bind_atlas(pybind11::module_& module);
void bind_quad_layout_types(pybind11::module_& module);
void bind_quad_layouts(pybind11::module_& module);
void bind_fixed_boundary(pybind11::module_& module);
void bind_t_mesh_types(pybind11::module_& module);
void bind_t_meshes(pybind11::module_& module);
void bind_renormalised_energy(pybind11::module_& module);
void bind_volume_types(pybind11::module_& module);
void bind_domain(pybind11::module_& module);
void bind_volume(pybind11::module_& module);
void bind_sampling_types(pybind11::module_& module);
void bind_sampling(pybind11::module_& module);
void bind_option_types(pybind11::module_& module);
void bind_schemes(pybind11::module_& module);
void bind_array_schemes(pybind11::module_& module);
void bind_smoothing(pybind11::module_& module);
void bind_field_analysis_types(pybind11::module_& module);
void bind_field_analysis(pybind11::module_& module);
void bind_frame_streamline_types(pybind11::module_& module);
void bind_frame_streamlines(pybind11::module_& module);
void bind_parameterization_types(pybind11::module_& module);
void bind_parameterization(pybind11::module_& module);
void bind_volume_input_types(pybind11::module_& module);
void bind_volume_input(pybind11::module_& module);
void bind_cells(pybind11::module_& module);
void bind_hexdom_types(pybind11::module_& module);
void bind_hexdom(pybind11::module_& module);
void bind_hexmesh(pybind11::module_& module);
void bind_axes_stretch(pybind11::module_& module);
void bind_recipe(pybind11::module_& module);
void add_examples(pybind11::module_& module);  // to docstrings, after everything else

}  // namespace octafield::bindings
