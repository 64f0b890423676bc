#include "aggregation.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "element_assembly.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

using Eigen::VectorXd;
using Entry = SparseMatrix::InnerIterator;

constexpr Index few = 500;      // unknowns, solved directly
constexpr double least = 0.05;  // strength of a coupling, on the first level; half of it on each further one
constexpr int power_steps = 12;

// A group that is a whole part of the mesh: its row is 0 but for rounding.
bool alone(const SparseMatrix& matrix, Index v) {
    return matrix.outerIndexPtr()[v + 1] - matrix.outerIndexPtr()[v] < 2;
}

VectorXd inverse_diagonal(const SparseMatrix& matrix) {
    VectorXd inverse = matrix.diagonal().cwiseInverse();
    for (Index v = 0; v < inverse.size(); ++v)
        if (alone(matrix, v)) inverse[v] = 0;
    return inverse;
}

// Symmetric, so that column v has the couplings of unknown v.
class Couplings {
public:
    Couplings(const SparseMatrix& matrix, const VectorXd& inverse_diagonal, double least)
        : matrix_(matrix), scale_(inverse_diagonal.cwiseSqrt()), least_(least) {}

    // body(other, strength) for those that v is strongly coupled with.
    template <class Body>
    void for_each(Index v, const Body& body) const {
        for (Entry entry(matrix_, v); entry; ++entry) {
            const Index other = static_cast<Index>(entry.row());
            const double strength = std::abs(entry.value()) * scale_[v] * scale_[other];
            if (other != v && strength > least_) body(other, strength);
        }
    }

private:
    const SparseMatrix& matrix_;
    VectorXd scale_;
    double least_;
};

struct Groups {
    std::vector<Index> of;
    Index count = 0;
};

// First unknowns with all they are coupled with, where none of these has a group; then the others join the group they
// are coupled with most, or form groups of their own.
Groups groups_of(const Couplings& couplings, Index unknowns) {
    std::vector<Index> of(unknowns, -1);
    Index count = 0;
    const auto found = [&](Index v) {
        of[v] = count;
        couplings.for_each(v, [&](Index other, double) { of[other] = of[other] < 0 ? count : of[other]; });
        ++count;
    };
    for (Index v = 0; v < unknowns; ++v) {
        bool single = true, free = of[v] < 0;
        if (free) couplings.for_each(v, [&](Index other, double) { single = false, free = free && of[other] < 0; });
        if (free && !single) found(v);
    }
    std::vector<Index> joined = of;
    for (Index v = 0; v < unknowns; ++v) {
        double most = 0;
        if (of[v] < 0)
            couplings.for_each(v, [&](Index other, double strength) {
                if (of[other] < 0 || strength <= most) return;
                most = strength;
                joined[v] = of[other];
            });
    }
    of = std::move(joined);
    for (Index v = 0; v < unknowns; ++v)
        if (of[v] < 0) found(v);
    return {std::move(of), count};
}

// Of D^-1 matrix.
double largest_eigenvalue(const SparseMatrix& matrix, const VectorXd& inverse, int threads) {
    VectorXd x(matrix.cols());
    for (Eigen::Index v = 0; v < x.size(); ++v) x[v] = std::sin(1.7 * static_cast<double>(v) + 1);
    double value = 1;
    for (int k = 0; k < power_steps; ++k) {
        x = inverse.cwiseProduct(symmetric_product(matrix, x / x.norm(), threads)).eval();
        value = x.norm();
    }
    return value;
}

// (1 - omega D^-1 matrix) times the indicator functions, omega = 4/3 over the largest eigenvalue of D^-1 matrix.
SparseMatrix smoothed_groups(const SparseMatrix& matrix, const VectorXd& inverse, double least_strength, int threads) {
    const Index unknowns = static_cast<Index>(matrix.cols());
    const Groups groups = groups_of(Couplings(matrix, inverse, least_strength), unknowns);
    const double omega = 4.0 / 3 / largest_eigenvalue(matrix, inverse, threads);
    SparseMatrix indicators(groups.count, unknowns);
    indicators.reserve(unknowns);
    for (Index v = 0; v < unknowns; ++v) {
        indicators.startVec(v);
        indicators.insertBack(groups.of[v], v) = 1;
    }
    indicators.finalize();
    const SparseMatrix steps = matrix * (omega * inverse).asDiagonal();
    const SparseMatrix transposed = indicators - SparseMatrix(indicators * steps);
    return transposed.transpose();
}

// One of Gauss and Seidel's; upwards or downwards.
void sweep(const SparseMatrix& matrix, const VectorXd& inverse, const VectorXd& right, VectorXd& x, bool up) {
    const Index unknowns = static_cast<Index>(matrix.cols());
    for (Index i = 0; i < unknowns; ++i) {
        const Index v = up ? i : unknowns - 1 - i;
        double rest = right[v];
        for (Entry entry(matrix, v); entry; ++entry) rest -= entry.value() * x[entry.row()];
        x[v] += inverse[v] * rest;
    }
}

// The matrix with the diagonal doubled at one unknown of each part: regular, and the solution of a right-hand side in
// the range is one that is 0 there.
SparseMatrix pinned(SparseMatrix matrix) {
    DisjointSets parts(matrix.cols());
    for (Index v = 0; v < matrix.cols(); ++v)
        for (Entry entry(matrix, v); entry; ++entry) parts.join(v, static_cast<Index>(entry.row()));
    for (Index v = 0; v < matrix.cols(); ++v)
        if (parts.lowest(v) == v) matrix.coeffRef(v, v) = alone(matrix, v) ? 1 : 2 * matrix.coeff(v, v);
    return matrix;
}

}  // namespace

Aggregation::Aggregation(const SparseMatrix& given, int threads) : first_(given), threads_(threads) {
    double strength = least;
    for (; matrix(coarser_.size()).cols() > few; strength /= 2) {
        const SparseMatrix& fine = matrix(coarser_.size());
        VectorXd inverse = inverse_diagonal(fine);
        SparseMatrix groups = smoothed_groups(fine, inverse, strength, threads);
        if (10 * groups.cols() > 9 * groups.rows()) break;  // nearly all are alone
        inverse_.push_back(std::move(inverse));
        const SparseMatrix images = fine * groups;
        coarser_.push_back(groups.transpose() * images);
        prolongation_.push_back(std::move(groups));
    }
    last_.compute(pinned(matrix(coarser_.size())));
    if (last_.info() != Eigen::Success)
        throw SolverError("the scaling's matrix could not be factorized; look for degenerate tets (octafield info)",
                          "scaling");
}

VectorXd Aggregation::cycle(std::size_t level, const VectorXd& right) const {
    if (level == coarser_.size()) return last_.solve(right);
    VectorXd x = VectorXd::Zero(right.size());
    sweep(matrix(level), inverse_[level], right, x, true);
    const VectorXd left = prolongation_[level].transpose() * (right - symmetric_product(matrix(level), x, threads_));
    x += prolongation_[level] * cycle(level + 1, left);
    sweep(matrix(level), inverse_[level], right, x, false);
    return x;
}

}  // namespace octafield::volume
