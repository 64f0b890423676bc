// Laplace-like systems without boundary values, against direct solutions.
#include "semidefinite_solver.hpp"

#include <gtest/gtest.h>

#include <Eigen/SparseCholesky>
#include <cmath>
#include <random>
#include <vector>

#include "field_fixtures.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/operators.hpp"
#include "tet_fixtures.hpp"

namespace octafield::volume {
namespace {

using testing::jittered_cube;
using testing::kuhn_grid;

Eigen::VectorXd random_right(Eigen::Index size, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    std::uniform_real_distribution<double> uniform(-1, 1);
    Eigen::VectorXd right(size);
    for (double& value : right) value = uniform(generator);
    return right;
}

SemidefiniteSolution solve(const TetMesh& mesh, const Eigen::VectorXd& right) {
    const Parts parts(mesh.tets, static_cast<Index>(mesh.vertices.rows()));
    return solve_semidefinite(stiffness(mesh), right, parts, mesh.tets, tet_volumes(mesh), 2);
}

// With the first unknown of each part held at 0, as sparse Cholesky has it; then both less the mean over vertices.
void expect_as_direct(const TetMesh& mesh, double tolerance) {
    const Index n = static_cast<Index>(mesh.vertices.rows());
    const Parts parts(mesh.tets, n);
    const auto centred = [&](Eigen::VectorXd values) {
        Eigen::VectorXd sum = Eigen::VectorXd::Zero(parts.count), count = sum;
        for (Index v = 0; v < n; ++v) sum[parts.of_unknown[v]] += values[v], ++count[parts.of_unknown[v]];
        for (Index v = 0; v < n; ++v) values[v] -= sum[parts.of_unknown[v]] / count[parts.of_unknown[v]];
        return values;
    };
    const Eigen::VectorXd right = centred(random_right(n, 3));
    SparseMatrix held = stiffness(mesh);
    std::vector<bool> seen(parts.count);
    for (Index v = 0; v < n; ++v)
        if (!seen[parts.of_unknown[v]]) held.coeffRef(v, v) += 1, seen[parts.of_unknown[v]] = true;
    const Eigen::VectorXd direct = centred(Eigen::SimplicialLDLT<SparseMatrix>(held).solve(right));
    const SemidefiniteSolution found = solve(mesh, right);
    EXPECT_LT((centred(found.values) - direct).norm(), tolerance * direct.norm());
    EXPECT_GT(found.iterations, 0);
}

TetMesh stretched(TetMesh mesh, double x) {
    mesh.vertices.col(0) *= x;
    return mesh;
}

TEST(SemidefiniteSolver, AgreesWithSparseCholesky) {
    expect_as_direct(jittered_cube(14, 0.2, 1), 1e-6);
    expect_as_direct(stretched(jittered_cube(14, 0.2, 1), 20), 1e-5);
}

// The long bar goes on over three levels, on which the cubes beside it are single unknowns.
TEST(SemidefiniteSolver, AgreesWithSparseCholeskyOnPartsOfDifferentSizes) {
    const auto bar_and_cubes = [](int i, int j, int) { return i < 12 || (i > 12 && i % 2 == 1 && j % 2 == 1); };
    expect_as_direct(kuhn_grid(22, 12, 12, 0.1, Eigen::Vector3d::Zero(), bar_and_cubes), 1e-6);
}

TEST(SemidefiniteSolver, TakesHardlyMoreStepsAsTheMeshIsRefined) {
    for (const double stretch : {1.0, 8.0}) {
        std::vector<int> steps;
        for (const int n : {8, 16, 32}) {
            const TetMesh mesh = stretched(jittered_cube(n, 0.2, 1), stretch);
            const Eigen::VectorXd wave =
                (3 * mesh.vertices.col(1).array()).sin() + random_right(mesh.vertices.rows(), 5).array();
            steps.push_back(solve(mesh, lumped_mass(mesh).cwiseProduct(wave)).iterations);
        }
        EXPECT_LE(steps[2], 25) << "stretched by " << stretch;
        EXPECT_LE(steps[2], steps[1] + 4) << "stretched by " << stretch;
    }
}

TEST(SemidefiniteSolver, OfZeroIsZeroAndRefusesWhatIsNotFinite) {
    const TetMesh mesh = jittered_cube(9, 0.2, 1);
    Eigen::VectorXd right = Eigen::VectorXd::Zero(mesh.vertices.rows());
    const SemidefiniteSolution none = solve(mesh, right);
    EXPECT_EQ(none.iterations, 0);
    EXPECT_EQ(none.values.cwiseAbs().maxCoeff(), 0);
    right[7] = std::nan("");
    EXPECT_THROW(solve(mesh, right), SolverError);
}

}  // namespace
}  // namespace octafield::volume
