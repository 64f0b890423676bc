#include "local_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double quarter = std::numbers::pi / 2;
constexpr double inside = 1e-9;  // least fraction of a side
constexpr double never = std::numeric_limits<double>::infinity();

double nearest(double angle, double period) { return period * std::round(angle / period); }

// -log(1 - y) / y.
Complex log_quotient(Complex y) {
    if (std::norm(y) < 1e-8) return 1.0 + y / 2.0 + y * y / 3.0 + y * y * y / 4.0;
    const Complex w = 1.0 - y;
    return -Complex(std::log(std::norm(w)) / 2, std::arg(w)) / y;
}

// (1 - exp(-x)) / x.
Complex exp_quotient(Complex x) {
    if (std::norm(x) < 1e-8) return 1.0 - x / 2.0 + x * x / 6.0 - x * x * x / 24.0;
    return (1.0 - std::exp(-x)) / x;
}

// Where g, >= 0 at low and < 0 at high, passes 0, or is as small as its rounding: regula falsi, with halved values at
// an end that stays twice (Illinois).
template <class Function>
double root(const Function& g, double low, double high, double rounding) {
    double at_low = g(low), at_high = g(high);
    int kept = 0;  // the end that stayed: 1 low, -1 high
    for (int i = 0; i < 100 && high - low > 1e-14 * high; ++i) {
        double middle = (low * at_high - high * at_low) / (at_high - at_low);
        if (!(middle > low && middle < high)) middle = (low + high) / 2;
        if (middle <= low || middle >= high) break;
        const double value = g(middle);
        if (value < 0) {
            high = middle;
            at_high = value;
            if (kept == 1) at_low /= 2;
            kept = 1;
        } else {
            low = middle;
            at_low = value;
            if (kept == -1) at_high /= 2;
            kept = -1;
        }
        if (std::abs(value) <= rounding) return middle;
    }
    return high;
}

double longest_side(const Charts& charts, Index t) {
    return std::max({std::abs(charts.side(t, 0)), std::abs(charts.side(t, 1)), std::abs(charts.side(t, 2))});
}

}  // namespace

LocalField::LocalField(const ImposedField& field) : charts_(field.field.domain) {
    const Triangles& triangles = charts_.mesh().triangles;
    for (Index t = 0; t < triangles.rows(); ++t) {
        Linear linear{charts_.centroid(t), 0, 0, 0};
        // grad H = sum H_k (normal of the opposite side) / twice the area; slope = H_x - i H_y.
        for (int k = 0; k < 3; ++k) {
            const double h = field.log_size[triangles(t, k)];
            linear.log_size += h / 3;
            linear.slope += h * std::conj(Complex(0, 1) * charts_.side(t, (k + 1) % 3)) / charts_.twice_area(t);
        }
        double first = 0;
        for (int k = 0; k < 3; ++k) {
            const Complex along = charts_.side(t, k);
            const double own = std::arg(field.field.values[charts_.topology().triangle_edges(t, k)]) / 4;
            const Complex middle = charts_.on_side(t, k, 0.5) - linear.centre;
            const double angle = own + std::arg(along) - (linear.slope * middle).imag();
            if (k == 0) first = angle;
            linear.angle += (angle - nearest(angle - first, quarter)) / 3;
        }
        at_.push_back(linear);
    }
}

Complex LocalField::parameters(const Place& from, Complex z) const {
    const Complex way = z - from.z;
    return exp_quotient(at_[from.t].slope * way) * way / velocity(from);
}

Complex LocalField::point(const Place& from, Complex way) const {
    return from.z + way * log_quotient(at_[from.t].slope * way);
}

// The distance g from the side has one extremum at most: its rate is that of cross(e, F) - s |F|^2 Im(conj(e b)).
double LocalField::first_exit(const Place& from, int side, bool entered, double before) const {
    const Complex e = charts_.side(from.t, side), v = velocity(from);
    const double rate = cross(e, v), bend = std::norm(v) * std::conj(e * at_[from.t].slope).imag();
    const auto distance = [&](double s) { return cross(e, point(from, v * s) - charts_.corners(from.t)[side]); };
    const double rounding = 1e-15 * std::abs(e) * longest_side(charts_, from.t);
    double low = 0, high = 0;
    const bool turns = bend != 0 && rate / bend > 0;
    if (rate < 0 && !entered && distance(0) <= 0) return 0;
    if (rate < 0 && turns) {
        high = rate / bend;
        if (!(distance(high) < 0)) return never;
    } else {
        if (rate >= 0) {
            if (!turns) return never;
            low = rate / bend;
        }
        if (before < never) {  // it falls from `low` on
            if (low >= before || distance(before) >= 0) return never;
            return root(distance, low, before, rounding);
        }
        double step = longest_side(charts_, from.t) / std::abs(v);
        for (int tries = 0;; ++tries, step *= 2) {
            if (tries == 60) return never;
            high = low + step;
            if (distance(high) < 0) break;
        }
    }
    return root(distance, low, high, rounding);
}

// Both triangles lead to their common side: along it to its end, and out by the next side.
LocalField::Exit LocalField::along_side(const Place& from, int entry) const {
    const bool forward = dot(charts_.side(from.t, entry), velocity(from)) > 0;
    const Complex end = charts_.corners(from.t)[forward ? (entry + 1) % 3 : entry];
    const double length = std::abs(end - from.z) / std::exp(log_size(from.t, (from.z + end) / 2.0));
    return forward ? Exit{(entry + 1) % 3, inside, length} : Exit{(entry + 2) % 3, 1 - inside, length};
}

LocalField::Exit LocalField::exit(const Place& from, int entry) const {
    if (entry >= 0 && cross(charts_.side(from.t, entry), velocity(from)) <= 0) return along_side(from, entry);
    Exit found{-1, 0, never};
    for (int k = 0; k < 3; ++k)
        if (const double s = first_exit(from, k, k == entry, found.length); s < found.length) found = {k, 0, s};
    if (found.side < 0)
        throw SolverError("a curve of the layout finds no way out of triangle " + std::to_string(from.t), "stuck",
                          {from.t});
    const Complex e = charts_.side(from.t, found.side);
    const Complex way = point(from, velocity(from) * found.length) - charts_.corners(from.t)[found.side];
    found.fraction = std::clamp(dot(e, way) / std::norm(e), inside, 1 - inside);
    return found;
}

LocalField::Place LocalField::across(Charts::Side from, double fraction, double heading, double shear) const {
    const Charts::Side to = charts_.across(from);
    Place place{to.triangle, charts_.on_side(to.triangle, to.side, 1 - fraction), 0};
    const double carried = std::arg(charts_.carried(std::polar(1.0, heading), from, to));
    const double turn = carried - angle(place.t, place.z);
    place.turn = shear + nearest(turn - shear, quarter);
    return place;
}

}  // namespace octafield::surface::detail
