// Jittered squares, sizes by formula and angles in the plane, for the tests of sized fields.
#pragma once

#include <random>

#include "direction_field_fixtures.hpp"
#include "octafield/surface/reached_sizes.hpp"
#include "octafield/surface/sized_field.hpp"
#include "sized_system.hpp"

namespace octafield::surface {

// The unit square, vertices inside moved by up to 0.3 of an edge.
inline TriangleMesh jittered_square(int n, unsigned seed = 1) {
    TriangleMesh mesh = square(n);
    std::mt19937 engine(seed);
    std::uniform_real_distribution<double> shift(-0.3 / n, 0.3 / n);
    for (Index v = 0; v < mesh.vertices.rows(); ++v) {
        const Vector x = mesh.vertices.row(v), move(shift(engine), shift(engine), 0);
        if (x.head(2).minCoeff() > 0 && x.head(2).maxCoeff() < 1) mesh.vertices.row(v) += move.transpose();
    }
    return mesh;
}

inline Eigen::VectorXd at_points(const Points& points, const std::function<double(const Vector&)>& size) {
    Eigen::VectorXd values(points.rows());
    for (Index i = 0; i < values.size(); ++i) values[i] = size(points.row(i));
    return values;
}

inline WantedSizes sizes_of(const SurfaceDomain& domain, const std::function<double(const Vector&)>& size) {
    return wanted_sizes(domain, at_points(domain.mesh().vertices, size), at_points(edge_midpoints(domain), size));
}

inline SizedFieldOptions unaligned() {
    SizedFieldOptions options;
    options.boundary_alignment = options.feature_alignment = Alignment::none;
    return options;
}

// exp(i N theta), theta from the x axis, at vertex v of a surface in the plane.
inline Complex turned_to_x(const SizedField& field, Index v) {
    return std::pow(flat(field.directions.row(v)), field.field.symmetry);
}

// The largest difference from exp(i N angle) over the vertices at least `beyond` from the origin, after the best
// constant rotation, radians of N theta.
inline double largest_error(const SizedField& field, const std::function<double(const Vector&)>& angle,
                            double beyond = 0) {
    const Points& points = field.field.domain.mesh().vertices;
    const auto difference = [&](Index v) {
        return turned_to_x(field, v) * std::polar(1.0, -field.field.symmetry * angle(points.row(v)));
    };
    Complex mean = 0;
    for (Index v = 0; v < points.rows(); ++v) mean += difference(v);
    double most = 0;
    for (Index v = 0; v < points.rows(); ++v)
        if (points.row(v).norm() >= beyond) most = std::max(most, std::abs(std::arg(difference(v) * std::conj(mean))));
    return most;
}

inline int sum_of(const std::vector<int>& indices) { return std::accumulate(indices.begin(), indices.end(), 0); }

}  // namespace octafield::surface
