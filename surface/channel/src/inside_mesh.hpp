// The mesh inside: squares or the user's quads, without what is outside or too near to the outline.
#pragma once

#include "octafield/surface/fixed_boundary_quads.hpp"

namespace octafield::surface::detail {

// Points and segments, of loops first.
struct Outline {
    PlanePoints points;
    Edges segments;
    Index loops = 0;  // how many of them
};

struct InsideMesh {
    PlanePoints points{0, 2};
    Quads quads{0, 4};  // ids of these points, counter-clockwise
};

// Squares that cover the points' box. Throws InvalidInput (kind "too_many_quads").
InsideMesh squares(const PlanePoints& points, double edge_length, const FixedBoundaryOptions& options);

// Throws InvalidInput (kinds "bad_inside_mesh": not in the plane z = 0, not convex or with triangles;
// "index_out_of_range").
InsideMesh plane_quads_of(const QuadMesh& mesh);

// Quads with all vertices inside and at least clearance times their mean edge length from all segments, with no segment
// through them. Vertices are numbered anew; those without a quad come last.
InsideMesh trimmed(const InsideMesh& mesh, const Outline& outline, double clearance);

}  // namespace octafield::surface::detail
