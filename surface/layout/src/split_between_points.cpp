#include "split_between_points.hpp"

#include <array>
#include <cmath>
#include <map>

#include "local_field.hpp"

namespace octafield::surface::detail {
namespace {

using Middles = std::map<std::pair<Index, Index>, Index>;

Middles edges_between_points(const ImposedField& field) {
    const SurfaceDomain& domain = field.field.domain;
    std::vector<bool> is_point(domain.vertex_count(), false);
    for (std::size_t i = 0; i < field.point_vertices.size(); ++i)
        if (field.pattern.points[i].index_times_four != 0) is_point[field.point_vertices[i]] = true;
    for (const CornerQuads& corner : field.pattern.corners)
        if (corner.quads != 2) is_point[corner.vertex] = true;
    Middles middles;
    Index next = domain.vertex_count();
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const auto ends = domain.topology().edges.row(e);
        if (is_point[ends[0]] && is_point[ends[1]] && domain.topology().edge_triangles.row(e).minCoeff() >= 0)
            middles[{ends[0], ends[1]}] = next++;
    }
    return middles;
}

struct Part {
    std::array<Index, 3> corners;
    Index origin;
};

std::vector<Part> halved(const Triangles& triangles, const Middles& middles) {
    std::vector<Part> done, waiting;
    for (Index t = 0; t < triangles.rows(); ++t) {
        waiting = {{{triangles(t, 0), triangles(t, 1), triangles(t, 2)}, t}};
        while (!waiting.empty()) {
            const auto [v, origin] = waiting.back();
            waiting.pop_back();
            int split = 0;
            while (split < 3 && !middles.contains(std::minmax(v[split], v[(split + 1) % 3]))) ++split;
            if (split == 3) {
                done.push_back({v, origin});
                continue;
            }
            const Index a = v[split], b = v[(split + 1) % 3], c = v[(split + 2) % 3];
            const Index m = middles.at(std::minmax(a, b));
            waiting.push_back({{m, b, c}, origin});
            waiting.push_back({{a, m, c}, origin});
        }
    }
    return done;
}

}  // namespace

ImposedField split_between_points(const ImposedField& field) {
    const Middles middles = edges_between_points(field);
    if (middles.empty()) return field;
    const LocalField local(field);
    const Charts& charts = local.charts();
    const TriangleMesh& old = charts.mesh();
    const std::vector<Part> parts = halved(old.triangles, middles);
    ImposedField result = field;
    const auto count = old.vertices.rows() + static_cast<Eigen::Index>(middles.size());
    TriangleMesh mesh{Points(count, 3), Triangles(static_cast<Eigen::Index>(parts.size()), 3)};
    mesh.vertices.topRows(old.vertices.rows()) = old.vertices;
    result.log_size.conservativeResize(count);
    for (const auto& [ends, middle] : middles) {
        mesh.vertices.row(middle) = (old.vertices.row(ends.first) + old.vertices.row(ends.second)) / 2;
        result.log_size[middle] = (field.log_size[ends.first] + field.log_size[ends.second]) / 2;
    }
    for (std::size_t t = 0; t < parts.size(); ++t)
        for (int k = 0; k < 3; ++k) mesh.triangles(static_cast<Eigen::Index>(t), k) = parts[t].corners[k];
    SurfaceDomain domain(std::move(mesh));
    const EdgeTopology& topology = domain.topology();
    result.field.values.resize(domain.edge_count());
    Eigen::VectorXd lengths(domain.edge_count());
    for (Index e = 0; e < domain.edge_count(); ++e) {
        const auto beside = topology.edge_triangles.row(e);
        const Index t = parts[beside.maxCoeff()].origin;
        const Eigen::Vector3d a = domain.mesh().vertices.row(topology.edges(e, 0));
        const Eigen::Vector3d b = domain.mesh().vertices.row(topology.edges(e, 1));
        const Complex along = charts.lower_vector(t, b - a);
        const double angle = local.angle(t, charts.lower(t, (a + b) / 2)) - std::arg(along);
        result.field.values[e] = beside.minCoeff() < 0 ? 1.0 : std::polar(1.0, 4 * angle);
        lengths[e] = std::abs(along);
    }
    if (charts.domain().has_own_lengths()) domain = domain.with_edge_lengths(std::move(lengths));
    result.field.domain = domain;
    return result;
}

}  // namespace octafield::surface::detail
