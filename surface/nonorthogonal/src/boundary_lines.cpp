#include "boundary_lines.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
// Interior angles this near to a bound (radians) lie on it.
constexpr double rounding = 1e-6;
// Two given lines are at least this far apart (radians).
constexpr double least_between = 1e-3;

std::string degrees(double angle) {
    const std::string text = std::to_string(std::round(angle * 1800 / pi) / 10);
    return text.substr(0, text.find('.') + 2) + " degrees";
}

bool is_corner(int quads) { return quads % 2 != 0; }

// Angle from the boundary to the next line counter-clockwise, on the side that begins at a corner and on the one that
// ends there.
double leaving_angle(double phi, int quads) { return phi - (quads - 1) / 2 * pi; }
double arriving_angle(double phi, int quads) { return pi - leaving_angle(phi, quads); }

bool fits(double phi, int quads) {
    if (!is_corner(quads)) return std::abs(phi - quads * pi / 2) < pi;
    const double angle = leaving_angle(phi, quads);
    return angle > least_between && angle < pi - least_between;
}

std::vector<Index> following_vertices(const SurfaceDomain& domain, const VertexCharts& charts) {
    std::vector<Index> next(domain.vertex_count(), -1);
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (!charts.on_boundary(v)) continue;
        const Index corner = domain.fans().corners[charts.fan(v).first];
        next[v] = domain.mesh().triangles(corner / 3, (corner % 3 + 1) % 3);
    }
    return next;
}

void require_corners(const std::vector<CornerQuads>& corners, const VertexCharts& charts, Index vertices) {
    std::vector<Index> outside, twice, seen;
    for (const auto& [vertex, quads] : corners) {
        if (vertex < 0 || vertex >= vertices || !charts.on_boundary(vertex)) outside.push_back(vertex);
        seen.push_back(vertex);
    }
    std::sort(seen.begin(), seen.end());
    for (std::size_t i = 1; i < seen.size(); ++i)
        if (seen[i] == seen[i - 1] && (twice.empty() || twice.back() != seen[i])) twice.push_back(seen[i]);
    if (!outside.empty())
        throw InvalidInput("corners: quads are given for vertices " + first_few(outside) +
                               ", which are not on the boundary of the surface; leave them out",
                           "not_on_boundary", outside);
    if (!twice.empty())
        throw InvalidInput(
            "corners: quads are given more than once for vertices " + first_few(twice) + "; keep one of each",
            "given_twice", twice);
}

std::vector<int> corner_quads(const SurfaceDomain& domain, const VertexCharts& charts,
                              const NonOrthogonalFieldOptions& options) {
    require_corners(options.corners, charts, domain.vertex_count());
    std::vector<int> quads(domain.vertex_count(), 0);
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (charts.on_boundary(v)) quads[v] = quads_of_angle(charts.total(v), options.corner_angle);
    for (const auto& corner : options.corners) quads[corner.vertex] = corner.quads;
    std::vector<Index> bad;
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (charts.on_boundary(v) && (quads[v] < 1 || !fits(charts.total(v), quads[v]))) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput("the interior angle of " + degrees(charts.total(bad.front())) + " at vertex " +
                               std::to_string(bad.front()) + " cannot hold " + std::to_string(quads[bad.front()]) +
                               " quads between lines along the boundary (vertices " + first_few(bad) +
                               "): give such vertices another number in `corners`, 1 for angles below 180 degrees, 2 "
                               "for a smooth boundary, 3 for angles above 180",
                           "bad_corner", bad);
    return quads;
}

// The side that begins at `start` (a corner, or any vertex of a curve without corners): angles of its second lines.
void spread_side(const SurfaceDomain& domain, const VertexCharts& charts, Index start, BoundaryLines& boundary) {
    const auto length = [&](Index v) {
        return (domain.mesh().vertices.row(boundary.next[v]) - domain.mesh().vertices.row(v)).norm();
    };
    double whole = length(start);
    Index end = boundary.next[start];
    for (; !boundary.is_held[end] && end != start; end = boundary.next[end]) whole += length(end);
    const bool cornered = boundary.is_held[start];
    const double first = cornered ? leaving_angle(charts.total(start), boundary.quads[start]) : pi / 2;
    const double last = cornered ? arriving_angle(charts.total(end), boundary.quads[end]) : pi / 2;
    double gone = 0;
    for (Index v = start;;) {
        if (!is_corner(boundary.quads[v])) {
            const double along = (charts.total(v) - boundary.quads[v] * pi / 2) / 2;
            boundary.lines[v] = {along, along + first + gone / whole * (last - first)};
        }
        gone += length(v);
        v = boundary.next[v];
        if (v == end) break;
    }
}

}  // namespace

int quads_of_angle(double phi, double corner_angle) {
    const int half_turns = static_cast<int>(std::floor((phi + corner_angle - rounding) / pi));
    return std::max(1, 2 * half_turns + (phi > half_turns * pi + corner_angle + rounding ? 1 : 0));
}

BoundaryLines boundary_lines(const SurfaceDomain& domain, const VertexCharts& charts,
                             const NonOrthogonalFieldOptions& options) {
    BoundaryLines boundary;
    boundary.quads = corner_quads(domain, charts, options);
    boundary.next = following_vertices(domain, charts);
    boundary.lines.assign(domain.vertex_count(), {0, 0});
    boundary.is_held.assign(domain.vertex_count(), false);
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (!is_corner(boundary.quads[v])) continue;
        boundary.is_held[v] = true;
        boundary.lines[v] = {0, leaving_angle(charts.total(v), boundary.quads[v])};
    }
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (boundary.is_held[v]) spread_side(domain, charts, v, boundary);
    for (Index v = 0; v < domain.vertex_count(); ++v)  // curves without corners: every line is still (0, 0)
        if (boundary.next[v] >= 0 && boundary.lines[v].first == boundary.lines[v].second)
            spread_side(domain, charts, v, boundary);
    return boundary;
}

}  // namespace octafield::surface::detail
