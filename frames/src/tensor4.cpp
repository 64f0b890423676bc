#include "octafield/frames/tensor4.hpp"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "joint_eigenvectors.hpp"
#include "nearest_frame.hpp"
#include "octafield/frames/harmonics.hpp"
#include "quartic_bands.hpp"

namespace octafield::frames {
namespace {

using Vector = Tensor4::Vector;

// Index pairs and weights of Mandel's orthonormal basis of symmetric matrices.
constexpr int mandel_pairs[6][2] = {{0, 0}, {1, 1}, {2, 2}, {1, 2}, {2, 0}, {0, 1}};
constexpr double mandel_weights[6] = {1, 1, 1, std::numbers::sqrt2, std::numbers::sqrt2, std::numbers::sqrt2};

// Number of the monomial x_i x_j x_k x_l of each of the 81 entries, in the order of Full's rows and columns.
const std::array<int, 81>& monomial_of_entry() {
    static const auto table = [] {
        std::array<int, 81> t{};
        for (int n = 0; n < 81; ++n) {
            int exponents[3] = {0, 0, 0};
            for (const int axis : {n / 27, n / 9 % 3, n / 3 % 3, n % 3}) ++exponents[axis];
            while (quartic_exponents[t[n]][0] != exponents[0] || quartic_exponents[t[n]][1] != exponents[1]) ++t[n];
        }
        return t;
    }();
    return table;
}

// Degree-4 band over the sh4 vector: the Frobenius length of the degree-4 part of a frame.
const double sh4_scale = std::sqrt(1.2);

// The point of Chemin's affine subspace nearest to zero: (delta_ij delta_kl + delta_ik delta_jl + delta_il delta_jk)
// / 5.
const Vector& isotropic() {
    static const Vector centre = [] {
        Vector m = Vector::Zero();  // the polynomial 3/5 (x^2 + y^2 + z^2)^2
        for (int c = 0; c < 15; ++c) {
            const auto& e = quartic_exponents[c];
            if (e[0] == 4 || e[1] == 4 || e[2] == 4) m[c] = 0.6;
            if (e[0] % 2 == 0 && e[1] % 2 == 0 && m[c] == 0) m[c] = 1.2;
        }
        return Tensor4::from_monomials(m);
    }();
    return centre;
}

auto degree4_rows() { return quartic_bands().bottomRows<9>(); }

Matrix3 from_mandel_vector(const Eigen::Matrix<double, 6, 1>& v) {
    Matrix3 m;
    for (int a = 0; a < 6; ++a) {
        const auto [i, j] = mandel_pairs[a];
        m(i, j) = m(j, i) = v[a] / mandel_weights[a];
    }
    return m;
}

}  // namespace

Tensor4::Vector Tensor4::embed(const Quaternion& q) {
    require_unit(q);
    const Matrix3 axes = q.toRotationMatrix();
    Vector sum = quartic_monomials(axes.col(0));
    for (int k = 1; k < 3; ++k) sum += quartic_monomials(axes.col(k));
    return root_multiplicities().cwiseProduct(sum);
}

Tensor4::Differential Tensor4::differential(const Quaternion& q) {
    require_unit(q);
    return sh4_scale * degree4_rows().transpose() * Sh4::differential(q);
}

Matrix3 Tensor4::hessian(const Quaternion& q, const Vector& v) {
    require_unit(q);
    require_finite(v, "the vector paired with the Hessian");
    return 1.2 * Sh4::hessian(q, to_sh4(v));
}

Tensor4::Vector Tensor4::rotate(const Quaternion& g, const Vector& v) {
    require_finite(v, "the vector to rotate");
    Vector bands = quartic_bands() * v;
    bands.segment<5>(band_start[1]) = Harmonics<2>::rotate(g, bands.segment<5>(band_start[1]));
    bands.segment<9>(band_start[2]) = Harmonics<4>::rotate(g, bands.segment<9>(band_start[2]));
    return quartic_bands().transpose() * bands;
}

Projection Tensor4::project(const Vector& v, const Quaternion* guess) {
    require_finite(v, "the vector to project");
    const Quaternion frame = Sh4::project(to_sh4(v), guess).frame;
    return {frame, (v - embed(frame)).stableNorm()};
}

Tensor4::Full Tensor4::full(const Vector& v) {
    const Vector entries = v.cwiseQuotient(root_multiplicities());
    Full a;
    for (int n = 0; n < 81; ++n) a(n / 9, n % 9) = entries[monomial_of_entry()[n]];
    return a;
}

Tensor4::Vector Tensor4::from_full(const Full& a) {
    Vector sums = Vector::Zero();
    for (int n = 0; n < 81; ++n) sums[monomial_of_entry()[n]] += a(n / 9, n % 9);
    return sums.cwiseQuotient(root_multiplicities());  // mean over the multiplicity, times its root
}

Tensor4::Vector Tensor4::monomials(const Vector& v) { return v.cwiseProduct(root_multiplicities()); }

Tensor4::Vector Tensor4::from_monomials(const Vector& coefficients) {
    return coefficients.cwiseQuotient(root_multiplicities());
}

Tensor4::Mandel Tensor4::mandel(const Vector& v) {
    const Full a = full(v);
    Mandel m;
    for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c)
            m(r, c) = mandel_weights[r] * mandel_weights[c] *
                      a(3 * mandel_pairs[r][0] + mandel_pairs[r][1], 3 * mandel_pairs[c][0] + mandel_pairs[c][1]);
    return m;
}

