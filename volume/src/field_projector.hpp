// From sh4 vectors off the variety, as linear solves leave them, to the nearest frames that the constraints allow.
#pragma once

#include <vector>

#include "constraint_spaces.hpp"

namespace octafield::volume {

class FieldProjector {
public:
    FieldProjector(const ConstraintSpaces& spaces, int threads);

    // `frames` of free vertices: in, guesses for the projection; out, the frames of the projected field. Where a
    // vertex turns about an axis only its vector moves, to the circle (twist() tells the frame); where all its points
    // are equally near it stays as `before`.
    void project(Sh4Field& field, const Sh4Field& before, Quaternions& frames) const;

    // Writes the frames of vertices that turn about an axis, from a projected field.
    void twist(const Sh4Field& field, Quaternions& frames) const;

private:
    void project_block(std::size_t first, std::size_t last, Sh4Field& field, Quaternions& frames) const;

    const ConstraintSpaces& spaces_;
    int threads_;
    std::vector<Index> free_;
};

}  // namespace octafield::volume
