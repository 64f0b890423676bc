#include "octafield/volume/integrability.hpp"

#include <algorithm>

#include "octafield/frames/sh4.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/triangle_table.hpp"
#include "require_frames.hpp"
#include "tet_axes.hpp"

namespace octafield::volume {
namespace {

using frames::Quaternion;
using frames::Sh4;
using frames::Vector3;

constexpr Eigen::Index tets_per_block = 256;

void project_block(const TetMesh& mesh, const Quaternions& frames, Eigen::Index first, Eigen::Index count,
                   Quaternions& result) {
    Rows<double, Sh4::dimension> mean(count, Sh4::dimension);
    Quaternions guess(count, 4);
    for (Eigen::Index i = 0; i < count; ++i) {
        Sh4::Vector sum = Sh4::Vector::Zero();
        for (int k = 0; k < 4; ++k) sum += Sh4::embed(frames::from_wxyz(frames.row(mesh.tets(first + i, k))));
        mean.row(i) = sum.transpose() / 4;
        guess.row(i) = frames.row(mesh.tets(first + i, 0));
    }
    Eigen::VectorXd distance(count);
    frames::sh4_project(mean.data(), guess.data(), count, result.row(first).data(), distance.data());
}

Vector3 area_vector(const TetMesh& mesh, const TriangleTable& table, Eigen::Index t) {
    const auto p = [&](int k) -> Vector3 { return mesh.vertices.row(table.triangles(t, k)).transpose(); };
    return (p(1) - p(0)).cross(p(2) - p(0)) / 2;
}

// The root of the sum of the squares of t_i = n_i . curl n_i.
double tet_twist(const TetMesh& mesh, const Quaternions& frames, const Quaternion& centre, Eigen::Index t) {
    return centre.toRotationMatrix().cwiseProduct(axis_curls(mesh, frames, centre, t)).colwise().sum().norm();
}

}  // namespace

Quaternions tet_frames(const TetDomain& domain, const Quaternions& frames, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    const Eigen::Index count = mesh.tets.rows();
    Quaternions result(count, 4);
    parallel_for((count + tets_per_block - 1) / tets_per_block, threads,
                 [&](std::int64_t block) {
                     const Eigen::Index first = block * tets_per_block;
                     project_block(mesh, frames, first, std::min(tets_per_block, count - first), result);
                 },
                 1);
    return result;
}

Integrability integrability(const TetDomain& domain, const Quaternions& frames, int threads) {
    const TetMesh& mesh = domain.mesh();
    const Quaternions of_tets = tet_frames(domain, frames, threads);
    Integrability result;
    result.twist.resize(mesh.tets.rows());
    parallel_for(mesh.tets.rows(), threads, [&](std::int64_t t) {
        result.twist[t] = tet_twist(mesh, frames, frames::from_wxyz(of_tets.row(t)), t);
    });
    result.twist_rms = weighted_rms(result.twist, tet_volumes(mesh));
    result.twist_max = largest_of(result.twist);

    const TriangleTable& table = domain.triangles();
    Eigen::VectorXd jumps = Eigen::VectorXd::Zero(table.triangles.rows()), areas = jumps;
    parallel_for(jumps.size(), threads, [&](std::int64_t t) {
        if (table.sides(t, 1) < 0) return;
        const Vector3 area = area_vector(mesh, table, t);
        areas[t] = area.norm();
        jumps[t] = face_jump(frames::from_wxyz(of_tets.row(table.sides(t, 0) / 4)), Vector3::Ones(),
                             frames::from_wxyz(of_tets.row(table.sides(t, 1) / 4)), Vector3::Ones(), area.normalized());
    });
    result.jump_rms = weighted_rms(jumps, areas);
    result.jump_max = largest_of(jumps);
    return result;
}

}  // namespace octafield::volume
