#include "octafield/surface/sized_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "definiteness.hpp"
#include "free_system.hpp"
#include "given_directions.hpp"
#include "inverse_iteration.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/library_threads.hpp"
#include "random_field.hpp"
#include "size_checks.hpp"
#include "sized_system.hpp"
#include "sparse_cholesky.hpp"

namespace octafield::surface {
namespace {

using detail::Complex;
using detail::GivenDirections;
using detail::SizedConnection;
using detail::SizedSystem;
using detail::VertexCharts;
using std::numbers::pi;

// Makes A definite where a parallel field exists, far below any other eigenvalue; times 1 / area.
constexpr double least_shift = 1e-6;

void check(const SurfaceDomain& domain, const WantedSizes& sizes, const SizedFieldOptions& options) {
    const auto require = [](bool holds, const char* what) {
        if (!holds) throw InvalidInput(what, "bad_option");
    };
    detail::require_in_space(domain);
    if (domain.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
    require(options.symmetry >= 1 && options.symmetry <= largest_symmetry,
            "the symmetry of a direction field must be at least 1 and at most 1000");
    require(options.s >= -1 && options.s <= 1, "s must lie between -1 and 1; 0 is the Dirichlet energy");
    require(options.corner_tolerance >= 0 && options.corner_tolerance <= 1,
            "corner_tolerance must lie between 0 and 1");
    require(std::isfinite(options.shift), "shift must be a number below the least eigenvalue; 0 is usual");
    require(options.max_iterations >= 1, "max_iterations must be at least 1");
    require(options.tolerance >= 0, "tolerance must not be negative");
    detail::require_lengths(sizes.lengths, domain.vertex_count(), "vertex");
    if (sizes.turns.size() != domain.edge_count())
        throw InvalidInput("sizes must hold one turn per edge, " + std::to_string(domain.edge_count()) + ", not " +
                               std::to_string(sizes.turns.size()) + "; wanted_sizes makes them",
                           "wrong_size");
    std::vector<Index> bad;
    for (Index e = 0; e < sizes.turns.size(); ++e)
        if (!std::isfinite(sizes.turns[e])) bad.push_back(e);
    if (!bad.empty()) throw InvalidInput("turns at edges " + first_few(bad) + " are not finite", "bad_turns", bad);
}

// Connected parts of the surface by vertex.
struct Parts {
    std::vector<Index> of_vertex;  // (V), -1: in no triangle
    std::vector<double> areas;
    std::vector<bool> given;  // whether something is given there

    Parts(const SurfaceDomain& domain, const SizedSystem& system, const GivenDirections& directions)
        : of_vertex(domain.vertex_count(), -1) {
        DisjointSets sets(domain.vertex_count());
        const Edges& edges = domain.topology().edges;
        for (Index e = 0; e < domain.edge_count(); ++e) sets.join(edges(e, 0), edges(e, 1));
        for (Index v = 0; v < domain.vertex_count(); ++v) {
            if (system.row[v] < 0) continue;
            const Index lowest = sets.lowest(v);
            if (lowest == v) {
                of_vertex[v] = static_cast<Index>(areas.size());
                areas.push_back(0);
                given.push_back(false);
            }
            const Index part = of_vertex[v] = of_vertex[lowest];
            areas[part] += system.shares[v];
            if (directions.is_held[v] || directions.source[v] != 0.0) given[part] = true;
        }
    }
};

// A - shift M with the vertices that are free as unknowns.
class Solver {
public:
    Solver(const SurfaceDomain& domain, const SizedSystem& system, const GivenDirections& given, const Parts& parts,
           double shift)
        : system_(system), free_of_row_(system.energy.rows(), -1), value_of_row_(system.energy.rows()) {
        std::vector<double> shift_of_row(system.energy.rows());
        for (std::size_t v = 0; v < system.row.size(); ++v) {
            const Index row = system.row[v];
            if (row < 0) continue;
            value_of_row_[row] = given.held[v];
            const Index part = parts.of_vertex[v];
            shift_of_row[row] = (parts.given[part] ? shift : 0) - least_shift / parts.areas[part];
            if (!given.is_held[v]) free_of_row_[row] = static_cast<Index>(rows_.size());
            if (!given.is_held[v]) rows_.push_back(row);
        }
        shifted_ = system.energy;
        for (Index c = 0; c < shifted_.cols(); ++c) {
            SizedSystem::Matrix::InnerIterator mass(system.mass, c);
            for (SizedSystem::Matrix::InnerIterator entry(shifted_, c); entry; ++entry, ++mass)
                entry.valueRef() -= shift_of_row[c] * mass.value();
        }
        if (!rows_.empty()) factorize(domain, shift);
    }

    // u at all rows, with the held values there and (A - shift M) u = right at the others.
    Eigen::VectorXcd solve(const Eigen::VectorXcd& right) {
        Eigen::VectorXcd values = value_of_row_;
        return add_solution(right - hermitian_product(shifted_, value_of_row_), values);
    }
    // The same for held values 0.
    Eigen::VectorXcd solve_free(const Eigen::VectorXcd& right) {
        return add_solution(right, Eigen::VectorXcd::Zero(right.size()));
    }

    static Eigen::VectorXcd hermitian_product(const SizedSystem::Matrix& lower, const Eigen::VectorXcd& values) {
        return lower.selfadjointView<Eigen::Lower>() * values;
    }

private:
    Eigen::VectorXcd add_solution(const Eigen::VectorXcd& right, Eigen::VectorXcd values) {
        if (rows_.empty()) return values;
        const Eigen::VectorXcd found = cholesky_->solve(right(rows_));
        values(rows_) = found;
        return values;
    }

    void factorize(const SurfaceDomain& domain, double shift) {
        std::vector<Eigen::Triplet<Complex>> entries;
        for (Index c = 0; c < shifted_.cols(); ++c)
            for (SizedSystem::Matrix::InnerIterator entry(shifted_, c); entry; ++entry) {
                const Index a = free_of_row_[entry.row()], b = free_of_row_[c];
                if (a >= 0 && b >= 0) entries.emplace_back(a, b, entry.value());
            }
        SizedSystem::Matrix matrix(static_cast<Index>(rows_.size()), static_cast<Index>(rows_.size()));
        matrix.setFromTriplets(entries.begin(), entries.end());
        using Cholesky = detail::SparseCholesky<Complex>;
        cholesky_ = std::make_unique<Cholesky>(matrix, Cholesky::amd_order(matrix));
        if (cholesky_->factorize(matrix)) return;
        if (shift > 0)
            throw SolverError(
                "shift is not below the least eigenvalue of the smoothness matrix; choose a smaller one, "
                "0 for the smoothest extension",
                "shift_too_large");
        detail::explaining_failure(domain, [] {
            throw SolverError("the smoothness matrix of the sized field is not positive definite to rounding",
                              detail::not_definite);
        });
    }

    const SizedSystem& system_;
    std::vector<Index> free_of_row_, rows_;  // unknown of each row, -1: held; row of each unknown
    Eigen::VectorXcd value_of_row_;          // held values, 0 elsewhere
    SizedSystem::Matrix shifted_;
    std::unique_ptr<detail::SparseCholesky<Complex>> cholesky_;
};

class Work {
public:
    Work(const SurfaceDomain& domain, const WantedSizes& sizes, const SizedFieldOptions& options,
         const Progress& progress)
        : domain_(domain),
          sizes_(sizes),
          options_(options),
          progress_(progress),
          charts_(domain),
          connection_(domain, charts_, sizes.turns, options.symmetry),
          system_(domain, connection_, options.s),
          given_(given_directions(domain, charts_, options)),
          parts_(domain, system_, given_) {
        part_of_row_.resize(system_.energy.rows());
        for (std::size_t v = 0; v < system_.row.size(); ++v)
            if (system_.row[v] >= 0) part_of_row_[system_.row[v]] = parts_.of_vertex[v];
    }

    SizedField run() {
        Solver solver(domain_, system_, given_, parts_, options_.shift);
        Eigen::VectorXcd source = Eigen::VectorXcd::Zero(system_.energy.rows());
        for (std::size_t v = 0; v < system_.row.size(); ++v)
            if (system_.row[v] >= 0) source[system_.row[v]] = given_.source[v];
        Eigen::VectorXcd values = solver.solve(Solver::hermitian_product(system_.mass, source));
        if (!std::all_of(parts_.given.begin(), parts_.given.end(), [](bool given) { return given; }))
            add_eigenvectors(solver, values);
        finish(values);
        return std::move(result_);
    }

private:
    // Of parts where nothing is given; 0 in the others.
    void add_eigenvectors(Solver& solver, Eigen::VectorXcd& values) {
        Eigen::VectorXcd found = detail::as_complex(detail::random_vector(2 * values.size(), options_.seed));
        for (Index i = 0; i < found.size(); ++i)
            if (parts_.given[part_of_row_[i]]) found[i] = 0;
        const auto solve = [&](const Eigen::VectorXcd& before) -> Eigen::VectorXcd {
            return solver.solve_free(Solver::hermitian_product(system_.mass, before));
        };
        const auto scale = [&](Eigen::VectorXcd& vectors) {
            const Eigen::ArrayXd norms = by_part(vectors, system_.mass).sqrt();
            for (Index i = 0; i < vectors.size(); ++i)
                if (norms[part_of_row_[i]] > 0) vectors[i] /= norms[part_of_row_[i]];
            return norms;
        };
        const auto go_on = [&] { return report(progress_, "sized field", 0.5, NAN); };
        result_.iterations = detail::inverse_iteration(found, solve, scale, options_.max_iterations, options_.tolerance,
                                                       go_on, result_.converged);
        values += found;
    }

    // v* matrix v of each part.
    Eigen::ArrayXd by_part(const Eigen::VectorXcd& v, const SizedSystem::Matrix& matrix) const {
        const Eigen::VectorXcd product = Solver::hermitian_product(matrix, v);
        Eigen::ArrayXd sums = Eigen::ArrayXd::Zero(static_cast<Index>(parts_.areas.size()));
        for (Index i = 0; i < v.size(); ++i) sums[part_of_row_[i]] += (std::conj(v[i]) * product[i]).real();
        return sums;
    }

    void finish(const Eigen::VectorXcd& values) {
        result_.eigenvalue = (by_part(values, system_.energy) / by_part(values, system_.mass)).maxCoeff();
        result_.holonomy = connection_.holonomy;
        for (Index t = 0; t < domain_.triangle_count(); ++t)
            if (std::abs(connection_.holonomy[t]) >= pi) result_.unresolved.push_back(t);
        result_.least_length = values.cwiseAbs().minCoeff() / values.cwiseAbs().maxCoeff();
        result_.values = Eigen::VectorXcd::Zero(domain_.vertex_count());
        result_.directions = Points::Zero(domain_.vertex_count(), 3);
        for (Index v = 0; v < domain_.vertex_count(); ++v) {
            if (system_.row[v] < 0) continue;
            result_.values[v] = values[system_.row[v]];
            result_.directions.row(v) = charts_.lifted(v, std::arg(result_.values[v]) / options_.symmetry);
        }
        result_.triangle_indices = turned_triangles(domain_, connection_, result_.values);
        set_edge_field();
    }

    // At midpoints of edges, the mean of what both ends say there.
    void set_edge_field() {
        DirectionField& field = result_.field;
        field.symmetry = options_.symmetry;
        field.domain = domain_;
        field.converged = result_.converged;
        field.iterations = result_.iterations;
        field.values.resize(domain_.edge_count());
        const Triangles& triangles = domain_.mesh().triangles;
        for (Index t = 0; t < domain_.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Index from = triangles(t, k), to = triangles(t, (k + 1) % 3), next = 3 * t + (k + 1) % 3;
                const double leaving =
                    from < to ? charts_.leaving(3 * t + k)
                              : charts_.leaving(next) + charts_.scale(to) * domain_.corner_angles()(t, next % 3);
                const Index e = domain_.topology().triangle_edges(t, k);
                field.values[e] = middle_value(e, leaving);
            }
        field.values = detail::unit_values(field.values);
        for (Index e = 0; e < field.values.size(); ++e) follow(e, field.values[e]);
    }

    // `leaving`: angle of the edge at its lower vertex.
    Complex middle_value(Index e, double leaving) const {
        const auto ends = domain_.topology().edges.row(e);
        const double n = options_.symmetry, half = sizes_.turns[e] / 2;
        return std::polar(1.0, -n * leaving) *
               (result_.values[ends[0]] * std::polar(1.0, n * half) +
                result_.values[ends[1]] * std::polar(1.0, -n * (charts_.transport(e) + half)));
    }

    void follow(Index e, Complex& value) const {
        const auto ends = domain_.topology().edges.row(e);
        const bool backward = options_.symmetry % 2 == 1 && domain_.topology().edge_triangles(e, 0) < 0;
        const double along = backward ? -1 : 1;
        const bool held = given_.is_held[ends[0]] || given_.is_held[ends[1]];
        if (given_.followed[e] && held && along * value.real() > 0) value = along;
    }

    const SurfaceDomain& domain_;
    const WantedSizes& sizes_;
    const SizedFieldOptions& options_;
    const Progress& progress_;
    VertexCharts charts_;
    SizedConnection connection_;
    SizedSystem system_;
    GivenDirections given_;
    Parts parts_;
    std::vector<Index> part_of_row_;
    SizedField result_;
};

}  // namespace

SizedField sized_field(const SurfaceDomain& domain, const WantedSizes& sizes, const SizedFieldOptions& options,
                       const Progress& progress) {
    calm_library_threads();
    check(domain, sizes, options);
    report_or_throw(progress, "sized field", 0, std::numeric_limits<double>::quiet_NaN());
    return Work(domain, sizes, options, progress).run();
}

}  // namespace octafield::surface
