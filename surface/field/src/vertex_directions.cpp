#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "charts.hpp"
#include "crouzeix_raviart.hpp"
#include "octafield/surface/directions.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;

// Whether the direction at an edge is the edge's, to a millionth of a radian of the N-fold angle.
bool along_edge(Complex value, int symmetry) {
    return std::abs(value.imag()) <= 1e-6 * std::abs(value.real()) &&
           (symmetry % 2 == 0 ? value.real() > 0 : value.real() != 0);
}

// An edge leaving a vertex.
struct Spoke {
    Index edge;
    double map_angle;      // in the polar map
    double tangent_angle;  // of its projection onto the tangent plane
    double weight;         // half the angles of the corners beside it
    Complex value;         // of the field, from the outgoing direction
    bool feature;          // that the field follows
};

struct TangentFrame {
    Eigen::Vector3d x, y;
    Eigen::Vector3d at(double angle) const { return std::cos(angle) * x + std::sin(angle) * y; }
};

TangentFrame tangent_frame(const Eigen::Vector3d& normal) {
    if (normal.isZero(0)) return {Eigen::Vector3d::UnitX(), Eigen::Vector3d::UnitY()};  // opposite triangles cancel
    const Eigen::Vector3d x = normal.unitOrthogonal();
    return {x, normal.cross(x)};
}

// Mean of exp(i N angle) over the spokes: its length says how far they agree (1: fully).
struct Mean {
    double angle;  // in the tangent plane, one of N
    double agreement;
};

Mean mean_direction(const std::vector<Spoke>& spokes, int symmetry, bool features_only) {
    Complex sum = 0, anchor = 0;
    double weight = 0;
    for (const Spoke& spoke : spokes) {
        // The rotation that fits the polar map best to the projected edges.
        anchor += spoke.weight * std::polar(1.0, spoke.tangent_angle - spoke.map_angle);
        if (features_only && !spoke.feature) continue;
        sum += spoke.weight * spoke.value * std::polar(1.0, symmetry * spoke.map_angle);
        weight += spoke.weight;
    }
    return {std::arg(anchor) + std::arg(sum) / symmetry, weight > 0 ? std::abs(sum) / weight : 0};
}

// Of the N directions at angle + k 2 pi / N, the one nearest to `target`; ties go to the smaller angle.
double nearest_of(double angle, double target, int symmetry) {
    const double step = 2 * std::numbers::pi / symmetry;
    return angle + step * std::round((target - angle) / step - 1e-6);
}

double direction_angle(const std::vector<Spoke>& spokes, int symmetry, bool corner) {
    constexpr double pi = std::numbers::pi;
    // Below this the feature edges of a corner contradict each other, as three at 120 degrees do when N = 4.
    constexpr double least_agreement = 0.2;
    std::vector<const Spoke*> features;
    const Spoke* first = &spokes.front();
    for (const Spoke& spoke : spokes) {
        if (spoke.edge < first->edge) first = &spoke;
        if (spoke.feature) features.push_back(&spoke);
    }
    if (features.empty())
        return nearest_of(mean_direction(spokes, symmetry, false).angle, first->tangent_angle, symmetry);
    const auto along = [&](const Spoke& spoke) {
        return spoke.tangent_angle + (symmetry % 2 == 1 && spoke.value.real() < 0 ? pi : 0);
    };
    if (features.size() == 1) return along(*features[0]);
    if (features.size() == 2 && !corner) {
        const double reverse = features[1]->tangent_angle + pi;
        const double turn = std::remainder(reverse - features[0]->tangent_angle, 2 * pi);
        return along(*features[0]) + turn / 2;
    }
    const auto lowest =
        *std::min_element(features.begin(), features.end(), [](auto a, auto b) { return a->edge < b->edge; });
    const Mean mean = mean_direction(spokes, symmetry, true);
    if (mean.agreement < least_agreement) return along(*lowest);
    return nearest_of(mean.angle, lowest->tangent_angle, symmetry);
}

