// Edges inside a tet mesh that join two singular vertices without being singular: a seamless map of a field in the tets
// has no freedom at them, and meshers get flipped tets there.
#pragma once

#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

struct SingularSplit {
    TetMesh mesh;               // old vertices first, with their ids
    std::vector<Index> parent;  // (m) old tet that each tet is part of, whose frame it keeps
    Edges edges;                // (e, 2) of the old mesh that were to be split; lower id first, in order
    Edges left;                 // of these, what is still there: rounding would invert a flat tet
    Index added_vertices = 0;
};

// Splits edges at their midpoints that are no edges of the surface, not singular, and join two vertices of singular
// edges. With the frames of the parents, the singular edges are those of the old mesh, none split, and the new vertices
// are on none of them. of_tets: (m, 4) unit quaternions w x y z. Near linear. Throws InvalidInput, GeometryError.
SingularSplit split_between_singular(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

}  // namespace octafield::volume
