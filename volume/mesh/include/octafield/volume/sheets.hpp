// A surface that is not manifold, such as boundary and interfaces of a tet mesh, cut open into sheets that are.
#pragma once

#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::volume {

// A surface cut open along all edges that do not have exactly two triangles. The sheets are manifold, with rims; a
// surface that is so already stays as it is. Triangles keep their order.
struct Sheets {
    surface::TriangleMesh mesh;
    std::vector<Index> vertex_map;  // (n) the surface's vertex that each is a copy of, ascending; all but unused ones
    Edges cuts;                     // (c, 2) the surface's edges with three triangles or more, lower id first, in order
};
Sheets cut_into_sheets(const surface::TriangleMesh& surface);

// The edges of the sheets that are copies of feature edges of the surface, and the corners between them.
surface::FeatureGraph features_on_sheets(const surface::FeatureGraph& features, const Sheets& sheets);

}  // namespace octafield::volume
