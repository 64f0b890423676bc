// Remeshing for its own sake: what module.cpp calls, and checks of its options (as in checks.hpp).
#pragma once

#include <pybind11/pybind11.h>

namespace octafield::surface {
struct CloseRemeshOptions;
}  // namespace octafield::surface

namespace octafield::bindings {

void bind_close_remesh(pybind11::module_& module);
void check(const surface::CloseRemeshOptions& options);

}  // namespace octafield::bindings
