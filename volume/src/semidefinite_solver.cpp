#include "semidefinite_solver.hpp"

#include <Eigen/IterativeLinearSolvers>
#include <utility>

#include "disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

constexpr double tolerance = 1e-7;  // of the residual over the right-hand side

// values -= mean of the part; the mean is over `places` unknowns with their weights.
class Means {
public:
    explicit Means(const Parts& parts)
        : parts_(parts), sum_(Eigen::VectorXd::Zero(parts.count)), weight_(Eigen::VectorXd::Zero(parts.count)) {}
    void add(Index unknown, double value, double weight) {
        sum_[parts_.of_unknown[unknown]] += weight * value;
        weight_[parts_.of_unknown[unknown]] += weight;
    }
    void subtract_from(Eigen::VectorXd& values) const {
        for (Eigen::Index v = 0; v < values.size(); ++v) {
            const Index part = parts_.of_unknown[v];
            values[v] -= sum_[part] / weight_[part];
        }
    }

private:
    const Parts& parts_;
    Eigen::VectorXd sum_, weight_;
};

}  // namespace

Parts::Parts(const Tets& elements, Index unknowns) {
    DisjointSets sets(unknowns);
    for (Eigen::Index e = 0; e < elements.rows(); ++e)
        for (int k = 1; k < 4; ++k) sets.join(elements(e, 0), elements(e, k));
    of_unknown = std::move(sets).numbers(count);
}

SemidefiniteSolution solve_semidefinite(const SparseMatrix& matrix, Eigen::VectorXd right, const Parts& parts,
                                        const Tets& elements, const Eigen::VectorXd& weights) {
    Means rounding(parts);  // the right-hand side must be in the range of the matrix
    for (Index v = 0; v < right.size(); ++v) rounding.add(v, right[v], 1);
    rounding.subtract_from(right);

    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double, Eigen::Lower, Eigen::NaturalOrdering<int>>> solver;
    solver.setTolerance(tolerance);
    solver.compute(matrix);
    if (solver.info() != Eigen::Success)
        throw SolverError("the scaling's matrix could not be factorized; look for degenerate tets (octafield info)",
                          "scaling");
    SemidefiniteSolution result{solver.solve(right), static_cast<int>(solver.iterations())};
    if (solver.info() != Eigen::Success || !result.values.allFinite())
        throw SolverError("the scaling did not converge; look for degenerate tets (octafield info)", "scaling");

    Means means(parts);
    for (Eigen::Index e = 0; e < elements.rows(); ++e)
        for (int k = 0; k < 4; ++k) means.add(elements(e, k), result.values[elements(e, k)], weights[e]);
    means.subtract_from(result.values);
    return result;
}

}  // namespace octafield::volume
