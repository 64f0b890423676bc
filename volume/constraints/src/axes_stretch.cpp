#include "octafield/volume/axes_stretch.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <string>

#include "feature_axes.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/feature_alignment.hpp"
#include "octafield/volume/operators.hpp"
#include "require_frames.hpp"
#include "stretched_directions.hpp"
#include "surface_constraints.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

constexpr double least_volume = 1.7e-2;  // of three unit directions: an angle of a degree between two of them
constexpr double solve_tolerance = 1e-10;

Eigen::Matrix<double, 1, 6> packed(const Matrix3& s) { return {s(0, 0), s(1, 1), s(2, 2), s(1, 2), s(0, 2), s(0, 1)}; }

Matrix3 unpacked(const Eigen::Matrix<double, 1, 6>& s) {
    Matrix3 full;
    full << s[0], s[5], s[4], s[5], s[1], s[3], s[4], s[3], s[2];
    return full;
}

template <class Function>
Matrix3 of_eigenvalues(const Matrix3& symmetric, const Function& function) {
    const Eigen::SelfAdjointEigenSolver<Matrix3> solver(symmetric);
    return solver.eigenvectors() * solver.eigenvalues().unaryExpr(function).asDiagonal() *
           solver.eigenvectors().transpose();
}

Matrix3 exp_of(const Matrix3& symmetric) {
    return of_eigenvalues(symmetric, [](double x) { return std::exp(x); });
}

// log S for S with S S = F F^T, so that the columns of F are orthonormal in the metric S^-2.
Matrix3 log_stretch(const Matrix3& axes) {
    return of_eigenvalues(axes * axes.transpose(), [](double x) { return std::log(x) / 2; });
}

// Between two of the directions and a right angle, the most.
double deviation(const Matrix3& axes) {
    double most = 0;
    for (int i = 0; i < 3; ++i)
        most = std::max(most, std::asin(std::min(1.0, std::abs(axes.col(i).dot(axes.col((i + 1) % 3))))));
    return most;
}

// int grad phi_i . grad phi_j over the surface, rows by vertices of the tet mesh.
SparseMatrix surface_stiffness(const TetDomain& domain) {
    const BoundarySurface& surface = domain.surface();
    std::vector<Eigen::Triplet<double>> entries;
    for (const auto& triangle : surface.mesh.triangles.rowwise()) {
        const auto side = [&](int k) {
            return Vector3(surface.mesh.vertices.row(triangle[(k + 2) % 3]) -
                           surface.mesh.vertices.row(triangle[(k + 1) % 3]));
        };
        const double twice_area = side(0).cross(side(1)).norm();
        for (int i = 0; i < 3; ++i)
            for (int j = 0; j < 3; ++j)
                entries.emplace_back(surface.vertex_map[triangle[i]], surface.vertex_map[triangle[j]],
                                     side(i).dot(side(j)) / (2 * twice_area));
    }
    SparseMatrix result(domain.vertex_count(), domain.vertex_count());
    result.setFromTriplets(entries.begin(), entries.end());
    return result;
}

// Harmonic on the elements of the matrix, with the values of `logs` where `held`. Vertices in no element, and
// parts of the mesh where nothing is held, get 0.
void extend(const SparseMatrix& stiffness, const std::vector<std::uint8_t>& held, Stretches& logs) {
    const Index count = static_cast<Index>(held.size());
    std::vector<Index> place(count, -1);
    Index free = 0;
    for (Index v = 0; v < count; ++v)
        if (!held[v] && stiffness.coeff(v, v) > 0) place[v] = free++;
    std::vector<Eigen::Triplet<double>> entries;
    Rows<double, 6> right = Rows<double, 6>::Zero(free, 6);
    for (Index column = 0; column < count; ++column)
        for (SparseMatrix::InnerIterator it(stiffness, column); it; ++it) {
            const Index row = place[it.row()];
            if (row < 0) continue;
            if (place[column] >= 0)
                entries.emplace_back(row, place[column], it.value());
            else
                right.row(row) -= it.value() * logs.row(column);
        }
    SparseMatrix matrix(free, free);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Eigen::ConjugateGradient<SparseMatrix, Eigen::Lower> solver;
    solver.setTolerance(solve_tolerance);
    solver.setMaxIterations(10000);
    solver.compute(matrix);
    for (int k = 0; k < 6; ++k) {
        const Eigen::VectorXd found = solver.solve(Eigen::VectorXd(right.col(k)));
        if (solver.info() != Eigen::Success && solver.error() > 1e-9)
            throw SolverError(
                "stretches between feature edges did not converge; look for degenerate tets (octafield info)",
                "conjugate_gradients");
        for (Index v = 0; v < count; ++v)
            if (place[v] >= 0) logs(v, k) = found[place[v]];
    }
}

void require_options(const AxesStretchOptions& options) {
    if (!(options.corner_angle > 0 && options.corner_angle < std::numbers::pi / 2))
        throw InvalidInput("corner_angle is in radians, above 0 and below pi/2", "bad_option");
    if (!(options.least_deviation >= 0 && options.least_deviation <= std::numbers::pi / 2))
        throw InvalidInput("least_deviation is in radians, from 0 to pi/2", "bad_option");
}

