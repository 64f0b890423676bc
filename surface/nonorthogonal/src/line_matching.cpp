#include "line_matching.hpp"

#include <cmath>
#include <numbers>

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;

double branch(const TwoLines& lines, int k) {
    const int half_turns = k >= 0 ? k / 2 : (k - 1) / 2;
    return (k - 2 * half_turns == 0 ? lines.first : lines.second) + half_turns * pi;
}

}  // namespace

int line_shift(const TwoLines& from, const TwoLines& to, double transport) {
    const double mean_from = (from.first + from.second) / 2 + transport, mean_to = (to.first + to.second) / 2;
    const int middle = static_cast<int>(std::lround((mean_from - mean_to) / (pi / 2)));
    int best = middle;
    double least = -1;
    for (int m = middle - 1; m <= middle + 1; ++m) {
        double cost = 0;
        for (int k = 0; k < 2; ++k) {
            const double turn = branch(to, k + m) - branch(from, k) - transport;
            cost += turn * turn;
        }
        if (least >= 0 && cost >= least) continue;
        least = cost;
        best = m;
    }
    return best;
}

std::vector<int> triangle_indices(const SurfaceDomain& domain, const VertexCharts& charts,
                                  const std::vector<TwoLines>& lines) {
    const EdgeTopology& topology = domain.topology();
    std::vector<int> shifts(domain.edge_count()), indices(domain.triangle_count());
    for (Index e = 0; e < domain.edge_count(); ++e)
        shifts[e] = line_shift(lines[topology.edges(e, 0)], lines[topology.edges(e, 1)], charts.transport(e));
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        double turn = 0;
        for (int k = 0; k < 3; ++k) {
            const Index e = topology.triangle_edges(t, k);
            const int sense = topology.edges(e, 0) == domain.mesh().triangles(t, k) ? 1 : -1;
            indices[t] += sense * shifts[e];
            turn += sense * charts.transport(e);
        }
        // Counter-clockwise round the triangle a branch has turned by so many quarters against the transport, which
        // itself has gone round by whole turns, and by the curvature in the triangle.
        indices[t] -= 4 * static_cast<int>(std::lround(turn / (2 * pi)));
    }
    return indices;
}

}  // namespace octafield::surface::detail
