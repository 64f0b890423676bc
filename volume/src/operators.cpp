#include "octafield/volume/operators.hpp"

#include <algorithm>
#include <vector>

#include "octafield/frames/sh4.hpp"
#include "octafield/parallel.hpp"
#include "require_frames.hpp"

namespace octafield::volume {
namespace {

using Gradients = Eigen::Matrix<double, 4, 3>;  // rows: gradients of the four hat functions of a tet

// With E the edge vectors p_k - p_0 as columns, the gradients of phi_1..3 are the rows of E^-1.
Gradients hat_gradients(const Eigen::Matrix3d& e) {
    Gradients g;
    g.row(1) = e.col(1).cross(e.col(2)).transpose();
    g.row(2) = e.col(2).cross(e.col(0)).transpose();
    g.row(3) = e.col(0).cross(e.col(1)).transpose();
    g.bottomRows<3>() /= e.col(0).dot(g.row(1));
    g.row(0) = -(g.row(1) + g.row(2) + g.row(3));
    return g;
}

Eigen::Matrix3d tet_edges(const TetMesh& mesh, Eigen::Index t) {
    Eigen::Matrix3d e;
    for (int k = 0; k < 3; ++k)
        e.col(k) = (mesh.vertices.row(mesh.tets(t, k + 1)) - mesh.vertices.row(mesh.tets(t, 0))).transpose();
    return e;
}

// For every vertex its corners 4 tet + k, in ascending order of tets.
struct Corners {
    std::vector<std::int64_t> begin;  // (n + 1)
    std::vector<Index> corner;        // (4 m)
};

Corners vertex_corners(const TetMesh& mesh) {
    const Eigen::Index n = mesh.vertices.rows(), m = mesh.tets.rows();
    Corners corners{std::vector<std::int64_t>(n + 1, 0), std::vector<Index>(4 * m)};
    for (Eigen::Index i = 0; i < 4 * m; ++i) ++corners.begin[mesh.tets(i / 4, i % 4) + 1];
    for (Eigen::Index v = 0; v < n; ++v) corners.begin[v + 1] += corners.begin[v];
    std::vector<std::int64_t> next(corners.begin.begin(), corners.begin.end() - 1);
    for (Eigen::Index i = 0; i < 4 * m; ++i) corners.corner[next[mesh.tets(i / 4, i % 4)]++] = static_cast<Index>(i);
    return corners;
}

// Sums the columns element_column(tet, k) of the 4 x 4 element matrices into a sparse matrix. Column by column, so that
// no list of 16 m triplets is ever held; both halves sum the same numbers in the same order, so the result is exactly
// symmetric.
template <class ElementColumn>
SparseMatrix assemble(const TetMesh& mesh, const ElementColumn& element_column) {
    require_valid(mesh);
    const Corners corners = vertex_corners(mesh);
    const Index n = static_cast<Index>(mesh.vertices.rows());
    SparseMatrix matrix(n, n);
    matrix.reserve(n + 14 * static_cast<std::int64_t>(n));  // a vertex has about 14 neighbours
    std::vector<double> value(n, 0);
    std::vector<Index> stamp(n, -1), rows;
    for (Index column = 0; column < n; ++column) {
        rows.clear();
        for (std::int64_t c = corners.begin[column]; c < corners.begin[column + 1]; ++c) {
            const Index tet = corners.corner[c] / 4;
            const Eigen::Vector4d local = element_column(tet, corners.corner[c] % 4);
            for (int k = 0; k < 4; ++k) {
                const Index row = mesh.tets(tet, k);
                if (stamp[row] != column) {
                    stamp[row] = column;
                    value[row] = 0;
                    rows.push_back(row);
                }
                value[row] += local[k];
            }
        }
        std::sort(rows.begin(), rows.end());
        matrix.startVec(column);
        for (const Index row : rows) matrix.insertBack(row, column) = value[row];
    }
    matrix.finalize();
    return matrix;
}

}  // namespace

SparseMatrix stiffness(const TetMesh& mesh) {
    return assemble(mesh, [&](Index tet, int k) -> Eigen::Vector4d {
        const Eigen::Matrix3d e = tet_edges(mesh, tet);
        const Gradients g = hat_gradients(e);
        const Eigen::Vector4d dots = g * g.row(k).transpose();  // before scaling: exact symmetry
        return e.determinant() / 6 * dots;
    });
}

SparseMatrix mass(const TetMesh& mesh) {
    return assemble(mesh, [&](Index tet, int k) -> Eigen::Vector4d {
        const double volume = tet_edges(mesh, tet).determinant() / 6;
        return (Eigen::Vector4d::Ones() + Eigen::Vector4d::Unit(k)) * (volume / 20);
    });
}

Eigen::VectorXd lumped_mass(const TetMesh& mesh) {
    require_valid(mesh);
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    Eigen::VectorXd lumped = Eigen::VectorXd::Zero(mesh.vertices.rows());
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) lumped[mesh.tets(t, k)] += volumes[t] / 4;
    return lumped;
}

double dirichlet_energy(const TetMesh& mesh, const Quaternions& frames, int threads) {
    require_valid(mesh);
    require_frames(frames, mesh.vertices.rows());
    using frames::Sh4;
    Rows<double, Sh4::dimension> a(frames.rows(), Sh4::dimension);
    parallel_for(frames.rows(), threads,
                 [&](std::int64_t v) { a.row(v) = Sh4::embed(frames::from_wxyz(frames.row(v))).transpose(); });

    Eigen::VectorXd energy(mesh.tets.rows());
    parallel_for(mesh.tets.rows(), threads, [&](std::int64_t t) {
        const Eigen::Matrix3d e = tet_edges(mesh, t);
        Eigen::Matrix<double, Sh4::dimension, 3>
            differences;  // exactly 0 for a constant field, unlike a sum over four corners
        for (int k = 0; k < 3; ++k)
            differences.col(k) = (a.row(mesh.tets(t, k + 1)) - a.row(mesh.tets(t, 0))).transpose();
        energy[t] = e.determinant() / 12 * (differences * hat_gradients(e).bottomRows<3>()).squaredNorm();
    });
    double sum = 0;  // serial: the order of the sum must not depend on the number of threads
    for (const double value : energy) sum += value;
    return sum;
}

}  // namespace octafield::volume
