// Frames whose axes a stretch tilts: what axes_stretch gives, put to use.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "octafield/volume/axes_stretch.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "require_frames.hpp"
#include "stretched_directions.hpp"
#include "surface_constraints.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

template <class Columns>
Eigen::VectorXd angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch,
                       const std::vector<Index>& vertex, const Points& direction, const Columns& columns) {
    require_frames(frames, domain.vertex_count());
    require_stretch(stretch, domain.vertex_count());
    Eigen::VectorXd result(direction.rows());
    for (Eigen::Index i = 0; i < result.size(); ++i) {
        const Index v = domain.surface().vertex_map[vertex[i]];
        const Matrix3 rotation = frames::from_wxyz(frames.row(v)).toRotationMatrix();
        result[i] = angle_to_nearest_column(columns(unpacked(stretch.row(v)), rotation), direction.row(i).transpose());
    }
    return result;
}

}  // namespace

void require_stretch(const Stretches& stretch, Index count) {
    if (stretch.rows() != count)
        throw InvalidInput(
            "stretch has " + std::to_string(stretch.rows()) + " rows; give one per vertex, " + std::to_string(count),
            "wrong_size");
    std::vector<Index> bad;
    for (Index v = 0; v < count; ++v)
        if (!stretch.row(v).allFinite() || unpacked(stretch.row(v)).llt().info() != Eigen::Success) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput("stretch must be symmetric positive definite matrices (xx, yy, zz, yz, xz, xy); not at " +
                               std::string("vertices ") + first_few(bad),
                           "not_positive", bad);
}

double angle_to_nearest_column(const Matrix3& columns, const Vector3& direction) {
    double best = std::numbers::pi / 2;
    for (int i = 0; i < 3; ++i)
        best =
            std::min(best, std::atan2(columns.col(i).cross(direction).norm(), std::abs(columns.col(i).dot(direction))));
    return best;
}

const Stretches* stretch_or_none(const Stretches& stretch, Index count) {
    if (stretch.rows() == 0) return nullptr;
    require_stretch(stretch, count);
    return &stretch;
}

StretchedDirections::StretchedDirections(const Matrix3& stretch)
    : stretch_(stretch), inverse_(stretch.inverse()), is_identity_(stretch == Matrix3::Identity()) {}

StretchedDirections stretched_directions(const Stretches& stretch, Index vertex) {
    return StretchedDirections(unpacked(stretch.row(vertex)));
}

Rows<double, 9> stretched_axes(const Quaternions& frames, const Stretches& stretch) {
    require_frames(frames, frames.rows());
    require_stretch(stretch, static_cast<Index>(frames.rows()));
    Rows<double, 9> result(frames.rows(), 9);
    for (Eigen::Index v = 0; v < frames.rows(); ++v) {
        const Matrix3 axes = unpacked(stretch.row(v)) * frames::from_wxyz(frames.row(v)).toRotationMatrix();
        result.row(v) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(axes.data());
    }
    return result;
}

BoundaryConstraints boundary_constraints(const TetDomain& domain, const Points& directions, const Stretches& stretch,
                                         const BoundaryOptions& options) {
    require_stretch(stretch, domain.vertex_count());
    return constraints_on_surface(domain.vertex_count(), domain.surface(), domain.features(), directions, options,
                                  &stretch);
}

Eigen::VectorXd alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch) {
    const SectorNormals normals = sector_normals(domain);
    return angles(domain, frames, stretch, normals.vertex, normals.normal,
                  [](const Matrix3& s, const Matrix3& q) { return Matrix3(s.inverse() * q); });
}

Eigen::VectorXd feature_alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch) {
    const FeatureTangents tangents = feature_tangents(domain);
    return angles(domain, frames, stretch, tangents.vertex, tangents.tangent,
                  [](const Matrix3& s, const Matrix3& q) { return Matrix3(s * q); });
}

}  // namespace octafield::volume
