// A triangle surface with vertices put in given places, refined by bisection of longest edges (Rivara 1984): the shape
// stays, angles keep a lower bound, and there are no hanging vertices. Lengths and angles are those of the domain: in
// space, or by its own edge lengths.
#pragma once

#include <array>
#include <vector>

#include "charts.hpp"
#include "octafield/surface/singular_pattern.hpp"

namespace octafield::surface::detail {

using Vector = Eigen::Vector3d;

// A point on the surface: in the interior of a triangle, of a side (one weight exactly 0), or at a corner (one exactly
// 1).
struct Place {
    Index triangle;
    Vector weights;  // barycentric
};

// The place, put on a side or corner that is nearer than 1e-4 of the height on it.
Place snapped(Place place);

class BisectedMesh {
public:
    struct Triangle {
        std::array<Index, 3> corners;
        std::array<Index, 3> neighbours;  // across side k, from corner k to corner k + 1; -1: none
        std::array<bool, 3> is_feature;   // side k, in the domain's features
        Index origin;                     // triangle of the input
        std::array<Vector, 3> weights;    // of corner k, barycentric in the origin
    };

    // Throws InvalidInput (kind "coincident_points", elements: places) where two are at the same vertex.
    BisectedMesh(const SurfaceDomain& domain, std::vector<Place> places);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Vector>& positions() const { return positions_; }     // vertices of the input first
    const std::vector<Index>& centres() const { return centres_; }          // the vertex at each place
    Index triangle_at(Index vertex) const { return triangle_at_[vertex]; }  // one of those there
    bool at_centre(Index t) const;                                          // whether one is a corner of t
    // Corners k, k + 1 and k + 2 of t: in space, or in the plane of t's origin where the domain has its own lengths.
    std::array<Vector, 3> corners_from(Index t, int k) const {
        return {corner(t, k), corner(t, k + 1), corner(t, k + 2)};
    }
    // The place with these weights of t's corners, likewise.
    Vector place(Index t, const Vector& weights) const {
        return weights[0] * corner(t, 0) + weights[1] * corner(t, 1) + weights[2] * corner(t, 2);
    }
    double longest(Index t) const { return length(t, longest_side(t)); }

    // Bisects longest edges until t is bisected: first those at the end of the path from t to ever longer ones. With
    // keep_spokes, triangles at a centre are bisected at the side opposite to it, however long the others are: sizes
    // beyond the star shrink against it.
    void bisect(Index t, bool keep_spokes = false);

private:
    Vector corner(Index t, int k) const;
    double length(Index t, int k) const;  // the same from both sides
    int longest_side(Index t) const;
    int bisected_side(Index t, bool keep_spokes) const;
    int side_to(Index t, Index neighbour, Index from) const;
    Index add_vertex(Index t, const Vector& weights);
    void insert(const Place& place);
    void split_inside(Index t, const Vector& weights);
    void split_edge(Index t, int k, double fraction);
    void split_side(Index t, int k, double fraction, Index vertex, Index half);

    std::vector<Triangle> triangles_;
    std::vector<std::array<Complex, 3>> shapes_;  // corners of the input's triangles in the plane; none: as in space
    std::vector<Vector> positions_;
    std::vector<Index> triangle_at_;
    std::vector<Place> waiting_;  // to be inserted, in the triangles as they are; triangle -1: done
    std::vector<Index> centres_;
    std::vector<bool> is_centre_;  // (vertices)
};

}  // namespace octafield::surface::detail
