// The representations known to Python: module functions <name>_embed and so on, and the registry `representations`.
#pragma once

#include <pybind11/pybind11.h>

namespace octafield::bindings {

// To add a representation, add its type to the list in representations.cpp.
void bind_representations(pybind11::module_& module);

}  // namespace octafield::bindings
