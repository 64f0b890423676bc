#include "unfolded_patch.hpp"

#include <cmath>
#include <set>

namespace octafield::surface::detail {
namespace {

// A triangle's chart in the middle one's: z -> shift + turn * z.
struct Unfolded {
    Index triangle;
    Complex turn, shift;
};

Unfolded beyond(const ChartedField& field, const Unfolded& from, int side, const ChartedField::Side& to) {
    const Complex turn = from.turn * std::conj(field.carried(1, {from.triangle, side}, to));
    const Complex shared = from.shift + from.turn * field.corners(from.triangle)[side];
    return {to.triangle, turn, shared - turn * field.corners(to.triangle)[(to.side + 1) % 3]};
}

double distance_to_segment(Complex p, Complex a, Complex b) {
    const double t = std::clamp(dot(b - a, p - a) / std::norm(b - a), 0.0, 1.0);
    return std::abs(a + t * (b - a) - p);
}

constexpr std::size_t most_triangles = 200;

}  // namespace

std::vector<PatchValue> values_round(const ChartedField& field, const std::function<bool(Index)>& is_barrier, Index t,
                                     Complex centre, double inner, double outer) {
    std::vector<PatchValue> ring, middle;
    std::vector<Unfolded> queue = {{t, 1, 0}};
    std::set<Index> seen = {t};
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const Unfolded here = queue[next];
        for (int k = 0; k < 3; ++k) {
            const auto point = [&](double fraction) {
                return here.shift + here.turn * field.on_side(here.triangle, k, fraction);
            };
            const Complex f = field.value(here.triangle, field.on_side(here.triangle, k, 0.5)) *
                              std::pow(here.turn, field.symmetry());
            const PatchValue value{point(0.5), f == 0.0 ? f : f / std::abs(f), field.twice_area(here.triangle) / 6};
            const double distance = std::abs(value.at - centre);
            if (distance > inner && distance < outer) ring.push_back(value);
            if (next == 0) middle.push_back(value);
            const ChartedField::Side there = field.across({here.triangle, k});
            if (there.triangle < 0 || is_barrier(field.topology().triangle_edges(here.triangle, k)) ||
                queue.size() == most_triangles || distance_to_segment(centre, point(0), point(1)) > outer)
                continue;
            if (seen.insert(there.triangle).second) queue.push_back(beyond(field, here, k, there));
        }
    }
    return ring.empty() ? middle : ring;
}

}  // namespace octafield::surface::detail
