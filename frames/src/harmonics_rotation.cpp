#include "harmonics_rotation.hpp"

#include <cmath>

#include "harmonics_values.hpp"
#include "sphere_quadrature.hpp"

namespace octafield::frames {
namespace {

EulerTurns::Multiples multiples(double cosine, double sine) {
    EulerTurns::Multiples m;
    m.cosine[0] = 1, m.sine[0] = 0;
    for (int k = 1; k <= EulerTurns::most; ++k) {
        m.cosine[k] = m.cosine[k - 1] * cosine - m.sine[k - 1] * sine;
        m.sine[k] = m.cosine[k - 1] * sine + m.sine[k - 1] * cosine;
    }
    return m;
}

// The 2 l + 1 coefficients sorted by parity: even orders cos, even sin, odd cos, odd sin, |m| rising in each. A turn
// about z then mixes neighbours in rank of two classes, and the exchange of y and z maps whole classes to classes.
template <int degree>
struct Parities {
    static constexpr int even = degree / 2, odd = (degree + 1) / 2;  // how many orders m > 0
    static constexpr int even_cos = 0, even_sin = even + 1, odd_cos = even_sin + even, odd_sin = odd_cos + odd;
    static constexpr int size = 2 * degree + 1;

    static constexpr std::array<int, size> order = [] {
        std::array<int, size> m{};
        for (int k = 0; k <= even; ++k) m[even_cos + k] = 2 * k;
        for (int k = 1; k <= even; ++k) m[even_sin + k - 1] = -2 * k;
        for (int k = 0; k < odd; ++k) m[odd_cos + k] = 2 * k + 1, m[odd_sin + k] = -2 * k - 1;
        return m;
    }();

    // The class that the exchange of y and z maps to the one named: y- and z-parity change places.
    static constexpr bool is_even = degree % 2 == 0;
    static constexpr int to_even_cos = is_even ? even_cos : odd_sin, to_even_sin = is_even ? odd_cos : even_sin;
    static constexpr int to_odd_cos = is_even ? even_sin : odd_cos, to_odd_sin = is_even ? odd_sin : even_cos;
};

template <int degree>
using Sorted = typename Harmonics<degree>::Vector;  // coefficients in the order of Parities

// (J f)(x, y, z) = f(x, z, y): symmetric, its own inverse, one square block per parity class.
template <int degree>
struct Exchange {
    using P = Parities<degree>;
    Eigen::Matrix<double, P::even + 1, P::even + 1> even_cos;
    Eigen::Matrix<double, P::even, P::even> even_sin;
    Eigen::Matrix<double, P::odd, P::odd> odd_cos, odd_sin;

    Exchange() {
        using Accumulator = Eigen::Matrix<long double, P::size, P::size>;
        const HarmonicsValues<degree, long double> values;
        Accumulator sum = Accumulator::Zero();
        for (const SphereNode& node : sphere_quadrature(degree + 1)) {
            const auto left = values(node.x, node.y, node.z), right = values(node.x, node.z, node.y);
            for (int i = 0; i < P::size; ++i)
                for (int j = 0; j < P::size; ++j)
                    sum(i, j) += node.weight * left[degree + P::order[i]] * right[degree + P::order[j]];
        }
        const Eigen::Matrix<double, P::size, P::size> j = sum.template cast<double>();
        even_cos = j.template block<P::even + 1, P::even + 1>(P::even_cos, P::to_even_cos);
        even_sin = j.template block<P::even, P::even>(P::even_sin, P::to_even_sin);
        odd_cos = j.template block<P::odd, P::odd>(P::odd_cos, P::to_odd_cos);
        odd_sin = j.template block<P::odd, P::odd>(P::odd_sin, P::to_odd_sin);
    }

