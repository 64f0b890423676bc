// sh469: the completion of the su2 invariants under rotation from the left.
//
// h0, h1, h2 (su2.hpp; Beaufort, thesis, UCLouvain 2019, chapter 4) are matrix entries of the irreducible
// representations of degrees 4, 6 and 9 (Wigner 1931). Left rotations generate from them the vectors a_4, a_6, a_9: the
// unit O-invariant harmonics of these degrees turned by the frame (harmonics.hpp). The embedding is (sqrt(w_4) a_4,
// sqrt(w_6) a_6, sqrt(w_9) a_9), 9 + 13 + 19 = 41 numbers; this completion is the project's own. With the default
// weights its squared distance is the average over all world rotations g of |h(g p) - h(g q)|^2.
#pragma once

#include <string_view>

#include "octafield/frames/representation.hpp"

namespace octafield::frames {

struct Sh469 {
    static constexpr std::string_view name = "sh469";
    static constexpr int dimension = 41;
    // Integrals of |h0|^2, |h1|^2, |h2|^2 over the unit 3-sphere (normalised measure).
    static constexpr BandWeights band_weights = {8.0 / 15, 8.0 / 3003, 8.0 / 399};
    static constexpr double speed = 2.048012537132058;  // sqrt(sum_l w_l l (l + 1) / 3), default weights
    using Vector = Eigen::Matrix<double, dimension, 1>;
    using Differential = Eigen::Matrix<double, dimension, 3>;

    // Weights w_4, w_6, w_9 must be finite, not negative and not all zero; else InvalidInput is thrown.
    static Vector embed(const Quaternion& q, const BandWeights& weights = band_weights);
    static Differential differential(const Quaternion& q, const BandWeights& weights = band_weights);
    static Matrix3 hessian(const Quaternion& q, const Vector& v, const BandWeights& weights = band_weights);
    static Vector rotate(const Quaternion& g, const Vector& v);  // weights do not matter: each degree turns by itself
    static Projection project(const Vector& v, const Quaternion* guess = nullptr,
                              const BandWeights& weights = band_weights);
};

static_assert(Equivariant<Sh469>);

}  // namespace octafield::frames
