// tensor4: frames as fourth-order symmetric tensors (Chemin, Henrotte, Remacle, Van Schaftingen 2018).
//
// A_ijkl = sum_m R_im R_jm R_km R_lm. A fully symmetric tensor has 15 independent entries A_ijkl, i <= j <= k <= l, one
// per monomial x^a y^b z^c, a + b + c = 4, in the order x4 x3y x3z x2y2 x2yz x2z2 xy3 xy2z xyz2 xz3 y4 y3z y2z2 yz3 z4.
// The embedding multiplies each by the square root of its multiplicity 4!/(a! b! c!), so that Euclidean distance in
// R^15 is the Frobenius distance of the full tensors: sqrt(6/5) times that of the sh4 vectors (linearly isometric).
#pragma once

#include <string_view>

#include "octafield/frames/representation.hpp"
#include "octafield/frames/sh4.hpp"

namespace octafield::frames {

struct Tensor4 {
    static constexpr std::string_view name = "tensor4";
    static constexpr int dimension = 15;
    static constexpr BandWeights band_weights = {1.2, 0, 0};
    static constexpr double speed = 2.8284271247461903;  // sqrt(8)
    using Vector = Eigen::Matrix<double, dimension, 1>;
    using Differential = Eigen::Matrix<double, dimension, 3>;
    using Full = Eigen::Matrix<double, 9, 9>;    // row 3 i + j, column 3 k + l: A_ijkl
    using Mandel = Eigen::Matrix<double, 6, 6>;  // A as a map of symmetric matrices, in the orthonormal basis xx, yy,
                                                 // zz, sqrt2 yz, sqrt2 zx, sqrt2 xy
    using Affine = Eigen::Matrix<double, 9, 1>;

    static Vector embed(const Quaternion& q);
    static Differential differential(const Quaternion& q);
    static Matrix3 hessian(const Quaternion& q, const Vector& v);
    static Vector rotate(const Quaternion& g, const Vector& v);
    // Frobenius-nearest frame, through the isometry with sh4. Zero gives the identity; throws InvalidInput if v is not
    // finite.
    static Projection project(const Vector& v, const Quaternion* guess = nullptr);

    // Other coordinates of the same symmetric tensor.
    static Full full(const Vector& v);
    static Vector from_full(const Full& a);    // the symmetric part: orthogonal projection from all 81 entries
    static Vector monomials(const Vector& v);  // coefficients of the polynomial A_ijkl x_i x_j x_k x_l
    static Vector from_monomials(const Vector& coefficients);
    static Mandel mandel(const Vector& v);
    static Vector from_mandel(const Mandel& m);  // the symmetric part again: Mandel matrices have 21 entries, not 15

    // Chemin's nine parameters: orthonormal coordinates of the affine subspace of tensors with the partial traces
    // A_iikl = delta_kl, which holds every frame. The origin is its point nearest to zero.
    static Affine affine(const Vector& v);  // of the orthogonal projection of v onto that subspace
    static Vector from_affine(const Affine& p);

    // The isometry: from_sh4(a) is the tensor with the partial traces of a frame whose degree-4 part is a.
    static Sh4::Vector to_sh4(const Vector& v);
    static Vector from_sh4(const Sh4::Vector& a);

    // How far 81 numbers are from being a frame (Chemin et al. 2018, the algebraic characterisation): all three are
    // zero exactly for frames.
    struct Residual {
        double symmetry;       // Frobenius distance to full symmetry
        double partial_trace;  // Frobenius norm of A_iikl - delta_kl of the symmetric part
        double projector;      // Frobenius norm of P P - P, P the Mandel matrix of the symmetric part
    };
    static Residual residual(const Full& a);

    // Recovery by eigentensors: the joint eigenvectors of the three symmetric matrices that span the eigenspace of the
    // largest eigenvalues of the Mandel matrix. Exact for frames; near them within the order of the error of v.
    // Throws InvalidInput if v is not finite or zero.
    static Quaternion recover(const Vector& v);
};

static_assert(Equivariant<Tensor4>);

}  // namespace octafield::frames
