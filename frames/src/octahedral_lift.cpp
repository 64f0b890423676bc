#include "octafield/frames/octahedral_lift.hpp"

#include <cmath>

namespace octafield::frames {
namespace {

constexpr int order = 2 * octahedral_order;
// Two matchings equally near are apart by 45 degrees or more, so the cosines of half their angles part by a fifth of the
// difference of the angles or more.
constexpr double tie = 1e-6 / 5;

int negated(int a) { return (a + octahedral_order) % order; }

// The element with the sign that makes the dot product with q positive.
int with_sign(int element, const Quaternion& q) {
    return octahedral_group()[element].dot(q) < 0 ? negated(element) : element;
}

const std::array<std::array<int, order>, order>& product_table() {
    static const auto table = [] {
        std::array<std::array<int, order>, order> t{};
        const auto& group = binary_octahedral_group();
        for (int a = 0; a < order; ++a)
            for (int b = 0; b < order; ++b)
                t[a][b] = with_sign(octahedral_product(holonomy_of(a), holonomy_of(b)), group[a] * group[b]);
        return t;
    }();
    return table;
}

}  // namespace

int lifted_product(int a, int b) { return product_table()[a][b]; }

int lifted_inverse(int a) {
    return with_sign(octahedral_inverse(holonomy_of(a)), binary_octahedral_group()[a].conjugate());
}

LiftedMatching lifted_matching(const Quaternion& q1, const Quaternion& q2) {
    const Quaternion difference = q1.conjugate() * q2;
    const int element = matching(q1, q2);
    const double largest = std::abs(octahedral_group()[element].dot(difference));
    bool tied = false;
    for (int other = 0; other < octahedral_order && !tied; ++other)
        tied = other != element && std::abs(octahedral_group()[other].dot(difference)) > largest - tie;
    return {with_sign(element, difference), tied};
}

}  // namespace octafield::frames
