// Which axes of a combed field the surface and its feature curves hold: the boundary conditions of a parameterization.
#pragma once

#include <cstdint>
#include <vector>

#include "octafield/surface/features.hpp"
#include "octafield/volume/combing.hpp"

namespace octafield::volume {

// Axes are 1, 2, 3 for x, y, z of the combed frame of the tet named, negative for their opposites. Patches: triangles
// of the surface joined across edges that are no features and have two of its triangles, by lowest triangle.
struct AlignmentTables {
    // Per triangle of the surface.
    std::vector<Index> triangle_tet;    // (F) the tet behind it
    std::vector<Index> triangle_axis;   // (F) nearest to its normal, outward
    Eigen::VectorXd triangle_angle;     // (F) between the two, radians
    std::vector<Index> triangle_patch;  // (F)
    // Per patch, 1: one axis is normal all over. Carried by the matchings from a triangle's tet round their edge to
    // that of the next triangle, the first's axis is the second's.
    std::vector<std::uint8_t> patch_one_axis;
    // Per feature edge.
    Edges feature_edges;              // (E, 2) tet-mesh vertices a, b in the order of the features
    std::vector<Index> feature_tet;   // (E) the lowest tet at it
    std::vector<Index> feature_axis;  // (E) nearest to b - a
    Eigen::VectorXd feature_angle;    // (E) between the two, radians
};

// surface: of the mesh, boundary_surface or that of region_surface; features: its. combed: of comb(mesh, ...). Near
// linear. Throws InvalidInput, GeometryError (unsound mesh).
AlignmentTables alignment_tables(const TetDomain& domain, const CombedField& combed);

}  // namespace octafield::volume
