// The Dirichlet energy of an embedded field and its quadratic model by rotation vectors (world axes), one per site. The
// Hessian and its preconditioner are in single precision: they tell directions, energy and gradient tell where to stop.
#pragma once

#include <type_traits>
#include <vector>

#include "block_inverse.hpp"
#include "block_laplacian.hpp"
#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/representation.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::volume {

template <frames::Representation R>
class FieldModel {
public:
    static constexpr bool is_sh4 = std::is_same_v<R, frames::Sh4>;

    FieldModel(const BlockLaplacian& laplacian, const BoundaryConstraints& constraints, int threads)
        : laplacian_(laplacian), turns_(constraints), threads_(threads) {
        const Index n = laplacian.rows();
        values_.resize(n, R::dimension);
        turned_.resize(n, R::dimension);
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
        turns_.move_to(frames, threads_);
        parallel_for(frames.rows(), threads_, [&](std::int64_t v) {
            const typename R::Vector image = images_.row(v).transpose();
            const auto [differential, curvature] = derivatives(frame(frames, v), values_.row(v).transpose(), image);
            gradient_.row(v) = turns_.allowed<double>(v, differential.transpose() * image).transpose();
            const frames::Matrix3 stiff = laplacian_.diagonal()[v] * differential.transpose().lazyProduct(differential);
            inverses_[v] = inverse_of_block(turns_, v, stiff, curvature).template cast<float>();
            differentials_[v] = differential.template cast<float>();
            curvatures_[v] = curvature.template cast<float>();
        });
    }

    const Rows<double, 3>& gradient() const { return gradient_; }
    Tangent precondition(Index v, const Tangent& w) const { return inverses_[v] * w; }

    // y = H w; returns w . y. Before, turn(v, w_v) for every v.
    double hessian_times(const Tangents& w, Tangents& y) const {
        return laplacian_.for_rows_of_product(turned_, threads_, [&](Index v, const auto& product) {
            const Tangent own = w.row(v).transpose();
            const Tangent image =
                turns_.allowed<float>(v, differentials_[v].transpose() * product + curvatures_[v] * own);
            y.row(v) = image.transpose();
            return image.dot(own);
        });
    }
    void turn(Index v, const Tangent& w) { turned_.row(v) = (differentials_[v] * w).transpose(); }

    const ConstraintTurns& turns() const { return turns_; }  // at the field last linearised

    // Length of a step that turns every frame by a radian, about, and what rounding leaves of the gradient of a field
    // without energy.
    double radian() const { return std::sqrt(laplacian_.diagonal().sum() * squared_differential() / 3); }
    double no_gradient() const { return 1e-14 * laplacian_.diagonal().norm() * squared_differential(); }

private:
    static frames::Quaternion frame(const Quaternions& frames, std::int64_t v) {
        return frames::from_wxyz(frames::Vector4(frames.row(v).transpose()));
    }

    static double squared_differential() { return R::differential(frames::Quaternion::Identity()).squaredNorm(); }

    struct Derivatives {
        typename R::Differential differential;
        frames::Matrix3 curvature;  // Hessian of image . embed
    };
    static Derivatives derivatives(const frames::Quaternion& q, const typename R::Vector& value,
                                   const typename R::Vector& image) {
        if constexpr (is_sh4) {
            // What Sh4 would compute from the embedding once more.
            const typename R::Differential d = frames::Harmonics<4>::derivatives(value);
            const frames::Matrix3 products = frames::Harmonics<4>::derivatives(image).transpose().lazyProduct(d);
            return {d, -(products + products.transpose()) / 2};
        } else {
            return {R::differential(q), R::hessian(q, image)};
        }
    }

    const BlockLaplacian& laplacian_;
    ConstraintTurns turns_;
    int threads_;
    Rows<double, R::dimension> values_, images_;
    Rows<double, 3> gradient_;
    Rows<float, R::dimension> turned_;
    std::vector<Eigen::Matrix<float, R::dimension, 3>> differentials_;
    std::vector<Eigen::Matrix3f> curvatures_, inverses_;
};

}  // namespace octafield::volume
