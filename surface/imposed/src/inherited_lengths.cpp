#include "inherited_lengths.hpp"

namespace octafield::surface::detail {
namespace {

// Where a vertex of the refined mesh is in triangle t of the input's charts. It may be known by its weights in another
// triangle that it is on the border of.
Complex place_in(const Charts& charts, Index t, Index source, const Eigen::RowVector3d& weights) {
    Complex place = 0;
    for (int k = 0; k < 3; ++k) {
        if (weights[k] == 0) continue;
        int here = k;
        if (source != t)
            for (int j = 0; j < 3; ++j)
                if (charts.mesh().triangles(t, j) == charts.mesh().triangles(source, k)) here = j;
        place += weights[k] * charts.corners(t)[here];
    }
    return place;
}

}  // namespace

SurfaceDomain measured_alike(const SurfaceDomain& input, const RingedMesh& refined, SurfaceDomain domain) {
    if (!input.has_own_lengths()) return domain;
    const Charts charts(input);
    const EdgeTopology& topology = domain.topology();
    Eigen::VectorXd lengths(domain.edge_count());
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const Index t = refined.origins[topology.edge_triangles.row(e).maxCoeff()];
        const auto place = [&](Index v) {
            return place_in(charts, t, refined.vertex_triangles[v], refined.vertex_weights.row(v));
        };
        lengths[e] = std::abs(place(topology.edges(e, 1)) - place(topology.edges(e, 0)));
    }
    return domain.with_edge_lengths(std::move(lengths));
}

}  // namespace octafield::surface::detail
