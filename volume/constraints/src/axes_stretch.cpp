#include "octafield/volume/axes_stretch.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/IterativeLinearSolvers>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "feature_axes.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/operators.hpp"
#include "stretched_directions.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

constexpr double least_volume = 1.7e-2;  // of three unit directions: an angle of a degree between two of them
constexpr double solve_tolerance = 1e-10;

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

}  // namespace

Matrix3 AxesStretch::at(Index vertex) const { return unpacked(values.row(vertex)); }

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

}  // namespace octafield::volume
