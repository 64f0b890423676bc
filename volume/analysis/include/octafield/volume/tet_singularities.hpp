// Singular curves of a frame field that lives in the tets, from holonomy round edges.
#pragma once

#include <vector>

#include "octafield/volume/singularities.hpp"

namespace octafield::volume {

// An edge inside the mesh round which the product of the matchings across its triangles, lifted to the binary
// octahedral group (frames/octahedral_lift.hpp), is not the identity. Edges of the boundary have no loop of tets round
// them, so none is singular.
struct SingularEdge {
    Index a, b;    // tet-mesh vertex ids, a < b
    int holonomy;  // of the octahedral group: the frame of the lowest tet comes back as q h, right-handed round a -> b
    // As of a SingularTriangle, the curve running along the edge, from -4 to 3: +3 valence 1, -3 valence 7, -4 valence
    // 8 (holonomy 0, frames that turn once round; index +1 would be the same, but leaves no hexahedra).
    int quarter_turns;
    // Hexahedra round the edge: 4 less the turns about a -> b itself. Other than 4 - quarter_turns where the edge runs
    // against its curve in a zigzag. no_valence: complex, or the axis of the turn is at right angles to the edge.
    int valence = no_valence;
    // As of a SingularTriangle: a matching across a triangle at the edge, or the sign, is chance.
    bool undecided = false;

    static constexpr int no_valence = -1;
};

struct SingularEdges {
    std::vector<SingularEdge> edges;  // in the order of (a, b)
    int complex_edges = 0;
    int undecided_edges = 0;
    int tied_triangles =
        0;  // inside, across which two matchings are equally near: edges at them may be singular or not
    // The curves that they make: no triangles, points at mesh vertices, nodes where other than two of them meet inside.
    // They end at vertices of the boundary.
    SingularGraph graph;
    std::vector<Index> vertices;  // tet-mesh vertex of each point of the graph, ascending
};

// of_tets: (m, 4) unit quaternions w x y z. Near linear; the same result at any thread count. Throws InvalidInput,
// GeometryError (unsound mesh).
SingularEdges singular_edges(const TetDomain& domain, const Quaternions& of_tets, int threads = 0);

}  // namespace octafield::volume