void require_stretch(const Stretches& stretch, Index count) {
    if (stretch.rows() != count)
        throw InvalidInput(
            "stretch has " + std::to_string(stretch.rows()) + " rows; give one per vertex, " + std::to_string(count),
            "wrong_size");
    std::vector<Index> bad;
    for (Index v = 0; v < count; ++v)
        if (!stretch.row(v).allFinite() || unpacked(stretch.row(v)).llt().info() != Eigen::Success) bad.push_back(v);
    if (!bad.empty())
        throw InvalidInput("stretch must be symmetric positive definite matrices (xx, yy, zz, yz, xz, xy); not at " +
                               std::string("vertices ") + first_few(bad),
                           "not_positive", bad);
}

}  // namespace

Matrix3 AxesStretch::at(Index vertex) const { return unpacked(values.row(vertex)); }

StretchedDirections::StretchedDirections(const Matrix3& stretch)
    : stretch_(stretch), inverse_(stretch.inverse()), is_identity_(stretch == Matrix3::Identity()) {}

StretchedDirections stretched_directions(const Stretches& stretch, Index vertex) {
    return StretchedDirections(unpacked(stretch.row(vertex)));
}

AxesStretch axes_stretch(const TetDomain& domain, const AxesStretchOptions& options) {
    require_options(options);
    const Index count = domain.vertex_count();
    AxesStretch result;
    result.values = Stretches::Zero(count, 6);
    result.values.leftCols<3>().setOnes();
    Stretches logs = Stretches::Zero(count, 6);
    std::vector<std::uint8_t> held(count, 0);
    const BoundarySurface& surface = domain.surface();
    for (const FeatureAxes& at : feature_axes(surface.mesh, domain.features(), options.corner_angle)) {
        const Index v = surface.vertex_map[at.vertex];  // ascending, as the axes are
        if (std::abs(at.axes.determinant()) < least_volume) {
            result.needles.push_back(v);
            continue;
        }
        if (deviation(at.axes) > options.least_deviation) result.sharp.push_back(v);
        result.followed.push_back(v);
        held[v] = 1;
        logs.row(v) = packed(log_stretch(at.axes));
    }
    if (result.sharp.empty()) {
        result.followed.clear();
        return result;
    }
    // From curves straight into space there would be no limit on finer meshes: a curve has no capacity in it.
    extend(surface_stiffness(domain), held, logs);
    for (const Index v : surface.vertex_map) held[v] = 1;
    extend(stiffness(domain), held, logs);
    for (Index v = 0; v < count; ++v) result.values.row(v) = packed(exp_of(unpacked(logs.row(v))));
    return result;
}

Rows<double, 9> stretched_axes(const Quaternions& frames, const Stretches& stretch) {
    require_frames(frames, frames.rows());
    require_stretch(stretch, static_cast<Index>(frames.rows()));
    Rows<double, 9> result(frames.rows(), 9);
    for (Eigen::Index v = 0; v < frames.rows(); ++v) {
        const Matrix3 axes = unpacked(stretch.row(v)) * frames::from_wxyz(frames.row(v)).toRotationMatrix();
        result.row(v) = Eigen::Map<const Eigen::Matrix<double, 1, 9>>(axes.data());
    }
    return result;
}

BoundaryConstraints boundary_constraints(const TetDomain& domain, const Points& directions, const Stretches& stretch,
                                         const BoundaryOptions& options) {
    require_stretch(stretch, domain.vertex_count());
    return constraints_on_surface(domain.vertex_count(), domain.surface(), domain.features(), directions, options,
                                  &stretch);
}

namespace {

// Angle between the direction and the nearest column, at most pi / 2.
double angle_to_nearest(const Matrix3& columns, const Vector3& direction) {
    double best = std::numbers::pi / 2;
    for (int i = 0; i < 3; ++i)
        best =
            std::min(best, std::atan2(columns.col(i).cross(direction).norm(), std::abs(columns.col(i).dot(direction))));
    return best;
}

template <class Columns>
Eigen::VectorXd angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch,
                       const std::vector<Index>& vertex, const Points& direction, const Columns& columns) {
    require_frames(frames, domain.vertex_count());
    require_stretch(stretch, domain.vertex_count());
    Eigen::VectorXd result(direction.rows());
    for (Eigen::Index i = 0; i < result.size(); ++i) {
        const Index v = domain.surface().vertex_map[vertex[i]];
        const Matrix3 rotation = frames::from_wxyz(frames.row(v)).toRotationMatrix();
        result[i] = angle_to_nearest(columns(unpacked(stretch.row(v)), rotation), direction.row(i).transpose());
    }
    return result;
}

}  // namespace

Eigen::VectorXd alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch) {
    const SectorNormals normals = sector_normals(domain);
    return angles(domain, frames, stretch, normals.vertex, normals.normal,
                  [](const Matrix3& s, const Matrix3& q) { return Matrix3(s.inverse() * q); });
}

Eigen::VectorXd feature_alignment_angles(const TetDomain& domain, const Quaternions& frames, const Stretches& stretch) {
    const FeatureTangents tangents = feature_tangents(domain);
    return angles(domain, frames, stretch, tangents.vertex, tangents.tangent,
                  [](const Matrix3& s, const Matrix3& q) { return Matrix3(s * q); });
}

}  // namespace octafield::volume
