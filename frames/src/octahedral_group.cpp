#include "octafield/frames/octahedral_group.hpp"

#include <cmath>
#include <numbers>

namespace octafield::frames {
namespace {

using Group = std::array<Quaternion, octahedral_order>;
using Table = std::array<std::array<int, octahedral_order>, octahedral_order>;

constexpr double half = 0.5;
constexpr double root = std::numbers::sqrt2 / 2;

Group make_group() {
    // clang-format off
    return {Quaternion{1, 0, 0, 0},
            {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1},                                           // half turns
            {root, root, 0, 0}, {root, -root, 0, 0}, {root, 0, root, 0}, {root, 0, -root, 0},   // quarter turns
            {root, 0, 0, root}, {root, 0, 0, -root},
            {0, root, root, 0}, {0, 0, root, root}, {0, root, 0, root},                         // edge half turns
            {0, -root, root, 0}, {0, 0, -root, root}, {0, root, 0, -root},
            {half, half, half, half}, {half, half, half, -half}, {half, half, -half, half},     // third turns
            {half, half, -half, -half}, {half, -half, half, half}, {half, -half, half, -half},
            {half, -half, -half, half}, {half, -half, -half, -half}};
    // clang-format on
}

// Number of the element whose quaternion is q or -q up to rounding; in general the one closest to q.
int closest_element(const Quaternion& q) {
    int best = 0;
    double largest = -1;
    const Group& group = octahedral_group();
    for (int i = 0; i < octahedral_order; ++i) {
        const double dot = std::abs(q.coeffs().dot(group[i].coeffs()));
        if (dot > largest + 1e-14) {
            largest = dot;
            best = i;
        }
    }
    return best;
}

const Table& product_table() {
    static const Table table = [] {
        Table t{};
        for (int a = 0; a < octahedral_order; ++a)
            for (int b = 0; b < octahedral_order; ++b)
                t[a][b] = closest_element(octahedral_group()[a] * octahedral_group()[b]);
        return t;
    }();
    return table;
}

}  // namespace

const std::array<Quaternion, octahedral_order>& octahedral_group() {
    static const Group group = make_group();
    return group;
}

const std::array<Quaternion, 2 * octahedral_order>& binary_octahedral_group() {
    static const auto binary = [] {
        std::array<Quaternion, 2 * octahedral_order> both;
        for (int i = 0; i < octahedral_order; ++i) {
            both[i] = octahedral_group()[i];
            both[i + octahedral_order] = Quaternion(-both[i].coeffs());
        }
        return both;
    }();
    return binary;
}

int octahedral_product(int a, int b) { return product_table()[a][b]; }

int octahedral_inverse(int a) {
    static const auto inverses = [] {
        std::array<int, octahedral_order> inverse{};
        for (int i = 0; i < octahedral_order; ++i) inverse[i] = closest_element(octahedral_group()[i].conjugate());
        return inverse;
    }();
    return inverses[a];
}

OctahedralClass octahedral_class(int a) {
    if (a == 0) return OctahedralClass::identity;
    if (a < 4) return OctahedralClass::half_turn;
    if (a < 10) return OctahedralClass::quarter_turn;
    return a < 16 ? OctahedralClass::edge_half_turn : OctahedralClass::third_turn;
}

int matching(const Quaternion& q1, const Quaternion& q2) { return closest_element(q1.conjugate() * q2); }

double distance(const Quaternion& q1, const Quaternion& q2) {
    const Quaternion difference = q1.conjugate() * q2;
    const Quaternion rest = octahedral_group()[closest_element(difference)].conjugate() * difference;
    return 2 * std::atan2(rest.vec().norm(), std::abs(rest.w()));  // accurate at small angles, unlike acos
}

Quaternion closest_representative(const Quaternion& q, const Quaternion& reference) {
    const Quaternion candidate = q * octahedral_group()[matching(q, reference)];
    return candidate.dot(reference) < 0 ? Quaternion(-candidate.coeffs()) : candidate;
}

}  // namespace octafield::frames
