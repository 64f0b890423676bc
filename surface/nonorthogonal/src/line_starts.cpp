#include "line_starts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "walk_straight.hpp"

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr int samples = 360;
constexpr double boundary_width = 0.02;  // lines at a corner nearer than this (radians) to the boundary run along it

SeparatrixStart straight_way(const ChartedLines& field, const LinesTracer& tracer, const SurfaceSingularity& point,
                             double angle, double length) {
    const Complex exact = field.lower(point.triangle, point.position);
    const Complex inner = exact + 1e-3 * (field.centroid(point.triangle) - exact);  // not on a side
    SeparatrixStart start{{point.position}, {}, {point.triangle, inner, std::polar(1.0, angle)}};
    walk_straight(field, tracer, length, start.place, start.points, start.triangles);
    return start;
}

// Merges the nearest angles of a circle until there are `count`.
void thin_out(std::vector<double>& angles, std::size_t count) {
    while (angles.size() > count) {
        std::size_t nearest = 0;
        double least = 4 * pi;
        for (std::size_t i = 0; i < angles.size(); ++i) {
            const double gap = i + 1 < angles.size() ? angles[i + 1] - angles[i] : angles[0] + 2 * pi - angles[i];
            if (gap >= least) continue;
            least = gap;
            nearest = i;
        }
        angles[nearest] = std::fmod(angles[nearest] + least / 2, 2 * pi);
        angles.erase(angles.begin() + static_cast<std::ptrdiff_t>((nearest + 1) % angles.size()));
        std::sort(angles.begin(), angles.end());
    }
}

// Where the angle from the straight way to the nearest direction falls through zero. Between two directions, where
// another one becomes the nearest, it jumps up.
std::vector<double> straight_angles(const ChartedLines& field, const LinesTracer& tracer,
                                    const SurfaceSingularity& point, double length) {
    std::vector<double> off(samples + 1), angles;
    const double step = 2 * pi / samples;
    for (int i = 0; i < samples; ++i) {
        const Place place = straight_way(field, tracer, point, i * step, length).place;
        off[i] = std::arg(field.direction(place.triangle, place.at, place.heading) / place.heading);
    }
    off[samples] = off[0];
    for (int i = 0; i < samples; ++i)
        if (off[i] > 0 && off[i + 1] <= 0 && off[i] - off[i + 1] < pi / 4)
            angles.push_back(step * (i + off[i] / (off[i] - off[i + 1])));
    return angles;
}

}  // namespace

std::vector<SeparatrixStart> starts_of_point(const ChartedLines& field, const SurfaceSingularity& point,
                                             const LinesTracer& tracer) {
    const int count = 4 - point.index_times_symmetry;
    if (count <= 0) return {};
    const double edge = 1.5 * std::sqrt(field.twice_area(point.triangle));  // of an equilateral triangle
    std::vector<double> angles;
    double length = edge;
    for (const double part : {1.0, 1.5, 0.7}) {  // where the mesh hides a direction at one distance
        length = part * edge;
        angles = straight_angles(field, tracer, point, length);
        if (static_cast<int>(angles.size()) >= count) break;
    }
    thin_out(angles, static_cast<std::size_t>(count));
    std::vector<SeparatrixStart> starts;
    for (const double angle : angles) starts.push_back(straight_way(field, tracer, point, angle, length));
    return starts;
}

std::vector<SeparatrixStart> starts_of_corner(const ChartedLines& field, const NonOrthogonalField& lines,
                                              const VertexCharts& vertices, Index vertex) {
    const double phi = vertices.total(vertex);
    std::vector<double> angles;
    for (int k = 0; k < 2; ++k)
        for (double angle = std::fmod(lines.angles(vertex, k), pi); angle < phi - boundary_width; angle += pi)
            if (angle > boundary_width) angles.push_back(angle);
    std::sort(angles.begin(), angles.end());
    std::vector<SeparatrixStart> starts;
    const VertexFans::Fan& fan = vertices.fan(vertex);
    const auto& corners = field.domain().fans().corners;
    for (const double angle : angles) {
        Index place = fan.first;
        while (place + 1 < fan.last && vertices.leaving(corners[place + 1]) <= angle) ++place;
        const Index corner = corners[place];
        const double width = field.domain().corner_angles()(corner / 3, corner % 3);
        starts.push_back(start_in_corner(field, corner, width, angle - vertices.leaving(corner)));
    }
    return starts;
}

}  // namespace octafield::surface::detail
