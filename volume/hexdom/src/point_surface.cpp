#include "octafield/volume/point_surface.hpp"

#include <algorithm>
#include <cmath>

#include "flip_edges.hpp"
#include "octafield/error.hpp"
#include "place_points.hpp"
#include "thin_complex.hpp"

namespace octafield::volume {
namespace {

using detail::Corners;
using detail::TriangleComplex;
using detail::WantedEdges;

// Where triangles end or three and more meet along a curve that is no feature, so that no corners of it are known.
bool turns_sharply(const TriangleComplex& complex, Index v) {
    if (complex.curves_at[v].size() != 2) return false;
    std::vector<Index> triangles;
    for (const Index e : complex.curves_at[v]) {
        const detail::CurveEdge& edge = complex.curve_edges[e];
        complex.triangles_at_edge(edge.a, edge.b, triangles);
        if (edge.feature || triangles.size() == 2) return false;
    }
    const detail::CurveEdge joined = complex.joined_curve(v);
    return joined.beneath.front().dot(joined.beneath.back()) < std::cos(surface::FeatureOptions{}.corner_angle);
}

// Old vertices but corners; those that turn out to be ends or meetings of curves stay anyway.
std::vector<std::uint8_t> removable(const detail::PlacedPoints& placed, Index points, const std::vector<Index>& corners,
                                    const std::vector<std::uint8_t>& stays) {
    std::vector<std::uint8_t> result(placed.source.size(), 1);
    std::fill(result.begin(), result.begin() + points, 0);
    for (const Index v : corners)
        if (placed.vertex_of[v] >= 0) result[placed.vertex_of[v]] = 0;
    for (Index v = points; v < static_cast<Index>(result.size()); ++v)
        if (turns_sharply(placed.complex, v) || (!stays.empty() && stays[placed.source[v]])) result[v] = 0;
    return result;
}

Index recover_edges(TriangleComplex& complex, const WantedEdges& wanted) {
    Index count = 0;
    for (const auto& [a, b] : wanted.all())
        if (!complex.has_edge(a, b)) count += detail::recover_edge(complex, wanted, a, b);
    return count;
}

// At each vertex of the complex.
std::vector<double> lengths_at(const surface::TriangleMesh& mesh, const SurfacePoints& points,
                               const std::vector<Index>& source, const Eigen::VectorXd& lengths, double edge_length) {
    std::vector<double> result(source.size(), edge_length);
    if (lengths.size() == 0) return result;
    for (std::size_t v = 0; v < source.size(); ++v)
        result[v] = v < points.triangle.size()
                        ? points.weights.row(v).dot(lengths(mesh.triangles.row(points.triangle[v])))
                        : lengths[source[v]];
    return result;
}

// 1.6 times the length there, and at points the longest diagonal of their quads.
detail::LengthBound length_bound(const TriangleComplex& complex, const Quads& quads, std::vector<double> lengths) {
    detail::LengthBound bound{lengths, std::move(lengths)};
    for (double& most : bound.at) most *= 1.6;
    for (const auto q : quads.rowwise()) {
        const double longest = 1.001 * std::max(complex.distance(q[0], q[2]), complex.distance(q[1], q[3]));
        for (const Index p : q) bound.at[p] = std::max(bound.at[p], longest);
    }
    return bound;
}

void redraw(TriangleComplex& complex, const std::vector<std::uint8_t>& old, const WantedEdges& wanted,
            const detail::LengthBound& bound) {
    const double cos_30 = 0.8660254037844387, cos_60 = 0.5;
    detail::flip_edges(complex, wanted, bound);
    detail::thin(complex, old, bound, {cos_30, 0.3, 0, false});
    detail::flip_edges(complex, wanted, bound);
    for (int round = 0; round < 4; ++round) {
        const detail::ThinLimits first{cos_60, 0.1, 0, false}, last_resort{cos_60, 0.02, 0.25, true};
        Index changes = detail::thin(complex, old, bound, round == 0 ? first : last_resort);
        detail::flip_edges(complex, wanted, bound);
        changes += recover_edges(complex, wanted);
        detail::flip_edges(complex, wanted, bound);
        if (changes == 0 && round > 0) break;
    }
}

bool half_found(const TriangleComplex& complex, Index a, Index b, Index c, Index d) {
    return complex.has_triangle(a, b, c) && complex.has_triangle(a, c, d) && complex.curve_edge(a, c) < 0;
}

std::vector<std::uint8_t> found_quads(const TriangleComplex& complex, const Quads& quads) {
    std::vector<std::uint8_t> found;
    for (const auto q : quads.rowwise())
        found.push_back(half_found(complex, q[0], q[1], q[2], q[3]) || half_found(complex, q[1], q[2], q[3], q[0]));
    return found;
}

class Result {
public:
    Result(const detail::PlacedPoints& placed, Index points)
        : placed_(placed), complex_(placed.complex), new_id_(placed.source.size(), -1) {
        for (Index v = 0; v < static_cast<Index>(new_id_.size()); ++v)
            if (v < points || !complex_.star[v].empty()) {
                new_id_[v] = static_cast<Index>(kept_.size());
                kept_.push_back(v);
            }
    }

