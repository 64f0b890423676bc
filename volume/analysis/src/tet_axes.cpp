#include "tet_axes.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "element_assembly.hpp"
#include "octafield/frames/octahedral_group.hpp"

namespace octafield::volume {

using frames::Matrix3;
using frames::Quaternion;
using frames::Vector3;

// Sum of grad phi_k x n_k; by differences, so that it is exactly 0 where all four are the same.
Matrix3 axis_curls(const TetMesh& mesh, const Quaternions& frames, const Quaternion& centre, Eigen::Index tet) {
    const auto axes = [&](int k) {
        return frames::closest_representative(frames::from_wxyz(frames.row(mesh.tets(tet, k))), centre)
            .toRotationMatrix();
    };
    const Gradients gradients = hat_gradients(tet_edges(mesh, tet));
    const Matrix3 first = axes(0);
    Matrix3 curls = Matrix3::Zero();
    for (int k = 1; k < 4; ++k) {
        const Matrix3 differences = axes(k) - first;
        for (int i = 0; i < 3; ++i) curls.col(i) += gradients.row(k).transpose().cross(differences.col(i));
    }
    return curls;
}

double face_jump(const Quaternion& q, const Vector3& lengths_q, const Quaternion& r, const Vector3& lengths_r,
                 const Vector3& unit_normal) {
    const Matrix3 matched = frames::closest_representative(q, r).toRotationMatrix(), other = r.toRotationMatrix();
    // Entries 0 and 1: which axis of q became which.
    const Matrix3 permutation = (q.toRotationMatrix().transpose() * matched).cwiseAbs();
    const Vector3 lengths = permutation.transpose() * lengths_q, mean = (lengths + lengths_r) / 2;
    Matrix3 jump = matched * lengths.cwiseQuotient(mean).asDiagonal();
    jump -= other * lengths_r.cwiseQuotient(mean).asDiagonal();
    return (jump - unit_normal * (unit_normal.transpose() * jump)).norm();
}

double weighted_rms(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
    double sum = 0, total = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        sum += weights[i] * values[i] * values[i];
        total += weights[i];
    }
    return total > 0 ? std::sqrt(sum / total) : 0;
}

double largest_of(const Eigen::VectorXd& values) { return values.size() > 0 ? values.maxCoeff() : 0; }

}  // namespace octafield::volume
