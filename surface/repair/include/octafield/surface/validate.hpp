// Is a triangle mesh the sound, closed boundary of a volume?
#pragma once

#include <string>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

// One thing wrong with a mesh. Kinds, in the order in which they are tested and reported:
//   "empty", "index_out_of_range", "non_finite_vertex", "degenerate_triangle", "soup" (triangles share no vertices
//   although points coincide), "duplicate_vertex", "non_manifold_edge", "inconsistent_orientation", "not_closed",
//   "non_manifold_vertex", "inside_out", "self_intersection". Unused vertices are no defect.
struct Defect {
    std::string kind;
    std::string element;          // what the ids number: "triangle", "vertex" or "edge"
    std::vector<Index> elements;  // all of them; for edges the two vertex ids of each, flattened
    std::string message;          // one sentence: what, where (first few), and the remedy
};

struct ValidateOptions {
    bool closed = true;             // require no boundary edges
    bool self_intersection = true;  // the slowest test, O(n log n)
};

// All defects found. Tests that need a sound combinatorial mesh are left out while an earlier one fails.
std::vector<Defect> find_defects(const TriangleMesh& mesh, const ValidateOptions& options = {});

// Throws GeometryError with the first defect's kind, elements and message (naming the number of further kinds).
void require_valid(const TriangleMesh& mesh, const ValidateOptions& options = {});

}  // namespace octafield::surface
