#include "octafield/volume/scaling.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <utility>

#include "axis_orbits.hpp"
#include "element_assembly.hpp"
#include "octafield/error.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/integrability.hpp"
#include "require_frames.hpp"
#include "semidefinite_solver.hpp"
#include "tet_axes.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

// The axes in the tets and their curls.
class CurlField {
public:
    CurlField(const TetDomain& domain, const Quaternions& frames, int threads)
        : of_tets_(tet_frames(domain, frames, threads)), curls_(domain.tet_count(), 9) {
        const TetMesh& mesh = domain.mesh();
        parallel_for(mesh.tets.rows(), threads, [&](std::int64_t t) {
            Eigen::Map<Matrix3>(curls_.row(t).data()) = axis_curls(mesh, frames, frames::from_wxyz(of_tets_.row(t)), t);
        });
    }

    const Quaternions& of_tets() const { return of_tets_; }
    Matrix3 axes(Eigen::Index t) const { return frames::from_wxyz(of_tets_.row(t)).toRotationMatrix(); }
    Matrix3 curls(Eigen::Index t) const { return Eigen::Map<const Matrix3>(curls_.row(t).data()); }
    // -n_i x curl n_i = (n_i . grad) n_i, for linear axes without the change of their length.
    Matrix3 turns(Eigen::Index t) const {
        const Matrix3 n = axes(t), c = curls(t);
        Matrix3 result;
        for (int i = 0; i < 3; ++i) result.col(i) = c.col(i).cross(n.col(i));
        return result;
    }
    // The root of sum_i |g_i x n_i + curl n_i|^2, g_i the columns of `gradients`.
    double residual(Eigen::Index t, const Matrix3& gradients) const {
        const Matrix3 n = axes(t), c = curls(t);
        double sum = 0;
        for (int i = 0; i < 3; ++i) sum += (gradients.col(i).cross(n.col(i)) + c.col(i)).squaredNorm();
        return std::sqrt(sum);
    }

private:
    Quaternions of_tets_;
    Rows<double, 9> curls_;
};

// gradients(t): of H_i as columns. log_scales: (m, 3) H_i at the centres.
template <class GradientsOf>
ScaledIntegrability measure(const TetMesh& mesh, const FaceMatchings& faces, const CurlField& field,
                            const GradientsOf& gradients, const Points& log_scales, int threads) {
    Eigen::VectorXd curls(mesh.tets.rows()), jumps(faces.tets.rows()), areas(faces.tets.rows());
    parallel_for(curls.size(), threads, [&](std::int64_t t) { curls[t] = field.residual(t, gradients(t)); });
    parallel_for(jumps.size(), threads, [&](std::int64_t f) {
        const auto p = [&](int k) -> Vector3 { return mesh.vertices.row(faces.triangles(f, k)).transpose(); };
        const Vector3 area = (p(1) - p(0)).cross(p(2) - p(0)) / 2;
        const auto frame = [&](int k) { return frames::from_wxyz(field.of_tets().row(faces.tets(f, k))); };
        const auto lengths = [&](int k) -> Vector3 { return log_scales.row(faces.tets(f, k)).array().exp(); };
        areas[f] = area.norm();
        jumps[f] = face_jump(frame(0), lengths(0), frame(1), lengths(1), area.normalized());
    });
    ScaledIntegrability result{
        weighted_rms(curls, tet_volumes(mesh)), largest_of(curls), weighted_rms(jumps, areas), largest_of(jumps), {}};
    result.curl = std::move(curls);
    return result;
}

ScaledIntegrability measure_unscaled(const TetMesh& mesh, const FaceMatchings& faces, const CurlField& field,
                                     int threads) {
    const auto none = [](Eigen::Index) -> Matrix3 { return Matrix3::Zero(); };
    return measure(mesh, faces, field, none, Points::Zero(mesh.tets.rows(), 3), threads);
}

Gradients gradients_of(const TetMesh& mesh, Eigen::Index t) { return hat_gradients(tet_edges(mesh, t)); }

// Vertices of tets as 0, 1, ...
Tets compact_numbers(const TetMesh& mesh, std::vector<Index>& vertices) {
    std::vector<Index> number(mesh.vertices.rows(), -1);
    for (const Index v : mesh.tets.reshaped()) number[v] = 0;
    for (std::size_t v = 0; v < number.size(); ++v) {
        if (number[v] < 0) continue;
        number[v] = static_cast<Index>(vertices.size());
        vertices.push_back(static_cast<Index>(v));
    }
    return mesh.tets.unaryExpr([&](Index v) { return number[v]; });
}

}  // namespace

