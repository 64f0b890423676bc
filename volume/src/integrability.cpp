#include "octafield/volume/integrability.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "octafield/frames/octahedral_group.hpp"
#include "octafield/frames/sh4.hpp"
#include "octafield/frames/sh4_projection.hpp"
#include "octafield/parallel.hpp"
#include "require_frames.hpp"
#include "triangle_table.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
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

// The tangential jump J of the axes across triangle t between the tets on its sides.
double face_jump(const TriangleTable& table, const Quaternions& of_tets, Eigen::Index t, const Vector3& area_vector) {
    const Quaternion q = frames::from_wxyz(of_tets.row(table.sides(t, 0) / 4));
    const Quaternion r = frames::from_wxyz(of_tets.row(table.sides(t, 1) / 4));
    const Matrix3 jump = frames::closest_representative(q, r).toRotationMatrix() - r.toRotationMatrix();
    const Vector3 normal = area_vector.normalized();
    return (jump - normal * (normal.transpose() * jump)).norm();
}

Vector3 area_vector(const TetMesh& mesh, const TriangleTable& table, Eigen::Index t) {
    const auto p = [&](int k) -> Vector3 { return mesh.vertices.row(table.triangles(t, k)).transpose(); };
    return (p(1) - p(0)).cross(p(2) - p(0)) / 2;
}

// t_i = n_i . curl n_i. The curl of a linear vector field with the Jacobian D is read off D - D^T.
double tet_twist(const TetMesh& mesh, const Quaternions& frames, const Quaternion& centre, Eigen::Index t) {
    std::array<Matrix3, 4> axes;
    for (int k = 0; k < 4; ++k)
        axes[k] =
            frames::closest_representative(frames::from_wxyz(frames.row(mesh.tets(t, k))), centre).toRotationMatrix();
    Matrix3 edges;
    for (int k = 0; k < 3; ++k)
        edges.col(k) = (mesh.vertices.row(mesh.tets(t, k + 1)) - mesh.vertices.row(mesh.tets(t, 0))).transpose();
    const Matrix3 to_barycentric = edges.inverse(), front = centre.toRotationMatrix();
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
        Matrix3 differences;
        for (int k = 0; k < 3; ++k) differences.col(k) = axes[k + 1].col(i) - axes[0].col(i);
        const Matrix3 d = differences * to_barycentric;
        const Vector3 curl(d(2, 1) - d(1, 2), d(0, 2) - d(2, 0), d(1, 0) - d(0, 1));
        const double twist = front.col(i).dot(curl);
        sum += twist * twist;
    }
    return std::sqrt(sum);
}

// Serial: the order of the sum must not depend on the number of threads.
double weighted_rms(const Eigen::VectorXd& values, const Eigen::VectorXd& weights) {
    double sum = 0, total = 0;
    for (Eigen::Index i = 0; i < values.size(); ++i) {
        sum += weights[i] * values[i] * values[i];
        total += weights[i];
    }
    return total > 0 ? std::sqrt(sum / total) : 0;
}

double largest(const Eigen::VectorXd& values) { return values.size() > 0 ? values.maxCoeff() : 0; }

}  // namespace

Quaternions tet_frames(const TetMesh& mesh, const Quaternions& frames, int threads) {
    require_valid(mesh);
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

Integrability integrability(const TetMesh& mesh, const Quaternions& frames, int threads) {
    const Quaternions of_tets = tet_frames(mesh, frames, threads);
    Integrability result;
    result.twist.resize(mesh.tets.rows());
    parallel_for(mesh.tets.rows(), threads, [&](std::int64_t t) {
        result.twist[t] = tet_twist(mesh, frames, frames::from_wxyz(of_tets.row(t)), t);
    });
    result.twist_rms = weighted_rms(result.twist, tet_volumes(mesh));
    result.twist_max = largest(result.twist);

    const TriangleTable table = triangle_table(mesh, threads);
    Eigen::VectorXd jumps = Eigen::VectorXd::Zero(table.triangles.rows()), areas = jumps;
    parallel_for(jumps.size(), threads, [&](std::int64_t t) {
        if (table.sides(t, 1) < 0) return;
        const Vector3 area = area_vector(mesh, table, t);
        areas[t] = area.norm();
        jumps[t] = face_jump(table, of_tets, t, area);
    });
    result.jump_rms = weighted_rms(jumps, areas);
    result.jump_max = largest(jumps);
    return result;
}

}  // namespace octafield::volume
