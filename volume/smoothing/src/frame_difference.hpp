// Differences of two frames: what stands for a_j - a_i when a field is smoothed in a metric instead of an embedding.
//
// All are vectors in world axes, radians, that agree with the rotation vector from p to q to first order in it,
// whatever representatives p and q are. Derivatives are by world rotation vectors of p and of q. The su2 ones have a
// fourth component, first, for what part of (du, dv) changes the norm of the quaternion.
#pragma once

#include <concepts>
#include <vector>

#include "octafield/frames/su2_surface.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {

template <int Dimension>
struct Difference {
    Eigen::Matrix<double, Dimension, 1> value;
    Eigen::Matrix<double, Dimension, 3> by_first, by_second;  // set only if asked for
};

// Laws (tests/volume/difference_laws.hpp):
// - made(options): the scheme with what it takes of the options;
// - at(q, derivatives): what is computed once per site, for all its pairs;
// - difference(pair, p, q, derivatives): of the pair of that number; the rotation vector from p to q to first order in
//   it (its norm, where it has more than three components), whichever quaternions stand for the frames.
template <class Scheme>
concept DifferenceScheme = requires(const Scheme& scheme, const SmoothOptions& options, const frames::Quaternion& q,
                                    const typename Scheme::Vertex& vertex) {
    { Scheme::dimension } -> std::convertible_to<int>;
    { Scheme::made(options) } -> std::same_as<Scheme>;
    { Scheme::at(q, true) } -> std::same_as<typename Scheme::Vertex>;
    { scheme.difference(std::size_t{0}, vertex, vertex, true) } -> std::same_as<Difference<Scheme::dimension>>;
};

// log(q (p o)^-1), o the matching.
struct GeodesicScheme {
    static constexpr int dimension = 3;
    static GeodesicScheme made(const SmoothOptions&) { return {}; }
    using Vertex = frames::Quaternion;
    static Vertex at(const frames::Quaternion& q, bool) { return q; }
    Difference<3> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const;
};

// The same of quaternions that are read from the invariants of p and q.
struct Su2GeodesicScheme {
    static constexpr int dimension = 3;
    static Su2GeodesicScheme made(const SmoothOptions&) { return {}; }
    using Vertex = frames::Quaternion;
    static Vertex at(const frames::Quaternion& q, bool);
    Difference<3> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const {
        return GeodesicScheme{}.difference(pair, p, q, derivatives);
    }
};

struct SurfaceUnknowns;

// Rotation vector of the shortest geodesic on the model surface of su2, from points of it alone
// (frames/su2_surface.hpp); where that finds none, between frames far apart, that of Su2GeodesicScheme, which is the
// same vector.
struct SurfaceScheme {
    static constexpr int dimension = 3;
    static SurfaceScheme made(const SmoothOptions&) { return {}; }
    using Unknowns = SurfaceUnknowns;  // points h instead of quaternions
    using Vertex = frames::su2_surface::Point;
    static Vertex at(const frames::Quaternion& q, bool) { return frames::su2_surface::point(frames::Su2::embed(q)); }
    static Vertex at(const frames::Su2::Vector& h, bool) { return frames::su2_surface::point(h); }
    Difference<3> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const;
};

// A frame with its invariants and their derivative by its world rotation vector.
struct Su2Vertex {
    frames::Quaternion q;
    frames::Complex3 h;
    Eigen::Matrix<frames::Complex, 3, 3> dh;
};
Su2Vertex su2_vertex(const frames::Quaternion& q, bool derivatives);

// 2 J^+(m) (h(q) - h(p)) m^-1, m half-way between p o and q; blended into the geodesic one over angles from limit / 2
// to limit.
struct MidpointScheme {
    static constexpr int dimension = 4;
    static MidpointScheme made(const SmoothOptions& options) { return {options.midpoint_limit}; }
    using Vertex = Su2Vertex;
    double limit;  // radians
    static Vertex at(const frames::Quaternion& q, bool derivatives) { return su2_vertex(q, derivatives); }
    Difference<4> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const;
};

// Over sqrt(2), 2 J^+(m) (h(q) - h(p)) m^-1 for m = p o and for m = q.
struct SymmetricScheme {
    static constexpr int dimension = 8;
    static SymmetricScheme made(const SmoothOptions&) { return {}; }
    using Vertex = Su2Vertex;
    static Vertex at(const frames::Quaternion& q, bool derivatives) { return su2_vertex(q, derivatives); }
    Difference<8> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const;
};

// As MidpointScheme without a limit, at midpoints of another field that do not move with p and q.
struct FrozenScheme {
    static constexpr int dimension = 4;
    static FrozenScheme made(const SmoothOptions&) { return {}; }
    using Vertex = Su2Vertex;
    using Metric = Eigen::Matrix<double, 4, 6>;  // takes (re, im of h0, h1, h2) to the difference
    std::vector<Metric> metrics;                 // per pair
    static Vertex at(const frames::Quaternion& q, bool derivatives) { return su2_vertex(q, derivatives); }
    static Metric metric(const frames::Quaternion& p, const frames::Quaternion& q);
    Difference<4> difference(std::size_t pair, const Vertex& p, const Vertex& q, bool derivatives) const;
};

}  // namespace octafield::volume
