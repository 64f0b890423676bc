#include "disk_map.hpp"

#include <umfpack.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "octafield/error.hpp"
#include "octafield/library_threads.hpp"

namespace octafield::surface::detail {
namespace {

using Matrix = Eigen::SparseMatrix<double>;
using Entries = std::vector<Eigen::Triplet<double>>;

// Diagonally dominant with a symmetric pattern, so no pivoting is needed and the order is that of minimum degree.
Eigen::MatrixX2d solved(const Matrix& matrix, const Eigen::MatrixX2d& right) {
    calm_library_threads();
    double control[UMFPACK_CONTROL], info[UMFPACK_INFO];
    umfpack_di_defaults(control);
    control[UMFPACK_STRATEGY] = UMFPACK_STRATEGY_SYMMETRIC;
    const int n = static_cast<int>(matrix.rows());
    const int *columns = matrix.outerIndexPtr(), *rows = matrix.innerIndexPtr();
    const double* values = matrix.valuePtr();
    void *symbolic = nullptr, *numeric = nullptr;
    int status = umfpack_di_symbolic(n, n, columns, rows, values, &symbolic, control, info);
    if (status >= 0) status = umfpack_di_numeric(columns, rows, values, symbolic, &numeric, control, info);
    umfpack_di_free_symbolic(&symbolic);
    Eigen::MatrixX2d result(n, 2);
    for (int c = 0; c < 2 && status == UMFPACK_OK; ++c)
        status = umfpack_di_solve(UMFPACK_A, columns, rows, values, result.col(c).data(), right.col(c).data(), numeric,
                                  control, info);
    umfpack_di_free_numeric(&numeric);
    if (status == UMFPACK_ERROR_out_of_memory)
        throw SolverError("not enough memory to factorize the matrix of mean value coordinates; use a coarser surface");
    if (status != UMFPACK_OK)
        throw SolverError("the factorization of the matrix of mean value coordinates failed (UMFPACK status " +
                          std::to_string(status) + ")");
    return result;
}

class DiskSystem {
public:
    explicit DiskSystem(const ChartMesh& chart) : chart_(chart), fixed_(chart.vertex_count(), -1) {
        add_circle();
        row_.assign(chart.vertex_count(), -1);
        for (Index v = 0; v < chart.vertex_count(); ++v)
            if (fixed_[v] < 0) row_[v] = rows_++;
        for_each_weight(chart, [&](Index i, Index j, double weight) { add(row_[i], j, weight); });
    }

    void fill(const std::vector<Index>& loop);

    PlanePoints solve() {
        Eigen::MatrixX2d right = Eigen::MatrixX2d::Zero(rows_, 2);
        for (const auto& [row, place, weight] : pulls_) right.row(row) += weight * circle_.row(place);
        Eigen::MatrixX2d found(rows_, 2);
        if (rows_ > 0) {
            Matrix matrix(rows_, rows_);
            matrix.setFromTriplets(entries_.begin(), entries_.end());
            scale_rows(matrix, right);
            found = solved(matrix, right);
        }
        PlanePoints uv(chart_.vertex_count(), 2);
        for (Index v = 0; v < chart_.vertex_count(); ++v)
            uv.row(v) = fixed_[v] >= 0 ? Eigen::RowVector2d(circle_.row(fixed_[v])) : found.row(row_[v]);
        return uv;
    }

private:
    struct Pull {
        Index row, place;
        double weight;
    };

    void add_circle() {
        std::vector<double> after(chart_.vertex_count(), 0);
        for (Index t = 0; t < chart_.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k)
                if (chart_.neighbours(t, k) < 0) after[chart_.triangles(t, k)] = chart_.lengths(t, k);
        after_ = std::move(after);
        const std::vector<Index>& loop = chart_.loops.front();
        double total = 0, at = 0;
        for (const Index v : loop) total += after_[v];
        circle_.resize(static_cast<Eigen::Index>(loop.size()), 2);
        for (std::size_t i = 0; i < loop.size(); ++i) {
            const double angle = 2 * std::numbers::pi * at / total;
            circle_.row(static_cast<Eigen::Index>(i)) << std::cos(angle), std::sin(angle);
            fixed_[loop[i]] = static_cast<Index>(i);
            at += after_[loop[i]];
        }
    }

