// Batched nearest-frame search for sh4: what the vector code of sh4_search.ipp offers, once per instruction set.
//
// With T the fully symmetric trace-free tensor of the quartic v . axis(x) and r_1, r_2, r_3 the axes of q,
// F(q) = v . embed(q) = T(r_1,r_1,r_1,r_1) + T(r_2,r_2,r_2,r_2) + T(r_3,r_3,r_3,r_3).
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace octafield::frames::sh4 {

// Independent components T_ijkl, in this order: xxxx xxyy yyyy xxxy xyyy xxyz yyyz xxzx yyzx; then those that the
// vanishing trace gives: yyzz xyzz xxzz.
constexpr int form_size = 12;
constexpr int neighbours_each = 9;  // in the cover, at most
constexpr int chunk = 32;           // inputs searched together; a multiple of every lane count

// Federer 1959, "Curvature measures", theorem 4.8: points nearer to a set than its reach have one nearest point in it,
// and p is that point if v - p is normal to the set at p. All of t v, t > 0, have the same nearest frames; with the
// best t the test reads F(q) >= sqrt(1 - reach^2) |v| at a critical point q of F. The embedded frames have reach
// sqrt(5/12), the radius of the circles that turns about an axis of the frame describe: so it is not more. That it is
// not less is an inequality between polynomials of a rotation matrix, checked numerically (sh4_projection_test.cpp),
// not derived.
constexpr double reach_squared = 5.0 / 12;
constexpr double sure_value = 0.76376261582597345;  // sqrt(7/12), rounded up

struct Tables {
    double form[form_size][9];     // form = table * v
    std::vector<double> frames;    // (n, 4) cover of SO(3)/O, wxyz, the identity first
    std::vector<double> embedded;  // (n, 9)
    std::vector<int> neighbours;   // (n, neighbours_each), filled up with the frame itself
    double margin = 0;             // the frame of the cover next to a global maximum scores best - margin or more
    int size() const { return static_cast<int>(frames.size() / 4); }
};

const Tables& tables();

struct Kernel {
    std::string_view name;
    int lanes;
    // n <= chunk rows of v (n, 9), finite; guess (n, 4) or null, not zero; frames (n, 4) unit; distances (n).
    void (*project)(const Tables& tables, const double* v, const double* guess, int n, double* frames,
                    double* distances);
    // Value, gradient (3), Hessian (11 22 33 23 31 12) of u -> F(q exp(u)) at u = 0 for n quaternions, any norm but 0.
    // q: (4, stride), expansion: (10, stride), component by component; stride a multiple of 8, at least n.
    void (*expand)(const double* form, const double* q, std::int64_t n, std::int64_t stride, double* expansion);
    // Local ascent from one quaternion, replaced by the unit quaternion reached.
    void (*climb)(const double* form, double* q);
};

// Form of v / |v|; returns |v|, which may be 0.
double unit_form(const double* v, double (&form)[form_size]);

// Those this processor runs, the widest first. All give the same bits.
const std::vector<Kernel>& kernels();

}  // namespace octafield::frames::sh4
