// A direction field in plane coordinates of each triangle: what tracing curves needs of it.
#pragma once

#include <array>

#include "crouzeix_raviart.hpp"
#include "octafield/surface/direction_field.hpp"

namespace octafield::surface::detail {

inline double cross(Complex a, Complex b) { return (std::conj(a) * b).imag(); }
inline double dot(Complex a, Complex b) { return (std::conj(a) * b).real(); }

// Coordinates of triangle t: origin at its corner 0, real axis along its edge 0 from lower to higher vertex id,
// imaginary axis a quarter turn counter-clockwise. Side k runs from corner k to corner k + 1.
class ChartedField {
public:
    // Keeps references to mesh and field.
    ChartedField(const TriangleMesh& mesh, const DirectionField& field, const std::vector<CornerLink>& links);

    int symmetry() const { return symmetry_; }
    const TriangleMesh& mesh() const { return mesh_; }
    const EdgeTopology& topology() const { return topology_; }
    const std::array<Complex, 3>& corners(Index t) const { return charts_[t].corners; }
    Complex side(Index t, int k) const { return charts_[t].corners[(k + 1) % 3] - charts_[t].corners[k]; }
    Complex on_side(Index t, int k, double fraction) const { return charts_[t].corners[k] + fraction * side(t, k); }
    double twice_area(Index t) const { return cross(side(t, 0), side(t, 1)); }
    Complex centroid(Index t) const { return (charts_[t].corners[1] + charts_[t].corners[2]) / 3.0; }

    // F, linear; directions are the N-th roots of it.
    Complex value(Index t, Complex z) const {
        return charts_[t].constant + z.real() * charts_[t].by_x + z.imag() * charts_[t].by_y;
    }
    // Change of F along z.
    Complex slope(Index t, Complex z) const { return z.real() * charts_[t].by_x + z.imag() * charts_[t].by_y; }
    // The one of the N unit directions at z that is nearest to `heading`; that itself where F = 0.
    Complex direction(Index t, Complex z, Complex heading) const;

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
    struct Chart {
        std::array<Complex, 3> corners;
        Complex constant, by_x, by_y;
    };
    std::array<Eigen::Vector3d, 2> axes(Index t) const;

    const TriangleMesh& mesh_;
    const EdgeTopology& topology_;
    int symmetry_;
    std::vector<Chart> charts_;
};

}  // namespace octafield::surface::detail
