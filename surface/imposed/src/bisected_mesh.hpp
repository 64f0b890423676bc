// A triangle surface refined by bisection of longest edges (Rivara 1984): the shape stays, angles keep a lower bound,
// and there are no hanging vertices.
#pragma once

#include <array>
#include <vector>

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

    BisectedMesh(const SurfaceDomain& domain, std::vector<Place> places);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Vector>& positions() const { return positions_; }
    const std::vector<Place>& places() const { return places_; }  // in the triangles as they are now
    Vector position(const Place& place) const;
    Vector corner(Index t, int k) const { return positions_[triangles_[t].corners[k]]; }
    double length(Index t, int k) const { return (corner(t, (k + 1) % 3) - corner(t, k)).norm(); }
    double longest(Index t) const { return length(t, longest_side(t)); }
    int side_to(Index t, Index neighbour,
                Index from) const;  // the side of t at `neighbour` that starts at vertex `from`

    // Bisects the longest edge at the end of the path from t to ever longer edges: t itself, or something beside it
    // that has to go before.
    void bisect(Index t);

private:
    int longest_side(Index t) const;
    void split_side(Index t, int k, Index middle, Index half);
    void move_places(Index t, int k, Index half);

    std::vector<Triangle> triangles_;
    std::vector<Vector> positions_;
    std::vector<Place> places_;
};

}  // namespace octafield::surface::detail
