// Straight ways over the surface of a tet mesh.
#pragma once

#include <utility>
#include <vector>

#include "tet_walk.hpp"

namespace octafield::volume {

// Edges of the surface that nothing crosses: features, and those of other than two triangles. Ascending, lower vertex
// of surface() first.
Edges surface_curves(const TetDomain& domain);

// Geodesics over the triangles, straight across edges (Polthier, Schmies 1998), from any place of the surface: those
// from edges and vertices begin in the triangle round it that they lead into.
class SurfaceWalker {
public:
    SurfaceWalker(const TetDomain& domain, const Edges& curves);

    // A direction is followed as it is seen in the plane of the triangle where it begins; one within 41 degrees of the
    // normal is not. Curves are in the way.
    FrontStep along(const FrontPlace& from, const frames::Vector3& way) const;

    // Whether no curve is in the way, or it does not lead over the surface.
    bool free(const FrontPlace& from, const frames::Vector3& way) const;

    // The direction at the start for which the way has `axis` at its middle, where it arrived by `half`.
    frames::Vector3 corrected(const FrontStep& half, const frames::Vector3& direction,
                              const frames::Vector3& axis) const;

    FrontPlace place(Index triangle, const frames::Vector3& weights) const;
    FrontPlace at_vertex(Index vertex) const;  // of surface()
    // (F) numbers, from 0, of the parts that curves separate.
    std::vector<Index> parts() const;
    // Triangles round a place.
    std::vector<Index> round(const FrontPlace& place) const;

private:
    struct Start {
        Index triangle = -1;
        frames::Vector3 weights, direction;
    };
    Start start(const FrontPlace& from, const frames::Vector3& way) const;
    frames::Vector3 corner(Index triangle, int k) const;
    // Of the weights, along a direction in the plane, per length.
    frames::Vector3 change(Index triangle, const frames::Vector3& direction) const;
    frames::Vector3 across(Index from, int edge, Index to, int other, const frames::Vector3& direction) const;

    const TetDomain& domain_;
    const surface::TriangleMesh& mesh_;
    Points normals_;
    std::vector<Index> ahead_;                 // 3 triangle + edge: the same of the triangle across it, or -1
    std::vector<Index> first_, triangles_at_;  // triangles at each vertex
    Rows<std::int8_t, 3> tet_corner_;          // (F) corners of the tet behind
};

}  // namespace octafield::volume
