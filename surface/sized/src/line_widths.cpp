#include "line_widths.hpp"

#include <cmath>
#include <numbers>

namespace octafield::surface::detail {

namespace {

// |f| at a centroid, where it is 1 at the middles of edges, above which f is smooth enough to be averaged: it turns by
// less than about 1.2 radians per edge length.
constexpr double least_smooth = 0.97;

// grad alpha, as a vector in the chart; 0 where there is no direction.
Complex slope_at(const ChartedField& field, Index t, Complex z) {
    const Complex f = field.value(t, z);
    if (f == 0.0) return 0;
    const Complex by_x = field.slope(t, 1), by_y = field.slope(t, Complex(0, 1));
    return Complex(cross(f, by_x), cross(f, by_y)) / (std::norm(f) * field.symmetry());
}

}  // namespace

AngleSlopes::AngleSlopes(const ChartedField& field)
    : field_(field), is_smooth_(field.mesh().triangles.rows(), true), corners_(field.mesh().triangles.rows()) {
    const VertexCharts vertices(field.domain());
    const Triangles& triangles = field.mesh().triangles;
    const Index count = field.domain().triangle_count();
    Eigen::VectorXcd sums = Eigen::VectorXcd::Zero(field.domain().vertex_count());
    Eigen::VectorXd areas = Eigen::VectorXd::Zero(sums.size());
    std::vector<bool> is_rough(sums.size(), false);
    for (Index t = 0; t < count; ++t) {
        const Complex slope = slope_at(field, t, field.centroid(t));
        const bool rough = std::abs(field.value(t, field.centroid(t))) < least_smooth;
        for (int k = 0; k < 3; ++k) {
            const Index v = triangles(t, k);
            if (rough) is_rough[v] = true;
            sums[v] += field.twice_area(t) * slope * std::polar(1.0, -vertices.into_triangle(field, 3 * t + k));
            areas[v] += field.twice_area(t);
        }
    }
    for (Index t = 0; t < count; ++t)
        for (int k = 0; k < 3; ++k) {
            const Index v = triangles(t, k);
            if (is_rough[v]) is_smooth_[t] = false;
            corners_[t][k] = sums[v] / areas[v] * std::polar(1.0, vertices.into_triangle(field, 3 * t + k));
        }
}

double AngleSlopes::along(Index t, Complex z, Complex step) const {
    if (!is_smooth_[t]) return dot(slope_at(field_, t, z), step);
    Complex slope = 0;
    for (int k = 0; k < 3; ++k) {
        const int next = (k + 1) % 3;
        slope += cross(field_.side(t, next), z - field_.corners(t)[next]) / field_.twice_area(t) * corners_[t][k];
    }
    return dot(slope, step);
}

std::vector<double> width_growth(const AngleSlopes& slopes, const Streamline& line) {
    const Charts& charts = slopes.field();
    std::vector<double> growth{0};
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i];
        const Complex from = charts.lower(t, line.points.row(static_cast<Index>(i))),
                      to = charts.lower(t, line.points.row(static_cast<Index>(i) + 1));
        growth.push_back(growth.back() + slopes.along(t, (from + to) / 2.0, Complex(0, 1) * (to - from)));
    }
    return growth;
}

void LineIndex::add(Index number, const Streamline& line) {
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i], row = static_cast<Index>(i);
        segments_[t].push_back(
            {number, row, charts_.lower(t, line.points.row(row)), charts_.lower(t, line.points.row(row + 1))});
    }
}

std::vector<LineCrossing> LineIndex::crossings(Index number, const Streamline& line) const {
    const double least_sine = std::sin(std::numbers::pi / 8);
    std::vector<LineCrossing> found;
    for (std::size_t i = 0; i < line.triangles.size(); ++i) {
        const Index t = line.triangles[i], row = static_cast<Index>(i);
        const Complex from = charts_.lower(t, line.points.row(row)), to = charts_.lower(t, line.points.row(row + 1));
        for (const Segment& other : segments_[t]) {
            const Complex along = to - from, across = other.to - other.from;
            const double sine = cross(along, across);
            if (!(std::abs(sine) > least_sine * std::abs(along) * std::abs(across))) continue;
            const double here = cross(other.from - from, across) / sine, there = cross(other.from - from, along) / sine;
            // Half-open, so that a crossing at the common end of two segments counts once.
            if (here < 0 || here >= 1 || there < 0 || there >= 1) continue;
            found.push_back({{number, row, here}, {other.line, other.segment, there}, t, from + here * along});
        }
    }
    return found;
}

}  // namespace octafield::surface::detail
