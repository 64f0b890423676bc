#include <Eigen/IterativeLinearSolvers>

#include "constraints.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/operators.hpp"
#include "octafield/volume/smooth.hpp"

namespace octafield::volume {
namespace {

using frames::Sh4;
using frames::Vector4;

using Field = Rows<double, Sh4::dimension>;

// Boundary vertices hold their start, except released corners: no frame fits them, so theirs is as good as none.
std::vector<char> held_vertices(const BoundaryConstraints& constraints) {
    std::vector<char> held(constraints.on_boundary.begin(), constraints.on_boundary.end());
    for (std::size_t v = 0; v < held.size(); ++v) held[v] = held[v] || constraints.kind[v] != VertexConstraint::free;
    for (const Index corner : constraints.released_corners) held[corner] = 0;
    return held;
}

// Solves L_uu a_u = -L_uh a_h for all components; rows of `field` hold a_h on entry and all values on return.
void harmonic_extension(const SparseMatrix& laplacian, const std::vector<char>& held, Field& field) {
    const Index n = static_cast<Index>(held.size());
    std::vector<Index> unknown_of(n, -1);
    Index unknowns = 0;
    for (Index v = 0; v < n; ++v)
        if (!held[v]) unknown_of[v] = unknowns++;
    if (unknowns == 0) return;

    std::vector<Eigen::Triplet<double>> entries;
    Eigen::MatrixXd right = Eigen::MatrixXd::Zero(unknowns, Sh4::dimension);
    for (Index column = 0; column < n; ++column)
        for (SparseMatrix::InnerIterator it(laplacian, column); it; ++it) {
            const Index row = unknown_of[it.row()];
            if (row < 0) continue;
            if (held[column])
                right.row(row) -= it.value() * field.row(column);
            else
                entries.emplace_back(row, unknown_of[column], it.value());
        }
    SparseMatrix system(unknowns, unknowns);
    system.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower | Eigen::Upper, Eigen::IncompleteCholesky<double>> solver;
    solver.setTolerance(1e-10);
    solver.compute(system);
    if (solver.info() != Eigen::Success)
        throw SolverError(
            "the incomplete Cholesky factorization of the stiffness matrix failed; look for degenerate tets (octafield "
            "info)",
            "factorization");
    const Eigen::MatrixXd solution = solver.solve(right);
    for (Index v = 0; v < n; ++v)
        if (!held[v]) field.row(v) = solution.row(unknown_of[v]);
}

}  // namespace

Quaternions initial_frames(const TetMesh& mesh, const BoundaryConstraints& constraints, int threads) {
    require_fitting(mesh, constraints);
    const Index n = static_cast<Index>(mesh.vertices.rows());
    const SparseMatrix laplacian = stiffness(mesh);
    std::vector<char> held = held_vertices(constraints);
    for (Index v = 0; v < n; ++v)
        if (laplacian.outerIndexPtr()[v] == laplacian.outerIndexPtr()[v + 1]) held[v] = 1;  // in no tet: no equation
    Field field = Field::Zero(n, Sh4::dimension);
    for (Index v = 0; v < n; ++v)
        if (held[v])
            field.row(v) = Sh4::embed(frames::from_wxyz(Vector4(constraints.frames.row(v).transpose()))).transpose();
    harmonic_extension(laplacian, held, field);

    Quaternions result = constraints.frames;
    parallel_for(n, threads, [&](std::int64_t v) {
        if (!held[v]) result.row(v) = frames::to_wxyz(Sh4::project(field.row(v).transpose()).frame).transpose();
    });
    return result;
}

}  // namespace octafield::volume
