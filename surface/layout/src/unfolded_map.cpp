#include "unfolded_map.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "sparse_cholesky.hpp"

namespace octafield::surface::detail {
namespace {

using Matrix2 = Eigen::Matrix2d;
using Matrix4 = Eigen::Matrix4d;
using Cholesky = SparseCholesky<double>;
constexpr double area_weight = 0.1;
constexpr int most_steps = 120, most_after = 20;  // of Newton's method; without folds
constexpr int most_inner = 5;                     // before the softness falls
constexpr int most_halvings = 40;
constexpr double slow = 0.02, settled = 1e-3;  // what a step takes off the energy
constexpr double least_gain = 0.5;             // by which the softness falls, in part

// Where the six coordinates of each triangle go in a symmetric matrix of the unknowns.
class Assembly {
public:
    explicit Assembly(const MapProblem& problem) : problem_(problem) {
        std::vector<Eigen::Triplet<double>> entries;
        for (Index i = 0; i < problem.values.count; ++i) entries.emplace_back(i, i, 0.0);
        each_pair([&](Index row, Index col, std::size_t) { entries.emplace_back(row, col, 0.0); });
        matrix_.resize(problem.values.count, problem.values.count);
        matrix_.setFromTriplets(entries.begin(), entries.end());
        each_pair([&](Index row, Index col, std::size_t at) {
            const int* first = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[col];
            const int* last = matrix_.innerIndexPtr() + matrix_.outerIndexPtr()[col + 1];
            places_.resize(at + 1, -1);
            places_[at] = static_cast<Index>(std::lower_bound(first, last, row) - matrix_.innerIndexPtr());
        });
        places_.resize(21 * problem.to_unit.size(), -1);
    }

    void clear() { std::fill(matrix_.valuePtr(), matrix_.valuePtr() + matrix_.nonZeros(), 0.0); }
    const GridValue& value(std::size_t t, int i) const { return problem_.values.corners[3 * t + i / 2][i % 2]; }

    void add(std::size_t t, const Eigen::Matrix<double, 6, 6>& block) {
        std::size_t at = 21 * t;
        for (int i = 0; i < 6; ++i)
            for (int j = 0; j <= i; ++j, ++at) {
                if (places_[at] < 0) continue;
                double x = block(i, j) * value(t, i).sign * value(t, j).sign;
                if (i != j && value(t, i).value == value(t, j).value) x *= 2;  // both halves
                matrix_.valuePtr()[places_[at]] += x;
            }
    }
    Eigen::SparseMatrix<double>& matrix() { return matrix_; }

private:
    template <class Call>
    void each_pair(const Call& call) const {
        std::size_t at = 0;
        for (std::size_t t = 0; t < problem_.to_unit.size(); ++t)
            for (int i = 0; i < 6; ++i)
                for (int j = 0; j <= i; ++j, ++at) {
                    const Index a = value(t, i).value, b = value(t, j).value;
                    if (a >= 0 && b >= 0) call(std::max(a, b), std::min(a, b), at);
                }
    }

    const MapProblem& problem_;
    Eigen::SparseMatrix<double> matrix_;  // lower triangle
    std::vector<Index> places_;
};

// The rows that take the corners' places to the columns of the derivative.
Eigen::Matrix<double, 3, 2> slopes(const Matrix2& to_unit) {
    Eigen::Matrix<double, 3, 2> result;
    result.bottomRows<2>() = to_unit;
    result.row(0) = -to_unit.colwise().sum();
    return result;
}

class Energy {
public:
    explicit Energy(const MapProblem& problem)
        : problem_(problem), assembly_(problem), weights_(problem.to_unit.size(), 1) {
        for (const Matrix2& m : problem.to_unit) slopes_.push_back(slopes(m));
        cholesky_ = std::make_unique<Cholesky>(assembly_.matrix(), Cholesky::amd_order(assembly_.matrix()));
    }

    // Triangles count by their area in the map, with the size that they have.
    void count_by_area(const Eigen::VectorXd& x) {
        for (std::size_t t = 0; t < slopes_.size(); ++t) {
            const double d = derivative(t, x).determinant();
            weights_[t] = problem_.areas[t] * d;
            slopes_[t] /= std::sqrt(d);
        }
    }

