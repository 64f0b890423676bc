#include "octafield/frames/binary_groups.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::frames {
namespace {

constexpr double golden = std::numbers::phi;
const double sqrt5 = std::sqrt(5.0);

// The first elements of the octahedral list are the vierer group and, with the third turns, the tetrahedral one.
bool in_vierer(OctahedralClass c) { return c == OctahedralClass::identity || c == OctahedralClass::half_turn; }
bool in_tetrahedral(OctahedralClass c) { return in_vierer(c) || c == OctahedralClass::third_turn; }

std::vector<Quaternion> octahedral_subgroup(bool (*contains)(OctahedralClass)) {
    std::vector<Quaternion> list;
    const auto& all = binary_octahedral_group();
    for (int i = 0; i < 2 * octahedral_order; ++i)
        if (contains(octahedral_class(i % octahedral_order))) list.push_back(all[i]);
    return list;
}

// The tetrahedral elements, then the even permutations of (golden, 1, 1/golden, 0) / 2 with all signs (Du Val 1964,
// section 20).
std::vector<Quaternion> make_icosahedral() {
    std::vector<Quaternion> list = octahedral_subgroup(in_tetrahedral);
    for (int sign = 0; sign < 8; ++sign) {
        const double values[4] = {(sign & 1 ? -0.5 : 0.5) * golden, sign & 2 ? -0.5 : 0.5,
                                  (sign & 4 ? -0.5 : 0.5) * (golden - 1), 0};
        std::array<int, 4> place = {0, 1, 2, 3};
        do {
            int inversions = 0;
            for (int i = 0; i < 4; ++i)
                for (int j = 0; j < i; ++j) inversions += place[j] > place[i];
            if (inversions % 2 == 0)
                list.emplace_back(values[place[0]], values[place[1]], values[place[2]], values[place[3]]);
        } while (std::next_permutation(place.begin(), place.end()));
    }
    return list;
}

// u v (u^4 - v^4), u^8 + 14 u^4 v^4 + v^8, u^12 - 33 u^4 v^4 (u^4 + v^4) + v^12.
Complex3 tetrahedral_invariants(const Complex& u, const Complex& v) {
    const Complex u2 = u * u, v2 = v * v, u4 = u2 * u2, v4 = v2 * v2, sum = u4 + v4, product = u4 * v4;
    return {u * v * (u4 - v4), sum * sum + 12.0 * product, sum * (sum * sum - 36.0 * product)};
}

Complex3 icosahedral_invariants(const Complex3& g) {
    const Complex s = g[0] * g[0];
    return {g[2] + 22 / sqrt5 * s, g[1] * (g[2] - 38 * sqrt5 / 3 * s),
            g[0] * (g[2] * g[2] - 116 * sqrt5 / 45 * s * g[2] + 3444.0 / 25 * s * s)};
}

}  // namespace

std::string_view name_of(BinaryGroup group) {
    constexpr std::array<std::string_view, 4> names = {"vierer", "tetrahedral", "octahedral", "icosahedral"};
    return names[static_cast<std::size_t>(group)];
}

BinaryGroup binary_group(std::string_view name) {
    std::string known;
    for (const BinaryGroup group : all_binary_groups) {
        if (name_of(group) == name) return group;
        known += (known.empty() ? "" : ", ") + std::string(name_of(group));
    }
    throw InvalidInput("binary group '" + std::string(name) + "' is not one of: " + known, "unknown_option_value");
}

const std::vector<Quaternion>& elements(BinaryGroup group) {
    static const std::array<std::vector<Quaternion>, 4> lists = {
        octahedral_subgroup(in_vierer), octahedral_subgroup(in_tetrahedral),
        octahedral_subgroup([](OctahedralClass) { return true; }), make_icosahedral()};
    return lists[static_cast<std::size_t>(group)];
}

Generators generators(BinaryGroup group) {
    constexpr double root = std::numbers::sqrt2 / 2;
    const Quaternion third{0.5, 0.5, 0.5, 0.5};
    switch (group) {
        case BinaryGroup::vierer:
            return {2, 2, {0, 1, 0, 0}, {0, 0, 1, 0}, {0, 0, 0, 1}};
        case BinaryGroup::tetrahedral:
            return {3, 3, third, {0.5, -0.5, 0.5, 0.5}, {0, 0, 0, 1}};
        case BinaryGroup::octahedral:
            return {4, 3, {root, root, 0, 0}, third, {0, root, 0, root}};
        default:
            return {5, 3, {golden / 2, 0.5, (golden - 1) / 2, 0}, third, {0, golden / 2, (golden - 1) / 2, 0.5}};
    }
}

std::array<int, 3> invariant_degrees(BinaryGroup group) {
    constexpr std::array<std::array<int, 3>, 4> degrees = {{{4, 4, 6}, {6, 8, 12}, {8, 12, 18}, {12, 20, 30}}};
    return degrees[static_cast<std::size_t>(group)];
}

Complex3 invariants(BinaryGroup group, const Quaternion& q) {
    if (!q.coeffs().allFinite()) throw InvalidInput("the quaternion is not finite", "non_finite");
    const Complex u(q.w(), q.x()), v(q.y(), q.z());
    const Complex3 g = tetrahedral_invariants(u, v);
    switch (group) {
        case BinaryGroup::vierer:
            return {u * u * v * v, u * u * u * u + v * v * v * v, g[0]};
        case BinaryGroup::tetrahedral:
            return g;
        case BinaryGroup::octahedral:
            return {g[1], g[0] * g[0], g[0] * g[2]};
        default:
            return icosahedral_invariants(g);
    }
}

Complex relation_residual(BinaryGroup group, const Complex3& f) {
    const Complex square0 = f[0] * f[0], square1 = f[1] * f[1], square2 = f[2] * f[2];
    switch (group) {
        case BinaryGroup::vierer:
            return square2 - f[0] * (square1 - 4.0 * square0);
        case BinaryGroup::tetrahedral:
            return square2 - (square1 * f[1] - 108.0 * square0 * square0);
        case BinaryGroup::octahedral:
            return square2 - f[1] * (square0 * f[0] - 108.0 * square1);
        default:
            return square2 - (square0 * square0 * f[0] - square1 * f[1]) / (60 * sqrt5);
    }
}

}  // namespace octafield::frames
