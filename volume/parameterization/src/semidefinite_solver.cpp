#include "semidefinite_solver.hpp"

#include <utility>

#include "aggregation.hpp"
#include "element_assembly.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

constexpr double tolerance = 1e-7;  // of the residual over the right-hand side
constexpr int most_iterations = 2000;

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

// From 0.
SemidefiniteSolution conjugate_gradients(const SparseMatrix& matrix, Eigen::VectorXd residual, int threads) {
    const Aggregation preconditioner(matrix, threads);
    const double small = tolerance * residual.norm();
    Eigen::VectorXd x = Eigen::VectorXd::Zero(residual.size()), direction = x;
    double before = 1;
    int iterations = 0;
    for (; !(residual.norm() <= small); ++iterations) {
        const Eigen::VectorXd near = preconditioner.cycle(residual);
        const double now = residual.dot(near);
        direction = near + now / before * direction;
        before = now;
        const Eigen::VectorXd image = symmetric_product(matrix, direction, threads);
        const double curvature = direction.dot(image);
        if (iterations == most_iterations || !(curvature > 0))
            throw SolverError("the scaling did not converge; look for degenerate tets (octafield info)", "scaling");
        x += now / curvature * direction;
        residual -= now / curvature * image;
    }
    return {std::move(x), iterations};
}

}  // namespace

Parts::Parts(const Tets& elements, Index unknowns) {
    DisjointSets sets(unknowns);
    for (Eigen::Index e = 0; e < elements.rows(); ++e)
        for (int k = 1; k < 4; ++k) sets.join(elements(e, 0), elements(e, k));
    of_unknown = std::move(sets).numbers(count);
}

SemidefiniteSolution solve_semidefinite(const SparseMatrix& matrix, Eigen::VectorXd right, const Parts& parts,
                                        const Tets& elements, const Eigen::VectorXd& weights, int threads) {
    Means rounding(parts);  // the right-hand side must be in the range of the matrix
    for (Index v = 0; v < right.size(); ++v) rounding.add(v, right[v], 1);
    rounding.subtract_from(right);

    SemidefiniteSolution result = conjugate_gradients(matrix, right, threads);

    Means means(parts);
    for (Eigen::Index e = 0; e < elements.rows(); ++e)
        for (int k = 0; k < 4; ++k) means.add(elements(e, k), result.values[elements(e, k)], weights[e]);
    means.subtract_from(result.values);
    return result;
}

}  // namespace octafield::volume
