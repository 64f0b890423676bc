// Check of a frame array handed in by a caller.
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "octafield/arrays.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {

// Throws InvalidInput unless `frames` has `count` rows of unit quaternions (to 1e-6).
inline void require_frames(const Quaternions& frames, Eigen::Index count) {
    if (frames.rows() != count)
        throw InvalidInput("frames has " + std::to_string(frames.rows()) +
                               " rows; give one quaternion (w, x, y, z) per vertex, " + std::to_string(count) + " rows",
                           "wrong_size");
    std::vector<std::int32_t> bad;
    for (Eigen::Index v = 0; v < count; ++v)
        if (!(std::abs(frames.row(v).squaredNorm() - 1) < 1e-6)) bad.push_back(static_cast<std::int32_t>(v));
    if (!bad.empty())
        throw InvalidInput("frames at vertices " + first_few(bad) + " are not unit quaternions; normalise them",
                           "not_unit", bad);
}

}  // namespace octafield::volume
