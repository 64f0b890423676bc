// Quad layouts: a surface cut by separatrices of an imposed field into patches, most of them with four corners.
#pragma once

#include <memory>

#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface {

namespace detail {
struct LayoutPieces;
}

enum class LayoutVertexKind {
    singular,  // point inside, of index other than 0
    corner,    // vertex of the boundary, with other than 2 quads
    crossing,  // of two curves
    boundary,  // where a curve ends at the boundary
    t_joint,   // where a curve ends at another one (motorcycle graphs only)
};

struct LayoutVertex {
    LayoutVertexKind kind;
    Index vertex;          // of the field's domain, -1: none
    int index_times_four;  // t
    Eigen::Vector3d position;
};

// Part of a curve or of the boundary between two vertices of the layout.
struct LayoutSide {
    Index first, last;  // vertices of the layout; -1: a closed curve of the boundary that no curve meets
    Index curve;        // place in LayoutCurves::curves; -1: part of the boundary, which has the surface on its left
    Index chord;        // of sides that get the same number of quads: opposite to one another in patches
    Points points;      // (n, 3) the polyline on the surface
    Eigen::VectorXd parameters;  // (n) length up to each point in quad coordinates, from 0
    double length() const { return parameters[parameters.size() - 1]; }
};

enum class PatchKind {
    quad,     // a disk with four corners
    polygon,  // a disk with another number of corners
    annulus,  // two boundary curves, genus 0
    other,
};

struct DirectedSide {
    Index side;
    bool reversed;
};

struct LayoutPatch {
    PatchKind kind;
    int euler_characteristic;  // 1 for a disk, 0 for an annulus
    int corners;
    std::vector<std::vector<DirectedSide>> loops;  // its boundary curves, the patch on their left
    std::vector<Index> corner_sides;  // of each loop in turn, places of the sides that start at a corner of the patch;
                                      // the others start at a T-joint
};

struct LayoutChord {
    std::vector<Index> sides;  // ascending
    double length;             // mean of the sides, in parameters
};

struct QuadLayout {
    std::vector<LayoutVertex> vertices;
    std::vector<LayoutSide> sides;
    std::vector<LayoutPatch> patches;
    std::vector<LayoutChord> chords;
    LayoutCurves curves;
    double largest_mismatch = 0;                         // of opposite sides' lengths in a quad patch, over their mean
    SurfaceDomain domain;                                // of the curves
    std::shared_ptr<const detail::LayoutPieces> pieces;  // the surface cut into polygons
};

// V - E + (the sum of the patches' Euler characteristics) is that of the surface; checked. Patches that are no quads
// are reported by their kind; layout_quads refuses them. Throws as layout_curves, and GeometryError (kind
// "bad_subdivision").
//
// A closed curve of the boundary that no separatrix meets bounds an annulus; it is cut by a curve at right angles from
// its lowest vertex, unless cut_annuli is false.
QuadLayout quad_layout(const ImposedField& field, const LayoutCurveOptions& options = {}, bool cut_annuli = true,
                       const Progress& progress = {});

}  // namespace octafield::surface
