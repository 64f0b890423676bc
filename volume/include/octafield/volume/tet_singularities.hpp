// Singular curves of a frame field that lives in the tets, from holonomy round edges.
#pragma once

#include <vector>

#include "octafield/volume/singularities.hpp"

namespace octafield::volume {

// An edge inside the mesh round which the product of the matchings across its triangles is not the identity. Edges of
// the boundary have no loop of tets round them, so none is singular.
struct SingularEdge {
    Index a, b;    // tet-mesh vertex ids, a < b
    int holonomy;  // of the octahedral group: the frame of the lowest tet comes back as q h, right-handed round a -> b
    int quarter_turns;  // as of a SingularTriangle, the curve running along the edge
};

struct SingularEdges {
    std::vector<SingularEdge> edges;  // in the order of (a, b)
    int complex_edges = 0;
    // The curves that they make: no triangles, points at mesh vertices, nodes where other than two of them meet inside.
    SingularGraph graph;
    std::vector<Index> vertices;  // tet-mesh vertex of each point of the graph, ascending
};

// of_tets: (m, 4) unit quaternions w x y z. Near linear; the same result at any thread count. Throws InvalidInput,
// GeometryError (unsound mesh).
SingularEdges singular_edges(const TetMesh& mesh, const Quaternions& of_tets, int threads = 0);

}  // namespace octafield::volume