IsotropicScale isotropic_scale(const TetDomain& domain, const Quaternions& frames, int threads) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    const CurlField field(domain, frames, threads);
    const FaceMatchings faces = face_matchings(domain, field.of_tets(), threads);
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    std::vector<Index> vertices;
    const Tets elements = compact_numbers(mesh, vertices);
    const Index count = static_cast<Index>(vertices.size());

    // 2 |grad H|^2 - 2 grad H . sum_i (n_i . grad) n_i, halved twice.
    const SparseMatrix matrix = assemble(elements, count, threads, [&](Index t, int k) -> Eigen::Vector4d {
        const Gradients g = gradients_of(mesh, t);
        return volumes[t] * (g * g.row(k).transpose());
    });
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (Eigen::Index t = 0; t < elements.rows(); ++t)
        right(elements.row(t)) += volumes[t] / 2 * (gradients_of(mesh, t) * field.turns(t).rowwise().sum());

    const Parts parts(elements, count);
    const SemidefiniteSolution solution =
        solve_semidefinite(matrix, std::move(right), parts, elements, volumes, threads);
    IsotropicScale result;
    result.parts = parts.count;
    result.iterations = solution.iterations;
    result.log_scale = Eigen::VectorXd::Zero(mesh.vertices.rows());
    result.log_scale(vertices) = solution.values;

    const auto of_corners = [&](Eigen::Index t) -> Eigen::Vector4d { return solution.values(elements.row(t)); };
    const auto gradients = [&](Eigen::Index t) -> Matrix3 {
        return (gradients_of(mesh, t).transpose() * of_corners(t)).replicate<1, 3>();
    };
    Points log_scales(mesh.tets.rows(), 3);
    for (Eigen::Index t = 0; t < log_scales.rows(); ++t) log_scales.row(t).setConstant(of_corners(t).mean());
    result.before = measure_unscaled(mesh, faces, field, threads);
    result.after = measure(mesh, faces, field, gradients, log_scales, threads);
    return result;
}

AxisScales axis_scales(const TetDomain& domain, const Quaternions& frames, const AxisScaleOptions& options) {
    const TetMesh& mesh = domain.mesh();
    require_frames(frames, mesh.vertices.rows());
    if (!(options.along > 0 && options.along <= 1))
        throw InvalidInput("along is a weight above 0 and at most 1", "along");
    const CurlField field(domain, frames, options.threads);
    const FaceMatchings faces = face_matchings(domain, field.of_tets(), options.threads);
    const Eigen::VectorXd volumes = tet_volumes(mesh);
    AxisOrbits orbits = axis_orbits(mesh, faces);

    // Element 3 t + i: axis i of tet t.
    const Eigen::Index m = mesh.tets.rows();
    Tets elements(3 * m, 4);
    Eigen::VectorXd weights(3 * m), right = Eigen::VectorXd::Zero(orbits.count);
    for (Eigen::Index t = 0; t < m; ++t) {
        const Eigen::Matrix<double, 4, 3> loads = volumes[t] * (gradients_of(mesh, t) * field.turns(t));
        for (int i = 0; i < 3; ++i) {
            const auto row = Eigen::seqN(i, Eigen::fix<4>, 3);
            elements.row(3 * t + i) = orbits.of_tets.row(t)(row);
            weights[3 * t + i] = volumes[t];
            for (int k = 0; k < 4; ++k) right[elements(3 * t + i, k)] += loads(k, i);
        }
    }
    const SparseMatrix matrix =
        assemble(elements, orbits.count, options.threads, [&](Index e, int k) -> Eigen::Vector4d {
            const Gradients g = gradients_of(mesh, e / 3);
            const Eigen::Vector4d along = g * field.axes(e / 3).col(e % 3);
            return volumes[e / 3] * (g * g.row(k).transpose() - (1 - options.along) * along[k] * along);
        });

    const Parts parts(elements, orbits.count);
    SemidefiniteSolution solution =
        solve_semidefinite(matrix, std::move(right), parts, elements, weights, options.threads);
    AxisScales result;
    result.parts = parts.count;
    result.iterations = solution.iterations;
    const auto of_corners = [&](Eigen::Index t, int i) -> Eigen::Vector4d {
        return solution.values(elements.row(3 * t + i));
    };
    const auto gradients = [&](Eigen::Index t) {
        Matrix3 columns;
        for (int i = 0; i < 3; ++i) columns.col(i) = gradients_of(mesh, t).transpose() * of_corners(t, i);
        return columns;
    };
    result.log_scales.resize(m, 3);
    for (Eigen::Index t = 0; t < m; ++t)
        for (int i = 0; i < 3; ++i) result.log_scales(t, i) = of_corners(t, i).mean();
    result.before = measure_unscaled(mesh, faces, field, options.threads);
    result.after = measure(mesh, faces, field, gradients, result.log_scales, options.threads);
    result.values = std::move(solution.values);
    result.unknowns = std::move(orbits.of_tets);
    result.of_tets = field.of_tets();
    return result;
}

}  // namespace octafield::volume
