#include "mapped_chart.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "disk_map.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double left_out = 0.05;  // of the area, where the least values are not counted
constexpr int stretch_rounds = 10;

Eigen::Matrix2d as_matrix(const Eigen::Vector3d& metric) {
    Eigen::Matrix2d m;
    m << metric[0], metric[1], metric[1], metric[2];
    return m;
}

// The linear map of determinant 1 after which the sum of area * log(s + 1 / s), s the conformity, is least: one-to-one
// maps stay so. Rounds of weighted sums of (s + 1 / s), whose best map is a square root of the mean metric.
Eigen::Matrix2d best_stretch(const ChartMesh& mesh, const PlanePoints& uv) {
    std::vector<std::pair<double, Eigen::Matrix2d>> metrics;  // of determinant 1
    for (Index t = 0; t < mesh.triangle_count(); ++t) {
        const Eigen::Matrix2d m = as_matrix(pulled_metric(mesh, t, corners_of(uv, mesh.triangles, t)));
        const double root = std::sqrt(m.determinant());
        if (root > 0 && std::isfinite(root)) metrics.emplace_back(mesh.twice_area(t), m / root);
    }
    Eigen::Matrix2d inverse = Eigen::Matrix2d::Identity(), mean = inverse;  // of the map's square
    for (int i = 0; i < stretch_rounds; ++i) {
        Eigen::Matrix2d sum = Eigen::Matrix2d::Zero();
        for (const auto& [area, m] : metrics) sum += area / (m * inverse).trace() * m;
        const double root = std::sqrt(sum.determinant());
        if (!(root > 0 && std::isfinite(root))) break;
        mean = sum / root;
        inverse = mean.inverse();
    }
    // The longer axis of the ellipse to the first coordinate.
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(mean);
    const Eigen::Vector2d longer = axes.eigenvectors().col(1), roots = axes.eigenvalues().cwiseSqrt();
    Eigen::Matrix2d stretch;
    stretch << roots[1] * longer[0], roots[1] * longer[1], -roots[0] * longer[1], roots[0] * longer[0];
    return stretch;
}

// The value that all but a twentieth of the area has at least.
double low_value(const Eigen::VectorXd& values, const Eigen::VectorXd& areas) {
    std::vector<Index> order(values.size());
    std::iota(order.begin(), order.end(), 0);
    std::sort(order.begin(), order.end(), [&](Index a, Index b) { return values[a] < values[b]; });
    double left = left_out * areas.sum();
    for (const Index t : order)
        if ((left -= areas[t]) < 0) return values[t];
    return values[order.back()];
}

}  // namespace

MappedChart mapped_chart(ChartMesh mesh) {
    MappedChart chart;
    chart.uv = disk_map(mesh, true);
    chart.one_to_one = not_positive(chart.uv, mesh.triangles).empty();
    const Index count = mesh.triangle_count();
    Eigen::VectorXd areas(count), scales(count);
    chart.conformity.resize(count);
    if (chart.one_to_one) {
        chart.uv = chart.uv * best_stretch(mesh, chart.uv).transpose();
        chart.one_to_one = not_positive(chart.uv, mesh.triangles).empty();
    }
    for (Index t = 0; t < count; ++t) {
        const Eigen::Vector2d values = stretches(mesh, t, corners_of(chart.uv, mesh.triangles, t));
        areas[t] = mesh.twice_area(t) / 2;
        chart.conformity[t] = std::max(0.0, values[1] / values[0]);
        scales[t] = values[1] > 0 ? 1 / std::sqrt(values[0] * values[1]) : 0;
    }
    const double area = areas.sum(), mean = std::sqrt(std::numbers::pi / area);
    chart.scale = Eigen::VectorXd::Constant(mesh.vertex_count(), std::numeric_limits<double>::infinity());
    for (Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            double& least = chart.scale[mesh.triangles(t, k)];
            least = std::min(least, scales[t] / mean);
        }
    AtlasChart& figures = chart.figures;
    figures.triangles = count;
    figures.area = area;
    figures.loops = static_cast<int>(mesh.loops.size());
    figures.conformity = low_value(chart.conformity, areas);
    figures.least_conformity = chart.conformity.minCoeff();
    figures.mean_conformity = chart.conformity.dot(areas) / area;
    figures.evenness = low_value(scales / mean, areas);
    chart.mesh = std::move(mesh);
    return chart;
}

}  // namespace octafield::surface::detail
