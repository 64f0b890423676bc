// Seamless maps of frame fields.
#pragma once

namespace pybind11 {
class module_;
}

namespace octafield::bindings {

void bind_field_map(pybind11::module_& module);  // after SeamlessMap

}  // namespace octafield::bindings
