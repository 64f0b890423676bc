// Schemes of one's own, given as functions on arrays of frames: nothing to compile, no derivative needed. The trust
// region minimises them (SmoothOptions::own_scheme) on the same meshes, with the same constraints, as those of
// schemes.hpp; it is slower, for they are evaluated some twenty times a step.
#pragma once

#include <functional>
#include <string>

#include "octafield/volume/sampling.hpp"

namespace octafield::volume {

using ArrayValues = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

// One of `embed` and `residual` is set. They are called by one thread at a time, with unit quaternions (k, 4) w x y z,
// any k. An exception of theirs ends the smoothing.
//
// embed: (k, d), what is minimised is 1/2 sum over components c of a_c^T L a_c (sampling.hpp). Frames that are the same
// must have the same vector.
//
// residual: (k, d) of the pairs of row r of both arrays, what is minimised is 1/2 sum over edges ij of w_ij |r_ij|^2,
// w_ij = -L_ij; where these are negative, whole tets with residuals from their first vertex, as for the metrics of
// schemes.hpp. It must vanish for the same frame, and |r_ij| = |r_ji|. Steps are those of Gauss and Newton.
//
// differential: of embed, (k, 3 d): d numbers by x, then by y, by z, of the world rotation vector w in exp(w) q, at
// w = 0. residual_differential: (k, 6 d), of residual by the first frame's vector, then by the second's. Not set:
// central differences of fourth order.
struct ArrayScheme {
    std::string name;
    Index dimension = 0;  // d
    std::function<ArrayValues(const Quaternions&)> embed, differential;
    std::function<ArrayValues(const Quaternions&, const Quaternions&)> residual, residual_differential;
};

// What is minimised, of any frames (n, 4), one per site. The same bits at any thread count. Throws InvalidInput where a
// function gives another shape or numbers that are not finite.
double array_energy(const ArrayScheme& scheme, const Sampling& sampling, const Quaternions& frames, int threads = 0);

}  // namespace octafield::volume
