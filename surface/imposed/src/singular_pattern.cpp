#include "octafield/surface/singular_pattern.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>

#include "octafield/error.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;
constexpr double farthest = 1e-3;  // of the surface's size

// On an edge, or at a vertex, of the boundary: a point beyond it has its nearest place there.
bool on_boundary(const SurfaceDomain& domain, const ImposedPoint& point) {
    for (int k = 0; k < 3; ++k)
        if (point.weights[(k + 2) % 3] == 0 &&
            domain.topology().edge_triangles.row(domain.topology().triangle_edges(point.triangle, k)).minCoeff() < 0)
            return true;
    return false;
}

// Barycentric coordinates of the triangle's point nearest to p (Ericson, Real-Time Collision Detection, 5.1.5).
Vector nearest_weights(const Vector& p, const Vector& a, const Vector& b, const Vector& c) {
    const Vector ab = b - a, ac = c - a;
    const double d1 = ab.dot(p - a), d2 = ac.dot(p - a), d3 = ab.dot(p - b), d4 = ac.dot(p - b), d5 = ab.dot(p - c),
                 d6 = ac.dot(p - c);
    if (d1 <= 0 && d2 <= 0) return Vector(1, 0, 0);
    if (d3 >= 0 && d4 <= d3) return Vector(0, 1, 0);
    if (d6 >= 0 && d5 <= d6) return Vector(0, 0, 1);
    const double vc = d1 * d4 - d3 * d2, vb = d5 * d2 - d1 * d6, va = d3 * d6 - d5 * d4;
    if (vc <= 0 && d1 >= 0 && d3 <= 0) return Vector(1 - d1 / (d1 - d3), d1 / (d1 - d3), 0);
    if (vb <= 0 && d2 >= 0 && d6 <= 0) return Vector(1 - d2 / (d2 - d6), 0, d2 / (d2 - d6));
    if (va <= 0 && d4 >= d3 && d5 >= d6) {
        const double w = (d4 - d3) / (d4 - d3 + d5 - d6);
        return Vector(0, 1 - w, w);
    }
    return Vector(va, vb, vc) / (va + vb + vc);
}

void require_places(const std::vector<ImposedPoint>& points, std::span<const Index> places) {
    std::vector<Index> bad, seen;
    for (const Index place : places) {
        if (place < 0 || place >= static_cast<Index>(points.size()) ||
            std::find(seen.begin(), seen.end(), place) != seen.end())
            bad.push_back(place);
        seen.push_back(place);
    }
    if (!bad.empty())
        throw InvalidInput("singular points " + first_few(bad) + " are named twice or do not exist; there are " +
                               std::to_string(points.size()) + ", numbered from 0",
                           "index_out_of_range", bad);
}

}  // namespace

Eigen::Vector3d imposed_position(const SurfaceDomain& domain, const ImposedPoint& point) {
    const TriangleMesh& mesh = domain.mesh();
    if (point.triangle < 0 || point.triangle >= domain.triangle_count())
        throw InvalidInput("there is no triangle " + std::to_string(point.triangle), "outside_surface");
    Vector result = Vector::Zero();
    for (int k = 0; k < 3; ++k)
        result += point.weights[k] * mesh.vertices.row(mesh.triangles(point.triangle, k)).transpose();
    return result;
}

ImposedPoint imposed_point(const SurfaceDomain& domain, const Eigen::Vector3d& position, int index_times_four) {
    if (!position.allFinite()) throw InvalidInput("the position of a singular point is not finite", "not_finite");
    const TriangleMesh& mesh = domain.mesh();
    ImposedPoint best{-1, Vector::Zero(), index_times_four};
    double least = 0;
    for (Index t = 0; t < domain.triangle_count(); ++t) {
        const Vector a = mesh.vertices.row(mesh.triangles(t, 0)), b = mesh.vertices.row(mesh.triangles(t, 1)),
                     c = mesh.vertices.row(mesh.triangles(t, 2));
        const Vector weights = nearest_weights(position, a, b, c);
        const double distance = (weights[0] * a + weights[1] * b + weights[2] * c - position).norm();
        if (best.triangle >= 0 && !(distance < least)) continue;
        best.triangle = t;
        best.weights = weights;
        least = distance;
    }
    double most = farthest * domain.size();
    if (best.triangle >= 0 && !on_boundary(domain, best)) most = std::max(most, domain.mean_edge_length() / 2);
    if (best.triangle < 0 || least > most)
        throw InvalidInput("the point (" + short_number(position[0]) + ", " + short_number(position[1]) + ", " +
                               short_number(position[2]) + ") is not on the surface" +
                               (best.triangle < 0 ? std::string(", which has no triangles")
                                                  : ", whose nearest place is " + short_number(least) + " away"),
                           "outside_surface");
    return best;
}

