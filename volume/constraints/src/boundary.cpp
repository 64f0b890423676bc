#include "octafield/volume/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <string>

#include "alignment.hpp"
#include "boundary_rules.hpp"
#include "boundary_star.hpp"
#include "octafield/error.hpp"
#include "octafield/frames/sh4.hpp"
#include "stretched_directions.hpp"
#include "surface_constraints.hpp"

namespace octafield::volume {

using frames::Quaternion;
using frames::Vector3;

bool fits(const Quaternion& frame, const Directions& directions, double tolerance) {
    return std::all_of(directions.begin(), directions.end(),
                       [&](const Vector3& d) { return angle_to_nearest_axis(frame, d) <= tolerance; });
}

Quaternion best_frame(const Directions& directions) {
    frames::Sh4::Vector sum = frames::Sh4::Vector::Zero();
    for (const Vector3& d : directions) sum += frames::Sh4::axis(d);
    return frames::Sh4::project(sum).frame;
}

namespace {

// The same among the frames with an axis on `tangent`. A direction d then counts with |d'|^4 cos 4(angle of d' -
// twist), d' its part orthogonal to the tangent, so the best twist is a quarter of the argument of the sum of (d')^4.
Quaternion best_frame_about(const Vector3& tangent, const Directions& directions) {
    const Quaternion reference =
        frames::frame_from_axes(directions.empty() ? Vector3::Zero() : directions.front(), tangent);
    const frames::Matrix3 axes = reference.toRotationMatrix();
    std::complex<double> sum = 0;
    double size = 0;
    for (const Vector3& d : directions) {
        const std::complex<double> part(d.dot(axes.col(0)), d.dot(axes.col(1)));
        sum += part * part * part * part;
        size += std::norm(part) * std::norm(part);
    }
    if (std::abs(sum) < 1e-9 * size) return reference;  // all twists are equal, as for normals 45 degrees apart
    return (frames::exp(std::arg(sum) / 4 * tangent) * reference).normalized();
}

// Tangent of a curve from the directions of its two edges at the vertex.
Vector3 curve_tangent(const Directions& edges) {
    const Vector3 tangent = edges[0] - edges[1];
    return tangent.norm() > 1e-9 ? Vector3(tangent.normalized()) : edges[0];
}

struct VertexRule {
    VertexConstraint kind = VertexConstraint::free;
    Vector3 axis = Vector3::Zero();
    Quaternion frame = Quaternion::Identity();
    bool released = false;
};

VertexRule smooth_rule(const Vector3& normal, const Vector3& direction, BoundaryMode mode) {
    const Quaternion frame = frames::frame_from_axes(direction, normal);
    if (mode == BoundaryMode::fixed) return {VertexConstraint::fixed, Vector3::Zero(), frame, false};
    return {VertexConstraint::axis, normal, frame, false};
}

VertexRule curve_rule(const Vector3& tangent, const Directions& normals, const BoundaryOptions& options) {
    const Quaternion frame = best_frame_about(tangent, normals);
    if (options.mode == BoundaryMode::fixed || fits(frame, normals, options.feature_tolerance))
        return {VertexConstraint::fixed, Vector3::Zero(), frame, false};
    return {VertexConstraint::axis, tangent, frame, false};
}

VertexRule corner_rule(const Directions& edges, const Directions& normals, double tolerance) {
    Directions all = edges;
    all.insert(all.end(), normals.begin(), normals.end());
    const Quaternion frame = best_frame(all);
    if (fits(frame, all, tolerance)) return {VertexConstraint::fixed, Vector3::Zero(), frame, false};
    return {VertexConstraint::free, Vector3::Zero(), frame, true};
}

// A feature curve that ends inside a smooth patch only gives its end vertex a direction. Several sectors without
// features are a vertex where the boundary touches itself: like a corner.
VertexRule vertex_rule(Directions edges, Directions normals, bool listed_corner, const Vector3& direction,
                       const StretchedDirections& stretched, const BoundaryOptions& options) {
    for (Vector3& normal : normals) normal = stretched.normal(normal);
    if (edges.size() <= 1 && normals.size() == 1)
        return smooth_rule(normals[0], stretched.tangent(edges.empty() ? direction : edges[0]), options.mode);
    if (edges.size() == 2 && !listed_corner)
        return curve_rule(stretched.tangent(curve_tangent(edges)), normals, options);
    for (Vector3& edge : edges) edge = stretched.tangent(edge);
    return corner_rule(edges, normals, options.feature_tolerance);
}

void require_boundary_inputs(const BoundarySurface& surface, const Points& directions, const BoundaryOptions& options) {
    const Eigen::Index count = surface.mesh.vertices.rows();
    if (directions.rows() != count)
        throw InvalidInput("directions has " + std::to_string(directions.rows()) +
                               " rows; give one per vertex of the surface, " + std::to_string(count),
                           "wrong_size");
    if (!directions.allFinite()) throw InvalidInput("directions must be finite numbers", "not_finite");
    if (!(options.feature_tolerance >= 0 && options.feature_tolerance <= std::numbers::pi / 2))
        throw InvalidInput("feature_tolerance is in radians, from 0 to pi/2", "feature_tolerance");
}

}  // namespace

SectorNormals sector_normals_of(const surface::TriangleMesh& surface, const surface::FeatureGraph& features) {
    const BoundaryStars stars(surface, features);
    SectorNormals result;
    std::vector<Vector3> normals;
    for (Index v = 0; v < stars.vertex_count(); ++v)
        for (const Vector3& normal : stars.sector_normals(v)) {
            result.vertex.push_back(v);
            normals.push_back(normal);
        }
    result.normal.resize(normals.size(), 3);
    for (std::size_t i = 0; i < normals.size(); ++i) result.normal.row(i) = normals[i].transpose();
    return result;
}

SectorNormals sector_normals(const TetDomain& domain) {
    return sector_normals_of(domain.surface().mesh, domain.features());
}

BoundaryConstraints constraints_on_surface(Index vertex_count, const BoundarySurface& surface,
                                           const surface::FeatureGraph& features, const Points& directions,
                                           const BoundaryOptions& options, const Stretches* stretch) {
    require_boundary_inputs(surface, directions, options);
    BoundaryConstraints result;
    result.kind.assign(vertex_count, VertexConstraint::free);
    result.axis = Points::Zero(vertex_count, 3);
    result.frames = Quaternions::Zero(vertex_count, 4);
    result.frames.col(0).setOnes();
    result.on_boundary.assign(vertex_count, 0);

    const BoundaryStars stars(surface.mesh, features);
    std::vector<std::uint8_t> listed(stars.vertex_count(), 0);
    for (const Index v : features.corners) listed[v] = 1;
    for (Index b = 0; b < stars.vertex_count(); ++b) {
        const Directions normals = stars.sector_normals(b);
        if (normals.empty()) continue;  // in no triangle
        const Index v = surface.vertex_map[b];
        const VertexRule rule =
            vertex_rule(stars.feature_directions(b), normals, listed[b], directions.row(b).transpose(),
                        stretch ? stretched_directions(*stretch, v) : StretchedDirections(), options);
        result.on_boundary[v] = 1;
        result.frames.row(v) = frames::to_wxyz(rule.frame).transpose();
        if (options.mode == BoundaryMode::none) continue;
        result.kind[v] = rule.kind;
        result.axis.row(v) = rule.axis.transpose();
        if (rule.released) result.released_corners.push_back(v);
    }
    return result;
}

BoundaryConstraints boundary_constraints(const TetDomain& domain, const Points& directions,
                                         const BoundaryOptions& options) {
    return constraints_on_surface(domain.vertex_count(), domain.surface(), domain.features(), directions, options);
}

Eigen::VectorXd alignment_angles(const TetDomain& domain, const Quaternions& frames) {
    const SectorNormals normals = sector_normals(domain);
    return angles_to_nearest_axis(domain.surface(), normals.vertex, normals.normal, frames);
}

}  // namespace octafield::volume
