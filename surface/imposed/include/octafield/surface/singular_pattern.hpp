// Patterns of singular points for cross fields: which points, where, of which index; and how many quads meet at the
// corners of the boundary. Made by hand or from a computed field, edited, then imposed (imposed_field.hpp).
//
// Indices are counted in quarter turns, t: a point inside has valence 4 - t (t = 1 is valence 3, t = -1 valence 5, t =
// -4 valence 8), a point of the boundary has 2 - t quads. The sum over all points of a connected surface, boundary
// included, is 4 times its Euler characteristic.
#pragma once

#include <span>
#include <vector>

#include "octafield/surface/corner_quads.hpp"
#include "octafield/surface/surface_singularities.hpp"

namespace octafield::surface {

// In a triangle, on an edge (one weight 0) or at a vertex (one weight 1).
struct ImposedPoint {
    Index triangle = 0;
    Eigen::Vector3d weights = Eigen::Vector3d::Constant(1.0 / 3);  // barycentric, >= 0, sum 1
    int index_times_four = 0;                                      // t
};

struct SingularPattern {
    std::vector<ImposedPoint> points;  // inside; one on the boundary says that 2 - t quads meet there
    std::vector<CornerQuads> corners;  // vertices of the boundary; those not listed as default_corner_quads has them
};

// Quads by the angle phi of the surface at each vertex of the boundary: phi / (pi / 2) rounded, halves down, at least 1
// (45 degrees: 1, 135: 1, 225: 2, 315: 3). Vertices where that is not 2, by vertex. Throws GeometryError (kind
// "non_manifold_vertex", elements: vertices) where parts of the surface only touch; so do all functions here that take
// corners.
std::vector<CornerQuads> default_corner_quads(const SurfaceDomain& domain);

// The same, but some rounded to the other side where that leaves fewer singular points to be imposed inside: the sum
// of t that is left for them, 4 chi - sum (2 - quads), comes as near to 0 as it can, by the changes that cost the least
// angle. `changed` names the vertices whose quads are not the default.
struct CornerChoice {
    std::vector<CornerQuads> corners;
    std::vector<Index> changed;           // ascending
    std::vector<int> inner_index_before;  // per connected component, in the order of their lowest triangles
    std::vector<int> inner_index;         // what is left for points inside, sum of t
};
CornerChoice fewest_points_corner_quads(const SurfaceDomain& domain);

// The nearest place of the surface. Throws InvalidInput (kind "outside_surface") for a point farther from it than half
// the mean edge length, or than 1e-3 of the surface's size (shape_size) if that is more or the place is on the
// boundary. Linear in the triangles.
ImposedPoint imposed_point(const SurfaceDomain& domain, const Eigen::Vector3d& position, int index_times_four);
ImposedPoint imposed_at_vertex(const SurfaceDomain& domain, Index vertex, int index_times_four);
Eigen::Vector3d imposed_position(const SurfaceDomain& domain, const ImposedPoint& point);

// The singular points of a cross field, as found by surface_singularities; every corner that the field does not have
// has 2 quads. Throws InvalidInput for other symmetries than 4 (kind "wrong_symmetry").
SingularPattern singular_pattern(const DirectionField& field, const SurfaceSingularities& singularities);
// The same of points found by any field of symmetry 4 on the surface, which may be measured by other lengths.
SingularPattern singular_pattern(const SurfaceDomain& domain, const SurfaceSingularities& singularities);

// Edits: the pattern with points, named by their places in `points`, changed. Each keeps the sum of t, but for
// remove_singular_points. Elements of errors are places.
SingularPattern move_singular_point(const SurfaceDomain& domain, SingularPattern pattern, Index place,
                                    const Eigen::Vector3d& to);
// A valence 3 and a valence 5 point more, in this order.
SingularPattern add_singular_pair(const SurfaceDomain& domain, SingularPattern pattern,
                                  const Eigen::Vector3d& valence_3, const Eigen::Vector3d& valence_5);
SingularPattern remove_singular_points(SingularPattern pattern, std::span<const Index> places);
// One point of the summed index at `to`, last; none if the sum is 0. Throws InvalidInput (kind "bad_valence") for a sum
// of 4 or more.
SingularPattern merge_singular_points(const SurfaceDomain& domain, SingularPattern pattern,
                                      std::span<const Index> places, const Eigen::Vector3d& to);

}  // namespace octafield::surface
