// Smoothing of triangles and quads on a surface by Winslow's functional.
#pragma once

#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/features.hpp"
#include "octafield/surface/quad_mesh.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct WinslowOptions {
    int rounds = 50;          // in which each vertex is moved once, at most
    double tolerance = 1e-4;  // relative decrease of the functional in a round, at which it stops
};

struct WinslowResult {
    Points points{0, 3};
    // Means over triangles and corners of quads: 1 where all are equilateral triangles and squares.
    double before = 0, after = 0;
    int rounds = 0;
    Index moved = 0;  // vertices that are not where they were
};

// Moves vertices of `points`, corners of triangles (t, 3) and quads (q, 4), on `surface`: per vertex a Newton step in
// the parameter plane of the triangle it is on, carried on over its neighbours by walking, so that charts leave no
// seams. What becomes least is the integral of (|x_u|^2 + |x_v|^2) / J over cells, whose minimum has harmonic u, v
// (Winslow 1966; without structure: Knupp 1999; on surfaces g^ij d_i d_j x = 0, Fortunato, Persson 2016): for triangles
// the sides' squares over 4 sqrt(3) areas, for corners of quads both sides' squares over twice the area. No cell is
// turned over; cells that are, are turned back where moving vertices one by one can. Vertices of `fixed`, of the cells'
// boundary and within 1e-6 diagonals of features stay; others are put on the surface first. Throws InvalidInput (ids
// out of range, not finite, nothing to smooth on).
WinslowResult winslow_smooth(const TriangleMesh& surface, const FeatureGraph& features, const Points& points,
                             const Triangles& triangles, const Quads& quads, const std::vector<Index>& fixed = {},
                             const WinslowOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::surface
