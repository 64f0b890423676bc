// Plane domains with holes, patterns and exact solutions, for the tests of imposed singular points.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <complex>
#include <functional>
#include <random>

#include "direction_field_fixtures.hpp"
#include "octafield/surface/imposed_field.hpp"

namespace octafield::surface {

using detail::Complex;
using testing::degree;

inline const ImposedFieldOptions rotate{.inadmissible = Inadmissible::rotate};

inline Vector in_plane(Complex z) { return Vector(z.real(), z.imag(), 0); }
inline Complex plane_point(const ImposedField& field, Index v) {
    const auto row = field.field.domain.mesh().vertices.row(v);
    return {row[0], row[1]};
}

// inner < |z| < 1, `around` vertices on each of `rings` + 1 circles whose radii grow geometrically.
inline TriangleMesh annulus(double inner, int around, int rings) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    for (int j = 0; j <= rings; ++j)
        for (int i = 0; i < around; ++i)
            points.push_back(in_plane(std::polar(std::pow(inner, 1 - static_cast<double>(j) / rings),
                                                 2 * pi * (i + 0.5 * (j % 2)) / around)));
    for (int j = 0; j < rings; ++j)
        for (int i = 0; i < around; ++i) {
            const int next = (i + 1) % around, a = j * around, b = a + around;
            if (j % 2 == 0) {
                triangles.insert(triangles.end(), {{a + i, b + i, a + next}, {b + i, b + next, a + next}});
            } else {
                triangles.insert(triangles.end(), {{a + i, b + i, b + next}, {a + i, b + next, a + next}});
            }
        }
    return make_mesh(points, triangles);
}

// The regular n-gon with corners on the unit circle, the first at angle 0.
inline TriangleMesh polygon(int n, int rings) {
    std::vector<Vector> points = {Vector::Zero()};
    for (int ring = 1; ring <= rings; ++ring)
        for (int i = 0; i < n * ring; ++i) {
            const Complex a = std::polar(1.0, 2 * pi * (i / ring) / n),
                          b = std::polar(1.0, 2 * pi * (i / ring + 1) / n);
            points.push_back(
                in_plane((a + (b - a) * (static_cast<double>(i % ring) / ring)) * (static_cast<double>(ring) / rings)));
        }
    return make_mesh(points, testing::concentric_triangles(n, rings));
}

// The square [-1, 1]^2 with round holes of `radius` in the middle of its left and right halves; 6 n edges per half.
inline TriangleMesh two_holes(int n, double radius) {
    std::vector<Vector> points;
    std::vector<Eigen::Vector3i> triangles;
    std::map<std::pair<long, long>, int> ids;
    const auto vertex = [&](Complex z) {
        const auto [place, fresh] =
            ids.try_emplace({std::lround(z.real() * 1e9), std::lround(z.imag() * 1e9)}, points.size());
        if (fresh) points.push_back(in_plane(z));
        return place->second;
    };
    for (const double middle : {-0.5, 0.5}) {
        std::vector<Complex> rim;  // counter-clockwise, from the middle of the half
        for (int i = 0; i < n; ++i) rim.emplace_back(-0.5 + 1.0 * i / n, -1);
        for (int i = 0; i < 2 * n; ++i) rim.emplace_back(0.5, -1 + 1.0 * i / n);
        for (int i = 0; i < n; ++i) rim.emplace_back(0.5 - 1.0 * i / n, 1);
        for (int i = 0; i < 2 * n; ++i) rim.emplace_back(-0.5, 1 - 1.0 * i / n);
        const auto count = static_cast<int>(rim.size());
        const auto at = [&](int ring, int i) {
            const Complex far = rim[i % count], near = radius * far / std::abs(far);
            return vertex(middle + near + (far - near) * (static_cast<double>(ring) / n));
        };
        for (int ring = 0; ring < n; ++ring)
            for (int i = 0; i < count; ++i) {
                const int a = at(ring, i), b = at(ring + 1, i), c = at(ring + 1, i + 1), d = at(ring, i + 1);
                triangles.insert(triangles.end(), {{a, b, c}, {a, c, d}});
            }
    }
    return make_mesh(points, triangles);
}

struct Source {
    Complex at;
    int index_times_four;
};

inline SingularPattern pattern_of(const SurfaceDomain& domain, const std::vector<Source>& sources) {
    SingularPattern pattern;
    for (const Source& s : sources) pattern.points.push_back(imposed_point(domain, in_plane(s.at), s.index_times_four));
    return pattern;
}

// H on the unit disk but for a constant; boundary points by their own term.
inline double disk_potential(const std::vector<Source>& sources, Complex z) {
    double sum = 0;
    for (const Source& s : sources) {
        const double k = s.index_times_four / 4.0;
        sum += std::abs(s.at) > 1 - 1e-9 ? 2 * k * std::log(std::abs(z - s.at))
                                         : k * std::log(std::abs(z - s.at) * std::abs(1.0 - std::conj(s.at) * z));
    }
    return sum;
}

struct Errors {
    double largest, root_mean_square;
};

// Of H against `exact`, up to a constant, at vertices where `counts`.
inline Errors potential_errors(const ImposedField& field, const std::function<double(const Vector&)>& exact,
                               const std::function<bool(const Vector&)>& counts) {
    std::vector<double> differences;
    const Points& vertices = field.field.domain.mesh().vertices;
    for (Index v = 0; v < vertices.rows(); ++v)
        if (counts(vertices.row(v))) differences.push_back(field.log_size[v] - exact(vertices.row(v)));
    double mean = 0, largest = 0, squares = 0;
    for (const double d : differences) mean += d / static_cast<double>(differences.size());
    for (const double d : differences) {
        largest = std::max(largest, std::abs(d - mean));
        squares += (d - mean) * (d - mean);
    }
    return {largest, std::sqrt(squares / static_cast<double>(differences.size()))};
}

inline std::function<bool(const Vector&)> farther(const std::vector<Source>& sources, double distance) {
    return [=](const Vector& x) {
        return std::all_of(sources.begin(), sources.end(),
                           [&](const Source& s) { return (x - in_plane(s.at)).norm() > distance; });
    };
}

// In (-pi/4, pi/4].
inline double modulo_quarter(double angle) { return angle - pi / 2 * std::ceil(angle / (pi / 2) - 0.5); }

// The points that surface_singularities finds, by vertex: t.
inline std::map<Index, int> found_indices(const DirectionField& field) {
    std::map<Index, int> found;
    for (const auto& p : surface_singularities(field).points) {
        const auto& mesh = field.domain.mesh();
        Index vertex = p.vertex;
        for (Index v = 0; vertex < 0 && v < mesh.vertices.rows(); ++v)
            if ((mesh.vertices.row(v).transpose() - p.position).norm() < 1e-3 * field.domain.mean_edge_length())
                vertex = v;
        found[vertex] += p.index_times_symmetry;
    }
    return found;
}

}  // namespace octafield::surface
