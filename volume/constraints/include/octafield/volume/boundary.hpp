// Boundary frames: vertex normal + cross direction, features aligned to their curves.
#pragma once

#include <cstdint>
#include <numbers>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/surface/triangle_mesh.hpp"
#include "octafield/volume/constraint_kinds.hpp"
#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume {

enum class BoundaryMode {
    aligned,  // one axis on the normal, twist free, starting from the cross field; frames on features fixed
    fixed,    // whole frame fixed: the cross field's on smooth parts, the best fit on feature curves; corners no frame
              // fits stay free
    none,     // nothing constrained; the cross field is still the start
};

struct BoundaryOptions {
    BoundaryMode mode = BoundaryMode::aligned;
    // A feature vertex keeps its whole frame when one frame fits all its normals and tangents within this angle
    // (radians); else a curve vertex keeps only its tangent, and a corner is released.
    double feature_tolerance = 20 * std::numbers::pi / 180;
};

struct BoundaryConstraints {
    std::vector<VertexConstraint> kind;     // (n) per site: tet-mesh vertex, or tet (tet_boundary_constraints)
    Points axis;                            // (n, 3) unit where the kind takes_axis (constraint_kinds.hpp), else 0
    Quaternions frames;                     // (n, 4): the value where the kind takes_frame, else the start on the
                                            // boundary, the identity inside
    std::vector<std::uint8_t> on_boundary;  // (n)
    std::vector<Index> released_corners;    // sites whose directions fit no frame: corners, or tets
    // (n, 3) or no rows (all 1), above 0; of odeco_lengths (smooth.hpp) alone: which column holds which axis is the
    // kind's length_columns.
    Points lengths{};

    SiteConstraint of(Index site) const { return {axis.row(site).transpose(), frames.row(site).transpose()}; }
};

// One normal per boundary vertex and smooth sector (triangles round the vertex between feature edges), weighted by
// triangle area.
struct SectorNormals {
    std::vector<Index> vertex;  // boundary-mesh vertex id, ascending
    Points normal;              // (k, 3) unit
};
SectorNormals sector_normals(const TetDomain& domain);

// `directions`: (B, 3) unit tangent cross directions at the boundary's vertices (surface::vertex_directions).
BoundaryConstraints boundary_constraints(const TetDomain& domain, const Points& directions,
                                         const BoundaryOptions& options = {});

// For frames in the tets (tet_sampling). A tet with one triangle of the surface has an axis on that triangle's normal,
// exactly. With several it has an axis on their mean normal, weighted by area, where all are within feature_tolerance
// of that; else the frame that fits the normals best, held whole, if each is within the tolerance; else nothing: such
// tets are in released_corners, and split_locking leaves none where all triangles that join the surface to itself can
// be split. Tangents of feature curves are not held, only the normals beside them. Interfaces hold the tets on both
// sides. surface: of the mesh, boundary_surface or that of region_surface; directions: (F, 3) unit tangents in its
// triangles (surface::triangle_directions). Throws InvalidInput, GeometryError.
BoundaryConstraints tet_boundary_constraints(const TetDomain& domain,
                                             const Points& directions, const BoundaryOptions& options = {});

// Angle (radians) between the normal of each triangle of the surface and the nearest axis of the frame in the tet
// behind it, then of an interface's tet ahead of it. frames: (m, 4), one per tet. Throws InvalidInput, GeometryError.
Eigen::VectorXd tet_alignment_angles(const TetDomain& domain, const Quaternions& frames);

// Angle (radians) between each sector normal and the nearest axis of the vertex's frame, in the order of
// sector_normals.
Eigen::VectorXd alignment_angles(const TetDomain& domain,
                                 const Quaternions& frames);

}  // namespace octafield::volume