    void add(Index row, Index to, double weight) {
        if (row < 0) return;
        entries_.emplace_back(row, row, weight);
        if (fixed_[to] >= 0) {
            pulls_.push_back({row, fixed_[to], weight});
        } else {
            entries_.emplace_back(row, row_[to], -weight);
        }
    }

    static void scale_rows(Matrix& matrix, Eigen::MatrixX2d& right) {
        const Eigen::VectorXd scale = matrix.diagonal().cwiseInverse();
        matrix = scale.asDiagonal() * matrix;
        right = scale.asDiagonal() * right;
    }

    const ChartMesh& chart_;
    std::vector<Index> fixed_;   // place on the circle of each vertex, -1: not there
    std::vector<double> after_;  // length of the boundary side that starts at a vertex
    PlanePoints circle_;
    std::vector<Index> row_;  // of each vertex, -1: on the circle
    Index rows_ = 0;
    Entries entries_;
    std::vector<Pull> pulls_;
};

// Isosceles triangles round a middle whose bases are the hole's sides and whose angles there are in proportion to them.
// Theirs are the weights of the middle and more of them on the hole's vertices.
void DiskSystem::fill(const std::vector<Index>& loop) {
    double perimeter = 0;
    for (const Index v : loop) perimeter += after_[v];
    const double radius = perimeter / (2 * std::numbers::pi);
    const Index middle = rows_++;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const Index a = loop[i], b = loop[(i + 1) % loop.size()];
        // A side is shorter than half the perimeter, but for holes without an area.
        const double apex = std::min(after_[a] / radius, (1 - 1e-6) * std::numbers::pi);
        const double half_base = std::tan((std::numbers::pi - apex) / 4), half_apex = std::tan(apex / 2);
        for (const Index v : {a, b}) {
            const double to_middle = half_base / radius, from_middle = half_apex / radius;
            entries_.emplace_back(row_[v], row_[v], to_middle);
            entries_.emplace_back(row_[v], middle, -to_middle);
            entries_.emplace_back(middle, middle, from_middle);
            entries_.emplace_back(middle, row_[v], -from_middle);
        }
        add(row_[a], b, half_base / after_[a]);
        add(row_[b], a, half_base / after_[a]);
    }
}

}  // namespace

PlanePoints disk_map(const ChartMesh& chart, bool fill_holes) {
    DiskSystem system(chart);
    if (fill_holes)
        for (std::size_t i = 1; i < chart.loops.size(); ++i) system.fill(chart.loops[i]);
    return system.solve();
}

Eigen::Vector3d pulled_metric(const ChartMesh& chart, Index t, const Eigen::Matrix<double, 3, 2>& corners) {
    const double h = chart.half_tangents(t, 0), cosine = (1 - h * h) / (1 + h * h), sine = 2 * h / (1 + h * h);
    Eigen::Matrix2d edges, plane;
    edges << chart.lengths(t, 0), chart.lengths(t, 2) * cosine, 0, chart.lengths(t, 2) * sine;
    plane.col(0) = corners.row(1) - corners.row(0);
    plane.col(1) = corners.row(2) - corners.row(0);
    const double determinant = plane(0, 0) * plane(1, 1) - plane(0, 1) * plane(1, 0);
    Eigen::Matrix2d adjoint;
    adjoint << plane(1, 1), -plane(0, 1), -plane(1, 0), plane(0, 0);
    const Eigen::Matrix2d jacobian = edges * adjoint / determinant;
    return {jacobian.col(0).squaredNorm(), jacobian.col(0).dot(jacobian.col(1)), jacobian.col(1).squaredNorm()};
}

Eigen::Vector2d stretches(const ChartMesh& chart, Index t, const Eigen::Matrix<double, 3, 2>& corners) {
    const Eigen::RowVector2d u = corners.row(1) - corners.row(0), v = corners.row(2) - corners.row(0);
    const double determinant = u[0] * v[1] - u[1] * v[0];
    if (determinant == 0) return {std::numeric_limits<double>::infinity(), 0};
    const Eigen::Vector3d metric = pulled_metric(chart, t, corners);
    const double large = std::sqrt((metric[0] + metric[2]) / 2 + std::hypot((metric[0] - metric[2]) / 2, metric[1]));
    return {large, chart.twice_area(t) / determinant / large};
}

}  // namespace octafield::surface::detail
