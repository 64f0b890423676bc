#include "unfolded_tets.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <cmath>
#include <limits>

#include "tet_assembly.hpp"

namespace octafield::volume::detail {
namespace {

using Matrix3 = Eigen::Matrix3d;
using Matrix9 = Eigen::Matrix<double, 9, 9>;
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Slopes = Eigen::Matrix<double, 4, 3>;  // places of the corners, as columns, times these: the derivative

constexpr int most_steps = 60, most_after = 10;  // of Newton's method; without folds
constexpr int most_inner = 4;                    // before the softness falls
constexpr int most_halvings = 30;
constexpr double slow = 0.02, settled = 1e-2;  // what a step takes off the energy
constexpr double least_gain = 0.5;             // by which the softness falls, in part
constexpr double crushed = 1e-3;               // of the target's volume
constexpr double least_softness = 1e-6;        // below it folds are there to stay

Slopes slopes(const Matrix3& to_unit) {
    Slopes result;
    result.bottomRows<3>() = to_unit;
    result.row(0) = -to_unit.colwise().sum();
    return result;
}

Matrix3 cross_matrix(const Eigen::Vector3d& a) {
    Matrix3 m;
    m << 0, -a[2], a[1], a[2], 0, -a[0], -a[1], a[0], 0;
    return m;
}

Matrix3 cofactors(const Matrix3& j) {
    Matrix3 c;
    for (int i = 0; i < 3; ++i) c.col(i) = j.col((i + 1) % 3).cross(j.col((i + 2) % 3));
    return c;
}

// d with its values below 0 bent up, by the softness.
double regular(double d, double softness) {
    if (softness == 0) return d > 0 ? d : 0;
    const double root = std::hypot(d, softness);
    return d > 0 ? (d + root) / 2 : softness * softness / (root - d) / 2;
}

double density(const Matrix3& j, double softness) {
    const double d = j.determinant(), chi = regular(d, softness);
    if (!(chi > 0)) return std::numeric_limits<double>::infinity();
    return j.squaredNorm() / std::pow(chi, 2.0 / 3) + (d * d + 1) / chi;
}

void make_positive(Matrix9& second) {
    if (Eigen::LLT<Matrix9>(second).info() == Eigen::Success) return;
    const Eigen::SelfAdjointEigenSolver<Matrix9> solver(second);
    second = solver.eigenvectors() * solver.eigenvalues().cwiseMax(0).asDiagonal() * solver.eigenvectors().transpose();
}

// First and second derivatives of the density by the columns of J, one after another.
void derivatives(const Matrix3& j, double softness, Vector9& first, Matrix9& second) {
    const double d = j.determinant(), root = std::hypot(d, softness), chi = regular(d, softness);
    const double chi1 = chi / root, chi2 = softness * softness / (2 * root * root * root);
    const double norm = j.squaredNorm(), power = std::pow(chi, -2.0 / 3), bent = d * d + 1;
    const double f_i = power, f_id = -2.0 / 3 * power / chi * chi1;
    const double f_d = norm * f_id + 2 * d / chi - bent * chi1 / (chi * chi);
    const double f_dd = norm * (-2.0 / 3) * power / chi * (chi2 - 5.0 / 3 * chi1 * chi1 / chi) + 2 / chi -
                        4 * d * chi1 / (chi * chi) - bent * (chi2 - 2 * chi1 * chi1 / chi) / (chi * chi);
    const Matrix3 cofactor = cofactors(j);
    const Eigen::Map<const Vector9> x(j.data()), c(cofactor.data());
    first = 2 * f_i * x + f_d * c;
    second = f_dd * c * c.transpose() + 2 * f_id * (x * c.transpose() + c * x.transpose());
    second.diagonal().array() += 2 * f_i;
    for (int i = 0; i < 3; ++i) {  // d = a_i . (a_i+1 x a_i+2)
        const Matrix3 cross = f_d * cross_matrix(j.col((i + 2) % 3));
        const int n = (i + 1) % 3;
        second.block<3, 3>(3 * i, 3 * n) -= cross;
        second.block<3, 3>(3 * n, 3 * i) += cross;
    }
    make_positive(second);
}

Eigen::Matrix<double, 3, 4> places_of(const TetProblem& problem, const Eigen::VectorXd& values, Index t) {
    Eigen::Matrix<double, 3, 4> places = Eigen::Matrix<double, 3, 4>::Zero();
    for (int k = 0; k < 4; ++k)
        for (int i = 0; i < 3; ++i)
            for (const auto& [unknown, c] : problem.free.rows[3 * problem.corners(t, k) + i])
                places(i, k) += c * values[unknown];
    return places;
}

class Descent {
public:
    Descent(const TetProblem& problem, UnfoldedTets& result, const Progress& progress)
        : problem_(problem), assembly_(problem), result_(result), progress_(progress) {
        for (const Matrix3& m : problem.to_unit) slopes_.push_back(slopes(m));
        second_.resize(slopes_.size());
        first_.resize(slopes_.size());
    }

    void run() {
        unfold();
        if (!(least() > 0)) return;
        for (int i = 0; i < most_after; ++i) {
            const double before = value(result_.values, 0);
            if (before - step(before, 0) < settled * before) return;
        }
    }

