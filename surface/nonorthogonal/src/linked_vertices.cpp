#include "linked_vertices.hpp"

namespace octafield::surface::detail {

std::vector<VertexLink> vertex_links(const SurfaceDomain& domain, const VertexCharts& charts, EdgeWeights weights) {
    const EdgeTopology& topology = domain.topology();
    std::vector<VertexLink> links(domain.edge_count());
    for (Index e = 0; e < domain.edge_count(); ++e)
        links[e] = {topology.edges(e, 0), topology.edges(e, 1), std::polar(1.0, 2 * charts.transport(e)),
                    weights == EdgeWeights::unit ? 1.0 : 0.0};
    if (weights == EdgeWeights::unit) return links;
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k)
            links[topology.triangle_edges(t, k)].weight += domain.cotangents()(t, (k + 2) % 3) / 2;
    return links;
}

double lines_energy(const std::vector<VertexLink>& links, const std::vector<TwoLines>& lines, double lambda) {
    std::vector<PowerSums> sums;
    sums.reserve(lines.size());
    for (const TwoLines& two : lines) sums.push_back(power_sums(two));
    double energy = 0;
    for (const VertexLink& link : links) {
        const PowerSums& from = sums[link.i];
        energy += link.weight *
                  squared_distance({link.turn * from.p1, link.turn * link.turn * from.p2}, sums[link.j], lambda);
    }
    return energy;
}

}  // namespace octafield::surface::detail
