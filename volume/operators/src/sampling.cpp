#include "octafield/volume/sampling.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <utility>

#include "block_laplacian.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "require_frames.hpp"
#include "sh4_field.hpp"

namespace octafield::volume {
namespace {

// All but what depends on the sites.
Sampling sampling_of(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    const surface::TriangleMesh& boundary = domain.boundary().mesh;
    Sampling sampling;
    sampling.body_radius = 3 * tet_volumes(mesh).sum() / surface::triangle_areas(boundary).sum();
    sampling.edge_length = surface::mean_edge_length(boundary);
    sampling.size = surface::shape_size(boundary);
    return sampling;
}

Points centroids(const TetMesh& mesh) {
    Points points = Points::Zero(mesh.tets.rows(), 3);
    for (Eigen::Index t = 0; t < points.rows(); ++t)
        for (int k = 0; k < 4; ++k) points.row(t) += mesh.vertices.row(mesh.tets(t, k)) / 4;
    return points;
}

double area(const TetMesh& mesh, const TriangleTable& table, Eigen::Index t) {
    const auto p = [&](int k) -> Eigen::Vector3d { return mesh.vertices.row(table.triangles(t, k)).transpose(); };
    return (p(1) - p(0)).cross(p(2) - p(0)).norm() / 2;
}

// Of positive weights per triangle; those of boundary triangles are left out.
SparseMatrix graph_laplacian(const TriangleTable& table, const Eigen::VectorXd& weights) {
    const Eigen::Index n = table.tet_triangles.rows();
    SparseMatrix matrix(n, n);
    matrix.reserve(5 * n);
    for (Index t = 0; t < n; ++t) {
        std::array<std::pair<Index, double>, 5> column;
        int size = 1;
        column[0] = {t, 0.0};
        for (int k = 0; k < 4; ++k) {
            const Index triangle = table.tet_triangles(t, k);
            if (table.sides(triangle, 1) < 0) continue;
            const Index first = table.sides(triangle, 0) / 4, second = table.sides(triangle, 1) / 4;
            column[size++] = {first == t ? second : first, -weights[triangle]};
            column[0].second += weights[triangle];
        }
        std::sort(column.begin(), column.begin() + size);
        matrix.startVec(t);
        if (size == 1) continue;  // of one tet alone
        for (int i = 0; i < size; ++i) {
            if (i > 0 && column[i].first == column[i - 1].first)
                matrix.valuePtr()[matrix.nonZeros() - 1] += column[i].second;  // tets with two triangles in common
            else
                matrix.insertBack(column[i].first, t) = column[i].second;
        }
    }
    matrix.finalize();
    return matrix;
}

constexpr Eigen::Index vertices_per_block = 256;

}  // namespace

Sampling::Sampling(const TetDomain& domain) : Sampling(vertex_sampling(domain)) {}

Sampling vertex_sampling(const TetDomain& domain) {
    Sampling sampling = sampling_of(domain);
    sampling.stiffness = stiffness(domain);
    sampling.mass = lumped_mass(domain);
    sampling.elements = domain.shared_mesh();
    return sampling;
}

Sampling tet_sampling(const TetDomain& domain) {
    const TetMesh& mesh = domain.mesh();
    Sampling sampling = sampling_of(domain);
    sampling.sites = Sites::tets;
    sampling.mass = tet_volumes(mesh);
    const TriangleTable& table = domain.triangles();
    const Points centres = centroids(mesh);
    Eigen::VectorXd weights = Eigen::VectorXd::Zero(table.triangles.rows());
    for (Eigen::Index t = 0; t < weights.size(); ++t) {
        if (table.sides(t, 1) < 0) continue;
        const double distance = (centres.row(table.sides(t, 0) / 4) - centres.row(table.sides(t, 1) / 4)).norm();
        weights[t] = area(mesh, table, t) / distance;
    }
    sampling.stiffness = graph_laplacian(table, weights);
    return sampling;
}

Quaternions vertex_frames(const TetDomain& domain, const Quaternions& of_tets, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(of_tets, mesh.tets.rows());
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    const Sh4Field field = embedded(of_tets, threads);
    const Eigen::Index count = mesh.vertices.rows();
    Sh4Field mean = Sh4Field::Zero(count, field.cols());
    Quaternions guess = Quaternions::Zero(count, 4), result(count, 4);
    guess.col(0).setOnes();
    for (Eigen::Index t = mesh.tets.rows() - 1; t >= 0; --t)
        for (int k = 0; k < 4; ++k) {
            mean.row(mesh.tets(t, k)) += volumes[t] * field.row(t);
            guess.row(mesh.tets(t, k)) = of_tets.row(t);
        }
    Eigen::VectorXd distance(count);
    const Eigen::VectorXd size = mean.rowwise().norm();  // lengths to the third power, of any unit
    for (Eigen::Index v = 0; v < count; ++v)
        if (size[v] > 0) mean.row(v) /= size[v];
    parallel_for((count + vertices_per_block - 1) / vertices_per_block, threads,
                 [&](std::int64_t block) {
                     const Eigen::Index first = block * vertices_per_block,
                                        rows = std::min(vertices_per_block, count - first);
                     frames::sh4_project(mean.row(first).data(), guess.row(first).data(), rows,
                                         result.row(first).data(), distance.data() + first);
                 },
                 1);
    return result;
}

double dirichlet_energy(const Sampling& sampling, const Quaternions& frames, int threads) {
    require_frames(frames, sampling.count());
    Sh4Field image;
    return BlockLaplacian(sampling).multiply(embedded(frames, threads), image, threads) / 2;
}

}  // namespace octafield::volume