    // The 12 coordinates' derivatives by J's 9: coordinate (k, i), J(i, n).
    static Eigen::Matrix<double, 9, 12> by_coordinates(const Slopes& slope) {
        Eigen::Matrix<double, 9, 12> by = Eigen::Matrix<double, 9, 12>::Zero();
        for (int k = 0; k < 4; ++k)
            for (int n = 0; n < 3; ++n)
                for (int i = 0; i < 3; ++i) by(3 * n + i, 3 * k + i) = slope(k, n);
        return by;
    }

private:
    Matrix3 derivative(Index t, const Eigen::VectorXd& x) const { return places_of(problem_, x, t) * slopes_[t]; }
    double least() const {
        double result = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < slopes_.size(); ++t)
            result = std::min(result, derivative(static_cast<Index>(t), result_.values).determinant());
        return result;
    }
    double value(const Eigen::VectorXd& x, double softness) const {
        std::vector<double> each(slopes_.size());
        parallel_for(static_cast<std::int64_t>(each.size()), problem_.threads, [&](std::int64_t t) {
            each[t] = problem_.volumes[t] * density(derivative(static_cast<Index>(t), x), softness);
        });
        double sum = 0;
        for (const double e : each) sum += e;
        return sum;
    }

    void unfold() {
        double least = this->least();
        const auto wanted = [&] { return std::sqrt(1e-12 + 0.04 * std::min(least, 0.0) * std::min(least, 0.0)); };
        double softness = std::max(wanted(), 1e-3);
        double first = value(result_.values, softness);
        for (int inner = 0; !(least > 0) && softness > least_softness && result_.steps < most_steps;) {
            const double before = value(result_.values, softness);
            const double now = step(before, softness);
            least = this->least();
            if (before - now > slow * before && ++inner < most_inner) continue;
            inner = 0;
            const double gain = std::max(1 - now / first, least_gain), root = std::hypot(least, softness);
            softness *= 1 - gain * root / (std::abs(least) + root);
            first = value(result_.values, softness);
        }
    }

    // Returns the energy behind it.
    double step(double before, double softness) {
        report_or_throw(progress_, "unfold", std::min(1.0, result_.steps / static_cast<double>(most_steps)), before);
        ++result_.steps;
        parallel_for(static_cast<std::int64_t>(slopes_.size()), problem_.threads, [&](std::int64_t t) {
            Vector9 first;
            Matrix9 second;
            derivatives(derivative(static_cast<Index>(t), result_.values), softness, first, second);
            const auto by = by_coordinates(slopes_[t]);
            first_[t] = problem_.volumes[t] * (by.transpose() * first);
            second_[t] = problem_.volumes[t] * (by.transpose() * second * by);
        });
        assembly_.clear();
        for (std::size_t t = 0; t < slopes_.size(); ++t) assembly_.add(t, first_[t], second_[t]);
        const Eigen::VectorXd way = assembly_.step();
        if (way.size() == 0) return before;
        const double slope = assembly_.gradient().dot(way);
        double part = 1;
        for (int halving = 0; halving < most_halvings; ++halving, part /= 2) {
            Eigen::VectorXd next = result_.values + part * way;
            const double now = value(next, softness);
            if (!(now <= before + 1e-4 * part * slope)) continue;
            result_.values = std::move(next);
            return now;
        }
        return before;
    }

    const TetProblem& problem_;
    TetAssembly assembly_;
    std::vector<Slopes> slopes_;
    std::vector<Vector12> first_;
    std::vector<Matrix12> second_;
    UnfoldedTets& result_;
    const Progress& progress_;
};

}  // namespace

Matrix3 mapped_edges(const TetProblem& problem, const Eigen::VectorXd& values, Index tet) {
    const auto places = places_of(problem, values, tet);
    return places.rightCols<3>().colwise() - places.col(0);
}

Eigen::VectorXd nearest_map(const TetProblem& problem) {
    if (problem.free.count == 0) return {};
    TetAssembly assembly(problem);
    assembly.clear();
    for (std::size_t t = 0; t < problem.to_unit.size(); ++t) {
        const auto by = Descent::by_coordinates(slopes(problem.to_unit[t]));
        const Matrix3 unit = Matrix3::Identity();
        const double weight = std::cbrt(problem.volumes[t] * problem.volumes[t]);
        assembly.add(t, -weight * (by.transpose() * Eigen::Map<const Vector9>(unit.data())),
                     weight * (by.transpose() * by));
    }
    Eigen::VectorXd values = assembly.step();
    if (values.size() == 0)
        throw SolverError("the map's linear system cannot be solved: is a part of the mesh degenerate?",
                          "singular_map");
    return values;
}

UnfoldedTets unfolded_tets(const TetProblem& problem, Eigen::VectorXd start, const Progress& progress) {
    UnfoldedTets result{std::move(start)};
    if (problem.free.count > 0) Descent(problem, result, progress).run();
    for (Index t = 0; t < problem.corners.rows(); ++t) {
        const double volume = mapped_edges(problem, result.values, t).determinant();
        if (!(volume > 0)) result.folded.push_back(t);
        if (!(volume > crushed * 6 * problem.volumes[t])) result.crushed.push_back(t);
    }
    return result;
}

}  // namespace octafield::volume::detail
