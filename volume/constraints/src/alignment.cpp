#include "alignment.hpp"

#include <cmath>

#include "require_frames.hpp"

namespace octafield::volume {

double angle_to_nearest_axis(const frames::Quaternion& frame, const frames::Vector3& direction) {
    const frames::Matrix3 axes = frame.toRotationMatrix();
    int nearest = 0;
    (axes.transpose() * direction).cwiseAbs().maxCoeff(&nearest);
    // atan2 is accurate at small angles.
    return std::atan2(axes.col(nearest).cross(direction).norm(), std::abs(axes.col(nearest).dot(direction)));
}

Eigen::VectorXd angles_to_nearest_axis(const TetDomain& domain, const std::vector<Index>& vertex,
                                       const Points& direction, const Quaternions& frames) {
    require_frames(frames, domain.vertex_count());
    const std::vector<Index>& vertex_map = domain.surface().vertex_map;
    Eigen::VectorXd angles(static_cast<Eigen::Index>(vertex.size()));
    for (Eigen::Index i = 0; i < angles.size(); ++i)
        angles[i] = angle_to_nearest_axis(frames::from_wxyz(frames.row(vertex_map[vertex[i]])),
                                          direction.row(i).transpose());
    return angles;
}

}  // namespace octafield::volume
