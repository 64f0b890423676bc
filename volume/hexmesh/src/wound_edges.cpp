#include "wound_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "map_transitions.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double same = 1e-8;  // of the edge's extent: a parameter that does not change along it

struct Wedge {
    Index a, b;  // a < b
    double angle;
    bool along_an_axis;
};

// Of the parameters of a tet round the edge of its corners a and b.
Wedge wedge_of(const SeamlessMap& map, Index tet, int a, int b) {
    std::array<int, 2> rest;
    int n = 0;
    for (int k = 0; k < 4; ++k)
        if (k != a && k != b) rest[n++] = k;
    const Eigen::Vector3d origin = parameters_at(map.parameters, tet, a);
    const Eigen::Vector3d end = parameters_at(map.parameters, tet, b);
    const double angle = angle_round(origin, end, parameters_at(map.parameters, tet, rest[0]),
                                     parameters_at(map.parameters, tet, rest[1]));
    const auto [low, high] = std::minmax(map.mesh.tets(tet, a), map.mesh.tets(tet, b));
    const Eigen::Array3d size = (end - origin).array().abs();
    return {low, high, angle, (size <= same * size.maxCoeff()).count() >= 2};
}

std::vector<std::pair<Index, Index>> boundary_edges(const TriangleTable& table) {
    std::vector<std::pair<Index, Index>> edges;
    for (Index row = 0; row < table.triangles.rows(); ++row)
        for (int k = 0; k < 3 && table.sides(row, 1) < 0; ++k)
            edges.push_back(std::minmax({table.triangles(row, k), table.triangles(row, (k + 1) % 3)}));
    std::sort(edges.begin(), edges.end());
    return edges;
}

bool is_wound(int quarters, bool inside, bool along_an_axis) {
    if (inside) return quarters < 2 || (quarters != 4 && !along_an_axis);
    return quarters < 1 || (quarters > 2 && !along_an_axis);
}

}  // namespace

Edges wound_edges(const SeamlessMap& map, const TriangleTable& table) {
    std::vector<Wedge> wedges;
    for (Index t = 0; t < map.mesh.tets.rows(); ++t)
        for (int a = 0; a < 4; ++a)
            for (int b = a + 1; b < 4; ++b) wedges.push_back(wedge_of(map, t, a, b));
    std::stable_sort(wedges.begin(), wedges.end(),
                     [](const Wedge& x, const Wedge& y) { return std::tie(x.a, x.b) < std::tie(y.a, y.b); });
    const auto boundary = boundary_edges(table);
    std::vector<Index> found;
    for (std::size_t i = 0; i < wedges.size();) {
        const Wedge& first = wedges[i];
        double sum = 0;
        for (; i < wedges.size() && wedges[i].a == first.a && wedges[i].b == first.b; ++i) sum += wedges[i].angle;
        const int quarters = static_cast<int>(std::lround(sum / (std::numbers::pi / 2)));
        const bool inside = !std::binary_search(boundary.begin(), boundary.end(), std::pair{first.a, first.b});
        if (is_wound(quarters, inside, first.along_an_axis)) found.insert(found.end(), {first.a, first.b});
    }
    return Eigen::Map<const Edges>(found.data(), static_cast<Index>(found.size() / 2), 2);
}

}  // namespace octafield::volume::detail
