#include "octafield/frames/odeco.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "joint_eigenvectors.hpp"
#include "nearest_frame.hpp"
#include "octafield/frames/harmonics.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/frames/tensor4.hpp"
#include "odeco_bands.hpp"
#include "quartic_bands.hpp"

namespace octafield::frames {
namespace {

using Vector = Odeco::Vector;

auto band2(auto& v) { return v.template middleRows<5>(band_start[1]); }
auto band4(auto& v) { return v.template bottomRows<9>(); }

// Odeco coordinates over band coordinates of the tensor: (r . x)^4 has the harmonic coefficients lambda_l Y_lm(r), its
// tensor the band coordinates sqrt(lambda_l) Y_lm(r), and sh4 the axis sqrt(16 pi / 189) Y_4m(r).
const Vector& scales() {
    static const Vector s = [] {
        const auto& lambda = kernel_eigenvalues();
        const double sh4 = std::sqrt(16 * std::numbers::pi / 189) / lambda[2];
        Vector k;
        for (int band = 0; band < 3; ++band)
            k.segment(band_start[band], band_size[band]).setConstant(sh4 * std::sqrt(lambda[band]));
        return k;
    }();
    return s;
}

// Monomials of an axis to its odeco coordinates.
const Matrix15& axis_matrix() {
    static const Matrix15 m = scales().asDiagonal() * quartic_bands() * root_multiplicities().asDiagonal();
    return m;
}

Odeco::Differential derivatives(const Vector& v) {
    Odeco::Differential d;
    d << Eigen::RowVector3d::Zero(), Harmonics<2>::derivatives(band2(v)), Harmonics<4>::derivatives(band4(v));
    return d;
}

}  // namespace

Vector odeco_axis(const Vector3& r) { return axis_matrix() * quartic_monomials(r); }

Quartic odeco_correlation(const Vector& v) { return Quartic(axis_matrix().transpose() * v); }

Vector15 odeco_tensor(const Vector& v) { return quartic_bands().transpose() * v.cwiseQuotient(scales()); }

OdecoFrame odeco_fit(const Quaternion& q, const Vector& v) {
    const Matrix3 axes = q.toRotationMatrix();
    Vector3 b;
    for (int k = 0; k < 3; ++k) b[k] = odeco_axis(axes.col(k)).dot(v);
    // Inverse of alpha I + beta 1 1^T.
    const double shared = odeco_beta / (odeco_alpha + 3 * odeco_beta) * b.sum();
    const Vector3 lengths = (b.array() - shared) / odeco_alpha;
    std::array<int, 3> order = {0, 1, 2};
    std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return lengths[i] > lengths[j]; });
    Matrix3 sorted;
    OdecoFrame result;
    for (int k = 0; k < 3; ++k) sorted.col(k) = axes.col(order[k]), result.lengths[k] = lengths[order[k]];
    if (sorted.determinant() < 0) sorted.col(2) *= -1;
    result.frame = Quaternion(sorted).normalized();
    result.distance = (v - Odeco::embed(result.frame, result.lengths)).stableNorm();
    return result;
}

Vector Odeco::embed(const Quaternion& q) { return embed(q, Vector3::Ones()); }

Vector Odeco::embed(const Quaternion& q, const Vector3& lengths) {
    require_unit(q);
    require_finite(lengths, "an axis length");
    const Matrix3 axes = q.toRotationMatrix();
    Vector15 sum = lengths[0] * quartic_monomials(axes.col(0));
    for (int k = 1; k < 3; ++k) sum += lengths[k] * quartic_monomials(axes.col(k));
    return axis_matrix() * sum;
}

Odeco::Differential Odeco::differential(const Quaternion& q) {
    require_unit(q);
    Differential d = Differential::Zero();  // degrees 0 and 2 are the same for all frames
    band4(d) = Sh4::differential(q);
    return d;
}

Odeco::FullDifferential Odeco::differential(const Quaternion& q, const Vector3& lengths) {
    FullDifferential d;
    d.leftCols<3>() = derivatives(embed(q, lengths));
    const Matrix3 axes = q.toRotationMatrix();
    for (int k = 0; k < 3; ++k) d.col(3 + k) = odeco_axis(axes.col(k));
    return d;
}

Matrix3 Odeco::hessian(const Quaternion& q, const Vector& v) {
    require_unit(q);
    require_finite(v, "the vector paired with the Hessian");
    return Sh4::hessian(q, band4(v));
}

Vector Odeco::rotate(const Quaternion& g, const Vector& v) {
    require_finite(v, "the vector to rotate");
    Vector rotated;
    rotated << v[0], Harmonics<2>::rotate(g, band2(v)), Harmonics<4>::rotate(g, band4(v));
    return rotated;
}

Projection Odeco::project(const Vector& v, const Quaternion* guess) {
    require_finite(v, "the vector to project");
    const Quaternion frame = Sh4::project(band4(v), guess).frame;
    return {frame, (v - embed(frame)).stableNorm()};
}

// Palmer, Bommes, Solomon 2020 (after Robeva 2016): a tensor is odeco exactly if its contractions A_ij.. commute; their
// common eigenvectors are the axes.
OdecoFrame Odeco::extract(const Vector& v) {
    require_finite(v, "the tensor to extract axes from");
    const double size = v.stableNorm();
    if (!(size > 0)) return {Quaternion::Identity(), Vector3::Zero(), 0};
    const Tensor4::Full a = Tensor4::full(odeco_tensor(v / size));
    std::vector<Matrix3> contractions;
    for (const int ij : {0, 4, 8, 5, 6, 1}) {
        const double weight = ij % 4 == 0 ? 1 : std::numbers::sqrt2;  // A_ij.. stands for A_ji.. too
        contractions.push_back(weight * a.row(ij).reshaped(3, 3));
    }
    return odeco_fit(Quaternion(joint_eigenvectors(contractions)).normalized(), v);
}

}  // namespace octafield::frames
