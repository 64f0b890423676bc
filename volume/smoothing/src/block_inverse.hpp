// The preconditioner of a trust region: inverses of the diagonal blocks of its Hessian.
#pragma once

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "constraint_turns.hpp"

namespace octafield::volume {

// Rotation vectors that the constraints allow.
using Tangent = Eigen::Vector3f;
using Tangents = Rows<float, 3>;

template <int Size>
Eigen::Matrix<double, Size, Size> positive_inverse(const Eigen::Matrix<double, Size, Size>& block, double floor) {
    Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, Size, Size>> solver;
    solver.computeDirect(block);
    const Eigen::Matrix<double, Size, 1> values = solver.eigenvalues().cwiseAbs().cwiseMax(floor);
    return solver.eigenvectors() * values.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
}

// Of stiff + curvature at site v, its eigenvalues made positive and kept from 0, within what the constraints allow.
// stiff: positive semidefinite, what tells how large the block is.
inline frames::Matrix3 inverse_of_block(const ConstraintTurns& turns, std::int64_t v, const frames::Matrix3& stiff,
                                        const frames::Matrix3& curvature) {
    constexpr double least = 1e-3;  // of the stiffness part
    const double floor = least * stiff.trace() / 3;
    const int unknowns = turns.unknowns(v);
    if (!(floor > 0) || unknowns == 0) return frames::Matrix3::Zero();
    const frames::Matrix3 block = stiff + curvature;
    if (unknowns == 1) {
        const frames::Vector3 axis = turns.basis(v).col(0);
        return axis * axis.transpose() / std::max(std::abs(axis.dot(block * axis)), floor);
    }
    if (unknowns == 2) {
        const TangentBasis<2>& plane = turns.basis(v);
        return plane * positive_inverse<2>(plane.transpose() * block * plane, floor) * plane.transpose();
    }
    const frames::Matrix3 above = block - floor * frames::Matrix3::Identity();
    if (above(0, 0) > 0 && above.topLeftCorner<2, 2>().determinant() > 0 && above.determinant() > 0)
        return block.inverse();
    return positive_inverse<3>(block, floor);
}

}  // namespace octafield::volume
