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

// No rows where none is given, as functions take frames at right angles.
inline volume::Stretches stretch_rows(const std::optional<ArrayLike>& given) {
    const std::optional<volume::Stretches> found = stretches_of(given);
    if (found && found->rows() == 0)
        throw InvalidInput("stretch has no rows; give one per vertex, or None for axes at right angles", "wrong_shape");
    return found.value_or(volume::Stretches());
}

}  // namespace octafield::bindings
