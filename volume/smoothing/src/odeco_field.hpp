// A field of odeco tensors as the solver sees it: a quaternion and three logarithms of axis lengths per site, and,
// computed once per evaluation, the tensors and their derivatives.
#pragma once

#include <ceres/evaluation_callback.h>

#include <array>
#include <limits>
#include <vector>

#include "frame_manifolds.hpp"
#include "octafield/frames/odeco.hpp"
#include "octafield/parallel.hpp"

namespace octafield::volume {

class OdecoField final : public ceres::EvaluationCallback {
public:
    using Vector = frames::Odeco::Vector;
    static constexpr int dimension = frames::Odeco::dimension;
    static constexpr std::array block_sizes = {4, 3};  // w x y z; logarithms of the lengths of axes u, v, w

    OdecoField(Quaternions quaternions, Points log_lengths, int threads)
        : threads_(threads),
          quaternions_(std::move(quaternions)),
          log_lengths_(std::move(log_lengths)),
          values_(quaternions_.rows()),
          by_quaternion_(quaternions_.rows()),
          by_log_length_(quaternions_.rows()) {}

    double* parameters(Index site, int block) {
        return block == 0 ? quaternions_.row(site).data() : log_lengths_.row(site).data();
    }
    Quaternions& quaternions() { return quaternions_; }
    Points lengths() const { return log_lengths_.array().exp(); }
    const Vector& value(Index site) const { return values_[site]; }
    // (dimension, block_sizes[block]), row-major
    const double* jacobian(Index site, int block) const {
        return block == 0 ? by_quaternion_[site].data() : by_log_length_[site].data();
    }

    void PrepareForEvaluation(bool evaluate_jacobians, bool new_evaluation_point) override {
        if (new_evaluation_point) jacobians_current_ = false;
        const bool jacobians = evaluate_jacobians && !jacobians_current_;
        if (!new_evaluation_point && !jacobians) return;
        parallel_for(quaternions_.rows(), threads_, [&](std::int64_t v) {
            const Eigen::Vector4d x = quaternions_.row(v);
            const frames::Quaternion q = frames::from_wxyz(x);
            const frames::Vector3 lengths = log_lengths_.row(v).array().exp();
            if (!lengths.allFinite()) {  // a step far too long: the solver rejects what is not a number
                values_[v].setConstant(std::numeric_limits<double>::quiet_NaN());
                return;
            }
            if (new_evaluation_point) values_[v] = frames::Odeco::embed(q, lengths);
            if (!jacobians) return;
            const frames::Odeco::FullDifferential d = frames::Odeco::differential(q, lengths);
            Eigen::Matrix<double, 3, 4, Eigen::RowMajor> left_inverse;  // of the manifolds' PlusJacobian
            FrameManifold().MinusJacobian(x.data(), left_inverse.data());
            by_quaternion_[v] = d.leftCols<3>() * left_inverse;
            by_log_length_[v] = d.rightCols<3>() * lengths.asDiagonal();
        });
        if (jacobians) jacobians_current_ = true;
    }

private:
    int threads_;
    bool jacobians_current_ = false;
    Quaternions quaternions_;
    Points log_lengths_;
    std::vector<Vector> values_;
    std::vector<Eigen::Matrix<double, dimension, 4, Eigen::RowMajor>> by_quaternion_;
    std::vector<Eigen::Matrix<double, dimension, 3, Eigen::RowMajor>> by_log_length_;
};

}  // namespace octafield::volume
