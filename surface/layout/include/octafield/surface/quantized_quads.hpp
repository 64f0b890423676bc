// Block-structured quads from a T-mesh: whole numbers of quads along its arcs, chosen all at once (Campen, Bommes,
// Kobbelt, "Quantized global parametrization", 2015), so that T-joints come to lie on vertices of the mesh.
#pragma once

#include "octafield/surface/base_complex.hpp"
#include "octafield/surface/layout_quads.hpp"
#include "octafield/surface/motorcycle_graph.hpp"

namespace octafield::surface {

enum class ArcWeights {
    equal,     // of |n - length / size|
    relative,  // that over length / size, of 1 at least
};

// What is divided by the size, and by what quads are spread along sides.
enum class ArcMeasure {
    parameters,  // quad coordinates: quads are as square as the field has them, and as large as its sizes are
    lengths,     // on the surface, as the domain measures it: quads are about as large as one another
};

enum class Blocks {
    // Whole numbers for large quads, the rows of which are split: blocks stay as few, and are more oblique. Tracks that
    // would keep strips without a large quad across apart become one, if no two points and corners do.
    few,
    fine,  // whole numbers for quads of the size wanted: near to the lengths, and blocks may be as small as quads
};

// Either an edge length or a number of quads is to be given, > 0.
struct QuantizedQuadsOptions {
    double edge_length = 0;  // as in LayoutQuadsOptions
    Index quad_count = 0;    // wanted; sizes are tried until the number is near
    Blocks blocks = Blocks::few;
    // Of `few`: structures of more blocks are tried until all quads have this scaled Jacobian, as far as the angles
    // between features allow. If none has it, the fewest blocks are taken that have 0.3 (0.8 of the best one's where
    // that is below 0.3). 0: the fewest.
    double least_jacobian = 0.3;
    ArcWeights weights = ArcWeights::equal;
    ArcMeasure measure = ArcMeasure::parameters;
    // For a surface cut open (FeatureCut::origins): parts of its boundary with the same origins are one curve again,
    // and get the same vertices on both sides. None: the boundary stays open.
    std::vector<Index> origins = {};
    // Rounds in which vertices are moved where that raises the least scaled Jacobian of the quads round them, on the
    // surface, or along the boundary and seams; singular points and corners stay. 0: none.
    int smoothing = 20;
    // Singular points inside are released where quads are measured by lengths, so that these can be as wanted between
    // them, and where quads of a scaled Jacobian below 0.3 are left: for computed points.
    bool release_points = false;
    // A cross field on the layout's surface, DirectionField::values, that edges of quads are drawn to where vertices
    // are moved (measure: lengths). None: quads are as square as can be.
    Eigen::VectorXcd follow = {};
    int most_nodes = 1000;  // of branch and bound, for each connected part
};

// `patches` are the blocks of the mesh's base complex, patch_sizes and chord_counts theirs.
struct QuantizedQuads : LayoutQuads {
    Rows<Index, 2> patch_chords{0, 2};  // of each block: chord across its first and second direction
    std::vector<Index> tiles;           // patch of the T-mesh of each quad
    std::vector<int> arc_counts;        // quads along each arc (side) of the T-mesh; 0 where tracks became one
    std::vector<int> part_counts;       // quads along each part of the seams and the boundary, between all ends of arcs
                                        // on their two sides; for integer_grid_map
    Index fewest_blocks = 0;            // that meshes with these faces and irregular vertices can have (fewest_blocks)
    Index coarsest_blocks = 0;          // of `few`: the fewest that whole numbers on the T-mesh were found to make,
                                        // whatever the shapes of quads; else those of `patches`
    Index t_joints = 0;                 // of the T-mesh; the quads have none
    std::vector<Index> irregular;       // vertices inside with other than four quads, of the boundary with other than 2
    double size = 0;                    // that lengths were divided by
    double deviation = 0, bound = 0;    // sum of weights |n - length / size|; what it cannot be below. By lengths,
                                        // what is large beside the number wanted counts more
    bool optimal = false;               // the two are the same
};

// Opposite sides of each patch get equal sums, every arc 1 at least, with the least sum of deviations: by a mixed
// integer programme, stopped by the number of nodes and never by time, so that the result is always the same. Patches
// are mapped as in layout_quads, sides linear in parameters between whole numbers.
//
// On a seam, where two parts of the boundary are one again, arcs of the two sides end at different places: all of these
// cut the seam into parts, 0 quads at least, whose sums both sides' arcs are. Places without a quad between them become
// one vertex. What the mesh has to have as vertices: corners, singular points, and where other than two seams meet.
//
// Throws as layout_quads, and GeometryError (kind "no_integers", elements: sides of the layout, then parts of seams: no
// whole numbers fit, as near misses leave a strip that closes on itself, or faces that meet along features ask for
// different numbers there), SolverError (kinds "node_limit", "solver_failed").
QuantizedQuads quantized_quads(const QuadLayout& layout, const QuantizedQuadsOptions& options,
                               const Progress& progress = {});

// Where no whole numbers fit: of each side of the layout, by how much it is below the least number that it has to have
// (1, or 2 or 3 where edges of the mesh would be the same) where sums are equal and these shortages sum to the least.
// All 0 where numbers fit. Throws InvalidInput as quantized_quads.
std::vector<double> arc_shortages(const QuadLayout& layout, const std::vector<Index>& origins = {});

}  // namespace octafield::surface
