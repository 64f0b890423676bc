// Whether a hex mesh can exist at the edges and corners of the surface of a frame field. NECESSARY conditions only, as
// in meshability.hpp.
//
// After Liu et al. 2018 and Liu, Bommes 2023 (singular edges and vertices of the boundary). A hex mesh has k >= 1
// hexahedra in the wedge between two surface triangles at an edge. Its axes follow both normals, so from one normal to
// the other, through the wedge, they turn k quarter turns less than geometry does: k = (wedge angle - turn of the
// field) / 90 degrees, a whole number where the field is aligned. In the same way there are n >= 1 quadrilaterals
// between two feature edges at a corner. The hexahedra round a corner cut a small sphere into triangles; Euler's
// formula there is sum over feature edges (3 - k) + sum over sectors (n - 1) + 2 s + 3 v3 + v5 = 6, with s regular
// edges and v3, v5 singular ones of valence 3 and 5 that go inside: the first two sums are at most 6.
#pragma once

#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/volume/axes_stretch.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

// A wedge of tets at a feature edge, from one triangle of the surface to the next. Edges of a boundary have one, those
// of interfaces several.
struct FeatureWedge {
    Index a, b;    // tet-mesh vertex ids, a < b
    double angle;  // of the wedge, radians in (0, 2 pi)
    // So many hexahedra fill it by the frame of a, and by that of b; zero and less: no hex mesh. no_number where that
    // frame has one and the same axis nearest to the edge and to a normal, as at corners that no frame fits.
    int hexahedra_a, hexahedra_b;
    // The same by the frame of a carried through the tets of the wedge and back: it differs where a singular curve runs
    // through them along the edge. no_number where the frames come back turned about another axis.
    int around;
    bool meshable;  // there is a number, and none below 1, at the ends
};
inline constexpr int no_number = -1000;

// An edge of the surface that is no feature, along which another axis takes the place of the normal: a singular edge on
// the surface crosses it, with so many hexahedra instead of 2 (on the inner side of the triangles).
struct SurfaceCrossing {
    Index a, b;  // tet-mesh vertex ids, a < b
    int hexahedra;
};

struct SurfaceCorner {
    Index vertex;            // tet-mesh id
    int feature_edges;       // there
    int sectors;             // parts of the surface between them
    int inside;              // 6 - sum (3 - k) - sum (n - 1): what is left for edges that go inside
    int empty_sectors;       // with fewer than one quadrilateral
    int unclear_sectors;     // without a number: a singular edge on the surface crosses them; left out of the sum
    int non_meshable_edges;  // of its feature edges
    bool meshable;           // no empty sectors, no such edges, and inside >= 0 unless sectors are unclear
};

struct BoundaryMeshability {
    std::vector<FeatureWedge> wedges;        // in the order of the edges
    std::vector<SurfaceCrossing> crossings;  // in the order of the edges
    std::vector<SurfaceCorner> corners;      // ascending; not those that interfaces or several sheets meet in
    int non_meshable_wedges = 0;
    int non_meshable_crossings = 0;  // fewer than one hexahedron
    int non_meshable_corners = 0;
};

// surface: of the mesh, boundary_surface or that of region_surface; features of it. frames: (n, 4) unit quaternions
// w x y z. stretch: of axes S Q (axes_stretch.hpp), or no rows; angles are counted after S^-1, in which an edge of 30
// degrees that both faces' axes follow has one hexahedron, and FeatureWedge::angle is that in space. Near linear; the
// same result at any thread count. Throws InvalidInput, GeometryError (unsound mesh).
BoundaryMeshability boundary_meshability(const TetDomain& domain, const Quaternions& frames, int threads = 0,
                                         const Stretches& stretch = {});

// (k, 2) radians per wedge, in the order of `wedges` above, the larger of both ends: the largest angle between the
// normal of one of its two triangles and the nearest normal of a pair of axes, and that between the edge and the
// nearest axis. Arguments and errors as above.
Rows<double, 2> wedge_alignment(const TetDomain& domain, const Quaternions& frames, int threads = 0,
                                const Stretches& stretch = {});

}  // namespace octafield::volume
