// Fields for the tests of quad layouts.
#pragma once

#include "imposed/imposed_fixtures.hpp"
#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface {

inline std::vector<Source> four_in_disk(double radius, const std::vector<double>& degrees) {
    std::vector<Source> sources;
    for (const double at : degrees) sources.push_back({std::polar(radius, at * degree), 1});
    return sources;
}

inline ImposedField disk_field(int rings, const std::vector<Source>& sources) {
    const SurfaceDomain domain(disk(rings));
    return impose_singular_points(domain, pattern_of(domain, sources));
}

// The factor by which parameters of `field` exceed those of the closed form of H in the disk.
inline double unit_of(const ImposedField& field, const std::vector<Source>& sources) {
    double sum = 0;
    int count = 0;
    for (Index v = 0; v < field.log_size.size(); ++v) {
        const Complex z = plane_point(field, v);
        if (!farther(sources, 0.2)(in_plane(z))) continue;
        sum += disk_potential(sources, z) - field.log_size[v];
        ++count;
    }
    return std::exp(sum / count);
}

inline Complex curve_point(const ImposedField& field, const LayoutCurvePoint& p) {
    if (p.vertex >= 0) return plane_point(field, p.vertex);
    const auto edge = field.field.domain.topology().edges.row(p.edge);
    return (1 - p.fraction) * plane_point(field, edge[0]) + p.fraction * plane_point(field, edge[1]);
}

}  // namespace octafield::surface
