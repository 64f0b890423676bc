// Whether a hex mesh can exist round the singular curves of a frame field and where they meet. NECESSARY conditions
// only: a field that meets them all may still have no hex mesh, for local reasons (the lengths along axes) and global
// ones.
//
// After the local conditions of Liu et al. 2018 (Singularity-constrained octahedral fields, enumeration of hex-mesh
// vertices and Hopf-Poincare formula) and Liu, Bommes 2023 (Locally meshable frame fields). The hexahedra round an
// interior vertex of a hex mesh cut a small sphere into triangles, one per hexahedron, a corner per edge; an edge of
// valence d is a corner of degree d. Euler's formula says sum (6 - d) = 12, where regular corners (d = 4) count 2.
// Round a vertex of the boundary the triangles form a disk; where the boundary is smooth, each of its boundary edges
// has two hexahedra, so all triangles share one corner: a single edge leaves inwards, along the normal.
// boundary_meshability.hpp has what concerns feature edges and corners.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/volume/axes_stretch.hpp"
#include "octafield/volume/singularities.hpp"

namespace octafield::volume {

// Whether a sphere has a triangulation with so many corners of degree 3, 5 and 6 and all others of degree 4, no two
// edges joining the same corners. 3 v3 + v5 + 2 v4 = 12 gives the number v4 of regular ones. Exact where there are at
// most 12 corners in all (by enumeration of the 9150 triangulations; 11 types without degree 6, two of them curves
// that pass, one regular); beyond that, which takes degree 6, true means only that no count forbids it. Throws
// InvalidInput for negative numbers. With corners of degree 7 and 8, 3 v3 + v5 + 2 v4 = 12 + v7 + 2 v8, and true means
// only that.
bool hex_vertex_exists(int valence3, int valence5, int valence6, int valence7 = 0, int valence8 = 0);

enum class SingularVertexKind : std::uint8_t {
    node,         // three or four singular segments meet in a tet
    change,       // the curve goes on with another type: valence 3 on one side and 5 on the other
    boundary_end  // the curve leaves through a triangle of the boundary
};

// Where curves of the singular graph end.
struct SingularVertex {
    Index point;  // into SingularGraph::points
    SingularVertexKind kind;
    // Curves that end here, by type; a curve with both ends here counts twice.
    int valence2, valence3, valence5, valence6, complex;
    // At a boundary end: the frames turn round the triangle about the axis nearest to its normal, so that the surface
    // cross field has a singular point of the same index there. False at other kinds.
    bool about_normal;
    // At a node: all its curves turn about one and the same axis of the frame. Only two curves that pass each other in
    // a tet can be meshed then: a hex vertex where all edges turn about one axis has two singular edges, one each way.
    bool one_axis;
    // Neither complex nor of valence 1 or 2 (two hexahedra would share two faces), and
    // node: hex_vertex_exists(valence3, valence5, valence6); with one_axis: as many curves of each type along the axis
    // as against it. change: false. boundary_end: about_normal.
    bool meshable;
    Index junction;                                // into Meshability::junctions
    int valence1 = 0, valence7 = 0, valence8 = 0;  // as above; of frames in tets only
};

// One end of a curve of the singular graph.
struct SingularEnd {
    Index vertex;       // into Meshability::vertices
    Index curve;        // into SingularGraph::curves
    int quarter_turns;  // type of the curve
    // The axis of the frames about which they turn, unit, pointing away from the vertex; 0 where the curve is complex.
    Eigen::Vector3d axis;
    // Radians in [0, pi] between that axis and the smoothed curve, away from the vertex; 0 where it is complex. A hex
    // mesh has its singular edges along the axis: small angles are good, and nothing is concluded from large ones.
    double angle;
};

// Vertices that complex curves join, as if these curves were shrunk to a point: a sampled node of a hex mesh often
// appears as two nodes a triangle apart, joined by one complex segment.
struct SingularJunction {
    int vertices;                                // in it
    int valence2, valence3, valence5, valence6;  // ends of curves that leave it
    int complex;                                 // complex curves inside it; none leaves it
    // One vertex: that vertex's. More: the complex curves form a tree (shrinking keeps a ball), no end on the boundary
    // is among its vertices, no curve has valence 2, and hex_vertex_exists(valence3, valence5, valence6).
    bool meshable;
    int valence1 = 0, valence7 = 0, valence8 = 0;
};

struct Meshability {
    std::vector<SingularVertex> vertices;  // ascending points
    std::vector<SingularJunction> junctions;
    std::vector<SingularEnd> ends;  // by vertex, then in the order of the curves
    Edges curve_ends;  // (curves, 2): vertices at the first and last point of each curve; -1, -1: closed without one
    int non_meshable_vertices = 0;
    int non_meshable_junctions = 0;
    int non_meshable_curves = 0;  // complex, or of valence 2 or 1
    int closed_curves = 0;
    int boundary_ends = 0;               // ends of curves on the boundary
    int boundary_ends_about_normal = 0;  // of those, the ones at singular points of the surface cross field
};

// graph: singular_graph(mesh, frames). frames: (n, 4) unit quaternions w x y z. stretch: of axes S Q
// (axes_stretch.hpp), or no rows. Feature curves of the boundary are not looked at. Linear in the graph. Throws
// InvalidInput where the sizes do not fit together.
Meshability local_meshability(const TetDomain& domain, const Quaternions& frames, const SingularGraph& graph,
                              const Stretches& stretch = {});

}  // namespace octafield::volume
