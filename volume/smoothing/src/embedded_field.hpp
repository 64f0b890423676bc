// The field as the solver sees it: one quaternion per vertex and, computed once per evaluation, its embedding and
// differential.
#pragma once

#include <ceres/evaluation_callback.h>

#include <array>
#include <vector>

#include "frame_manifolds.hpp"
#include "octafield/frames/representation.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {

template <frames::Representation R>
class EmbeddedField final : public ceres::EvaluationCallback {
public:
    using Vector = typename R::Vector;
    static constexpr int dimension = R::dimension;
    static constexpr std::array block_sizes = {4};  // of the parameters of a site
    // d embed / d (w, x, y, z): the differential under world rotations times the left inverse of the manifolds'
    // PlusJacobian, so that the product Ceres forms is the differential again.
    using Jacobian = Eigen::Matrix<double, R::dimension, 4, Eigen::RowMajor>;

    EmbeddedField(Quaternions quaternions, int threads)
        : threads_(threads),
          quaternions_(std::move(quaternions)),
          values_(quaternions_.rows()),
          jacobians_(quaternions_.rows()) {}

    double* parameters(Index vertex, int = 0) { return quaternions_.row(vertex).data(); }
    Quaternions& quaternions() { return quaternions_; }
    const Vector& value(Index vertex) const { return values_[vertex]; }
    // (dimension, block_sizes[block]), row-major
    const double* jacobian(Index vertex, int) const { return jacobians_[vertex].data(); }

    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
        if (new_evaluation_point) jacobians_current_ = false;
        const bool jacobians = evaluate_jacobians && !jacobians_current_;
        if (!new_evaluation_point && !jacobians) return;
        parallel_for(quaternions_.rows(), threads_, [&](std::int64_t v) {
            const Eigen::Vector4d x = quaternions_.row(v);
            const frames::Quaternion q = frames::from_wxyz(x);
            if (new_evaluation_point) values_[v] = R::embed(q);
            if (!jacobians) return;
            Eigen::Matrix<double, 3, 4, Eigen::RowMajor> left_inverse;
            FrameManifold().MinusJacobian(x.data(), left_inverse.data());
            jacobians_[v] = R::differential(q) * left_inverse;
        });
        if (jacobians) jacobians_current_ = true;
    }

private:
    int threads_;
    bool jacobians_current_ = false;
    Quaternions quaternions_;
    std::vector<Vector> values_;
    std::vector<Jacobian> jacobians_;
};

}  // namespace octafield::volume
