#include "octafield/surface/surface_domain.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "octafield/error.hpp"
#include "orientation.hpp"

namespace octafield::surface {
namespace {

std::atomic<long long> domains_made = 0;

// Sines of angles below this are rounding: cotangents would swamp every other entry of the stiffness matrix.
constexpr double smallest_sine = 1e-12;

void require_arrays(const TriangleMesh& mesh) {
    const Eigen::Index count = mesh.vertices.rows();
    std::vector<Index> bad;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        if (mesh.triangles.row(t).minCoeff() < 0 || mesh.triangles.row(t).maxCoeff() >= count) bad.push_back(t);
    if (!bad.empty())
        throw GeometryError("triangles " + first_few(bad) + " name vertices that do not exist; there are " +
                                std::to_string(count) + " vertices, numbered from 0",
                            "index_out_of_range", bad);
    for (Index v = 0; v < count; ++v)
        if (!mesh.vertices.row(v).allFinite()) bad.push_back(v);
    if (!bad.empty())
        throw GeometryError("the coordinates of " + std::to_string(bad.size()) + " vertices are not finite (" +
                                first_few(bad) + "); mend the file or leave their triangles out",
                            "non_finite", bad);
}

// The corner across the given edge of triangle t at the same vertex, -1 where the surface ends.
Index corner_across(const TriangleMesh& mesh, const EdgeTopology& topology, Index corner, Index edge) {
    const Index t = corner / 3, vertex = mesh.triangles(t, corner % 3);
    const Index other =
        topology.edge_triangles(edge, 0) == t ? topology.edge_triangles(edge, 1) : topology.edge_triangles(edge, 0);
    if (other < 0) return -1;
    for (int k = 0; k < 3; ++k)
        if (mesh.triangles(other, k) == vertex) return 3 * other + k;
    return -1;
}

VertexFans vertex_fans(const TriangleMesh& mesh, const EdgeTopology& topology) {
    const auto first_edge = [&](Index corner) { return topology.triangle_edges(corner / 3, corner % 3); };
    const auto second_edge = [&](Index corner) { return topology.triangle_edges(corner / 3, (corner % 3 + 2) % 3); };
    const Index corner_count = 3 * static_cast<Index>(mesh.triangles.rows());
    VertexFans result;
    result.corners.reserve(corner_count);
    std::vector<bool> done(corner_count, false);
    const auto run = [&](Index start, bool closed) {
        const Index first = static_cast<Index>(result.corners.size());
        for (Index c = start; c >= 0 && !done[c]; c = corner_across(mesh, topology, c, second_edge(c))) {
            done[c] = true;
            result.corners.push_back(c);
        }
        result.fans.push_back(
            {mesh.triangles(start / 3, start % 3), closed, first, static_cast<Index>(result.corners.size())});
    };
    for (Index c = 0; c < corner_count; ++c)
        if (topology.edge_triangles.row(first_edge(c)).minCoeff() < 0) run(c, false);
    for (Index c = 0; c < corner_count; ++c)
        if (!done[c]) run(c, true);
    std::stable_sort(result.fans.begin(), result.fans.end(),
                     [](const auto& a, const auto& b) { return a.vertex < b.vertex; });
    return result;
}

struct CornerAngles {
    Rows<double, 3> angles, cotangents;
};

CornerAngles angles_and_cotangents(const TriangleMesh& mesh) {
    CornerAngles result;
    result.angles.resize(mesh.triangles.rows(), 3);
    result.cotangents.resize(mesh.triangles.rows(), 3);
    std::vector<Index> degenerate, beyond;
    for (Index t = 0; t < mesh.triangles.rows(); ++t) {
        for (int k = 0; k < 3; ++k) {
            const Eigen::RowVector3d origin = mesh.vertices.row(mesh.triangles(t, k));
            const Eigen::RowVector3d a = mesh.vertices.row(mesh.triangles(t, (k + 1) % 3)) - origin;
            const Eigen::RowVector3d b = mesh.vertices.row(mesh.triangles(t, (k + 2) % 3)) - origin;
            const double sine = a.cross(b).norm(), cosine = a.dot(b);
            const double most = a.norm() * b.norm();
            const bool flat = !(sine > smallest_sine * most), square_fits = std::isnormal(most * most);
            const bool repeated = a.isZero(0) || b.isZero(0);
            if (flat && (square_fits || repeated) && (degenerate.empty() || degenerate.back() != t))
                degenerate.push_back(t);
            if (!square_fits && !repeated && (beyond.empty() || beyond.back() != t)) beyond.push_back(t);
            result.angles(t, k) = std::atan2(sine, cosine);
            result.cotangents(t, k) = cosine / sine;
        }
    }
    if (!beyond.empty())
        throw GeometryError("the squared areas of " + std::to_string(beyond.size()) + " triangles (" +
                                first_few(beyond) +
                                ") are beyond double precision; measure the surface in another unit of length",
                            "size_out_of_range", beyond);
    if (!degenerate.empty())
        throw GeometryError(std::to_string(degenerate.size()) + " triangles have no area (" + first_few(degenerate) +
                                "); repair or remesh the surface first",
                            "degenerate_triangle", degenerate);
    return result;
}

void require_lengths(const Eigen::VectorXd& lengths, Index edges) {
    if (lengths.size() != edges)
        throw InvalidInput("edge lengths are one number per edge, " + std::to_string(edges) + ", not " +
                               std::to_string(lengths.size()),
                           "bad_lengths");
    std::vector<Index> bad;
    for (Index e = 0; e < edges; ++e)
        if (!(lengths[e] > 0) || !std::isnormal(lengths[e] * lengths[e])) bad.push_back(e);
    if (!bad.empty())
        throw InvalidInput("the lengths of " + std::to_string(bad.size()) + " edges (" + first_few(bad) +
                               ") are not above 0, or their squares beyond double precision",
                           "bad_lengths", bad);
}

// Four times the area of the triangle with these sides; 0 or no number where there is none (Kahan, "Miscalculating
// area and angles of a needle-like triangle", 2014).
double four_areas(std::array<double, 3> sides) {
    std::sort(sides.begin(), sides.end(), std::greater<>());
    const auto [a, b, c] = sides;
    return std::sqrt((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)));
}

CornerAngles angles_and_cotangents(const Eigen::VectorXd& lengths, const EdgeTopology& topology) {
    CornerAngles result;
    result.angles.resize(topology.triangle_edges.rows(), 3);
    result.cotangents.resize(topology.triangle_edges.rows(), 3);
    std::vector<Index> bad;
    for (Index t = 0; t < topology.triangle_edges.rows(); ++t) {
        std::array<double, 3> sides{};
        for (int k = 0; k < 3; ++k) sides[k] = lengths[topology.triangle_edges(t, k)];
        const double area = four_areas(sides);
        bool flat = false;
        for (int k = 0; k < 3; ++k) {
            const double a = sides[k], b = sides[(k + 2) % 3], across = sides[(k + 1) % 3];
            const double cosine = a * a + b * b - across * across;
            flat = flat || !(area > 2 * smallest_sine * a * b);
            result.angles(t, k) = std::atan2(area, cosine);
            result.cotangents(t, k) = cosine / area;
        }
        if (flat) bad.push_back(t);
    }
    if (!bad.empty())
        throw GeometryError("with the edge lengths given, " + std::to_string(bad.size()) + " triangles (" +
                                first_few(bad) +
                                ") have a side as long as the other two: lengths change too fast there; remesh the "
                                "surface with shorter edges",
                            "no_triangle", bad);
    return result;
}

std::vector<bool> feature_flags(const FeatureGraph& ordered, const EdgeTopology& topology) {
    std::vector<bool> is_feature(topology.edges.rows());
    Index next = 0;  // both lists are in lexicographic order
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        const bool listed = next < ordered.edges.rows() && ordered.edges.row(next) == topology.edges.row(e);
        if (listed) ++next;
        is_feature[e] = listed || topology.edge_triangles.row(e).minCoeff() < 0;
    }
    return is_feature;
}

}  // namespace