    Sorted<degree> operator()(const Sorted<degree>& c) const {
        Sorted<degree> out;
        out.template segment<P::even + 1>(P::even_cos).noalias() =
            even_cos.lazyProduct(c.template segment<P::even + 1>(P::to_even_cos));
        out.template segment<P::even>(P::even_sin).noalias() =
            even_sin.lazyProduct(c.template segment<P::even>(P::to_even_sin));
        out.template segment<P::odd>(P::odd_cos).noalias() =
            odd_cos.lazyProduct(c.template segment<P::odd>(P::to_odd_cos));
        out.template segment<P::odd>(P::odd_sin).noalias() =
            odd_sin.lazyProduct(c.template segment<P::odd>(P::to_odd_sin));
        return out;
    }
};

// Turn about z by `sign` times the angle.
template <int degree>
void turn(Sorted<degree>& c, const EulerTurns::Multiples& angle, double sign) {
    using P = Parities<degree>;
    const auto mix = [&](double& cos_part, double& sin_part, int m) {
        const double before = cos_part, s = sign * angle.sine[m];
        cos_part = angle.cosine[m] * before - s * sin_part;
        sin_part = s * before + angle.cosine[m] * sin_part;
    };
    for (int k = 0; k < P::even; ++k) mix(c[P::even_cos + 1 + k], c[P::even_sin + k], 2 * k + 2);
    for (int k = 0; k < P::odd; ++k) mix(c[P::odd_cos + k], c[P::odd_sin + k], 2 * k + 1);
}

}  // namespace

// With A = w + iz = cos(beta/2) e^{i(alpha+gamma)/2} and B = y - ix = sin(beta/2) e^{i(alpha-gamma)/2}:
// e^{i alpha} ~ A B, e^{i gamma} ~ A conj(B). Near beta = 0 or pi an error of B (or A) turns alpha and gamma against
// each other, which moves the rotation by no more than that error.
EulerTurns::EulerTurns(const Quaternion& g) {
    const double a2 = g.w() * g.w() + g.z() * g.z(), b2 = g.x() * g.x() + g.y() * g.y();
    const double product = std::sqrt(a2) * std::sqrt(b2), squared_norm = a2 + b2;
    beta = multiples((a2 - b2) / squared_norm, 2 * product / squared_norm);
    constexpr double underflow = 1e-140;
    if (product > underflow) {
        alpha = multiples((g.w() * g.y() + g.z() * g.x()) / product, (g.z() * g.y() - g.w() * g.x()) / product);
        gamma = multiples((g.w() * g.y() - g.z() * g.x()) / product, (g.z() * g.y() + g.w() * g.x()) / product);
    } else {
        const double re = a2 > b2 ? g.w() : g.y(), im = a2 > b2 ? g.z() : -g.x();  // the larger of A and B
        alpha = multiples((re * re - im * im) / squared_norm, 2 * re * im / squared_norm);
        gamma = multiples(1, 0);
    }
}

// Pinchon and Hoggan 2007: D = Z(alpha) J Z(-beta) J Z(gamma), J Z(-beta) J being the turn by beta about y.
template <int degree>
typename Harmonics<degree>::Vector rotate_harmonics(const EulerTurns& turns,
                                                    const typename Harmonics<degree>::Vector& c) {
    static const Exchange<degree> exchange;
    constexpr auto& order = Parities<degree>::order;
    Sorted<degree> sorted;
    for (int i = 0; i < sorted.size(); ++i) sorted[i] = c[degree + order[i]];
    turn<degree>(sorted, turns.gamma, 1);
    sorted = exchange(sorted);
    turn<degree>(sorted, turns.beta, -1);
    sorted = exchange(sorted);
    turn<degree>(sorted, turns.alpha, 1);
    typename Harmonics<degree>::Vector out;
    for (int i = 0; i < sorted.size(); ++i) out[degree + order[i]] = sorted[i];
    return out;
}

template Harmonics<2>::Vector rotate_harmonics<2>(const EulerTurns&, const Harmonics<2>::Vector&);
template Harmonics<4>::Vector rotate_harmonics<4>(const EulerTurns&, const Harmonics<4>::Vector&);
template Harmonics<6>::Vector rotate_harmonics<6>(const EulerTurns&, const Harmonics<6>::Vector&);
template Harmonics<8>::Vector rotate_harmonics<8>(const EulerTurns&, const Harmonics<8>::Vector&);
template Harmonics<9>::Vector rotate_harmonics<9>(const EulerTurns&, const Harmonics<9>::Vector&);

}  // namespace octafield::frames
