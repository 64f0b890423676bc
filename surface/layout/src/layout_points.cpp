#include "layout_points.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double quarter = std::numbers::pi / 2;

std::map<Index, int> index_of_vertex(const ImposedField& field, const std::vector<Index>& cut_vertices) {
    std::map<Index, int> found;
    for (const CornerQuads& corner : field.pattern.corners) found[corner.vertex] = 2 - corner.quads;
    for (std::size_t i = 0; i < field.point_vertices.size(); ++i)
        found[field.point_vertices[i]] = field.pattern.points[i].index_times_four;
    std::erase_if(found, [](const auto& entry) { return entry.second == 0; });
    for (const Index v : cut_vertices) found.emplace(v, 0);
    return found;
}

// The field against the spokes, psi, goes down by quarter turns at the separatrices; linear between spokes.
void add_slots(const ImposedField& field, const LocalField& local, LayoutPoint& point) {
    const Charts& charts = local.charts();
    const auto own_angle = [&](Index t, int side) {
        return std::arg(field.field.values[charts.topology().triangle_edges(t, side)]) / 4;
    };
    const Index first = point.corners.front();
    double psi = point.boundary ? 0 : own_angle(first / 3, first % 3);
    if (!point.boundary && psi < 0) psi += quarter;
    const int count = point.boundary ? point.quads - 1 : point.quads;
    int level = point.boundary ? -1 : 0;
    for (std::size_t i = 0; i < point.corners.size(); ++i) {
        const Index t = point.corners[i] / 3;
        const int k = point.corners[i] % 3, back = (k + 2) % 3;
        const double angle = charts.domain().corner_angles()(t, k);
        double next =
            psi - angle + local.angle(t, charts.on_side(t, back, 0.5)) - local.angle(t, charts.on_side(t, k, 0.5));
        const double exact = own_angle(t, back);
        next = exact + quarter * std::round((next - exact) / quarter);
        while (static_cast<int>(point.slots.size()) < count && next < level * quarter) {
            const double part = psi > next ? std::clamp((psi - level * quarter) / (psi - next), 0.0, 1.0) : 0.0;
            point.slots.push_back(point.starts[i] + part * angle);
            --level;
        }
        psi = next;
    }
    // The last one may be on the first spoke again, but for rounding.
    if (static_cast<int>(point.slots.size()) == count - 1 && psi < level * quarter + 1e-6)
        point.slots.push_back(point.angle);
    if (static_cast<int>(point.slots.size()) != count)
        throw SolverError("of the " + std::to_string(count) + " separatrices at vertex " +
                              std::to_string(point.vertex) + " only " + std::to_string(point.slots.size()) +
                              " can be told; refine the mesh there",
                          "unclear_directions", {point.vertex});
}

}  // namespace

LayoutPoints layout_points(const ImposedField& field, const LocalField& local, const std::vector<Index>& cut_vertices,
                           bool cuts_inside) {
    LayoutPoints result;
    result.of_vertex.assign(local.domain().vertex_count(), -1);
    std::map<Index, std::size_t> fan_of;
    const VertexFans& fans = local.domain().fans();
    for (std::size_t f = 0; f < fans.fans.size(); ++f) fan_of.emplace(fans.fans[f].vertex, f);
    for (const auto& [vertex, index] : index_of_vertex(field, cut_vertices)) {
        const auto place = fan_of.find(vertex);
        if (place == fan_of.end() || (index == 0 && !cuts_inside && fans.fans[place->second].closed))
            throw InvalidInput("cuts start at vertices of the boundary; vertex " + std::to_string(vertex) + " is none",
                               "bad_option", {vertex});
        const VertexFans::Fan& fan = fans.fans[place->second];
        LayoutPoint point{vertex, index, (fan.closed ? 4 : 2) - index, !fan.closed};
        if (point.quads < 1)
            throw InvalidInput("vertex " + std::to_string(vertex) +
                                   " has no quads: its corner is infinitely long in quad coordinates; give it one "
                                   "quad, and a point of valence 3 inside",
                               "infinite_corner", {vertex});
        for (Index c = fan.first; c < fan.last; ++c) {
            const Index corner = fans.corners[c];
            point.corners.push_back(corner);
            point.starts.push_back(point.angle);
            point.angle += local.domain().corner_angles()(corner / 3, corner % 3);
        }
        point.power = point.quads * quarter / point.angle;
        add_slots(field, local, point);
        result.of_vertex[vertex] = static_cast<Index>(result.points.size());
        result.points.push_back(std::move(point));
    }
    return result;
}

}  // namespace octafield::surface::detail
