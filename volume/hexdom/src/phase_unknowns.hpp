// One phase per axis at each vertex of a tet mesh.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/combing.hpp"

namespace octafield::volume {

// A phase of axis i at corner c of a tet is sign x that of its unknown.
struct SignedUnknown {
    Index unknown;
    int sign;
};

class PhaseUnknowns {
public:
    // Axes at a vertex are one where matchings carry them from tet to tet. Those that come back as their opposites, as
    // at a singular curve of quarter turns, have phase 0: they are held.
    PhaseUnknowns(const TetMesh& mesh, const FaceMatchings& faces);

    Index count() const { return static_cast<Index>(held_.size()); }
    SignedUnknown at(Index tet, int corner, int axis) const {
        const Index code = codes_(tet, 3 * corner + axis);
        return code > 0 ? SignedUnknown{code - 1, 1} : SignedUnknown{-code - 1, -1};
    }
    bool held(Index unknown) const { return held_[unknown]; }
    void hold(Index unknown) { held_[unknown] = 1; }

private:
    Rows<Index, 12> codes_;  // unknown + 1, negative for the opposite
    std::vector<std::uint8_t> held_;
};

}  // namespace octafield::volume
