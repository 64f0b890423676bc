// Tets between a closed surface and what lies in it: TetGen asked in several ways, its answers checked.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/progress.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// What is to be filled. Triangles are outward; those with tets on both sides may be either way round.
struct Cavity {
    surface::TriangleMesh mesh;
    std::vector<std::uint8_t> two_sided;  // per triangle: between regions, filled on both sides
    std::vector<Eigen::Vector3d> holes;   // points in parts not to be filled: none is needed, each saves time
    Points inside{0, 3};                  // vertices to be, where they fit
    bool refine = true;                   // more vertices where tets with those are large or poor
    double edge_length = 0;               // the longest of the tets, in the mesh's unit
};

// All tets on the inner side of the triangles, none elsewhere: parts that TetGen fills on their outer side (cavities of
// the domain) are taken out. Positive, the surface's vertices first with the same bits, then those inside that tets
// have. Throws GeometryError (kind "tetgen_failed"; elements: vertices of the triangles on tets without volume that
// TetGen left, if any), Cancelled, SolverError ("tetgen_time": it took far longer than such a surface should).
TetMesh fill_cavity(const Cavity& cavity, const Progress& progress);

// The tets on the inner side; empty where the mesh has not all triangles of the surface as its own, each with tets on
// its inner side (both, if two-sided). Private to fill_cavity but for tests.
std::vector<Index> tets_inside(const TetMesh& mesh, const surface::TriangleMesh& surface,
                               const std::vector<std::uint8_t>& two_sided);

}  // namespace octafield::volume
