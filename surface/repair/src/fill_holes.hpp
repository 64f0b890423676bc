// Triangles for the holes of a surface.
#pragma once

#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct HoleFilling {
    std::size_t plain = 0, smooth = 0;       // holes filled: without new vertices, with
    std::size_t triangles = 0, vertices = 0;  // new ones
    std::size_t too_large = 0, largest = 0;   // holes left for their size, and the edges of the largest of all
    std::size_t unfillable = 0;               // holes left because every filling crosses the surface
};

// Fills the holes (loops of open edges, cut where they pass a vertex twice) of at most max_edges edges (0: any) with
// triangles oriented like their neighbours that cross nothing and make no edge of three triangles. smooth: patches that
// go on as the surface round them does, refined like it (Liepa 2003); but a plain rim from which the surface rises at
// more than 60 degrees to the rim's plane gets a lid in that plane. Otherwise, and where such a patch crosses
// something, without new vertices. The rim of a single triangle is no hole. New vertices and triangles come last.
HoleFilling fill_holes(TriangleMesh& mesh, int max_edges, bool smooth);

}  // namespace octafield::surface
