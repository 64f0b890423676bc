#include "octafield/surface/lines_metric.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "charted_lines.hpp"
#include "octafield/error.hpp"

namespace octafield::surface {
namespace {

constexpr double rounding = 1e-12;         // of lengths
constexpr double least_angle = 1e-3;       // between the lines, radians
constexpr double least_area = 0.5;         // of the least by a corner's metric
constexpr double least_metric = 1.0 / 64;  // of a metric; below it is that of space

class Metric {
public:
    explicit Metric(const NonOrthogonalField& field)
        : domain_(field.domain), charts_(field.domain), axes_(domain_.vertex_count()) {
        std::vector<Index> bad;
        for (Index v = 0; v < domain_.vertex_count(); ++v) {
            if (!charts_.used(v)) continue;
            const TwoLines lines = ordered({field.angles(v, 0), field.angles(v, 1)});
            if (angle_between(lines) < least_angle) bad.push_back(v);
            const double half = (lines.second - lines.first) / 2;
            axes_[v] = {(lines.first + lines.second) / 2, 2 * std::pow(std::cos(half), 2),
                        2 * std::pow(std::sin(half), 2)};
        }
        if (!bad.empty())
            throw GeometryError("the two lines at vertices " + first_few(bad) +
                                    " are next to parallel: no quad has such corners. Solve the field with another "
                                    "method (angles), a larger lambda or other corners",
                                "parallel_lines", bad);
        measure_edges();
        space_areas_ = domain_.areas();
    }

    LinesMetric result() {
        for (std::vector<Index> narrow = narrow_triangles(); !narrow.empty(); narrow = narrow_triangles()) damp(narrow);
        LinesMetric result;
        for (Index v = 0; v < domain_.vertex_count(); ++v) {
            if (axes_[v].part < 1) result.damped.push_back(v);
            result.least_part = std::min(result.least_part, axes_[v].part);
        }
        Eigen::VectorXd lengths(domain_.edge_count());
        for (Index e = 0; e < lengths.size(); ++e) lengths[e] = std::sqrt(square(e));
        const Eigen::VectorXd& in_space = domain_.edge_lengths();
        const bool alike = ((lengths - in_space).array().abs() <= rounding * in_space.array()).all();
        result.domain = alike ? domain_ : domain_.with_edge_lengths(std::move(lengths));
        return result;
    }

private:
    // F F^T has the bisectors of the lines as axes.
    struct Axes {
        double angle = 0;              // of the first one in the vertex's chart
        double first = 1, second = 1;  // eigenvalues of F F^T
        double part = 1;               // s
        double stretch(double direction) const {
            const double cosine = std::cos(direction - angle), sine = std::sin(direction - angle);
            return cosine * cosine * std::pow(first, -part) + sine * sine * std::pow(second, -part);
        }
        double area() const { return std::pow(first * second, -part / 2); }
    };

    // Directions of all edges at both ends, lower vertex first.
    void measure_edges() {
        directions_.resize(domain_.edge_count());
        const Triangles& triangles = domain_.mesh().triangles;
        for (Index t = domain_.triangle_count() - 1; t >= 0; --t)
            for (int k = 0; k < 3; ++k) {
                const int end = (k + 1) % 3;
                const Index from = triangles(t, k), to = triangles(t, end);
                const double leaving = charts_.leaving(3 * t + k);
                const double arriving =
                    charts_.leaving(3 * t + end) + charts_.scale(to) * domain_.corner_angles()(t, end);
                directions_[domain_.topology().triangle_edges(t, k)] =
                    from < to ? std::array{leaving, arriving} : std::array{arriving, leaving};
            }
    }

    // Of the length of an edge.
    double square(Index e) const {
        const auto ends = domain_.topology().edges.row(e);
        const double length = domain_.edge_lengths()[e];
        const double stretch = axes_[ends[0]].stretch(directions_[e][0]) + axes_[ends[1]].stretch(directions_[e][1]);
        return length * length * stretch / 2;
    }

    std::vector<Index> narrow_triangles() const {
        std::vector<double> squares(domain_.edge_count());
        for (Index e = 0; e < domain_.edge_count(); ++e) squares[e] = square(e);
        std::vector<Index> result;
        for (Index t = 0; t < domain_.triangle_count(); ++t) {
            std::array<double, 3> side{};
            double least = axes_[domain_.mesh().triangles(t, 0)].area();
            for (int k = 0; k < 3; ++k) {
                side[k] = squares[domain_.topology().triangle_edges(t, k)];
                least = std::min(least, axes_[domain_.mesh().triangles(t, k)].area());
            }
            const double wanted = least_area * least * space_areas_[t];
            // Heron: 16 area^2.
            const double sum = side[0] + side[1] + side[2];
            const double found = sum * sum - 2 * (side[0] * side[0] + side[1] * side[1] + side[2] * side[2]);
            const bool in_space = axes_[domain_.mesh().triangles(t, 0)].part == 0 &&
                                  axes_[domain_.mesh().triangles(t, 1)].part == 0 &&
                                  axes_[domain_.mesh().triangles(t, 2)].part == 0;
            if (!in_space && !(found >= 16 * wanted * wanted)) result.push_back(t);
        }
        return result;
    }

    void damp(const std::vector<Index>& triangles) {
        std::vector<bool> chosen(axes_.size(), false);
        for (const Index t : triangles) {
            const auto corners = domain_.mesh().triangles.row(t);
            const auto at_boundary = [&](Index v) { return charts_.on_boundary(v); };
            const bool any_inside = std::any_of(corners.begin(), corners.end(),
                                                [&](Index v) { return !at_boundary(v) && axes_[v].part > 0; });
            for (const Index v : corners)
                if (!any_inside || !at_boundary(v)) chosen[v] = true;
        }
        for (std::size_t v = 0; v < axes_.size(); ++v)
            if (chosen[v]) axes_[v].part = axes_[v].part > least_metric ? axes_[v].part / 2 : 0;
    }

    SurfaceDomain domain_;
    detail::VertexCharts charts_;
    std::vector<Axes> axes_;                         // (V)
    std::vector<std::array<double, 2>> directions_;  // (E) angles in the charts of both ends
    Eigen::VectorXd space_areas_;
};

}  // namespace

LinesMetric lines_metric(const NonOrthogonalField& field) {
    detail::require_fit(field);
    return Metric(field).result();
}

}  // namespace octafield::surface
