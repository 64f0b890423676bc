#include "octafield/volume/operators.hpp"

#include "element_assembly.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/parallel.hpp"
#include "require_frames.hpp"

namespace octafield::volume {

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

SparseMatrix stiffness(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    return assemble(mesh.tets, static_cast<Index>(mesh.vertices.rows()), 1, [&](Index tet, int k) -> Eigen::Vector4d {
        const Eigen::Matrix3d e = tet_edges(mesh, tet);
        const Gradients g = hat_gradients(e);
        const Eigen::Vector4d dots = g * g.row(k).transpose();  // before scaling: exact symmetry
        return e.determinant() / 6 * dots;
    });
}

SparseMatrix mass(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    return assemble(mesh.tets, static_cast<Index>(mesh.vertices.rows()), 1, [&](Index tet, int k) -> Eigen::Vector4d {
        const double volume = tet_edges(mesh, tet).determinant() / 6;
        return (Eigen::Vector4d::Ones() + Eigen::Vector4d::Unit(k)) * (volume / 20);
    });
}

Eigen::VectorXd lumped_mass(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    Eigen::VectorXd lumped = Eigen::VectorXd::Zero(mesh.vertices.rows());
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        for (int k = 0; k < 4; ++k) lumped[mesh.tets(t, k)] += volumes[t] / 4;
    return lumped;
}

double dirichlet_energy(const TetDomain& domain, const Quaternions& frames, int threads) {
    const TetMesh& mesh = domain.mesh();
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
