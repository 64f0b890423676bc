// Singular curves of a per-vertex frame field, from holonomy round triangles.
#pragma once

#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// A triangle is singular when the product of the matchings along its three edges is not the identity; a singular curve
// crosses it.
struct SingularTriangle {
    Index a, b, c;  // tet-mesh vertex ids, a < b < c; positive side: right-hand rule
    // Element h of the octahedral group (frames/octahedral_group.hpp): the frame of a, carried round a -> b -> c -> a,
    // comes back as q_a h.
    int holonomy;
    // Quarter turns of the frames about the curve, in the sense of going round it: +1 valence 3 (index +1/4), -1
    // valence 5, +2 valence 2, -2 valence 6. The sign is that of (axis of the turn) . (direction of the curve, from the
    // point before to the point after). Turns are counted modulo 8 quarters, along the steps from vertex to vertex,
    // each the smallest possible (frames/octahedral_lift.hpp): +2 and -2 are told apart, as are +1 and -3 (valence 7),
    // but three steps of at most 62.8 degrees never make three quarters. 0: not a rotation about one of its own axes (a
    // complex singularity: third turn or half turn about a face diagonal), which no hex mesh has.
    int quarter_turns;
    bool boundary;          // lies on the boundary of the mesh
    Eigen::Vector3d point;  // where the linear sh4 interpolant is shortest
    // Chance decides: two matchings along one of the edges are equally near, or the axis of the turn is at right angles
    // to the curve, both to 1e-6 radians.
    bool undecided = false;
};

// The dual graph: every tet joins the singular triangles among its faces. Two: a segment; three or four: a node inside
// the tet.
struct SingularGraph {
    std::vector<SingularTriangle> triangles;
    Points points;  // (p, 3): first one per singular triangle, then the nodes inside tets
    // Polylines as point ids, maximal between nodes, boundary ends and changes of type; closed ones repeat the first
    // id. A segment between triangles of different types belongs to the complex one, else to the one of lower id.
    std::vector<std::vector<Index>> curves;
    std::vector<int> curve_quarter_turns;  // of the triangles along the curve
    std::vector<Index> nodes;              // point ids inside tets where three or four segments meet
    double length = 0;                     // sum over the curves, input unit
    int complex_triangles = 0;
    int undecided_triangles = 0;
};

// frames: (n, 4) unit quaternions w x y z, n the number of vertices. Throws InvalidInput. The same result at any thread
// count.
SingularGraph singular_graph(const TetDomain& domain, const Quaternions& frames, int threads = 0);

}  // namespace octafield::volume
