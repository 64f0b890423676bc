#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

#include "octafield/surface/singular_pattern.hpp"
#include "structure.hpp"

namespace octafield::surface {
namespace {

constexpr double right_angle = std::numbers::pi / 2;
constexpr double most_misfit = 80 * std::numbers::pi / 180;  // between an angle and the quads rounded the other way

// Halves down, whatever the rounding of the angles.
int rounded_quads(double angle) { return std::max(1, static_cast<int>(std::ceil(angle / right_angle - 0.5 - 1e-9))); }

struct Change {
    double cost;  // of angle misfit
    Index vertex;
    int quads;
};

// The other neighbouring number of quads, where there is one that is not too far off.
void add_changes(Index vertex, double angle, std::vector<Change>& fewer, std::vector<Change>& more) {
    const int quads = rounded_quads(angle);
    const bool up = angle > quads * right_angle;
    const int other = up ? quads + 1 : quads - 1;
    const double misfit = std::abs(angle - other * right_angle);
    if (other < 1 || misfit > most_misfit) return;
    (up ? more : fewer).push_back({misfit - std::abs(angle - quads * right_angle), vertex, other});
}

}  // namespace

std::vector<CornerQuads> default_corner_quads(const SurfaceDomain& domain) {
    const detail::Structure structure(domain);
    std::vector<CornerQuads> corners;
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (structure.on_boundary[v])
            if (const int quads = rounded_quads(structure.angles[v]); quads != 2) corners.push_back({v, quads});
    return corners;
}

CornerChoice fewest_points_corner_quads(const SurfaceDomain& domain) {
    const detail::Structure structure(domain);
    const std::size_t count = structure.components.size();
    CornerChoice choice;
    std::vector<std::vector<Change>> fewer(count), more(count);
    for (const auto& component : structure.components)
        choice.inner_index_before.push_back(4 * component.euler_characteristic);
    std::vector<int> quads(domain.vertex_count(), 2);
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (!structure.on_boundary[v]) continue;
        const Index c = structure.of_vertex[v];
        quads[v] = rounded_quads(structure.angles[v]);
        choice.inner_index_before[c] -= 2 - quads[v];
        add_changes(v, structure.angles[v], fewer[c], more[c]);
    }
    choice.inner_index = choice.inner_index_before;
    for (std::size_t c = 0; c < count; ++c) {
        int& left = choice.inner_index[c];
        auto& changes = left > 0 ? fewer[c] : more[c];  // fewer quads: more index on the boundary
        std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) {
            return std::tuple(a.cost, a.vertex) < std::tuple(b.cost, b.vertex);
        });
        for (const Change& change : changes) {
            if (left == 0) break;
            left += left > 0 ? -1 : 1;
            quads[change.vertex] = change.quads;
            choice.changed.push_back(change.vertex);
        }
    }
    std::sort(choice.changed.begin(), choice.changed.end());
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (quads[v] != 2) choice.corners.push_back({v, quads[v]});
    return choice;
}

}  // namespace octafield::surface
