// Triangles for the holes of a surface.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct HoleFilling {
    std::vector<Eigen::Matrix<Index, 3, 1>> triangles;  // new ones, oriented like their neighbours; no new vertices
    int filled = 0;
    int left = 0;  // larger than allowed, or without a triangulation that respects the existing edges
};

// Fills every boundary loop of at most max_edges edges. Nothing is filled where the mesh is no oriented manifold.
HoleFilling fill_holes(const TriangleMesh& mesh, int max_edges);

}  // namespace octafield::surface
