// Closest points on the patches and curves of a surface, for vertices that slide on it.
#pragma once

#include <Eigen/Core>
#include <memory>

#include "octafield/surface/features.hpp"

namespace octafield::volume::detail {

// Patches: the triangles between feature edges and edges of three triangles or more; curves: the feature edges between
// corners. Pieces of both kinds are found by the point they start from and not left.
class SurfaceGuide {
public:
    using Vector = Eigen::Vector3d;

    // A point of a triangle, or feature edge, of a piece.
    struct Place {
        Index piece = -1, element = -1;
        Vector point;
    };

    // Triangles without area and edges without length are left out. Throws InvalidInput: kinds "index_out_of_range",
    // "non_finite_vertex".
    SurfaceGuide(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features);
    ~SurfaceGuide();

    bool has_triangles() const;
    bool has_edges() const;
    Place nearest_on_surface(const Vector& point) const;
    Place nearest_on_curves(const Vector& point) const;
    // Of the same piece; `near` is a place of it not far away.
    Place nearest_in_patch(const Vector& point, const Place& near) const;
    Place nearest_in_curve(const Vector& point, const Place& near) const;

    // Whether a place of a curve is within `tolerance` of a corner at an end of its edge.
    bool at_corner(const Place& place, double tolerance) const;

    Vector normal(Index triangle) const;  // unit, outward
    Vector tangent(Index edge) const;     // unit

private:
    struct Trees;
    std::unique_ptr<Trees> trees_;
};

}  // namespace octafield::volume::detail
