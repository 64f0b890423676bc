// Feature curves and corners of a triangle mesh.
#pragma once

#include <numbers>
#include <vector>

#include "octafield/surface/triangle_mesh.hpp"

namespace octafield::surface {

struct FeatureGraph {
    Edges edges;                 // (n, 2) vertex ids, lower first, lexicographic order
    std::vector<Index> corners;  // ascending vertex ids where feature curves meet, end or turn sharply
};

struct FeatureOptions {
    // An edge is a feature when the normals of its two triangles differ by more than this angle (radians, in (0, pi)).
    double angle = 40 * std::numbers::pi / 180;
    // A vertex with two feature edges is a corner when the curve turns by more than this angle there (radians).
    double corner_angle = 60 * std::numbers::pi / 180;
};

// Boundary edges of an open mesh are always features.
FeatureGraph detect_features(const TriangleMesh& mesh, const FeatureOptions& options = {});

// Corners of given feature edges (from a file, say): number of incident feature edges other than 2, or a turn.
FeatureGraph feature_graph(const TriangleMesh& mesh, const Edges& edges,
                           double corner_angle = FeatureOptions{}.corner_angle);

// The same features in the order that FeatureGraph promises, each once. Throws InvalidInput whose elements are the places
// of edges, or corners, that the mesh does not have: kinds "index_out_of_range", "not_an_edge".
FeatureGraph ordered_features(FeatureGraph features, const TriangleMesh& mesh);

}  // namespace octafield::surface
