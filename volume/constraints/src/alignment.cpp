#include "alignment.hpp"

#include <cmath>
#include <string>

#include "octafield/error.hpp"
#include "require_frames.hpp"

namespace octafield::volume {

double angle_to_nearest_axis(const frames::Quaternion& frame, const frames::Vector3& direction) {
    const frames::Matrix3 axes = frame.toRotationMatrix();
    int nearest = 0;
    (axes.transpose() * direction).cwiseAbs().maxCoeff(&nearest);
    // atan2 is accurate at small angles.
    return std::atan2(axes.col(nearest).cross(direction).norm(), std::abs(axes.col(nearest).dot(direction)));
}

Eigen::VectorXd angles_to_nearest_axis(const BoundarySurface& surface, const std::vector<Index>& vertex,
                                       const Points& direction, const Quaternions& frames) {
    const std::vector<Index>& vertex_map = surface.vertex_map;  // ascending
    if (!vertex_map.empty() && vertex_map.back() >= frames.rows())
        throw InvalidInput("frames has " + std::to_string(frames.rows()) + " rows, but the surface uses vertex " +
                               std::to_string(vertex_map.back()),
                           "wrong_size", {vertex_map.back()});
    require_frames(frames, frames.rows());
    Eigen::VectorXd angles(static_cast<Eigen::Index>(vertex.size()));
    for (Eigen::Index i = 0; i < angles.size(); ++i)
        angles[i] = angle_to_nearest_axis(frames::from_wxyz(frames.row(vertex_map[vertex[i]])),
                                          direction.row(i).transpose());
    return angles;
}

}  // namespace octafield::volume
