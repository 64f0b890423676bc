// odeco: orthogonally decomposable fourth-order tensors, frames with axis lengths (Palmer, Bommes, Solomon 2020).
//
// The polynomial sum_k lambda_k (r_k . x)^4 on the sphere, in harmonics of degrees 0, 2, 4: 1 + 5 + 9 = 15 numbers,
// order m = -l..l within each degree, scaled so that the degree-4 part of a frame with unit lengths is its sh4 vector.
// Euclidean distance in R^15 is then sqrt(525 / (64 pi)) = 1.6159 times the L2 distance of the polynomials on the
// sphere; unit lengths have sqrt(189 / 16) in degree 0 and zero in degree 2.
#pragma once

#include <string_view>

#include "octafield/frames/representation.hpp"

namespace octafield::frames {

// Axes with lengths: the polynomial sum_k lengths[k] (column k of R(frame) . x)^4.
struct OdecoFrame {
    Quaternion frame;
    Vector3 lengths;
    double distance = 0;  // from the input to embed(frame, lengths)
};

struct Odeco {
    static constexpr std::string_view name = "odeco";
    static constexpr int dimension = 15;
    static constexpr BandWeights band_weights = {1, 0, 0};
    static constexpr double speed = 2.581988897471611;  // sqrt(20/3): at unit lengths
    using Vector = Eigen::Matrix<double, dimension, 1>;
    using Differential = Eigen::Matrix<double, dimension, 3>;
    using FullDifferential = Eigen::Matrix<double, dimension, 6>;

    // As a representation of frames: all lengths 1.
    static Vector embed(const Quaternion& q);
    static Differential differential(const Quaternion& q);
    static Matrix3 hessian(const Quaternion& q, const Vector& v);
    static Vector rotate(const Quaternion& g, const Vector& v);
    static Projection project(const Vector& v, const Quaternion* guess = nullptr);  // nearest with unit lengths

    // With lengths (any real numbers).
    static Vector embed(const Quaternion& q, const Vector3& lengths);
    // Columns 0-2: under rotation from the left; 3-5: by the lengths.
    static FullDifferential differential(const Quaternion& q, const Vector3& lengths);

    // The nearest odeco tensor, lengths free: the best of Newton ascents from the joint diagonalisation of extract(),
    // the best frames of a scan, and `guess`. Not certified: 1,000 random starts found a better one
    // for none of 2,000 inputs each of odeco tensors with 1, 10 and 30 % of noise and of random tensors
    // (studies/odeco_nearest.py); for lengths over four decades they can, in the ninth digit of the distance. Axes are
    // sorted by falling length and the frame is right-handed. Zero gives zero lengths. Throws InvalidInput if v is not
    // finite.
    static OdecoFrame nearest(const Vector& v, const Quaternion* guess = nullptr);
    // Ascent from `start` alone: the local optimum next to it.
    static OdecoFrame nearest_local(const Vector& v, const Quaternion& start);
    // Axes and lengths of a tensor that is odeco up to rounding, by joint diagonalisation of its contractions: no
    // search, but not the nearest one to other tensors. Axes whose lengths are both zero are arbitrary.
    static OdecoFrame extract(const Vector& v);
};

static_assert(Equivariant<Odeco>);

}  // namespace octafield::frames
