// Supernodal sparse Cholesky factorization (CHOLMOD), real or complex Hermitian: one analysis of the pattern, many
// factorizations of its values.
#pragma once

#include <cholmod.h>

#include <Eigen/SparseCore>
#include <complex>
#include <string>
#include <type_traits>

#include "octafield/error.hpp"

namespace octafield::surface::detail {

template <class Scalar>
class SparseCholesky {
    static_assert(std::is_same_v<Scalar, double> || std::is_same_v<Scalar, std::complex<double>>);
    static constexpr int xtype = std::is_same_v<Scalar, double> ? CHOLMOD_REAL : CHOLMOD_COMPLEX;

public:
    using Matrix = Eigen::SparseMatrix<Scalar>;  // lower triangle, compressed
    using Vector = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

    // `order`: elimination order (which row comes first, second, ...); a permutation of the rows.
    SparseCholesky(const Matrix& pattern, const Eigen::VectorXi& order) {
        cholmod_start(&common_);
        common_.supernodal = CHOLMOD_SUPERNODAL;
        common_.quick_return_if_not_posdef = 1;
        common_.print = 0;
        common_.nmethods = 1;
        common_.method[0].ordering = CHOLMOD_GIVEN;
        cholmod_sparse view = view_of(pattern);
        factor_ = cholmod_analyze_p(&view, const_cast<int*>(order.data()), nullptr, 0, &common_);
        if (factor_ != nullptr) return;
        const int status = common_.status;
        cholmod_finish(&common_);
        fail(status);
    }
    ~SparseCholesky() {
        cholmod_free_dense(&solution_, &common_);
        cholmod_free_dense(&work_, &common_);
        cholmod_free_dense(&more_work_, &common_);
        cholmod_free_factor(&factor_, &common_);
        cholmod_finish(&common_);
    }
    SparseCholesky(const SparseCholesky&) = delete;
    SparseCholesky& operator=(const SparseCholesky&) = delete;

    // False when the matrix is not positive definite. The pattern must be the one analysed.
    bool factorize(const Matrix& matrix) {
        cholmod_sparse view = view_of(matrix);
        cholmod_factorize(&view, factor_, &common_);
        if (common_.status == CHOLMOD_NOT_POSDEF) return false;
        require(common_.status >= CHOLMOD_OK);
        return factor_->minor == factor_->n;
    }

    Vector solve(const Eigen::Ref<const Vector>& right) {
        cholmod_dense view = {};
        view.nrow = view.nzmax = view.d = right.size();
        view.ncol = 1;
        view.x = const_cast<Scalar*>(right.data());
        view.xtype = xtype;
        view.dtype = CHOLMOD_DOUBLE;
        require(cholmod_solve2(CHOLMOD_A, factor_, &view, nullptr, &solution_, nullptr, &work_, &more_work_, &common_));
        return Eigen::Map<const Vector>(static_cast<const Scalar*>(solution_->x), right.size());
    }

    // Approximate minimum degree order of the pattern: quick, and good for surfaces.
    static Eigen::VectorXi amd_order(const Matrix& pattern) { return order_by(cholmod_amd_order, pattern); }

    // Nested dissection (METIS): slower, and far less fill for volumes.
    static Eigen::VectorXi metis_order(const Matrix& pattern) { return order_by(cholmod_metis_order, pattern); }

private:
    static int cholmod_amd_order(cholmod_sparse* view, int* order, cholmod_common* common) {
        return cholmod_amd(view, nullptr, 0, order, common);
    }
    static int cholmod_metis_order(cholmod_sparse* view, int* order, cholmod_common* common) {
        return cholmod_metis(view, nullptr, 0, 1, order, common);
    }
    template <class Method>
    static Eigen::VectorXi order_by(const Method& method, const Matrix& pattern) {
        cholmod_common common;
        cholmod_start(&common);
        common.print = 0;
        cholmod_sparse view = view_of(pattern);
        Eigen::VectorXi order(pattern.rows());
        const bool success = method(&view, order.data(), &common);
        const int status = common.status;
        cholmod_finish(&common);
        if (!success) fail(status);
        return order;
    }

    static cholmod_sparse view_of(const Matrix& matrix) {
        cholmod_sparse view = {};
        view.nrow = matrix.rows();
        view.ncol = matrix.cols();
        view.nzmax = matrix.nonZeros();
        view.p = const_cast<int*>(matrix.outerIndexPtr());
        view.i = const_cast<int*>(matrix.innerIndexPtr());
        view.x = const_cast<Scalar*>(matrix.valuePtr());
        view.stype = -1;
        view.itype = CHOLMOD_INT;
        view.xtype = xtype;
        view.dtype = CHOLMOD_DOUBLE;
        view.sorted = 1;
        view.packed = 1;
        return view;
    }

    void require(bool success) const {
        if (!success) fail(common_.status);
    }

    [[noreturn]] static void fail(int status) {
        if (status == CHOLMOD_OUT_OF_MEMORY || status == CHOLMOD_TOO_LARGE)
            throw SolverError("not enough memory to factorize the direction field's matrix; use a coarser surface");
        throw SolverError("the factorization of the direction field's matrix failed (CHOLMOD status " +
                          std::to_string(status) + ")");
    }

    cholmod_common common_ = {};
    cholmod_factor* factor_ = nullptr;
    cholmod_dense *solution_ = nullptr, *work_ = nullptr, *more_work_ = nullptr;
};

}  // namespace octafield::surface::detail
