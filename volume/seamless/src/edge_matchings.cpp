#include "edge_matchings.hpp"

#include <algorithm>
#include <set>
#include <utility>

#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume::detail {
namespace {

using frames::octahedral_inverse;
using frames::octahedral_product;

constexpr int most_sweeps = 50;

// Of a singular triangle: one that no hex mesh has counts as several.
int cost(int holonomy) {
    switch (frames::octahedral_class(holonomy)) {
        case frames::OctahedralClass::identity:
            return 0;
        case frames::OctahedralClass::quarter_turn:
            return 1;
        case frames::OctahedralClass::half_turn:
            return 3;
        default:
            return 4;
    }
}

}  // namespace

EdgeMatchings::EdgeMatchings(const TetDomain& domain, const Quaternions& frames) : domain_(domain) {
    const TriangleTable& table = domain.triangles();
    std::vector<std::array<Index, 2>> edges;
    for (const auto t : table.triangles.rowwise())
        for (const auto& [i, j] : {std::pair{0, 1}, {1, 2}, {0, 2}}) edges.push_back({t[i], t[j]});
    std::sort(edges.begin(), edges.end());
    edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
    begin_.assign(domain.vertex_count() + 1, 0);
    for (const auto& [a, b] : edges) {
        ++begin_[a + 1];
        higher_.push_back(b);
        element_.push_back(static_cast<std::uint8_t>(
            frames::matching(frames::from_wxyz(frames.row(a)), frames::from_wxyz(frames.row(b)))));
    }
    for (std::size_t v = 1; v < begin_.size(); ++v) begin_[v] += begin_[v - 1];
    edges_of_.resize(table.triangles.rows(), 3);
    triangles_of_.resize(edges.size());
    for (Index row = 0; row < table.triangles.rows(); ++row) {
        const auto t = table.triangles.row(row);
        edges_of_.row(row) << row_of(t[0], t[1]), row_of(t[1], t[2]), row_of(t[0], t[2]);
        for (const Index edge : edges_of_.row(row)) triangles_of_[edge].push_back(row);
    }
}

Index EdgeMatchings::row_of(Index a, Index b) const {
    return static_cast<Index>(std::lower_bound(higher_.begin() + begin_[a], higher_.begin() + begin_[a + 1], b) -
                              higher_.begin());
}

int EdgeMatchings::operator()(Index from, Index to) const {
    if (from == to) return 0;
    return from < to ? element_[row_of(from, to)] : octahedral_inverse(element_[row_of(to, from)]);
}

void EdgeMatchings::turn(Index from, Index to, int element) {
    const int turned = octahedral_product(element, (*this)(from, to));
    element_[row_of(std::min(from, to), std::max(from, to))] =
        static_cast<std::uint8_t>(from < to ? turned : octahedral_inverse(turned));
}

const std::vector<Index>& EdgeMatchings::triangles_at(Index a, Index b) const {
    return triangles_of_[row_of(std::min(a, b), std::max(a, b))];
}

int EdgeMatchings::holonomy(Index row, Index edge, int instead) const {
    const auto element = [&](int k) {
        const Index e = edges_of_(row, k);
        return e == edge ? instead : static_cast<int>(element_[e]);
    };
    return octahedral_inverse(
        octahedral_product(octahedral_product(element(0), element(1)), octahedral_inverse(element(2))));
}

int EdgeMatchings::cost_round(Index edge, int element) const {
    int sum = 0;
    for (const Index row : triangles_of_[edge]) sum += cost(holonomy(row, edge, element));
    return sum;
}

int EdgeMatchings::shorten_curves() {
    const TriangleTable& table = domain_.triangles();
    std::vector<std::uint8_t> held(element_.size(), 0);  // edges of the surface
    for (const Index row : domain_.surface_rows())
        for (const Index edge : edges_of_.row(row)) held[edge] = 1;
    std::set<Index> near;  // edges whose triangles may be singular
    const auto look_round = [&](Index row) {
        for (const Index edge : edges_of_.row(row))
            if (!held[edge]) near.insert(edge);
    };
    for (Index row = 0; row < table.triangles.rows(); ++row)
        if (holonomy(row) != 0) look_round(row);
    int steps = 0;
    for (int sweep = 0; sweep < most_sweeps && !near.empty(); ++sweep)
        for (const Index edge : std::exchange(near, {})) {
            int best = element_[edge], least = cost_round(edge, best);
            for (int element = 0; least > 0 && element < frames::octahedral_order; ++element)
                if (const int found = cost_round(edge, element); found < least) {
                    least = found;
                    best = element;
                }
            if (best == element_[edge]) continue;
            element_[edge] = static_cast<std::uint8_t>(best);
            ++steps;
            for (const Index row : triangles_of_[edge]) look_round(row);
        }
    return steps;
}

}  // namespace octafield::volume::detail
