// Schemes of Python (octafield.volume.EmbeddingScheme, EdgeScheme) as C++ has them.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>

#include "octafield/volume/array_scheme.hpp"

namespace octafield::bindings {

// Whether a value is one: it has a callable `embed` or `residual`.
bool is_array_scheme(const pybind11::handle& value);
// Its functions take the lock of Python when they are called. Throws InvalidInput.
std::shared_ptr<const volume::ArrayScheme> array_scheme(const pybind11::handle& value);
pybind11::object python_scheme(const volume::ArrayScheme& scheme);  // the value it was made of

}  // namespace octafield::bindings
