// Places of vertices in tets.
#pragma once

#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// The corner of the tet at which the vertex is; it must be one of its vertices.
inline int corner_of(const TetMesh& mesh, Index tet, Index vertex) {
    int k = 0;
    while (mesh.tets(tet, k) != vertex) ++k;
    return k;
}

}  // namespace octafield::volume
