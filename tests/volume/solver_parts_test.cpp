// Private parts of the solvers: order of sites, products, linear solves, sweeps.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>

#include "field_fixtures.hpp"
#include "heat_solver.hpp"
#include "octafield/volume/smooth.hpp"
#include "reordering.hpp"
#include "site_descent.hpp"

namespace octafield::volume {
namespace {

using frames::Sh4;
using testing::constraints_on;
using testing::jittered_cube;
using testing::smooth_field;

Sh4Field random_field(Index rows, std::uint64_t seed) {
    std::mt19937_64 generator(seed);
    Sh4Field field(rows, Sh4::dimension);
    for (double& value : field.reshaped()) value = 2 * frames::uniform01(generator) - 1;
    return field;
}

Index bandwidth(const SparseMatrix& matrix) {
    Index widest = 0;
    for (Index v = 0; v < matrix.cols(); ++v)
        for (SparseMatrix::InnerIterator entry(matrix, v); entry; ++entry)
            widest = std::max(widest, std::abs(static_cast<Index>(entry.row()) - v));
    return widest;
}

std::vector<Index> shuffled(Index n, std::uint64_t seed) {
    std::vector<Index> order(n);
    std::iota(order.begin(), order.end(), 0);
    std::mt19937_64 generator(seed);
    for (Index i = n - 1; i > 0; --i) std::swap(order[i], order[generator() % (i + 1)]);
    return order;
}

TEST(Reordering, BringsNeighboursTogetherAndKeepsTheProblem) {
    const TetMesh mesh = jittered_cube(10, 0.2, 1);
    const Sampling given = vertex_sampling(mesh);
    const Sampling scattered = reordered(given, shuffled(given.count(), 2));
    const std::vector<Index> order = breadth_first_order(scattered.stiffness);
    const Sampling near = reordered(scattered, order);
    EXPECT_GT(bandwidth(scattered.stiffness), 1000);
    EXPECT_LT(bandwidth(near.stiffness), 300);  // of 1331 vertices; a layer has about 100
    EXPECT_NEAR(near.mass.sum(), given.mass.sum(), 1e-12);

    const Quaternions frames = frames::random_rotations(given.count(), 3);
    const double energy = dirichlet_energy(scattered, frames);
    EXPECT_NEAR(dirichlet_energy(near, reordered(frames, order)), energy, 1e-12 * energy);
    EXPECT_EQ(reordered(reordered(frames, order), inverse_order(order)), frames);
}

TEST(Reordering, TakesSeveralComponentsAndLoneSites) {
    SparseMatrix matrix(5, 5);
    for (const auto& [i, j] : {std::pair{0, 4}, std::pair{1, 3}})
        matrix.insert(i, j) = -1, matrix.insert(j, i) = -1, matrix.insert(i, i) = 1, matrix.insert(j, j) = 1;
    matrix.makeCompressed();
    std::vector<Index> order = breadth_first_order(matrix);
    EXPECT_EQ(std::abs(inverse_order(order)[0] - inverse_order(order)[4]), 1);
    EXPECT_EQ(std::abs(inverse_order(order)[1] - inverse_order(order)[3]), 1);
    std::sort(order.begin(), order.end());
    EXPECT_EQ(order, (std::vector<Index>{0, 1, 2, 3, 4}));
}

TEST(BlockLaplacian, MultipliesAsTheMatrixDoes) {
    const Sampling sampling = vertex_sampling(jittered_cube(6, 0.2, 4));
    const BlockLaplacian laplacian(sampling);
    const Sh4Field x = random_field(sampling.count(), 5);
    const Eigen::MatrixXd expected = sampling.stiffness * Eigen::MatrixXd(x);
    const double scale = expected.cwiseAbs().maxCoeff();

    Sh4Field image;
    EXPECT_NEAR(laplacian.multiply(x, image, 2), x.cwiseProduct(Sh4Field(expected)).sum(), 1e-10 * scale);
    EXPECT_LT((image - expected).cwiseAbs().maxCoeff(), 1e-13 * scale);
    const Rows<float, 9> single = x.cast<float>();
    laplacian.for_rows_of_product(single, 2, [&](Index v, const auto& product) {
        EXPECT_LT((product.template cast<double>() - expected.row(v).transpose()).norm(), 3e-6 * scale);
        return 0.0;
    });
    const Rows<double, 4> four = x.leftCols<4>();  // the general copy
    laplacian.for_rows_of_product(four, 1, [&](Index v, const auto& product) {
        EXPECT_LT((product - expected.row(v).leftCols<4>().transpose()).norm(), 1e-13 * scale);
        return 0.0;
    });
}

// The harmonic field is the critical point: in the spaces that the constraints leave its Laplacian is zero.
TEST(HeatSolver, RefinesToDoublePrecision) {
    const TetMesh mesh = jittered_cube(6, 0.2, 6);
    const Sampling sampling = vertex_sampling(mesh);
    const BlockLaplacian laplacian(sampling);
    for (const VertexConstraint kind : {VertexConstraint::axis, VertexConstraint::fixed}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, smooth_field(mesh));
        const ConstraintSpaces spaces(constraints, constraints.frames, laplacian);
        HeatSolver solver(laplacian, spaces, 1);
        Sh4Field field = spaces.given(), image;
        for (int k = 0; k < 4; ++k) solver.step(std::numeric_limits<double>::infinity(), field, 1e-11, 200);
        laplacian.multiply(field, image, 1);
        for (Index v = 0; v < sampling.count(); ++v)
            EXPECT_LT(spaces.reached(v, image.row(v).transpose()).norm(), 1e-9 * sampling.stiffness.coeff(v, v));
    }
}

class Sweeps : public ::testing::Test {
protected:
    const TetMesh mesh = jittered_cube(8, 0.2, 7);
    const Sampling sampling = vertex_sampling(mesh);
    const BlockLaplacian laplacian{sampling};

