// Descent site by site: each frame in turn becomes the best for its neighbours as they are.
#pragma once

#include <vector>

#include "field_projector.hpp"

namespace octafield::volume {

// With |a_v| = 1 the energy depends on site v through -a_v . b_v, b_v = -sum over neighbours of L_vw a_w, so the frame
// nearest to b_v is the minimum over frames of v, however far it is from the frame it replaces: sites that a sliver
// holds in a wrong frame are freed at once. Sites of one colour have no common edge and are done together.
class SiteDescent {
public:
    SiteDescent(const BlockLaplacian& laplacian, const ConstraintSpaces& spaces, const FieldProjector& projector,
                int threads);

    // Visits every site once. `field` and `frames` as in FieldProjector::project. Never raises the energy.
    void sweep(Sh4Field& field, Quaternions& frames) const;

private:
    const BlockLaplacian& laplacian_;
    const ConstraintSpaces& spaces_;
    const FieldProjector& projector_;
    int threads_;
    std::vector<std::vector<Index>> colours_;
};

}  // namespace octafield::volume
