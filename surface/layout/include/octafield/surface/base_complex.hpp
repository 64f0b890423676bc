// The coarsest block structure of a quad mesh: its base complex.
#pragma once

#include "octafield/surface/quad_mesh.hpp"

namespace octafield::surface {

// Blocks are cut out by the lines that go straight over the quads from irregular vertices: those inside with other than
// four quads, those of the boundary with other than two. Every block is a grid of quads, without T-joints.
struct BaseComplex {
    std::vector<Index> blocks;          // (Q) of each quad, by lowest quad
    Rows<Index, 2> block_sizes{0, 2};   // (B) quads along the first and second direction, from the block's lowest quad
    Rows<Index, 2> block_chords{0, 2};  // (B) chord across each of them: of sides opposite to one another in blocks
    std::vector<int> chord_counts;      // quads across each chord
    std::vector<Index> irregular;       // vertices, ascending
    Index cut_vertices = 0;             // regular ones from which lines were added, where blocks were no disks
};

// Near linear in quads. Throws InvalidInput (kind "not_quads" where there are triangles); GeometryError: kinds
// "index_out_of_range", "non_manifold_edge" (elements: the edge's vertices), "bad_blocks" (elements: a quad).
BaseComplex base_complex(const QuadMesh& mesh);

// A bound from below of the blocks without T-joints that there are for the irregular vertices of the mesh. Every block
// has four corners, and every quad at an irregular vertex, and at a place where lines cross, is in a corner of a block:
// so a quarter of these, rounded up, and one at least, for each connected part. How often lines cross at least follows
// from the faces (of each quad; none: one face), which must be those of the layout too, with their corners and
// irregular vertices: docs/quad_layouts.md. Throws as base_complex, but for blocks, and InvalidInput (kind
// "bad_option").
Index fewest_blocks(const QuadMesh& mesh, const std::vector<Index>& faces = {});

}  // namespace octafield::surface
