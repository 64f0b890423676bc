// The axes at the vertices of a tet mesh, identified across triangles by matchings.
#pragma once

#include "octafield/volume/combing.hpp"

namespace octafield::volume {

struct AxisOrbits {
    Rows<Index, 12> of_tets;  // (m, 12) column 3 c + i: the orbit of axis i, without its sign, at corner c
    Index count = 0;
};

AxisOrbits axis_orbits(const TetMesh& mesh, const FaceMatchings& faces);

}  // namespace octafield::volume