SurfaceDomain::Parts SurfaceDomain::parts_of(TriangleMesh mesh) {
    require_arrays(mesh);
    if (mesh.triangles.rows() > 0) ++domains_made;
    const auto topology = std::make_shared<Topology>();
    const auto metric = std::make_shared<Metric>();
    topology->mesh = std::move(mesh);
    const TriangleMesh& kept = topology->mesh;
    topology->edges = detail::oriented_topology(kept);
    CornerAngles corners = angles_and_cotangents(kept);
    metric->corner_angles = std::move(corners.angles);
    metric->cotangents = std::move(corners.cotangents);
    topology->fans = vertex_fans(kept, topology->edges);
    topology->normals = triangle_normals(kept);
    const Edges& edges = topology->edges.edges;
    metric->edge_lengths.resize(edges.rows());
    double sum = 0;
    for (Index e = 0; e < edges.rows(); ++e)
        sum += metric->edge_lengths[e] = (kept.vertices.row(edges(e, 0)) - kept.vertices.row(edges(e, 1))).norm();
    topology->mean_edge_length = edges.rows() > 0 ? sum / static_cast<double>(edges.rows()) : 0;
    topology->size = shape_size(kept);
    return {topology, metric};
}

SurfaceDomain::SurfaceDomain()
    : SurfaceDomain([] {
          static const SurfaceDomain empty{TriangleMesh{}};
          return empty;
      }()) {}

SurfaceDomain::SurfaceDomain(TriangleMesh mesh, FeatureGraph features)
    : SurfaceDomain(parts_of(std::move(mesh)), std::move(features)) {}

SurfaceDomain::SurfaceDomain(Parts parts, FeatureGraph features)
    : topology_(std::move(parts.topology)), metric_(std::move(parts.metric)) {
    FeatureGraph ordered = ordered_features(std::move(features), mesh());
    std::vector<bool> flags = feature_flags(ordered, this->topology());
    features_ = std::make_shared<const Features>(Features{std::move(ordered), std::move(flags)});
}

SurfaceDomain SurfaceDomain::with_features(FeatureGraph features) const {
    return {Parts{topology_, metric_}, std::move(features)};
}

SurfaceDomain SurfaceDomain::with_edge_lengths(Eigen::VectorXd lengths) const {
    require_lengths(lengths, edge_count());
    const auto metric = std::make_shared<Metric>();
    CornerAngles corners = angles_and_cotangents(lengths, topology());
    metric->corner_angles = std::move(corners.angles);
    metric->cotangents = std::move(corners.cotangents);
    metric->edge_lengths = std::move(lengths);
    metric->own = true;
    SurfaceDomain result = *this;
    result.metric_ = metric;
    return result;
}

Eigen::VectorXd SurfaceDomain::areas() const {
    if (!has_own_lengths()) return triangle_areas(mesh());
    Eigen::VectorXd result(triangle_count());
    for (Index t = 0; t < triangle_count(); ++t)
        result[t] = edge_lengths()[topology().triangle_edges(t, 0)] * edge_lengths()[topology().triangle_edges(t, 2)] *
                    std::sin(corner_angles()(t, 0)) / 2;
    return result;
}

long long SurfaceDomain::made() { return domains_made; }

}  // namespace octafield::surface
