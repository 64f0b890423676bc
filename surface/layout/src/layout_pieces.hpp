// The pieces of a surface that a layout is made of.
#pragma once

#include "cut_surface.hpp"
#include "layout_points.hpp"

namespace octafield::surface::detail {

// Nodes along a side of the layout.
struct NodeChain {
    Index curve;  // -1: boundary
    std::vector<CurveNode> nodes;
    bool closed = false;  // the first node is the last one, and no vertex of the layout
};

struct LayoutPieces {
    CutSurface cut;
    Points steps{0, 3};  // (F, 3) one quad of unit size along one of the field's directions, in each triangle's middle
    std::vector<Index> vertex_nodes;    // of each vertex of the layout
    std::vector<Index> vertex_of_node;  // -1: none
    std::vector<NodeChain> chains;      // of each side
    // Of each side of a polygon that is cut: which part of which chain. -1: not cut.
    std::vector<Index> chain_of_side, part_of_side;
    std::vector<bool> forward;                       // of each side of a polygon
    std::vector<bool> turns;                         // of each corner of a polygon: whether it is a corner of the patch
    std::vector<std::vector<Index>> patch_polygons;  // ascending
    std::vector<std::vector<std::vector<Index>>> loops;  // of each patch: sides of polygons along its boundary curves,
                                                         // from a vertex of the layout, if there is one
};

// Chains of the curves, then of the boundary. Throws GeometryError (kind "bad_subdivision").
LayoutPieces layout_pieces(const ImposedField& field, const LocalField& local, const LayoutPoints& points,
                           const std::vector<LayoutCurve>& curves, const CurveEnds& ends = {});

}  // namespace octafield::surface::detail
