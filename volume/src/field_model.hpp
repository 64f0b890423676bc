// The Dirichlet energy of an embedded field and its quadratic model by rotation vectors (world axes), one per vertex.
#pragma once

#include <Eigen/Eigenvalues>
#include <vector>

#include "block_laplacian.hpp"
#include "octafield/frames/representation.hpp"
#include "octafield/volume/boundary.hpp"

namespace octafield::volume {

using Tangents = Rows<double, 3>;  // rotation vectors; 0 where fixed, along the axis where one is fixed

template <frames::Representation R>
class FieldModel {
public:
    FieldModel(const BlockLaplacian& laplacian, const BoundaryConstraints& constraints, int threads)
        : laplacian_(laplacian), constraints_(constraints), threads_(threads) {
        const Index n = laplacian.rows();
        values_.resize(n, R::dimension);
        differentials_.resize(n);
        curvatures_.resize(n);
        inverses_.resize(n);
        gradient_.resize(n, 3);
    }

    // Energy of a field; its images stay for linearise().
    double evaluate(const Quaternions& frames) {
        parallel_for(frames.rows(), threads_,
                     [&](std::int64_t v) { values_.row(v) = R::embed(frame(frames, v)).transpose(); });
        return laplacian_.multiply(values_, images_, threads_) / 2;
    }

    // Gradient, Hessian and preconditioner at the field last evaluated.
    void linearise(const Quaternions& frames) {
        parallel_for(frames.rows(), threads_, [&](std::int64_t v) {
            const frames::Quaternion q = frame(frames, v);
            const typename R::Vector image = images_.row(v).transpose();
            differentials_[v] = R::differential(q);
            curvatures_[v] = R::hessian(q, image);
            gradient_.row(v) = allowed(v, differentials_[v].transpose() * image).transpose();
            inverses_[v] = inverse_of_block(v);
        });
    }

    const Tangents& gradient() const { return gradient_; }
    frames::Vector3 precondition(Index v, const frames::Vector3& w) const { return inverses_[v] * w; }

    // y = H w; returns w . y.
    double hessian_times(const Tangents& w, Tangents& y) {
        turned_.resize(w.rows(), R::dimension);
        parallel_for(w.rows(), threads_,
                     [&](std::int64_t v) { turned_.row(v) = (differentials_[v] * w.row(v).transpose()).transpose(); });
        return laplacian_.for_rows_of_product(turned_, threads_, [&](Index v, const auto& product) {
            const frames::Vector3 image =
                differentials_[v].transpose() * product + curvatures_[v] * w.row(v).transpose();
            y.row(v) = allowed(v, image).transpose();
            return y.row(v).dot(w.row(v));
        });
    }

    // The part of a rotation vector that the constraints of a vertex allow.
    frames::Vector3 allowed(std::int64_t v, const frames::Vector3& w) const {
        switch (constraints_.kind[v]) {
            case VertexConstraint::free:
                return w;
            case VertexConstraint::axis:
                return constraints_.axis.row(v).transpose() * constraints_.axis.row(v).dot(w);
            default:
                return frames::Vector3::Zero();
        }
    }

private:
    static frames::Quaternion frame(const Quaternions& frames, std::int64_t v) {
        return frames::from_wxyz(frames::Vector4(frames.row(v).transpose()));
    }

    // Of the diagonal block, its eigenvalues made positive and kept from 0, within what is allowed.
    frames::Matrix3 inverse_of_block(std::int64_t v) const {
        constexpr double least = 1e-3;  // of the stiffness part
        const frames::Matrix3 stiff = laplacian_.diagonal()[v] * differentials_[v].transpose() * differentials_[v];
        const double floor = least * stiff.trace() / 3;
        if (!(floor > 0) || constraints_.kind[v] == VertexConstraint::fixed) return frames::Matrix3::Zero();
        const frames::Matrix3 block = stiff + curvatures_[v];
        if (constraints_.kind[v] == VertexConstraint::axis) {
            const frames::Vector3 axis = constraints_.axis.row(v).transpose();
            return axis * axis.transpose() / std::max(std::abs(axis.dot(block * axis)), floor);
        }
        Eigen::SelfAdjointEigenSolver<frames::Matrix3> solver;
        solver.computeDirect(block);
        const frames::Vector3 values = solver.eigenvalues().cwiseAbs().cwiseMax(floor);
        return solver.eigenvectors() * values.cwiseInverse().asDiagonal() * solver.eigenvectors().transpose();
    }

    const BlockLaplacian& laplacian_;
    const BoundaryConstraints& constraints_;
    int threads_;
    Rows<double, R::dimension> values_, images_, turned_;
    std::vector<typename R::Differential> differentials_;
    std::vector<frames::Matrix3> curvatures_, inverses_;
    Tangents gradient_;
};

}  // namespace octafield::volume
