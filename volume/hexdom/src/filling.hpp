// What is left between hexahedra and the surface, filled with tets.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "lattice_surface.hpp"
#include "octafield/progress.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Hexahedra on vertices that begin with those of a surface through their points.
struct CellsOnSurface {
    PointSurface surface;
    std::vector<std::uint8_t> interface;  // per triangle of the surface, 1: between regions
    Quads quads;                          // of vertices, faces of cells on the surface
    Points vertices;                      // the surface's first, then those of hexahedra inside
    Hexahedra hexahedra;
    Points spare;  // points of the lattice inside that no hexahedron has
    double edge_length;
    Index crossing = 0;  // hexahedra left out as their faces crossed others or the surface
};

CellsOnSurface cells_on_surface(const TetDomain& domain, const LatticeCells& cells, double edge_length);

// Leaves out what is not to be had: hexahedra with a face on the surface that the surface has not, and those the faces
// of which cross others. Then tets in the rest (TetGen): hexahedra first, their quads met by pairs of triangles. Throws
// GeometryError, Cancelled, SolverError.
MixedMesh filled(CellsOnSurface& cells, const Progress& progress);

}  // namespace octafield::volume
