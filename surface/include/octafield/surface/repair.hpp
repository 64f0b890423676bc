// Safe repairs: only on request, and each one reported.
#pragma once

#include <string>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct RepairOptions {
    bool merge_vertices = true;  // coinciding points become one vertex (bit-equal coordinates)
    bool remove_degenerate =
        true;                 // triangles of zero area (dropped, or flipped into the neighbour), repeated triangles
    bool remove_fins = true;  // single triangles that hang on a non-manifold edge by one side, the two others free
    bool orient = true;       // consistent orientation, outward
    bool fill_holes = true;   // holes of at most max_hole_edges edges
    int max_hole_edges = 50;
};

struct RepairResult {
    TriangleMesh mesh;
    std::vector<std::string> actions;  // what was done, one sentence each; empty: nothing was needed
};

// Never moves a vertex. What cannot be repaired safely (self-intersections) is left for validation to name.
RepairResult repair(const TriangleMesh& mesh, const RepairOptions& options = {});

}  // namespace octafield::surface
