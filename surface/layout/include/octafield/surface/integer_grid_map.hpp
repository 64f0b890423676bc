// The map of a whole surface to the integer grid that block-structured quads are read off (Bommes, Zimmer, Kobbelt
// 2009; from whole numbers on a T-mesh: Campen, Bommes, Kobbelt, "Quantized global parametrization", 2015).
#pragma once

#include "octafield/surface/quantized_quads.hpp"

namespace octafield::surface {

struct IntegerGridMap {
    Points positions{0, 3};               // (n, 3) input unit, on the surface
    Triangles triangles{0, 3};            // (m, 3) counter-clockwise, parts of the surface's
    Rows<double, 2> coordinates{0, 2};    // (3 m, 2): u, v of corner k of triangle t in row 3 t + k
    std::vector<Index> triangle_origins;  // (m) of the layout's surface
    std::vector<Index> singular;          // vertices inside with another number of quads than four, ascending
    // Of the map against the grid, over the triangles by their area in it: mean and largest (s + 1 / s) / 2, s the
    // ratio of its two stretches; 1 where squares stay squares.
    double mean_distortion = 0, largest_distortion = 0;
    // How far u, v on the two sides of an edge are from a turn by quarters and a shift by whole numbers.
    double largest_residual = 0;
    int steps = 0;  // of Newton's method
};

// Every triangle is mapped with its sense; over an edge u, v go on after a turn by k quarters and a shift by whole
// numbers; singular points and corners are at whole numbers, the boundary and seams on lines of them, with the same
// coordinate along a seam on its two sides. So the grid's lines are those of the quads, of which `quads` says how many
// there are on each arc; the curves of the T-mesh themselves are free to move. The energy is that of foldover-free maps
// (Garanzha, Kaporin, Kudryavtseva, Protais, Ray, Sokolov 2021), minimised by Newton's method from the maps of the
// tiles.
//
// quads: of this layout; origins: as they were made with. Throws InvalidInput (kind "bad_option"); SolverError (kind
// "folded_map", elements: triangles of the layout's surface): no map without folds was found, as whole numbers are too
// far from the lengths, or the triangles too large; Cancelled.
IntegerGridMap integer_grid_map(const QuadLayout& layout, const QuantizedQuads& quads,
                                const std::vector<Index>& origins = {}, const Progress& progress = {});

}  // namespace octafield::surface