// Where right angles are not those in space nothing is averaged there.
Points directions_by_own_lengths(const DirectionField& field) {
    const detail::Charts charts(field.domain);
    const Points normals = vertex_normals(charts.mesh());
    Points directions = Points::Zero(charts.mesh().vertices.rows(), 3);
    for (const auto& fan : field.domain.fans().fans) {
        if (!directions.row(fan.vertex).isZero(0)) continue;
        const Index corner = field.domain.fans().corners[fan.first], t = corner / 3;
        const Index e = charts.topology().triangle_edges(t, corner % 3);
        const double sign = charts.topology().edges(e, 0) == fan.vertex || field.symmetry % 2 == 0 ? 1 : -1;
        const detail::Complex along = charts.side(t, corner % 3);
        const detail::Complex turn = std::polar(1.0, std::arg(sign * field.values[e]) / field.symmetry);
        const Eigen::RowVector3d lifted = charts.lift_vector(t, along * turn).transpose(),
                                 normal = normals.row(fan.vertex);
        directions.row(fan.vertex) = (lifted - lifted.dot(normal) * normal).normalized();
    }
    return directions;
}

}  // namespace

Points vertex_directions(const DirectionField& field) {
    if (field.domain.has_own_lengths()) return directions_by_own_lengths(field);
    const SurfaceDomain& domain = field.domain;
    const TriangleMesh& mesh = domain.mesh();
    const EdgeTopology& topology = domain.topology();
    const VertexFans& fans = domain.fans();
    const std::vector<detail::CornerLink> links = detail::corner_links(domain, field.symmetry);
    const Points normals = vertex_normals(mesh);
    std::vector<bool> is_corner(mesh.vertices.rows(), false);
    for (const Index v : domain.features().corners) is_corner[v] = true;

    Points directions = Points::Zero(mesh.vertices.rows(), 3);
    std::vector<Spoke> spokes;
    for (const auto& fan : fans.fans) {
        if (!directions.row(fan.vertex).isZero(0)) continue;
        const TangentFrame frame = tangent_frame(normals.row(fan.vertex));
        double total = 0;
        for (Index i = fan.first; i < fan.last; ++i) total += links[fans.corners[i]].angle;
        const double scale = fan.closed ? 2 * std::numbers::pi / total : 1;
        const auto spoke = [&](Index e, double map_angle, double weight) {
            const bool leaves_low = topology.edges(e, 0) == fan.vertex;
            const Eigen::RowVector3d along = (leaves_low ? 1 : -1) * (mesh.vertices.row(topology.edges(e, 1)) -
                                                                      mesh.vertices.row(topology.edges(e, 0)));
            const double sign = leaves_low || field.symmetry % 2 == 0 ? 1 : -1;
            return Spoke{e,
                         map_angle,
                         std::atan2(along.dot(frame.y), along.dot(frame.x)),
                         weight,
                         sign * field.values[e],
                         domain.is_feature()[e] && along_edge(field.values[e], field.symmetry)};
        };
        spokes.clear();
        double map_angle = 0, before = fan.closed ? links[fans.corners[fan.last - 1]].angle : 0;
        for (Index i = fan.first; i < fan.last; ++i) {
            const detail::CornerLink& link = links[fans.corners[i]];
            spokes.push_back(spoke(link.first, map_angle, (before + link.angle) / 2));
            map_angle += scale * link.angle;
            before = link.angle;
        }
        if (!fan.closed) spokes.push_back(spoke(links[fans.corners[fan.last - 1]].second, map_angle, before / 2));
        directions.row(fan.vertex) = frame.at(direction_angle(spokes, field.symmetry, is_corner[fan.vertex]));
    }
    return directions;
}

Points triangle_directions(const DirectionField& field) {
    const TriangleMesh& mesh = field.domain.mesh();
    const EdgeTopology& topology = field.domain.topology();
    const Points& normals = field.domain.normals();
    const std::vector<detail::CornerLink> links = detail::corner_links(field.domain, field.symmetry);
    std::optional<detail::Charts> charts;
    if (field.domain.has_own_lengths()) charts.emplace(field.domain);
    Points directions(mesh.triangles.rows(), 3);
    for (Index t = 0; t < directions.rows(); ++t) {
        const auto values = detail::local_values(links, field.values, t);
        const double angle = std::arg(values[0] + values[1] + values[2]) / field.symmetry;
        if (charts) {
            directions.row(t) = charts->lift_vector(t, std::polar(1.0, angle)).normalized();
            continue;
        }
        const auto edge = topology.edges.row(topology.triangle_edges(t, 0));
        const Eigen::Vector3d normal = normals.row(t);
        const Eigen::Vector3d x = (mesh.vertices.row(edge[1]) - mesh.vertices.row(edge[0])).normalized();
        directions.row(t) = std::cos(angle) * x + std::sin(angle) * normal.cross(x);
    }
    return directions;
}

}  // namespace octafield::surface
