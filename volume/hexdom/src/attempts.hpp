// From hexahedra of the lattice to a mesh whose faces match: what is done again, and what is left out, where a step
// fails.
#pragma once

#include <vector>

#include "filling.hpp"
#include "octafield/volume/hex_dominant.hpp"

namespace octafield::volume {

struct FilledCells {
    CellsOnSurface cells;
    MixedMesh mesh;  // hexahedra and tets, as of filling.hpp
};

// Where no tets can be had, hexahedra are left out: a few times those at vertices of tets without volume, then all next
// to tets, layer by layer, at last all. Throws as filled() does.
MixedMesh filled_by_layers(CellsOnSurface& cells, const Progress& progress);

// Where the surface through the points crosses itself, the old surface's vertices near stay, farther and farther round,
// at last all. Throws as filled() does when none of this helps.
FilledCells filled_cells(const TetDomain& domain, const LatticeCells& lattice, const EdgeLengths& lengths,
                         const Progress& progress);

// Tets joined, and pyramids where quads meet triangles: all faces match, all cells are proven positive, features are
// edges. Where a hexahedron cannot be kept it is left out of `filled` and that filled anew; where tets that were joined
// are in the way they are not joined again; where this does not help, no tets are; then no hexahedron stays. Throws
// GeometryError.
MixedMesh conforming(FilledCells& filled, const HexDominantOptions& options, HexDominantCounts& counts,
                     const Progress& progress);

// Hexahedra and wedges that are not proven positive: filled about a point inside, where that gives positive cells.
// Throws GeometryError (kind "unproven_cell"; elements: vertices of those cells) where some are left after a few
// rounds.
MixedMesh without_unproven(MixedMesh mesh, int threads);

// Vertices moved; where that mesh is not valid and proven positive, or the volume of a region is farther from the
// domain's by more than 0.5 %, with vertices of the surface held; where that one is not either, the mesh as it was.
// regions: per cell, or none.
MixedMesh improved(const MixedMesh& mesh, const TetDomain& domain, const std::vector<std::uint8_t>& support,
                   const std::vector<Index>& regions, double edge_length, int threads);

}  // namespace octafield::volume
