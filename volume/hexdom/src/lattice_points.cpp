#include "lattice_points.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

constexpr std::int64_t most_cells = 20'000'000;

std::int64_t floor_div(std::int64_t a, std::int64_t b) { return a >= 0 ? a / b : -((-a + b - 1) / b); }

// Before any is listed: one tet may have more of them than there is memory.
void require_room(const MapCharts& charts) {
    double cells = 0;
    for (Index t = 0; t < charts.domain().tet_count(); ++t) {
        if (!charts.map().usable[t]) continue;
        const TetCoordinates c = coordinates_of(charts.map(), t);
        cells += static_cast<double>(orientation(c[0], c[1], c[2], c[3])) / (6 * std::pow(periodic_unit, 3));
    }
    if (cells > most_cells)
        throw InvalidInput(
            "the mesh would have more than " + std::to_string(most_cells) + " cells; give a larger edge length",
            "edge_length");
}

}  // namespace

LatticePoints::LatticePoints(const MapCharts& charts, std::int32_t offset) {
    require_room(charts);
    enumerate(charts, offset);
    DisjointSets sets(at_.size());
    const TetDomain& domain = charts.domain();
    // Across triangles; then what lies at a vertex, or at the same place of an edge, also where the tets round it are
    // not all usable.
    struct OnEdge {
        Index a, b;
        std::int64_t part, whole;
        Index node;
        auto key() const { return std::tie(a, b, part, whole); }
    };
    std::vector<OnEdge> on_edges;
    std::vector<Index> at_vertex(domain.vertex_count(), -1);
    for (Index t = 0; t < domain.tet_count(); ++t)
        for (std::int64_t n = begin_[t]; n < begin_[t + 1]; ++n) {
            const Index node = static_cast<Index>(n);
            for (int k = 0; k < 4; ++k) {
                if (!(zero_[n] >> k & 1)) continue;
                const Index other = charts.joined(t, k);
                if (other < t) continue;
                const std::int64_t found = find_node(other, charts.change(t, k)(at_[n]));
                if (found >= 0) sets.join(node, static_cast<Index>(found));
            }
            const int weights = 4 - std::popcount(zero_[n]);
            if (weights > 2) continue;
            std::array<int, 2> corner{-1, -1};
            for (int k = 0, i = 0; k < 4; ++k)
                if (!(zero_[n] >> k & 1)) corner[i++] = k;
            const auto vertex = [&](int i) { return domain.mesh().tets(t, corner[i]); };
            if (weights == 1) {
                Index& first = at_vertex[vertex(0)];
                if (first < 0) first = node;
                sets.join(first, node);
                continue;
            }
            if (vertex(0) > vertex(1)) std::swap(corner[0], corner[1]);
            const TetCoordinates c = coordinates_of(charts.map(), t);
            const Coordinate along = c[corner[1]] - c[corner[0]], way = at_[n] - c[corner[0]];
            int largest = 0;
            for (int i = 1; i < 3; ++i)
                if (std::abs(along[i]) > std::abs(along[largest])) largest = i;
            const std::int64_t part = std::abs(way[largest]), whole = std::abs(along[largest]);
            const std::int64_t divisor = std::gcd(part, whole);
            on_edges.push_back({vertex(0), vertex(1), part / divisor, whole / divisor, node});
        }
    std::sort(on_edges.begin(), on_edges.end(), [](const OnEdge& x, const OnEdge& y) {
        return std::tie(x.a, x.b, x.part, x.whole, x.node) < std::tie(y.a, y.b, y.part, y.whole, y.node);
    });
    for (std::size_t i = 1; i < on_edges.size(); ++i)
        if (on_edges[i].key() == on_edges[i - 1].key()) sets.join(on_edges[i - 1].node, on_edges[i].node);
    Index count = 0;
    point_ = std::move(sets).numbers(count);
    place_.resize(count);
    for (Index t = domain.tet_count() - 1; t >= 0; --t)
        for (std::int64_t n = begin_[t]; n < begin_[t + 1]; ++n) place_[point_[n]] = {t, at_[n]};
}

void LatticePoints::enumerate(const MapCharts& charts, std::int32_t offset) {
    const Index m = charts.domain().tet_count();
    begin_.assign(m + 1, 0);
    for (Index t = 0; t < m; ++t) {
        begin_[t + 1] = begin_[t];
        if (!charts.map().usable[t]) continue;
        const TetCoordinates corners = coordinates_of(charts.map(), t);
        std::array<std::int64_t, 3> first, last;
        for (int i = 0; i < 3; ++i) {
            const auto [low, high] = std::minmax({corners[0][i], corners[1][i], corners[2][i], corners[3][i]});
            first[i] = -floor_div(-(low - offset), periodic_unit);
            last[i] = floor_div(high - offset, periodic_unit);
        }
        for (std::int64_t x = first[0]; x <= last[0]; ++x)
            for (std::int64_t y = first[1]; y <= last[1]; ++y)
                for (std::int64_t z = first[2]; z <= last[2]; ++z) {
                    const Coordinate at{x * periodic_unit + offset, y * periodic_unit + offset,
                                        z * periodic_unit + offset};
                    const std::array<Wide, 4> weights = barycentric(corners, at);
                    if (weights[0] < 0 || weights[1] < 0 || weights[2] < 0 || weights[3] < 0) continue;
                    at_.push_back(at);
                    std::uint8_t zero = 0;
                    for (int k = 0; k < 4; ++k) zero |= static_cast<std::uint8_t>((weights[k] == 0) << k);
                    zero_.push_back(zero);
                    ++begin_[t + 1];
                }
    }
}

std::int64_t LatticePoints::find_node(Index tet, const Coordinate& at) const {
    // They are listed in ascending order.
    const auto first = at_.begin() + begin_[tet], last = at_.begin() + begin_[tet + 1];
    const auto found = std::lower_bound(first, last, at);
    return found != last && *found == at ? found - at_.begin() : -1;
}

Index LatticePoints::find(const Place& place) const {
    const std::int64_t node = place.tet < 0 ? -1 : find_node(place.tet, place.at);
    return node < 0 ? -1 : point_[node];
}

}  // namespace octafield::volume