ImposedPoint imposed_at_vertex(const SurfaceDomain& domain, Index vertex, int index_times_four) {
    const auto& fans = domain.fans().fans;
    const auto fan = std::lower_bound(fans.begin(), fans.end(), vertex,
                                      [](const VertexFans::Fan& f, Index v) { return f.vertex < v; });
    if (fan == fans.end() || fan->vertex != vertex)
        throw InvalidInput("there is no vertex " + std::to_string(vertex) + ", or no triangle at it", "outside_surface",
                           {vertex});
    const Index corner = domain.fans().corners[fan->first];
    return {corner / 3, Vector::Unit(corner % 3), index_times_four};
}

SingularPattern singular_pattern(const DirectionField& field, const SurfaceSingularities& singularities) {
    if (field.symmetry != 4)
        throw InvalidInput("singular points can be imposed on cross fields, of symmetry 4; this field has " +
                               std::to_string(field.symmetry),
                           "wrong_symmetry");
    return singular_pattern(field.domain, singularities);
}

SingularPattern singular_pattern(const SurfaceDomain& domain, const SurfaceSingularities& singularities) {
    SingularPattern pattern;
    std::map<Index, int> quads;
    for (const CornerQuads& corner : default_corner_quads(domain)) quads[corner.vertex] = 2;
    for (const SurfaceSingularity& point : singularities.points) {
        if (point.boundary) {
            quads[point.vertex] = 2 - point.index_times_symmetry;
        } else if (point.vertex >= 0) {
            pattern.points.push_back(imposed_at_vertex(domain, point.vertex, point.index_times_symmetry));
        } else {
            pattern.points.push_back(imposed_point(domain, point.position, point.index_times_symmetry));
        }
    }
    for (const auto& [vertex, count] : quads) pattern.corners.push_back({vertex, count});
    return pattern;
}

SingularPattern move_singular_point(const SurfaceDomain& domain, SingularPattern pattern, Index place,
                                    const Eigen::Vector3d& to) {
    require_places(pattern.points, {&place, 1});
    pattern.points[place] = imposed_point(domain, to, pattern.points[place].index_times_four);
    return pattern;
}

SingularPattern add_singular_pair(const SurfaceDomain& domain, SingularPattern pattern,
                                  const Eigen::Vector3d& valence_3, const Eigen::Vector3d& valence_5) {
    pattern.points.push_back(imposed_point(domain, valence_3, 1));
    pattern.points.push_back(imposed_point(domain, valence_5, -1));
    return pattern;
}

SingularPattern remove_singular_points(SingularPattern pattern, std::span<const Index> places) {
    require_places(pattern.points, places);
    std::vector<ImposedPoint> kept;
    for (std::size_t i = 0; i < pattern.points.size(); ++i)
        if (std::find(places.begin(), places.end(), static_cast<Index>(i)) == places.end())
            kept.push_back(pattern.points[i]);
    pattern.points = std::move(kept);
    return pattern;
}

SingularPattern merge_singular_points(const SurfaceDomain& domain, SingularPattern pattern,
                                      std::span<const Index> places, const Eigen::Vector3d& to) {
    require_places(pattern.points, places);
    int sum = 0;
    for (const Index place : places) sum += pattern.points[place].index_times_four;
    if (sum >= 4)
        throw InvalidInput(
            "merged, the points would have the index " + std::to_string(sum) + "/4: no quad would be left round them",
            "bad_valence", std::vector<Index>(places.begin(), places.end()));
    SingularPattern result = remove_singular_points(std::move(pattern), places);
    if (sum != 0) result.points.push_back(imposed_point(domain, to, sum));
    return result;
}

}  // namespace octafield::surface
