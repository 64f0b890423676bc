// Blocks of a seamless map: boxes in its parameters that meet in rectangles, arcs and nodes.
#pragma once

#include <array>
#include <vector>

#include "octafield/volume/seamless_map.hpp"

namespace octafield::volume {

// An arc as part of a side of a rectangle.
struct SideArc {
    Index arc;
    bool along;  // from the arc's first node to its last one
};

// A patch as one block sees it.
struct PatchPlace {
    Index block;
    int side;                      // 2 axis + (0: at the low end, 1: at the high end of the box)
    std::array<Index, 4> corners;  // vertices of the block (BlockComplex::block_vertices) at the patch's corners
};

// A rectangle between two blocks, or of one with itself, or on the boundary. Its own two parameters are those of
// places[0] across the axis of the side, in the order of a right-handed turn.
struct BlockPatch {
    std::vector<Index>
        faces;  // its triangles, as the tets of places[0] have them: 4 tet + corner opposite the triangle
    // Low second parameter, high second, low first, high first; each in ascending order of the other parameter.
    std::array<std::vector<SideArc>, 4> sides;
    std::array<Index, 4> corners;    // nodes at (low, low), (high, low), (low, high), (high, high)
    std::vector<PatchPlace> places;  // one on the boundary, else two
    Eigen::Vector2d low, high;       // of its parameters
};

struct BlockArc {
    std::vector<Index> vertices;     // from node to node
    std::vector<double> parameters;  // of these, from 0
    bool feature, boundary;          // all of its edges are features; are on the boundary
    double length() const { return parameters.back(); }
};

struct BlockComplex {
    std::vector<Index> tet_block;  // (m)
    Rows<double, 12> charts;       // (m, 12) parameters, the same throughout a block
    Rows<double, 3> low, high;     // (b, 3) corners of the blocks' boxes
    // (m, 4) A vertex of the mesh as a block sees it: one for each of its places in the block's box.
    Tets block_vertices;
    std::vector<Eigen::Vector3d> places;  // of the block vertices, in their block's chart
    std::vector<Index> nodes;             // vertices where arcs meet, and feature corners on arcs, ascending
    std::vector<BlockArc> arcs;
    std::vector<BlockPatch> patches;
    Index block_count() const { return static_cast<Index>(low.rows()); }
};

// Near linear. Throws what seamless_report throws, and GeometryError: kinds "flipped_tet", "torn_map" (elements: tets),
// "bent_wall" (tets at walls that are no part of a box's side), "not_a_box" (blocks that
// go round a singular curve, or have sides that are no rectangles).
BlockComplex block_complex(const SeamlessMap& map);

}  // namespace octafield::volume