    PointSurface surface(const std::vector<Index>& corners) const {
        PointSurface result;
        result.mesh.vertices = complex_.at(kept_, Eigen::all);
        for (const Index v : kept_) result.source.push_back(placed_.source[v]);
        std::vector<Index> alive;
        for (Index t = 0; t < static_cast<Index>(complex_.triangles.size()); ++t)
            if (complex_.alive(t)) alive.push_back(t);
        result.mesh.triangles.resize(alive.size(), 3);
        for (std::size_t i = 0; i < alive.size(); ++i) {
            for (int k = 0; k < 3; ++k) result.mesh.triangles(i, k) = new_id_[complex_.triangles[alive[i]][k]];
            result.triangle.push_back(complex_.nearest_old_triangle(alive[i]));
        }
        result.features = features(corners);
        return result;
    }

private:
    surface::FeatureGraph features(const std::vector<Index>& corners) const {
        surface::FeatureGraph result;
        std::vector<std::pair<Index, Index>> edges;
        for (const detail::CurveEdge& e : complex_.curve_edges)
            if (e.feature && e.a >= 0) edges.push_back(std::minmax({new_id_[e.a], new_id_[e.b]}));
        std::sort(edges.begin(), edges.end());
        result.edges.resize(edges.size(), 2);
        for (std::size_t i = 0; i < edges.size(); ++i) result.edges.row(i) << edges[i].first, edges[i].second;
        for (const Index v : corners)
            if (placed_.vertex_of[v] >= 0) result.corners.push_back(new_id_[placed_.vertex_of[v]]);
        std::sort(result.corners.begin(), result.corners.end());
        return result;
    }

    const detail::PlacedPoints& placed_;
    const TriangleComplex& complex_;
    std::vector<Index> new_id_, kept_;
};

}  // namespace

PointSurface point_surface(const surface::TriangleMesh& mesh, const surface::FeatureGraph& given_features,
                           const std::vector<Index>& groups, const SurfacePoints& points, const Quads& quads,
                           double edge_length, const std::vector<std::uint8_t>& stays, const Eigen::VectorXd& lengths) {
    detail::require_usable(mesh, groups, points, quads, edge_length);
    const surface::FeatureGraph features = surface::ordered_features(given_features, mesh);
    const Index count = static_cast<Index>(points.triangle.size());
    detail::PlacedPoints placed = detail::place_points(mesh, features, groups, points);
    if (!stays.empty() && static_cast<Eigen::Index>(stays.size()) != mesh.vertices.rows())
        throw InvalidInput("stays has " + std::to_string(stays.size()) + " entries; give one per vertex of the surface",
                           "wrong_size");
    if (lengths.size() > 0 && lengths.size() != mesh.vertices.rows())
        throw InvalidInput(
            "lengths has " + std::to_string(lengths.size()) + " entries; give one per vertex of the surface",
            "wrong_size");
    const bool as_it_is = !stays.empty() && std::find(stays.begin(), stays.end(), 0) == stays.end();
    if (!as_it_is)
        redraw(placed.complex, removable(placed, count, features.corners, stays), WantedEdges(quads, count),
               length_bound(placed.complex, quads, lengths_at(mesh, points, placed.source, lengths, edge_length)));
    PointSurface result = Result(placed, count).surface(features.corners);
    result.quad_found = found_quads(placed.complex, quads);
    return result;
}

}  // namespace octafield::volume
