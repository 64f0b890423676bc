// From sh4 vectors off the variety, as linear solves leave them, to the nearest frames that the constraints allow.
#pragma once

#include <vector>

#include "constraint_spaces.hpp"

namespace octafield::volume {

class FieldProjector {
public:
    FieldProjector(const ConstraintSpaces& spaces, int threads);

    // The field's rows become the allowed vectors nearest to them. `frames` of free sites: in, guesses for the
    // projection; out, the frames of the projected field. Where a site is held in part only its vector moves
    // (write_frames() tells the frame); where all that it may be are equally near it stays as `before`.
    void project(Sh4Field& field, const Sh4Field& before, Quaternions& frames) const;
    // The same at some sites, none of them held: towards row k of `wanted` at site k of the list.
    void project_sites(const std::vector<Index>& sites, const Sh4Field& wanted, Sh4Field& field,
                       Quaternions& frames) const;

    // Writes the frames of sites that are held in part, from a projected field.
    void write_frames(const Sh4Field& field, Quaternions& frames) const;

private:
    // row(k): what site k of the list is projected from.
    template <class Row>
    void project_list(const std::vector<Index>& sites, const Row& row, const Sh4Field& before, Sh4Field& field,
                      Quaternions& frames) const;
    void project_free(const std::vector<Index>& sites, const std::vector<double>& values, Sh4Field& field,
                      Quaternions& frames) const;

    const ConstraintSpaces& spaces_;
    int threads_;
    std::vector<Index> moving_;  // sites that are not held
};

}  // namespace octafield::volume