    struct State {
        Quaternions frames;
        Sh4Field field;
    };

    State swept(const BoundaryConstraints& constraints, State state, int threads) const {
        const ConstraintSpaces spaces(constraints, state.frames, laplacian);
        const FieldProjector projector(spaces, threads);
        SiteDescent(laplacian, spaces, projector, threads).sweep(state.field, state.frames);
        projector.write_frames(state.field, state.frames);
        return state;
    }
    State constrained(const BoundaryConstraints& constraints, Quaternions frames) const {
        for (Index v = 0; v < frames.rows(); ++v)
            if (constraints.on_boundary[v]) frames.row(v) = constraints.frames.row(v);
        return {frames, embedded(frames, 1)};
    }
};

TEST_F(Sweeps, NeverRaiseTheEnergyAndEndWhereEachFrameIsTheBest) {
    for (const VertexConstraint kind : {VertexConstraint::axis, VertexConstraint::fixed}) {
        const BoundaryConstraints constraints = constraints_on(mesh, kind, smooth_field(mesh));
        State state = constrained(constraints, frames::random_rotations(sampling.count(), 8));
        double energy = dirichlet_energy(sampling, state.frames);
        for (int k = 0; k < 10; ++k) {
            state = swept(constraints, state, 1);
            const double next = dirichlet_energy(sampling, state.frames);
            EXPECT_LE(next, energy * (1 + 1e-12));
            energy = next;
        }
        EXPECT_LT((embedded(state.frames, 1) - state.field).cwiseAbs().maxCoeff(), 1e-12);

        // A minimum of Newton's method has no better frame at any site.
        SmoothOptions tight;
        tight.tolerance = 1e-14;
        const Quaternions minimum = smooth(sampling, constraints, smooth_field(mesh), tight).frames;
        const Quaternions after = swept(constraints, {minimum, embedded(minimum, 1)}, 1).frames;
        EXPECT_LT(testing::largest_distance(minimum, after), 1e-5);
    }
}

TEST_F(Sweeps, GiveTheSameBitsAtAnyThreadCount) {
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::axis, smooth_field(mesh));
    const State start = constrained(constraints, frames::random_rotations(sampling.count(), 9));
    EXPECT_EQ(swept(constraints, start, 1).frames, swept(constraints, start, 3).frames);
}

TEST_F(Sweeps, FreeASiteHeldInAWrongFrame) {
    const frames::Quaternion q = frames::exp({0.3, 0.1, -0.2}), wrong = frames::exp({0, 0.7, 0}) * q;
    const Quaternions constant = testing::sample(mesh, [&](const frames::Vector3&) { return q; });
    const BoundaryConstraints constraints = constraints_on(mesh, VertexConstraint::fixed, constant);
    State state = constrained(constraints, constant);
    for (Index v = 0; v < sampling.count(); v += 37)
        if (!constraints.on_boundary[v]) state.frames.row(v) = frames::to_wxyz(wrong).transpose();
    state.field = embedded(state.frames, 1);
    for (int k = 0; k < 30; ++k) state = swept(constraints, state, 1);
    EXPECT_LT(testing::largest_distance(state.frames, constant), 1e-3);
}

}  // namespace
}  // namespace octafield::volume
