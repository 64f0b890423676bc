#include "joint_eigenvectors.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <limits>

namespace octafield::frames {
namespace {

double off_diagonal(const std::vector<Matrix3>& matrices) {
    double sum = 0;
    for (const Matrix3& m : matrices) sum += m(0, 1) * m(0, 1) + m(0, 2) * m(0, 2) + m(1, 2) * m(1, 2);
    return sum;
}

// Turns the p-q plane by the angle that is best for all matrices together; false if that hardly moved it. Convergence
// is quadratic on commuting matrices: after such a turn the rest is below rounding.
bool turn_plane(std::vector<Matrix3>& matrices, Matrix3& axes, int p, int q) {
    double difference = 0, mixed = 0;
    for (const Matrix3& m : matrices) {
        const double h = m(p, p) - m(q, q), g = 2 * m(p, q);
        difference += h * h - g * g;
        mixed += 2 * h * g;
    }
    const double angle = 0.5 * std::atan2(mixed, difference + std::hypot(difference, mixed));
    const double c = std::cos(angle), s = std::sin(angle);
    Matrix3 turn = Matrix3::Identity();
    turn(p, p) = turn(q, q) = c, turn(p, q) = -s, turn(q, p) = s;
    for (Matrix3& m : matrices) m = turn.transpose() * m * turn;
    axes = axes * turn;
    return std::abs(angle) > 1e-9;
}

struct Result {
    Matrix3 axes;
    double off_diagonal;
};

Result jacobi(std::vector<Matrix3> matrices, const Matrix3& start) {
    constexpr int max_sweeps = 60;
    Matrix3 axes = start;
    for (Matrix3& m : matrices) m = start.transpose() * m * start;
    for (int sweep = 0; sweep < max_sweeps; ++sweep) {
        bool turned = turn_plane(matrices, axes, 0, 1);
        turned |= turn_plane(matrices, axes, 0, 2);
        turned |= turn_plane(matrices, axes, 1, 2);
        if (!turned) break;
    }
    return {axes, off_diagonal(matrices)};
}

// Eigenvectors of a combination with weights of no simple ratio.
Matrix3 combination_eigenvectors(const std::vector<Matrix3>& matrices, double seed) {
    Matrix3 sum = Matrix3::Zero();
    for (std::size_t k = 0; k < matrices.size(); ++k) sum += std::cos(seed * (k + 1.0)) * matrices[k];
    return Eigen::SelfAdjointEigenSolver<Matrix3>(sum).eigenvectors();
}

}  // namespace

Matrix3 joint_eigenvectors(const std::vector<Matrix3>& matrices) {
    double size = 0;
    for (const Matrix3& m : matrices) size = std::max(size, m.cwiseAbs().maxCoeff());
    if (!(size > 0)) return Matrix3::Identity();
    std::vector<Matrix3> scaled;
    for (const Matrix3& m : matrices) scaled.push_back(m / size);
    Result best = jacobi(scaled, Matrix3::Identity());
    constexpr double exact = 1e-28;  // squared rounding: nothing left to gain
    for (const double seed : {1.3, 2.9, 0.7, 5.1}) {
        if (best.off_diagonal < exact) break;
        const Result other = jacobi(scaled, combination_eigenvectors(scaled, seed));
        if (other.off_diagonal < (1 - 1e-12) * best.off_diagonal) best = other;
    }
    if (best.axes.determinant() < 0) best.axes.col(2) *= -1;
    return best.axes;
}

}  // namespace octafield::frames
