// su2: frames as points (h0, h1, h2) of the model surface of the binary octahedral group (Beaufort, thesis, UCLouvain
// 2019, chapter 4; Du Val 1964).
//
// With u = q0 + i q1, v = q2 + i q3 (in the place of the thesis's (4.25), which is invariant on the wrong side):
//   h0 = u^8 + 14 u^4 v^4 + v^8,  h1 = (u v (u^4 - v^4))^2,
//   h2 = u v (u^4 - v^4) (u^12 - 33 u^4 v^4 (u^4 + v^4) + v^12),   h2^2 = h1 (h0^3 - 108 h1^2).
// As a vector of R^6: re h0, im h0, re h1, im h1, re h2, im h2; Euclidean distance there is the thesis's C^3 distance
// (4.26). The world x axis is special: a turn by t about it multiplies h0, h1, h2 by exp(4it), exp(6it), exp(9it). No
// linear map of R^6 gives the turns about other axes: the completion is sh469.hpp.
//
// The three axes n_k of a frame appear as x_k = (u v)^2 = -(n_y + i n_z)^2 / 4 over the group: the roots of
// 16 x^3 - h0 x + h1 = 0. So h0 and h1 say where the axes project along world x, and the sign of h2 on which side.
#pragma once

#include <array>
#include <string_view>

#include "octafield/frames/binary_groups.hpp"
#include "octafield/frames/representation.hpp"

namespace octafield::frames {

struct Su2 {
    static constexpr std::string_view name = "su2";
    static constexpr int dimension = 6;
    static constexpr BandWeights band_weights = {8.0 / 15, 8.0 / 3003, 8.0 / 399};  // mean |h_i|^2 over the 3-sphere
    using Vector = Eigen::Matrix<double, dimension, 1>;
    using Differential = Eigen::Matrix<double, dimension, 3>;
    using Jacobian = Eigen::Matrix<Complex, 3, 2>;

    // Unit quaternions only (to 1e-6), else InvalidInput; for others see invariants().
    static Vector embed(const Quaternion& q);
    static Differential differential(const Quaternion& q);
    static Matrix3 hessian(const Quaternion& q, const Vector& v);
    // The nearest point of the model surface over SU(2), for any point of C^3: coarse scan of SO(3)/O, then Newton
    // (nearest_frame.hpp). Throws InvalidInput if v is not finite.
    static Projection project(const Vector& v, const Quaternion* guess = nullptr);

    static Complex3 complex(const Vector& v);
    static Vector real(const Complex3& h);

    // h0, h1, h2 at any (u, v), homogeneous of degrees 8, 12, 18.
    static Complex3 invariants(const Complex& u, const Complex& v);
    // d(h0, h1, h2) / d(u, v), complex derivatives. Of full rank except at 0: singular values between 0.3019 and 8 on
    // the unit 3-sphere.
    static Jacobian jacobian(const Complex& u, const Complex& v);
    // d^2 h_i / d(u, v)^2, one symmetric 2 x 2 matrix per invariant.
    using SecondDerivatives = std::array<Eigen::Matrix<Complex, 2, 2>, 3>;
    static SecondDerivatives second_derivatives(const Complex& u, const Complex& v);

    // h2^2 - h1 (h0^3 - 108 h1^2).
    static Complex surface_residual(const Complex3& h);

    // |(u, v)|^2 of any quaternion with these invariants, without computing one: 1 on the embedded frames. By
    // |(u, v)|^4 = 2 (|x_1| + |x_2| + |x_3|) over the roots of the cubic above, which stays accurate where roots meet;
    // equal to the thesis's (4.29, 4.30). h2 is not used: up to its sign h0 and h1 determine it.
    // Throws InvalidInput if h is not finite.
    static double squared_norm(const Complex3& h);

    // All 48 quaternions with invariants h, of common norm, 1 for embedded frames: the first one times the binary
    // octahedral group in its order. Thesis section 4 rearranged so that it has no branches: the root x of the cubic
    // largest in modulus is never double, a = u v is either of its square roots, and
    //   u^8 + v^8 = h0 - 14 x^2,  u^8 - v^8 = h2 / (a (h0 - 48 x^2)),
    // where the divisor is bounded away from zero; no root has to be matched by trial to the sign of h2. Then Newton
    // steps in (u, v). The error is a few units of rounding everywhere, at u v = 0, h1 = 0, h2 = 0 as elsewhere.
    // h must lie on the model surface: after scaling to norm 1, within `tolerance` of invariants of some (u, v), which
    // are returned; else InvalidInput with the distance and the residual. Zero has no inverse (InvalidInput).
    // The tolerance must be positive and finite, else InvalidInput.
    static std::array<Quaternion, 48> inverse(const Complex3& h, double tolerance = 1e-6);
    // The first of them, normalised: the frame.
    static Quaternion inverse_frame(const Complex3& h, double tolerance = 1e-6);
};

static_assert(Representation<Su2>);

// Frames one of whose axes is a given unit vector n (thesis section 4.2, corrected and in this convention, where the
// axes are columns and world x is special). A rotation taking e_x to n has a = u v = i (n_y + i n_z) / 2 and
// |u|^2 = (1 + n_x) / 2, |v|^2 = (1 - n_x) / 2; turning by t about n takes (u, v) to (u exp(it/2), v exp(-it/2)).
struct Su2Axis {
    explicit Su2Axis(const Vector3& n);  // unit to 1e-6, else InvalidInput

    // A quaternion of the frame turned by t about n. turn_frame(0) takes e_x to n by the shortest arc (for n = -e_x by
    // the half turn about y).
    Quaternion turn_frame(double t) const;
    // Its (h0, h1, h2): a closed curve with period pi/2.
    Complex3 turn(double t) const;

    // h0 = center0 + plus exp(4it) + minus exp(-4it), h1 = center1 + ratio (plus exp(4it) + minus exp(-4it)): two
    // similar ellipses with semi-axes | |plus| +- |minus| |, that of h1 |ratio| = (1 - n_x^2) / 4 times as large.
    // n = +-e_x: h0 runs round a circle and h1 = 0; n_x = 0: segments; else |plus| and |minus| are
    // ((1 +- n_x) / 2)^4. center0 = 14 a^4, center1 = -2 a^6, ratio = a^2.
    struct Ellipse {
        Complex center0, center1, plus, minus, ratio;
    };
    Ellipse ellipse() const;

    // a^2 h0 - h1 - 16 a^6 = 0: n or its mirror image (-n_x, n_y, n_z) is an axis. Linear in h, and all that complex
    // polynomials in h can say: the complexified curve of n holds that of the mirror image.
    Complex linear_residual(const Complex3& h) const;

    // For h on the surface over SU(2): both zero exactly if n is an axis of the frame. The first is the linear
    // residual; the second tells n from its mirror image (which is n turned half round world x, up to sign), by
    //   (p^2 - m^2) h2 = a (h0 - 48 a^4) ((p^2 + m^2) y - 2 a^8 conj(y)),  y = h0 - 14 a^4, p = |plus|, m = |minus|:
    // a polynomial in h and conj(h) with coefficients from n. It vanishes for n_x = 0, where the two are one axis.
    std::array<Complex, 2> residual(const Complex3& h) const;

private:
    double p_, m_;   // ((1 +- n_x) / 2)^4
    Complex u_, v_;  // of turn_frame(0)
    Complex a_;      // u v
};

}  // namespace octafield::frames