    Matrix2 derivative(std::size_t t, const Eigen::VectorXd& x) const {
        Eigen::Matrix<double, 2, 3> places;
        for (int k = 0; k < 3; ++k) places.col(k) = problem_.values.place(static_cast<Index>(3 * t + k), x);
        return places * slopes_[t];
    }
    double least(const Eigen::VectorXd& x) const {
        double result = std::numeric_limits<double>::infinity();
        for (std::size_t t = 0; t < slopes_.size(); ++t) result = std::min(result, derivative(t, x).determinant());
        return result;
    }
    double value(const Eigen::VectorXd& x, double softness) const {
        double sum = 0;
        for (std::size_t t = 0; t < slopes_.size(); ++t) {
            const Matrix2 j = derivative(t, x);
            const double d = j.determinant(), chi = regular(d, softness);
            if (!(chi > 0)) return std::numeric_limits<double>::infinity();
            sum += weights_[t] * ((1 - area_weight) * j.squaredNorm() / 2 + area_weight * (d * d + 1) / 2) / chi;
        }
        return sum;
    }

    // Newton's step, with each triangle's second derivatives made positive. Empty if it cannot be had.
    Eigen::VectorXd step(const Eigen::VectorXd& x, double softness, Eigen::VectorXd& gradient) {
        assembly_.clear();
        gradient = Eigen::VectorXd::Zero(x.size());
        for (std::size_t t = 0; t < slopes_.size(); ++t) add(t, derivative(t, x), softness, gradient);
        auto& matrix = assembly_.matrix();
        double most = 0;
        for (Index i = 0; i < matrix.cols(); ++i) most = std::max(most, matrix.valuePtr()[matrix.outerIndexPtr()[i]]);
        for (Index i = 0; i < matrix.cols(); ++i) {
            double& diagonal = matrix.valuePtr()[matrix.outerIndexPtr()[i]];
            diagonal += 1e-10 * diagonal + 1e-13 * most;
        }
        if (!cholesky_->factorize(matrix)) return {};
        return -cholesky_->solve(gradient);
    }

private:
    static double regular(double d, double softness) {
        if (softness == 0) return d > 0 ? d : 0;
        const double root = std::hypot(d, softness);
        return d > 0 ? (d + root) / 2 : softness * softness / (root - d) / 2;
    }

    void add(std::size_t t, const Matrix2& j, double softness, Eigen::VectorXd& gradient) {
        const double d = j.determinant(), root = std::hypot(d, softness), chi = regular(d, softness);
        const double chi1 = chi / root, chi2 = softness * softness / (2 * root * root * root);
        const double norm = j.squaredNorm(), a = (1 - area_weight) / 2, b = area_weight / 2;
        const double top = a * norm + b * (d * d + 1);  // over chi
        const double f_i = a / chi, f_d = 2 * b * d / chi - top * chi1 / (chi * chi);
        const double f_id = -a * chi1 / (chi * chi);
        const double f_dd =
            2 * b / chi - 4 * b * d * chi1 / (chi * chi) + top * (2 * chi1 * chi1 / chi - chi2) / (chi * chi);
        // J = a similarity z and what reverses the sense, w: norm = p^2 + q^2, d = (p^2 - q^2) / 2.
        const double half = std::sqrt(0.5);
        Eigen::Vector2d z((j(0, 0) + j(1, 1)) * half, (j(1, 0) - j(0, 1)) * half);
        Eigen::Vector2d w((j(0, 0) - j(1, 1)) * half, (j(1, 0) + j(0, 1)) * half);
        const double p = z.norm(), q = w.norm();
        z = p > 0 ? Eigen::Vector2d(z / p) : Eigen::Vector2d(1, 0);
        w = q > 0 ? Eigen::Vector2d(w / q) : Eigen::Vector2d(1, 0);
        const double by_z = 2 * f_i + f_d, by_w = 2 * f_i - f_d;
        const double pp = by_z + p * p * (4 * f_id + f_dd), qq = by_w + q * q * (f_dd - 4 * f_id), pq = -p * q * f_dd;
        const auto along = [&](double z1, double z2, double w1, double w2) {  // (j00, j10, j01, j11)
            return Eigen::Vector4d(half * (z1 + w1), half * (z2 + w2), half * (w2 - z2), half * (z1 - w1));
        };
        const Eigen::Vector4d z_out = along(z[0], z[1], 0, 0), z_turn = along(-z[1], z[0], 0, 0);
        const Eigen::Vector4d w_out = along(0, 0, w[0], w[1]), w_turn = along(0, 0, -w[1], w[0]);
        Matrix4 second =
            std::max(by_z, 0.0) * z_turn * z_turn.transpose() + std::max(by_w, 0.0) * w_turn * w_turn.transpose();
        const double mean = (pp + qq) / 2, apart = std::hypot((pp - qq) / 2, pq);
        for (const double sign : {-1.0, 1.0}) {
            const double found = mean + sign * apart;
            if (!(found > 0)) continue;
            // (pp - found) u + pq v = 0
            Eigen::Vector2d u(pq, found - pp), v(found - qq, pq);
            Eigen::Vector2d way = u.squaredNorm() > v.squaredNorm() ? u : v;
            if (way.squaredNorm() == 0) way = sign < 0 ? Eigen::Vector2d(1, 0) : Eigen::Vector2d(0, 1);
            way.normalize();
            const Eigen::Vector4d both = way[0] * z_out + way[1] * w_out;
            second += found * both * both.transpose();
        }
        Matrix2 cofactor;
        cofactor << j(1, 1), -j(1, 0), -j(0, 1), j(0, 0);
        const Matrix2 first = 2 * f_i * j + f_d * cofactor;
        add_block(t, first, second, gradient);
    }

