// Stretches of frames whose axes are not at right angles, as functions take them.
#pragma once

#include <optional>

#include "arrays.hpp"
#include "octafield/volume/axes_stretch.hpp"

namespace octafield::bindings {

inline std::optional<volume::Stretches> stretches_of(const std::optional<ArrayLike>& given) {
    if (!given) return std::nullopt;
    return from_python<volume::Stretches>(*given, "stretch");
}

}  // namespace octafield::bindings
