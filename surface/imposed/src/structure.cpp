#include "structure.hpp"

#include <algorithm>
#include <string>
#include <tuple>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

std::vector<Index> triangle_components(const SurfaceDomain& domain, Index& count) {
    DisjointSets sets(domain.triangle_count());
    for (const auto& beside : domain.topology().edge_triangles.rowwise())
        if (beside.minCoeff() >= 0) sets.join(beside[0], beside[1]);
    return std::move(sets).numbers(count);
}

void require_one_fan_each(const SurfaceDomain& domain) {
    std::vector<Index> bad;
    const auto& fans = domain.fans().fans;
    for (std::size_t f = 1; f < fans.size(); ++f)
        if (fans[f].vertex == fans[f - 1].vertex && (bad.empty() || bad.back() != fans[f].vertex))
            bad.push_back(fans[f].vertex);
    if (!bad.empty())
        throw GeometryError("at " + std::to_string(bad.size()) + " vertices (" + first_few(bad) +
                                ") parts of the surface touch without sharing an edge; give each part its own vertex",
                            "non_manifold_vertex", bad);
}

}  // namespace

Structure::Structure(const SurfaceDomain& domain) {
    if (domain.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
    require_one_fan_each(domain);
    Index count = 0;
    of_triangle = triangle_components(domain, count);
    components.resize(count, {-1, 0, {}});
    of_vertex.assign(domain.vertex_count(), -1);
    on_boundary.assign(domain.vertex_count(), false);
    angles = Eigen::VectorXd::Zero(domain.vertex_count());
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        Component& component = components[of_triangle[t]];
        if (component.triangle < 0) component.triangle = t;
        ++component.euler_characteristic;
        for (int k = 0; k < 3; ++k) {
            const Index v = domain.mesh().triangles(t, k);
            if (of_vertex[v] < 0) ++component.euler_characteristic;
            of_vertex[v] = of_triangle[t];
            angles[v] += domain.corner_angles()(t, k);
        }
    }
    for (Index e = 0; e < domain.edge_count(); ++e)
        --components[of_vertex[domain.topology().edges(e, 0)]].euler_characteristic;
    add_curves(domain);
}

void Structure::add_curves(const SurfaceDomain& domain) {
    const Edges& edges = domain.topology().edges;
    DisjointSets sets(domain.vertex_count());
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (domain.topology().edge_triangles.row(e).minCoeff() < 0) {
            sets.join(edges(e, 0), edges(e, 1));
            on_boundary[edges(e, 0)] = on_boundary[edges(e, 1)] = true;
        }
    std::vector<Index> place(domain.vertex_count(), -1);  // of the curve, at its lowest vertex
    for (Index e = 0; e < domain.edge_count(); ++e) {
        if (domain.topology().edge_triangles.row(e).minCoeff() >= 0) continue;
        const Index vertex = sets.lowest(edges(e, 0));
        auto& curves = components[of_vertex[vertex]].curves;
        if (place[vertex] < 0) {
            place[vertex] = static_cast<Index>(curves.size());
            curves.push_back({e, vertex, 0});
        }
        curves[place[vertex]].length += domain.edge_lengths()[e];
    }
    for (Component& component : components) {
        std::sort(component.curves.begin(), component.curves.end(), [](const Curve& a, const Curve& b) {
            return std::tuple(-a.length, a.edge) < std::tuple(-b.length, b.edge);
        });
        for (std::size_t c = 0; c < component.curves.size(); ++c)
            place[component.curves[c].vertex] = static_cast<Index>(c);
    }
    curve_of_vertex.assign(domain.vertex_count(), -1);
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (on_boundary[v]) curve_of_vertex[v] = place[sets.lowest(v)];
}

}  // namespace octafield::surface::detail
