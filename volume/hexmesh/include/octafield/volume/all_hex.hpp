// Hexahedra of a seamless map: whole numbers for the arcs of its blocks, a grid in each block, vertices moved.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/volume/block_complex.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Whole numbers of edges on the arcs: opposite sides of each patch have the same sum, so that blocks become grids.
struct ArcNumbers {
    std::vector<int> numbers;
    double deviation = 0;  // sum of |number - wanted| / max(wanted, 1/2)
    double bound = 0;      // that no choice is below
    std::int64_t hexahedra = 0;
};

// wanted: length of an arc times `scale`. least: the least number of each arc, 0 or more. The same result each run:
// branch and bound is stopped by `most_nodes`, never by time. Throws SolverError ("node_limit"), GeometryError
// ("no_integers").
ArcNumbers arc_numbers(const BlockComplex& blocks, double scale, const std::vector<int>& least, int most_nodes = 2000);

struct BlockHexahedra {
    MixedMesh mesh;                     // hexahedra only
    std::vector<Index> blocks;          // of each hexahedron
    std::vector<std::uint8_t> support;  // per vertex: 0 inside, 1 on the boundary, 2 on a feature, 3 a corner of these
};

// Vertices at equal distances along arcs (in parameters), at crossings of straight lines in patches, by transfinite
// interpolation in blocks (Gordon, Hall 1973), all in parameters and taken to the tets that hold them. What arcs of
// number 0 join becomes one vertex. Throws InvalidInput ("wrong_size"), GeometryError ("collapsed_cell": hexahedra
// with a vertex twice).
BlockHexahedra block_hexahedra(const SeamlessMap& map, const BlockComplex& blocks, const std::vector<int>& numbers);

struct AllHexOptions {
    Index cells = 0;         // wanted; 0: by edge_length
    double edge_length = 0;  // wanted, input unit; 0 and no cells: the mean edge of the boundary
    int most_nodes = 2000;
    Index most_hexahedra = 5000000;
    double good = 0.3;  // scaled Jacobians below are raised
    int sweeps = 40;    // of moving vertices; 0: left where the map says
    int threads = 0;
};

struct AllHexMesh {
    MixedMesh mesh;
    std::vector<Index> blocks;
    std::vector<std::uint8_t> support;
    ArcNumbers numbers;
    Index wanted = 0;    // hexahedra
    Index inverted = 0;  // with a scaled Jacobian of 0 or less, before vertices were moved
    Index block_count = 0;
    std::vector<std::string> notes;
};

// A number of hexahedra near the wanted one: of several choices of numbers the nearest that leaves none inverted.
// Vertices leave the surface by up to a tenth of an edge, so that the volume is kept where faces are chords. Features
// of the map, or where it has none edges of 40 degrees, are kept where arcs run along them; a note tells of the others.
// Progress names the phases "blocks", "numbers", "hexahedra", "improve". Throws what the steps throw, InvalidInput
// ("option_out_of_range", "too_many_cells"), SolverError ("inverted_cells": cells that no move of vertices mends).
AllHexMesh all_hex(const SeamlessMap& map, const AllHexOptions& options = {}, const Progress& progress = {});

}  // namespace octafield::volume
