// Axes of frames at the vertices inside a tet: their curls, and their jumps to the next.
#pragma once

#include "octafield/frames/quaternion.hpp"
#include "octafield/volume/tet_mesh.hpp"

namespace octafield::volume {

// Columns: the curls of the axes of the four vertices' frames, matched to the tet's frame `centre` and interpolated
// linearly; 1 / input unit.
frames::Matrix3 axis_curls(const TetMesh& mesh, const Quaternions& frames, const frames::Quaternion& centre,
                           Eigen::Index tet);

// Frobenius norm of the tangential jump of the axes h_i n_i of two frames over a face, each axis's divided by the mean
// of its two lengths h_i. lengths: of the axes of q and of r.
double face_jump(const frames::Quaternion& q, const frames::Vector3& lengths_q, const frames::Quaternion& r,
                 const frames::Vector3& lengths_r, const frames::Vector3& unit_normal);

// Root of the mean of squares; 0 for no weight. Serial: the order of the sum must not depend on the number of threads.
double weighted_rms(const Eigen::VectorXd& values, const Eigen::VectorXd& weights);
double largest_of(const Eigen::VectorXd& values);  // 0 for none

}  // namespace octafield::volume
