#include "vertex_charts.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;

double wrapped(double angle) { return angle - 2 * pi * std::ceil((angle - pi) / (2 * pi)); }

}  // namespace

VertexCharts::VertexCharts(const SurfaceDomain& domain)
    : domain_(domain),
      fan_(domain.vertex_count(), -1),
      total_(domain.vertex_count(), 0),
      scale_(domain.vertex_count(), 1),
      leaving_(3 * domain.triangle_count(), 0),
      transport_(domain.edge_count(), 0),
      x_(Points::Zero(domain.vertex_count(), 3)),
      y_(Points::Zero(domain.vertex_count(), 3)) {
    std::vector<Index> bad;
    const auto& fans = domain_.fans().fans;
    for (std::size_t f = 0; f < fans.size(); ++f) {
        Index& place = fan_[fans[f].vertex];
        if (place >= 0 && (bad.empty() || bad.back() != fans[f].vertex)) bad.push_back(fans[f].vertex);
        place = static_cast<Index>(f);
    }
    if (!bad.empty())
        throw GeometryError("parts of the surface touch at vertices " + first_few(bad) +
                                " only, which have no tangent plane then; give each part its own vertex there",
                            "non_manifold_vertex", bad);
    measure_fans();
    measure_edges();
    find_axes();
}

void VertexCharts::measure_fans() {
    const auto& corner_angles = domain_.corner_angles();
    const auto& corners = domain_.fans().corners;
    for (const auto& fan : domain_.fans().fans) {
        double total = 0;
        for (Index i = fan.first; i < fan.last; ++i) total += corner_angles(corners[i] / 3, corners[i] % 3);
        total_[fan.vertex] = total;
        const double scale = scale_[fan.vertex] = fan.closed ? 2 * pi / total : 1;
        double angle = 0;
        for (Index i = fan.first; i < fan.last; ++i) {
            leaving_[corners[i]] = angle;
            angle += scale * corner_angles(corners[i] / 3, corners[i] % 3);
        }
    }
}

void VertexCharts::measure_edges() {
    const EdgeTopology& topology = domain_.topology();
    const Triangles& triangles = domain_.mesh().triangles;
    for (Index t = domain_.triangle_count() - 1; t >= 0; --t)
        for (int k = 0; k < 3; ++k) {
            const int end = (k + 1) % 3;
            const Index from = triangles(t, k), to = triangles(t, end);
            const double arriving = leaving_[3 * t + end] + scale_[to] * domain_.corner_angles()(t, end);
            const double grows = wrapped(arriving + pi - leaving_[3 * t + k]);
            transport_[topology.triangle_edges(t, k)] = from < to ? grows : -grows;
        }
}

double VertexCharts::into_triangle(const Charts& charts, Index corner) const {
    const Index t = corner / 3;
    const int k = corner % 3;
    const double angle = domain_.corner_angles()(t, k);
    return std::arg(charts.side(t, k)) + angle / 2 - leaving_[corner] -
           scale_[domain_.mesh().triangles(t, k)] * angle / 2;
}

// Turned so that the polar map fits the edges projected onto the tangent plane best.
void VertexCharts::find_axes() {
    const Triangles& triangles = domain_.mesh().triangles;
    const Points normals = vertex_normals(domain_.mesh());
    for (const auto& fan : domain_.fans().fans) {
        Eigen::Vector3d normal = normals.row(fan.vertex);
        if (normal.isZero(0)) normal = domain_.normals().row(domain_.fans().corners[fan.first] / 3);
        const Eigen::Vector3d x = normal.unitOrthogonal(), y = normal.cross(x);
        Complex anchor = 0;
        for (Index i = fan.first; i < fan.last; ++i) {
            const Index corner = domain_.fans().corners[i], t = corner / 3;
            const double width = domain_.corner_angles()(t, corner % 3);
            for (const int other : {1, 2}) {
                const Index end = triangles(t, (corner % 3 + other) % 3);
                const Eigen::RowVector3d along =
                    domain_.mesh().vertices.row(end) - domain_.mesh().vertices.row(fan.vertex);
                const double here = leaving_[corner] + (other == 2 ? scale_[fan.vertex] * width : 0);
                anchor += width * std::polar(1.0, std::atan2(along.dot(y), along.dot(x)) - here);
            }
        }
        const double turn = std::arg(anchor);
        x_.row(fan.vertex) = std::cos(turn) * x + std::sin(turn) * y;
        y_.row(fan.vertex) = std::cos(turn) * y - std::sin(turn) * x;
    }
}

Eigen::RowVector3d VertexCharts::lifted(Index vertex, double angle) const {
    return std::cos(angle) * x_.row(vertex) + std::sin(angle) * y_.row(vertex);
}

double VertexCharts::lowered(Index vertex, const Eigen::RowVector3d& vector) const {
    return std::atan2(vector.dot(y_.row(vertex)), vector.dot(x_.row(vertex)));
}

}  // namespace octafield::surface::detail
