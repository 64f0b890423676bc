// Quads of a plane region whose boundary is given segment by segment: a mesh of quads inside, which may be the user's,
// and templates between it and the boundary (Simons, "Size-driven all-quad meshing for geographic data", 2024,
// chapter 2).
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/planar_outline.hpp"
#include "octafield/surface/quad_mesh.hpp"

namespace octafield::surface {

enum class OddLoops {
    refuse,     // GeometryError "odd_boundary"
    split_one,  // the longest segment that puts it right, at its middle
    split_all,  // every segment of the input at its middle
};

struct FixedBoundaryOptions {
    double edge_length = 0;  // of the squares inside, input unit; 0: the mean segment of the loops
    double rotation = 0;     // of the squares, radians counter-clockwise
    double offset_x = 0;     // of a vertex of them from the origin, in edge lengths along the rotated axes
    double offset_y = 0;
    double clearance = 0.95;  // of vertices inside from segments, in edge lengths (local ones of a given mesh), > 0.8
    OddLoops odd_loops = OddLoops::refuse;
    int rounds = 12;  // in which groups of quads are formed anew and vertices moved; 0: as first covered
};

struct FixedBoundaryQuads {
    QuadMesh mesh;                // z = 0, counter-clockwise; vertices: the points of the outline come first
    Edges boundary{0, 2};         // (L', 2) the segments of the loops, two for one that was split
    Edges lines{0, 2};            // (M', 2) those of the lines
    std::vector<Index> interior;  // quads that are of the mesh inside, ascending
    std::vector<Index> split;     // segments that were split: loops first, then lines from L on
    Index reformed = 0;           // groups of quads that were formed anew
};

// `inside`: quads of one's own, in the plane z = 0, of which those are taken that keep the clearance; their
// connectivity stays, but vertices at its rim may move. Without quads: squares of the edge length.
//
// Not as in the source: patches come from one triangulation of the channel instead of all cross edges, with middles of
// edges put in where parity asks for them, and then any group of quads with an outline of at most 10 sides is exchanged
// for the template with the least sum of costs, as long as one is better. So channels of every shape and number of
// boundaries are done alike, in time near to linear.
//
// Throws as require_planar; InvalidInput (kinds "bad_option", "bad_inside_mesh": triangles, or not in the plane z = 0,
// "too_many_quads"); as require_valid for the mesh inside; GeometryError "outside_line" (elements: segments),
// "odd_boundary" (elements: a segment for each region with an odd number round it, which, split, puts it right),
// "odd_interior" (a hole of the mesh inside has an odd number of edges); SolverError "inverted_quads" (elements: quads
// that no template made convex); Cancelled.
FixedBoundaryQuads fixed_boundary_quads(const PlanarOutline& outline, const QuadMesh& inside,
                                        const FixedBoundaryOptions& options, const Progress& progress = {});

}  // namespace octafield::surface
