// What is left between hexahedra and the surface, filled with tets.
#pragma once

#include <string>
#include <vector>

#include "lattice_surface.hpp"
#include "octafield/progress.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {

// Hexahedra on vertices that begin with those of a surface through their points.
struct CellsOnSurface {
    PointSurface surface;
    std::vector<std::uint8_t> two_sided;  // per triangle of the surface: between regions
    Quads quads;                          // of vertices, faces of cells on the surface
    Points vertices;                      // the surface's first, then those of hexahedra inside
    Hexahedra hexahedra;
    Points spare;                  // points of the lattice inside that no hexahedron has
    Eigen::VectorXd spare_length;  // of edges wanted there
    bool apart = false;            // of LatticeCells: with spare points tets are as small as they should be
    double edge_length;            // the longest wanted
    Index crossing = 0;            // hexahedra left out as their faces crossed others or the surface
};

// Hexahedra two points of which lie at one place of the surface are left out. stays: as in point_surface.
CellsOnSurface cells_on_surface(const TetDomain& domain, const LatticeCells& cells, const EdgeLengths& lengths,
                                const std::vector<std::uint8_t>& stays = {});

void leave_out(CellsOnSurface& cells, const std::vector<std::uint8_t>& marked);  // hexahedra

// Hexahedra, marked, with a face where tets will be.
std::vector<std::uint8_t> beside_cavity(CellsOnSurface& cells);

// Leaves out what is not to be had: hexahedra with a face on the surface that the surface has not, and those the faces
// of which cross others. Then tets in the rest: hexahedra first, their quads met by pairs of triangles. Throws
// GeometryError: "self_intersection" (elements: triangles of the domain's surface, near), "tetgen_failed" (elements:
// vertices on tets without volume that TetGen left, if any); Cancelled, SolverError.
MixedMesh filled(CellsOnSurface& cells, const Progress& progress);

}  // namespace octafield::volume