    // By the derivative of the map: first and second derivatives of the triangle's energy.
    void add_block(std::size_t t, const Matrix2& first, const Matrix4& second, Eigen::VectorXd& gradient) {
        Eigen::Matrix<double, 4, 6> by = Eigen::Matrix<double, 4, 6>::Zero();
        for (int k = 0; k < 3; ++k)
            for (int n = 0; n < 2; ++n)
                for (int i = 0; i < 2; ++i) by(2 * n + i, 2 * k + i) = slopes_[t](k, n);
        const Eigen::Vector4d flat(first(0, 0), first(1, 0), first(0, 1), first(1, 1));
        const Eigen::Matrix<double, 6, 1> slope = weights_[t] * (by.transpose() * flat);
        for (int i = 0; i < 6; ++i) {
            const GridValue& v = assembly_.value(t, i);
            if (v.value >= 0) gradient[v.value] += v.sign * slope[i];
        }
        assembly_.add(t, weights_[t] * (by.transpose() * (second * by)));
    }

    const MapProblem& problem_;
    Assembly assembly_;
    std::vector<Eigen::Matrix<double, 3, 2>> slopes_;
    std::vector<double> weights_;
    std::unique_ptr<Cholesky> cholesky_;
};

Index folded(const MapProblem& problem, const Eigen::VectorXd& values) {
    Index result = 0;
    for (std::size_t t = 0; t < problem.to_unit.size(); ++t) {
        Matrix2 edges;
        const auto first = static_cast<Index>(3 * t);
        for (int k = 0; k < 2; ++k)
            edges.col(k) = problem.values.place(first + k + 1, values) - problem.values.place(first, values);
        result += !(edges.determinant() > 0);
    }
    return result;
}

class Descent {
public:
    Descent(const MapProblem& problem, UnfoldedMap& result, const Progress& progress)
        : energy_(problem), result_(result), progress_(progress) {}

    void run() {
        unfold();
        if (!(energy_.least(result_.values) > 0)) return;
        improve();
        energy_.count_by_area(result_.values);
        improve();
    }

private:
    void unfold() {
        double least = energy_.least(result_.values);
        double softness = std::sqrt(1e-6 + 0.04 * least * least);
        double first = energy_.value(result_.values, softness);
        for (int inner = 0; !(least > 0) && result_.steps < most_steps;) {
            const double before = energy_.value(result_.values, softness);
            const double now = step(before, softness);
            least = energy_.least(result_.values);
            if (before - now > slow * before && ++inner < most_inner) continue;
            inner = 0;
            const double gain = std::max(1 - now / first, least_gain), root = std::hypot(least, softness);
            softness *= 1 - gain * root / (std::abs(least) + root);
            first = energy_.value(result_.values, softness);
        }
    }

    void improve() {
        for (int i = 0; i < most_after; ++i) {
            const double before = energy_.value(result_.values, 0);
            if (before - step(before, 0) < settled * before) return;
        }
    }

    // Returns the energy behind it.
    double step(double before, double softness) {
        report_or_throw(progress_, "unfold", std::min(1.0, result_.steps / static_cast<double>(most_steps)), before);
        ++result_.steps;
        Eigen::VectorXd gradient;
        const Eigen::VectorXd way = energy_.step(result_.values, softness, gradient);
        if (way.size() == 0) return before;
        const double slope = gradient.dot(way);
        double part = 1;
        for (int halving = 0; halving < most_halvings; ++halving, part /= 2) {
            Eigen::VectorXd next = result_.values + part * way;
            const double now = energy_.value(next, softness);
            if (!(now <= before + 1e-4 * part * slope)) continue;
            result_.values = std::move(next);
            return now;
        }
        return before;
    }

    Energy energy_;
    UnfoldedMap& result_;
    const Progress& progress_;
};

}  // namespace

UnfoldedMap unfolded_map(const MapProblem& problem, Eigen::VectorXd start, const Progress& progress) {
    UnfoldedMap result{std::move(start)};
    if (problem.values.count > 0) Descent(problem, result, progress).run();
    result.folded = folded(problem, result.values);
    return result;
}

}  // namespace octafield::surface::detail
