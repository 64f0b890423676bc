#include "log_factors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double gain_tolerance = 1e-12;   // to be expected from a step, relative to the objective
constexpr double least_curvature = 1e-10;  // of a term, relative to the largest: a term's own vanishes at a = 0
constexpr int most_halvings = 60;

struct Derivatives {
    double value, slope, curvature;
};

// Of q^p, q = 4 sinh^2(a / 2) = 2 cosh a - 2, p = 2 power.
Derivatives ratio_term(double a, int power) {
    const double half = std::sinh(a / 2), q = 4 * half * half, slope = 2 * std::sinh(a), p = 2.0 * power;
    const double lower = std::pow(q, p - 2);
    return {lower * q * q, p * lower * q * slope, p * lower * ((p - 1) * slope * slope + q * (q + 2))};
}

class Problem {
public:
    Problem(const std::vector<RatioTerm>& terms, Index unknowns, int power) : terms_(terms), power_(power) {
        DisjointSets sets(unknowns);
        for (const RatioTerm& term : terms) sets.join(term.one, term.other);
        part_.resize(unknowns);
        row_.assign(unknowns, -1);
        for (Index i = 0; i < unknowns; ++i) {
            part_[i] = sets.lowest(i);
            if (part_[i] != i) row_[i] = rows_++;
        }
    }

    LogFactors solve(int max_iterations, const std::function<bool(double)>& go_on) {
        LogFactors result;
        result.part = part_;
        result.x = Eigen::VectorXd::Zero(static_cast<Index>(part_.size()));
        if (rows_ == 0) {
            result.objective = objective(result.x);
            return result;
        }
        std::vector<Derivatives> squares;
        for (const RatioTerm& term : terms_) squares.push_back({0, 2 * term.offset, 2});
        result.x += step(squares);
        result.objective = objective(result.x);
        result.converged = false;
        while (result.iterations < max_iterations && go_on(result.objective)) {
            ++result.iterations;
            if (descend(result)) continue;
            result.converged = true;
            break;
        }
        return result;
    }

private:
    double ratio(const RatioTerm& term, const Eigen::VectorXd& x) const {
        return term.offset + x[term.one] - x[term.other];
    }

    double objective(const Eigen::VectorXd& x) const {
        double sum = 0;
        for (const RatioTerm& term : terms_) sum += ratio_term(ratio(term, x), power_).value;
        return std::isfinite(sum) ? sum : std::numeric_limits<double>::infinity();
    }

    // Whether the objective could be lowered by more than rounding.
    bool descend(LogFactors& result) {
        std::vector<Derivatives> derivatives;
        double largest = 0;
        for (const RatioTerm& term : terms_) {
            derivatives.push_back(ratio_term(ratio(term, result.x), power_));
            largest = std::max(largest, derivatives.back().curvature);
        }
        if (!(largest > std::numeric_limits<double>::min())) return false;
        for (Derivatives& term : derivatives) {
            term.curvature = term.curvature / largest + least_curvature;
            term.slope /= largest;
        }
        const Eigen::VectorXd step = this->step(derivatives);
        double slope = 0;
        for (std::size_t i = 0; i < terms_.size(); ++i)
            slope += largest * derivatives[i].slope * (step[terms_[i].one] - step[terms_[i].other]);
        if (!(-slope > gain_tolerance * result.objective)) return false;
        double part = 1;
        for (int halving = 0; halving < most_halvings; ++halving, part /= 2) {
            const Eigen::VectorXd tried = result.x + part * step;
            const double lower = objective(tried);
            if (!(lower <= result.objective + 1e-4 * part * slope)) continue;
            result.x = tried;
            result.objective = lower;
            return true;
        }
        return false;
    }

    // Of Newton's method.
    Eigen::VectorXd step(const std::vector<Derivatives>& derivatives) {
        std::vector<Eigen::Triplet<double>> entries;
        Eigen::VectorXd right = Eigen::VectorXd::Zero(rows_);
        for (std::size_t i = 0; i < terms_.size(); ++i) {
            const Index a = row_[terms_[i].one], b = row_[terms_[i].other];
            if (a >= 0) entries.emplace_back(a, a, derivatives[i].curvature);
            if (b >= 0) entries.emplace_back(b, b, derivatives[i].curvature);
            if (a >= 0 && b >= 0) entries.emplace_back(std::max(a, b), std::min(a, b), -derivatives[i].curvature);
            if (a >= 0) right[a] -= derivatives[i].slope;
            if (b >= 0) right[b] += derivatives[i].slope;
        }
        Eigen::SparseMatrix<double> matrix(rows_, rows_);
        matrix.setFromTriplets(entries.begin(), entries.end());
        using Cholesky = SparseCholesky<double>;
        if (!cholesky_) cholesky_ = std::make_unique<Cholesky>(matrix, Cholesky::amd_order(matrix));
        if (!cholesky_->factorize(matrix))
            throw SolverError(
                "the anisotropies at crossings differ too much for double precision; use a smaller power "
                "or a shorter max_length",
                "not_definite");
        const Eigen::VectorXd found = cholesky_->solve(right);
        Eigen::VectorXd all = Eigen::VectorXd::Zero(static_cast<Index>(row_.size()));
        for (std::size_t i = 0; i < row_.size(); ++i)
            if (row_[i] >= 0) all[static_cast<Index>(i)] = found[row_[i]];
        return all;
    }

    const std::vector<RatioTerm>& terms_;
    int power_;
    std::vector<Index> part_, row_;
    Index rows_ = 0;
    std::unique_ptr<SparseCholesky<double>> cholesky_;
};

}  // namespace

LogFactors least_log_factors(const std::vector<RatioTerm>& terms, Index unknowns, int power, int max_iterations,
                             const std::function<bool(double)>& go_on) {
    return Problem(terms, unknowns, power).solve(max_iterations, go_on);
}

}  // namespace octafield::surface::detail
