// A non-orthogonal cross at one point: two lines of a plane, without order or sense, at angles a and b (radians, modulo
// pi). With u = exp(2 i a) and v = exp(2 i b) its invariants are the power sums
//     p1 = u + v,   p2 = u^2 + v^2,
// which all 8 ways to write the cross (order, senses) share, and which determine it: u and v are the roots of
//     x^2 - p1 x + (p1^2 - p2) / 2 = 0.
// They are, up to factors, the Fourier coefficients of <a, s>^4 + <b, s>^4 on the circle of directions s (Desobry et
// al. 2021; Dermine 2024, (3.6) to (3.8)): c2 = 4 p1 and c4 = p2, and the L2 distance of two such functions is
// (pi / 64) (|difference of c2|^2 + |difference of c4|^2) after multiplication with 8. An orthogonal cross has p1 = 0.
#pragma once

#include <complex>
#include <optional>

namespace octafield::surface {

struct TwoLines {
    double first, second;  // angles, radians
};

struct PowerSums {
    std::complex<double> p1, p2;
};

PowerSums power_sums(const TwoLines& lines);

// The two lines of power sums, whether or not these are those of unit u and v: the angles of the roots. first in [0,
// pi), second in [first, first + pi). A root that is zero beside the other gets the direction across the other one's;
// nothing where both are zero, and where the sums are not finite.
std::optional<TwoLines> lines_of(const PowerSums& sums);

// The same lines with first in [0, pi), second in [first, first + pi), first the smaller one modulo pi.
TwoLines ordered(const TwoLines& lines);

// The angle between the lines, in [0, pi / 2].
double angle_between(const TwoLines& lines);

// lambda |difference of c2|^2 + |difference of c4|^2 (Dermine 2024, (3.14), for one edge).
double squared_distance(const PowerSums& a, const PowerSums& b, double lambda);

}  // namespace octafield::surface
