// Kinds of constraints in Python: by number, or by name.
#pragma once

#include "arrays.hpp"
#include "octafield/volume/constraint_kinds.hpp"

namespace octafield::bindings {

// Numbers as they are (checks.hpp refuses unknown ones), or names of the kinds. Throws InvalidInput.
template <>
std::vector<volume::VertexConstraint> from_python(const py::handle& value, std::string_view name);

// "1 free, 2 axis, 1 fixed": how many of each are there.
std::string count_kinds(const std::vector<volume::VertexConstraint>& kinds);

// "0 free (nothing held), 1 axis (...), ...": for docstrings.
std::string described_kinds();

}  // namespace octafield::bindings