Tensor4::Vector Tensor4::from_mandel(const Mandel& m) {
    Full a;
    for (int r = 0; r < 6; ++r)
        for (int c = 0; c < 6; ++c) {
            const double entry = m(r, c) / (mandel_weights[r] * mandel_weights[c]);
            const auto [i, j] = mandel_pairs[r];
            const auto [k, l] = mandel_pairs[c];
            a(3 * i + j, 3 * k + l) = a(3 * j + i, 3 * k + l) = a(3 * i + j, 3 * l + k) = a(3 * j + i, 3 * l + k) =
                entry;
        }
    return from_full(a);
}

Tensor4::Affine Tensor4::affine(const Vector& v) { return degree4_rows() * v; }

Tensor4::Vector Tensor4::from_affine(const Affine& p) { return isotropic() + degree4_rows().transpose() * p; }

Sh4::Vector Tensor4::to_sh4(const Vector& v) { return affine(v) / sh4_scale; }

Tensor4::Vector Tensor4::from_sh4(const Sh4::Vector& a) { return from_affine(sh4_scale * a); }

// Chemin et al. 2018: full symmetry, partial traces and P P = P characterise frames. Their proof in short: P projects
// onto three orthonormal symmetric matrices E_a; sum_a E_a^2 is the partial trace, I, and with full symmetry sum_ab
// |[E_a, E_b]|^2 = 2 (|I|^2 - |A|^2) = 2 (3 - tr P) = 0, so they share their eigenvectors.
Tensor4::Residual Tensor4::residual(const Full& a) {
    require_finite(a, "the tensor");
    const Vector v = from_full(a);
    const Full symmetric = full(v);
    Matrix3 trace = -Matrix3::Identity();
    for (int kl = 0; kl < 9; ++kl) trace(kl / 3, kl % 3) += symmetric(0, kl) + symmetric(4, kl) + symmetric(8, kl);
    const Mandel p = mandel(v);
    return {(a - symmetric).norm(), trace.norm(), (p * p - p).norm()};
}

// The sum of three eigentensors, whose eigenvectors the literature takes as the axes, can have repeated eigenvalues:
// the eigenspace has no preferred basis, and for one made of the r_m r_m^T the sum is the identity.
Quaternion Tensor4::recover(const Vector& v) {
    require_finite(v, "the tensor to recover a frame from");
    const double size = v.stableNorm();
    if (!(size > 0)) throw InvalidInput("the zero tensor has no eigentensors to recover a frame from", "zero_tensor");
    const Eigen::SelfAdjointEigenSolver<Mandel> eigen(mandel(v / size));
    std::vector<Matrix3> eigentensors;
    for (int k = 3; k < 6; ++k) eigentensors.push_back(from_mandel_vector(eigen.eigenvectors().col(k)));
    return Quaternion(joint_eigenvectors(eigentensors)).normalized();
}

}  // namespace octafield::frames
