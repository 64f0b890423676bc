// Boundary constraints of frames that live in the tets.
#include <algorithm>
#include <string>

#include "alignment.hpp"
#include "boundary_rules.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/boundary.hpp"
#include "require_frames.hpp"
#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Vector3;

// A triangle of the surface as a tet beside it sees it.
struct Side {
    Index tet, triangle;
};

std::vector<Side> sides_of(const TetDomain& domain) {
    const TriangleTable& table = domain.triangles();
    const std::vector<Index>& rows = domain.surface_rows();
    std::vector<Side> sides;
    for (std::size_t f = 0; f < rows.size(); ++f)
        for (int side = 0; side < 2; ++side)
            if (table.sides(rows[f], side) >= 0)
                sides.push_back({table.sides(rows[f], side) / 4, static_cast<Index>(f)});
    return sides;
}

struct TetRule {
    VertexConstraint kind;
    Vector3 axis = Vector3::Zero();
    Quaternion frame;
    bool released = false;
};

// normals: of the tet's triangles, the largest first; area: theirs; direction: in the first.
TetRule rule(const Directions& normals, const std::vector<double>& areas, const Vector3& direction,
             const BoundaryOptions& options) {
    Vector3 mean = normals[0];
    if (normals.size() > 1) {
        mean.setZero();
        for (std::size_t i = 0; i < normals.size(); ++i)
            mean += (normals[i].dot(normals[0]) < 0 ? -1 : 1) * areas[i] * normals[i];
        mean.normalize();
    }
    const auto near_mean = [&](const Vector3& n) {
        return std::atan2(n.cross(mean).norm(), std::abs(n.dot(mean))) <= options.feature_tolerance;
    };
    if (normals.size() == 1 || std::all_of(normals.begin(), normals.end(), near_mean)) {
        const Quaternion frame = frames::frame_from_axes(direction, mean);
        if (options.mode == BoundaryMode::fixed) return {VertexConstraint::fixed, Vector3::Zero(), frame};
        return {VertexConstraint::axis, mean, frame};
    }
    const Quaternion frame = best_frame(normals);
    if (fits(frame, normals, options.feature_tolerance)) return {VertexConstraint::fixed, Vector3::Zero(), frame};
    return {VertexConstraint::free, Vector3::Zero(), frame, true};
}

void require_sound(const BoundarySurface& surface, const Points& directions, const BoundaryOptions& options) {
    if (directions.rows() != surface.mesh.triangles.rows())
        throw InvalidInput("directions has " + std::to_string(directions.rows()) +
                               " rows; give one per triangle of the surface, " +
                               std::to_string(surface.mesh.triangles.rows()),
                           "wrong_size");
    if (!directions.allFinite()) throw InvalidInput("directions must be finite numbers", "not_finite");
    if (!(options.feature_tolerance >= 0 && options.feature_tolerance <= std::numbers::pi / 2))
        throw InvalidInput("feature_tolerance is in radians, from 0 to pi/2", "feature_tolerance");
}

}  // namespace

BoundaryConstraints tet_boundary_constraints(const TetDomain& domain,
                                             const Points& directions, const BoundaryOptions& options) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    require_sound(surface, directions, options);
    std::vector<Side> sides = sides_of(domain);
    const Points normals = surface::triangle_normals(surface.mesh);
    const Eigen::VectorXd areas = surface::triangle_areas(surface.mesh);
    std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
        if (a.tet != b.tet) return a.tet < b.tet;
        return areas[a.triangle] != areas[b.triangle] ? areas[a.triangle] > areas[b.triangle] : a.triangle < b.triangle;
    });

    BoundaryConstraints result;
    const Eigen::Index count = mesh.tets.rows();
    result.kind.assign(count, VertexConstraint::free);
    result.axis = Points::Zero(count, 3);
    result.frames = Quaternions::Zero(count, 4);
    result.frames.col(0).setOnes();
    result.on_boundary.assign(count, 0);
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        const Index tet = sides[i].tet;
        Directions of_tet;
        std::vector<double> weights;
        for (end = i; end < sides.size() && sides[end].tet == tet; ++end) {
            of_tet.push_back(normals.row(sides[end].triangle).transpose());
            weights.push_back(areas[sides[end].triangle]);
        }
        const TetRule found = rule(of_tet, weights, directions.row(sides[i].triangle).transpose(), options);
        result.on_boundary[tet] = 1;
        result.frames.row(tet) = frames::to_wxyz(found.frame).transpose();
        if (options.mode == BoundaryMode::none) continue;
        result.kind[tet] = found.kind;
        result.axis.row(tet) = found.axis.transpose();
        if (found.released) result.released_corners.push_back(tet);
    }
    return result;
}

Eigen::VectorXd tet_alignment_angles(const TetDomain& domain, const Quaternions& frames) {
    const TetMesh& mesh = domain.mesh();
    const BoundarySurface& surface = domain.surface();
    require_frames(frames, mesh.tets.rows());
    const std::vector<Side> sides = sides_of(domain);
    const Points normals = surface::triangle_normals(surface.mesh);
    Eigen::VectorXd angles(static_cast<Eigen::Index>(sides.size()));
    for (Eigen::Index i = 0; i < angles.size(); ++i)
        angles[i] = angle_to_nearest_axis(frames::from_wxyz(frames.row(sides[i].tet)),
                                          normals.row(sides[i].triangle).transpose());
    return angles;
}

}  // namespace octafield::volume
