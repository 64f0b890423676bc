// Boundary frames: vertex normal + cross direction, features aligned to their curves.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

enum class BoundaryMode {
    aligned,  // one axis on the normal, twist free, starting from the cross field; frames on features fixed
    fixed,    // whole frame fixed: the cross field's on smooth parts, the best fit on feature curves; corners no frame
              // fits stay free
    none,     // nothing constrained; the cross field is still the start
};

enum class VertexConstraint : std::uint8_t { free = 0, axis = 1, fixed = 2 };  // 3, 1 and 0 unknowns

struct BoundaryOptions {
    BoundaryMode mode = BoundaryMode::aligned;
    // A feature vertex keeps its whole frame when one frame fits all its normals and tangents within this angle
    // (radians); else a curve vertex keeps only its tangent, and a corner is released.
    double feature_tolerance = 20 * std::numbers::pi / 180;
};

struct BoundaryConstraints {
    std::vector<VertexConstraint> kind;  // (n) per tet-mesh vertex
    Points axis;                         // (n, 3) unit; the fixed axis where kind is axis, else 0
    Quaternions frames;  // (n, 4): the start on boundary vertices, the value where fixed; identity inside
    std::vector<std::uint8_t> on_boundary;  // (n)
    std::vector<Index> released_corners;    // tet-mesh ids of corners whose directions fit no frame
};

// One normal per boundary vertex and smooth sector (triangles round the vertex between feature edges), weighted by
// triangle area.
struct SectorNormals {
    std::vector<Index> vertex;  // boundary-mesh vertex id, ascending
    Points normal;              // (k, 3) unit
};
SectorNormals sector_normals(const surface::TriangleMesh& boundary, const surface::FeatureGraph& features);

// `directions`: (B, 3) unit tangent cross directions at the boundary's vertices (surface::vertex_directions).
BoundaryConstraints boundary_constraints(Index vertex_count, const BoundarySurface& boundary,
                                         const surface::FeatureGraph& features, const Points& directions,
                                         const BoundaryOptions& options = {});

// Angle (radians) between each sector normal and the nearest axis of the vertex's frame, in the order of
// sector_normals.
Eigen::VectorXd alignment_angles(const BoundarySurface& boundary, const surface::FeatureGraph& features,
                                 const Quaternions& frames);

}  // namespace octafield::volume
