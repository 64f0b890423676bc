// Plane coordinates of each triangle of a surface, and how they pass into one another across edges.
#pragma once

#include <array>

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

inline double cross(Complex a, Complex b) { return (std::conj(a) * b).imag(); }
inline double dot(Complex a, Complex b) { return (std::conj(a) * b).real(); }

// A vector in the plane of triangle t as the domain's edge lengths measure it: coordinates in the flat triangle with
// these sides, real axis from corner 0 to corner 1.
Complex vector_by_own_lengths(const SurfaceDomain& domain, Index t, const Eigen::Vector3d& vector);

// Coordinates of triangle t: origin at its corner 0, real axis along its edge 0 from lower to higher vertex id,
// imaginary axis a quarter turn counter-clockwise. Side k runs from corner k to corner k + 1. On a surface with its own
// edge lengths the coordinates are those of the triangles with these sides, taken to space and back by affine maps.
class Charts {
public:
    explicit Charts(SurfaceDomain domain);

    const SurfaceDomain& domain() const { return domain_; }
    const TriangleMesh& mesh() const { return mesh_; }
    const EdgeTopology& topology() const { return topology_; }
    const std::array<Complex, 3>& corners(Index t) const { return corners_[t]; }
    Complex side(Index t, int k) const { return corners_[t][(k + 1) % 3] - corners_[t][k]; }
    Complex on_side(Index t, int k, double fraction) const { return corners_[t][k] + fraction * side(t, k); }
    double twice_area(Index t) const { return cross(side(t, 0), side(t, 1)); }
    Complex centroid(Index t) const { return (corners_[t][1] + corners_[t][2]) / 3.0; }

    // Where the ray from z leaves the triangle, by a side other than `skip`; side -1 if nowhere.
    struct Exit {
        int side;
        double distance;
    };
    Exit exit(Index t, Complex z, Complex direction, int skip) const;

    // The same edge seen from the other triangle; triangle -1 where the surface ends. A point at `fraction` of one side
    // is at 1 - fraction of the other.
    struct Side {
        Index triangle;
        int side;
    };
    Side across(Side from) const;
    // A direction carried over that edge.
    Complex carried(Complex direction, Side from, Side to) const;

    Eigen::Vector3d lift(Index t, Complex z) const;
    Eigen::Vector3d lift_vector(Index t, Complex z) const;
    Complex lower(Index t, const Eigen::Vector3d& position) const;
    Complex lower_vector(Index t, const Eigen::Vector3d& vector) const;

private:
    std::array<Eigen::Vector3d, 2> axes(Index t) const;

    SurfaceDomain domain_;
    const TriangleMesh& mesh_;
    const EdgeTopology& topology_;
    std::vector<std::array<Complex, 3>> corners_;
};

}  // namespace octafield::surface::detail
