// Curves along which parts of a layout's surface that was cut open lie side by side, and its boundary.
#pragma once

#include "octafield/surface/quad_layout.hpp"

namespace octafield::surface::detail {

// Part of a seam between two places that the mesh has to have a vertex at, as one side or the other ends arcs there.
struct SeamPart {
    double first, last;  // lengths along the seam
    double parameters;   // in quad coordinates, mean of the sides
};

struct SeamStop {
    double at;                    // length along the seam
    Index node = -1;              // place in Seams::nodes; -1: none
    std::vector<Index> vertices;  // of the layout
};

struct Seam {
    std::vector<SeamStop> stops;  // by length; of a closed seam without nodes the first and the last are the same
    bool closed = false;
    double length = 0;
    Index first_part = 0;  // part i lies between stops i and i + 1
    struct Knot {
        double at, parameters;  // lengths from the seam's start, plain and in quad coordinates, mean of the sides
        Eigen::Vector3d position;
    };
    std::vector<Knot> knots;  // the polyline, also of a closed seam from its start to its end
    Index part_count() const { return static_cast<Index>(stops.size()) - 1; }
};

// Lengths along a closed seam may go on behind its end, or before its start; others end.
Eigen::Vector3d position_on(const Seam& seam, double at);

struct SeamUse {
    Index seam, part;  // part of all
    bool forward;
    double before;  // length along the side of the layout up to it
};

struct Seams {
    std::vector<Index> nodes;  // vertices of the whole surface that are to be vertices of the mesh
    std::vector<Eigen::Vector3d> node_positions;
    std::vector<Seam> seams;
    std::vector<SeamPart> parts;
    std::vector<std::vector<SeamUse>> uses;  // of each side of the layout, in its sense; none inside the surface
};

// origins: of each vertex of the surface that the field was made for, the one of the whole surface. Throws InvalidInput
// (kind "bad_option") where they do not fit the surface.
Seams find_seams(const QuadLayout& layout, const std::vector<Index>& origins);

// The same of a surface whose parts have layouts of their own: sides and vertices are counted on from part to part.
struct LayoutPart {
    const QuadLayout* layout;
    const std::vector<Index>* origins;
};
Seams find_seams(const std::vector<LayoutPart>& parts);

}  // namespace octafield::surface::detail
