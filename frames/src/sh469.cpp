#include "octafield/frames/sh469.hpp"

#include <array>
#include <cmath>

#include "harmonics_rotation.hpp"
#include "nearest_frame.hpp"

namespace octafield::frames {
namespace {

using H4 = Harmonics<4>;
using H6 = Harmonics<6>;
using H9 = Harmonics<9>;
using Vector = Sh469::Vector;

auto band4(auto& v) { return v.template topRows<H4::size>(); }
auto band6(auto& v) { return v.template middleRows<H6::size>(H4::size); }
auto band9(auto& v) { return v.template bottomRows<H9::size>(); }

void require_weights(const BandWeights& weights) {
    double sum = 0;
    for (const double w : weights) {
        if (!(w >= 0) || !std::isfinite(w))
            throw InvalidInput("band weight " + std::to_string(w) + " is negative or not finite",
                               "option_out_of_range");
        sum += w;
    }
    if (sum == 0) throw InvalidInput("all band weights are zero; give at least one", "option_out_of_range");
}

// Multiplies the bands by the square roots of the weights.
template <class V>
V scaled(V v, const BandWeights& weights) {
    band4(v) *= std::sqrt(weights[0]);
    band6(v) *= std::sqrt(weights[1]);
    band9(v) *= std::sqrt(weights[2]);
    return v;
}

Vector embed_unit(const Quaternion& q) {
    const EulerTurns turns(q);
    Vector e;
    e << rotate_harmonics<4>(turns, H4::octahedral()), rotate_harmonics<6>(turns, H6::octahedral()),
        rotate_harmonics<9>(turns, H9::octahedral());
    return e;
}

// Column k: the generator about the k-th axis applied to v.
Sh469::Differential derivatives(const Vector& v) {
    Sh469::Differential d;
    d << H4::derivatives(band4(v)), H6::derivatives(band6(v)), H9::derivatives(band9(v));
    return d;
}

// exp(w) e = e + w_i G_i e + 1/2 w_i w_j G_i G_j e, G skew: v . G_i G_j e = -(G_i v) . (G_j e).
Matrix3 second_derivatives(const Vector& e, const Vector& v) {
    const Matrix3 products = derivatives(v).transpose() * derivatives(e);
    return -(products + products.transpose()) / 2;
}

}  // namespace

Sh469::Vector Sh469::embed(const Quaternion& q, const BandWeights& weights) {
    require_unit(q);
    require_weights(weights);
    return scaled(embed_unit(q), weights);
}

Sh469::Differential Sh469::differential(const Quaternion& q, const BandWeights& weights) {
    return derivatives(embed(q, weights));
}

Matrix3 Sh469::hessian(const Quaternion& q, const Vector& v, const BandWeights& weights) {
    require_finite(v, "the vector paired with the Hessian");
    return second_derivatives(embed(q, weights), v);
}

Sh469::Vector Sh469::rotate(const Quaternion& g, const Vector& v) {
    require_unit(g);
    require_finite(v, "the vector to rotate");
    const EulerTurns turns(g);
    Vector rotated;
    rotated << rotate_harmonics<4>(turns, band4(v)), rotate_harmonics<6>(turns, band6(v)),
        rotate_harmonics<9>(turns, band9(v));
    return rotated;
}

// Embedded frames all have the same norm, so the nearest one to v has the largest product with v, and weights may go to
// v: the search is always among frames of unit weights, and the size of v does not matter.
Projection Sh469::project(const Vector& v, const Quaternion* guess, const BandWeights& weights) {
    require_finite(v, "the vector to project");
    require_weights(weights);
    if (guess) require_unit(*guess);
    Vector target = scaled(v, weights).stableNormalized();
    if (!target.allFinite()) target.setZero();
    static const auto table = embedded_cover(embed_unit);
    const NearestFrameProblem problem{
        [](const Quaternion& q) { return embed_unit(q); },
        [](const Quaternion& q) { return derivatives(embed_unit(q)); },
        [](const Quaternion& q, const Vector& r) { return second_derivatives(embed_unit(q), r); }, table};
    const Quaternion frame = problem.solve(target, guess).frame;
    return {frame, (v - embed(frame, weights)).stableNorm()};
}

}  // namespace octafield::frames
