// Fields for the tests of quad layouts.
#pragma once

#include <string>

#include "imposed/imposed_fixtures.hpp"
#include "octafield/surface/layout_curves.hpp"

namespace octafield::surface {

// Of the error that is thrown, "none" without one.
template <class Call>
std::string kind_of(const Call& call) {
    try {
        call();
    } catch (const Error& error) {
        return error.kind();
    }
    return "none";
}

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

// The square [-1, 1]^2 with a round hole of `radius` in the middle; 8 n edges round it.
inline TriangleMesh holed_square(int n, double radius) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    const int count = 8 * n;
    std::vector<Complex> rim;
    for (int side = 0; side < 4; ++side)
        for (int i = 0; i < 2 * n; ++i)
            rim.push_back(Complex(1, -1 + static_cast<double>(i) / n) * std::polar(1.0, side * pi / 2));
    for (int ring = 0; ring <= n; ++ring)
        for (int i = 0; i < count; ++i) {
            const Complex near = radius * rim[i] / std::abs(rim[i]);
            const double part = static_cast<double>(ring) / n;
            points.push_back(in_plane(near + (rim[i] - near) * part));
        }
    for (int ring = 0; ring < n; ++ring)
        for (int i = 0; i < count; ++i) {
            const int next = (i + 1) % count, a = ring * count + i, b = ring * count + next;
            triangles.insert(triangles.end(), {{a, a + count, b + count}, {a, b + count, b}});
        }
    return make_mesh(points, triangles);
}

// The regular n-gon with one quad at each corner and a point of valence n in the middle.
inline ImposedField polygon_field(int n, int rings) {
    const SurfaceDomain domain(polygon(n, rings));
    SingularPattern pattern;
    if (n != 4) pattern.points.push_back(imposed_point(domain, Vector::Zero(), 4 - n));
    for (int i = 0; i < n; ++i) {
        const Vector corner = in_plane(std::polar(1.0, 2 * pi * i / n));
        for (Index v = 0; v < domain.vertex_count(); ++v)
            if ((domain.mesh().vertices.row(v).transpose() - corner).norm() < 1e-9) pattern.corners.push_back({v, 1});
    }
    return impose_singular_points(domain, pattern);
}

inline ImposedField holed_field(int n) {
    const SurfaceDomain domain(holed_square(n, 0.4));
    std::vector<Source> sources;
    for (int i = 0; i < 4; ++i) sources.push_back({std::polar(0.9, (45 + 90 * i) * degree), -1});
    return impose_singular_points(domain, pattern_of(domain, sources));
}

inline ImposedField l_shape_field(int n) {
    const SurfaceDomain domain(plate(n, [](double x, double y) { return x < 0.5 || y < 0.5; }));
    return impose_singular_points(domain, {});
}

}  // namespace octafield::surface
