#include "octafield/surface/non_orthogonal_field.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "boundary_lines.hpp"
#include "definiteness.hpp"
#include "harmonic_lines.hpp"
#include "line_matching.hpp"
#include "line_moves.hpp"
#include "lines_energy.hpp"
#include "newton_descent.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "octafield/library_threads.hpp"
#include "octafield/surface/directions.hpp"
#include "projected_loop.hpp"

namespace octafield::surface {
namespace {

using detail::BoundaryLines;
using detail::VertexCharts;
using detail::VertexLink;
using std::numbers::pi;
constexpr int most_moves = 20;
constexpr double energy_tolerance = 1e-10;  // gain to be expected from a step, relative to the energy
// The angle to which lines that coincide in the start are spread (radians): there the energy does not tell them apart.
constexpr double least_spread = 0.02;

void require(bool holds, const std::string& what) {
    if (!holds) throw InvalidInput(what, "bad_option");
}

void check(const NonOrthogonalFieldOptions& options) {
    const auto& methods = non_orthogonal_field_methods();
    std::string names;
    for (const auto& method : methods) names += (names.empty() ? "" : ", ") + method.name;
    require(std::any_of(methods.begin(), methods.end(), [&](const auto& m) { return m.name == options.method; }),
            "method: there is no '" + options.method + "'; use one of " + names);
    require(options.lambda > 0 && std::isfinite(options.lambda), "lambda must be positive; 1.5 is usual");
    require(options.corner_angle > 0 && options.corner_angle < pi / 2,
            "corner_angle must be between 0 and pi / 2 radians; pi / 4 is usual");
    require(options.least_angle > 0 && options.least_angle < pi / 4,
            "least_angle must be between 0 and pi / 4 radians");
    require(options.max_iterations >= 1, "max_iterations must be at least 1");
    for (const double value : {options.inertia, options.penalty, options.tolerance})
        require(value >= 0 && std::isfinite(value), "inertia, penalty and tolerance must not be negative");
    require(options.method != "poly_vector" || options.second_line == SecondLine::fixed,
            "the method poly_vector is linear and needs both lines on the boundary: take second_line fixed, or another "
            "method");
}

void check(const SurfaceDomain& domain) {
    if (domain.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
    if (domain.has_own_lengths())
        throw InvalidInput("non-orthogonal fields are found on the surface in space, without edge lengths of its own",
                           "own_lengths");
    std::vector<Index> inside;
    for (Index e = 0; e < domain.edge_count(); ++e)
        if (domain.is_feature()[e] && domain.topology().edge_triangles.row(e).minCoeff() >= 0) inside.push_back(e);
    if (!inside.empty())
        throw InvalidInput("edges " + first_few(inside) +
                               " inside the surface are features, which non-orthogonal fields do not follow; cut the "
                               "surface along them, or give it without features",
                           "features_inside", inside);
}

// Vertices that keep their lines in the linear start: the boundary, and parts without one, which get the lines of the
// globally smoothest cross field.
std::vector<bool> given_vertices(const SurfaceDomain& domain, const VertexCharts& charts,
                                 const NonOrthogonalFieldOptions& options, std::vector<TwoLines>& lines) {
    DisjointSets parts(domain.vertex_count());
    for (Index e = 0; e < domain.edge_count(); ++e)
        parts.join(domain.topology().edges(e, 0), domain.topology().edges(e, 1));
    std::vector<bool> anchored(domain.vertex_count(), false), given(domain.vertex_count(), true);
    for (Index v = 0; v < domain.vertex_count(); ++v)
        if (charts.on_boundary(v)) anchored[parts.lowest(v)] = true;
    bool all = true;
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        given[v] = !charts.used(v) || charts.on_boundary(v) || !anchored[parts.lowest(v)];
        all = all && (!charts.used(v) || anchored[parts.lowest(v)]);
    }
    if (all) return given;
    DirectionFieldOptions smooth;
    smooth.method = "eigen";
    smooth.seed = options.seed;
    const Points directions = vertex_directions(direction_field(domain, smooth));
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        if (!charts.used(v) || anchored[parts.lowest(v)]) continue;
        const double angle = charts.lowered(v, directions.row(v));
        lines[v] = {angle, angle + pi / 2};
    }
    return given;
}

std::vector<TwoLines> linear_start(const SurfaceDomain& domain, const std::vector<VertexLink>& links,
                                   const std::vector<bool>& given, const std::vector<TwoLines>& boundary,
                                   bool poly_vector) {
    using detail::Extended;
    std::vector<TwoLines> lines;
    if (poly_vector) {
        detail::explaining_failure(
            domain, [&] { lines = detail::harmonic_lines(links, given, boundary, Extended::coefficients); });
        return lines;
    }
    try {
        lines = detail::harmonic_lines(links, given, boundary, Extended::power_sums);
    } catch (const SolverError& error) {  // curved, with obtuse triangles: any start will do
        if (error.kind() != detail::not_definite) throw;
        lines = detail::harmonic_lines(detail::with_positive_weights(links), given, boundary, Extended::power_sums);
    }
    for (std::size_t v = 0; v < lines.size(); ++v) {
        if (given[v] || angle_between(lines[v]) >= least_spread) continue;
        const double middle = std::arg(power_sums(lines[v]).p1) / 2;
        lines[v] = {middle - least_spread / 2, middle + least_spread / 2};
    }
    return lines;
}

// The field while it is made.
class Work {
public:
    Work(const SurfaceDomain& domain, const NonOrthogonalFieldOptions& options, const Progress& progress)
        : options_(options),
          progress_(progress),
          charts_(domain),
          boundary_(boundary_lines(domain, charts_, options)),
          links_(vertex_links(domain, charts_, options.weights)) {
        field_.domain = domain;
        field_.quads = boundary_.quads;
    }

    NonOrthogonalField run() {
        lines_ = boundary_.lines;
        const std::vector<bool> given = given_vertices(field_.domain, charts_, options_, lines_);
        lines_ = linear_start(field_.domain, links_, given, lines_, options_.method == "poly_vector");
        field_.start_energy = lines_energy(links_, lines_, options_.lambda);
        field_.freedom = options_.second_line == SecondLine::free ? 1 : 0;
        if (options_.method == "angles") descend_without_inversion();
        if (options_.method == "projected") loop();
        if (options_.method == "poly_vector") field_.converged = true;
        finish();
        return std::move(field_);
    }

private:
    bool told(double energy) {
        ++field_.iterations;
        const double done = static_cast<double>(field_.iterations) / options_.max_iterations;
        stopped_ = !report(progress_, "non-orthogonal field", std::min(done, 1.0), energy) ||
                   field_.iterations >= options_.max_iterations;
        return !stopped_;
    }

    // Bounded at every vertex, a free line may still jump from one bound to the other between two: then it is held
    // nearer to the angle that goes linearly along the side.
    void descend_without_inversion() {
        const std::vector<TwoLines> start = lines_;
        for (const double freedom : {1.0, 0.5, 0.25, 0.0}) {
            if (freedom > 0 && options_.second_line == SecondLine::fixed) continue;
            field_.freedom = freedom;
            lines_ = start;
            descend();
            find_inversions();
            if (field_.inverted.empty() || stopped_) return;
        }
    }

    void descend() {
        detail::LinesEnergy energy(links_, boundary_, charts_, options_.lambda, options_.least_angle, field_.freedom);
        field_.converged = energy.size() == 0;
        if (field_.converged) return;
        Eigen::VectorXd state = energy.state_of(lines_);
        const auto order =
            detail::SparseCholesky<double>::amd_order(energy.hessian(state, detail::LinesEnergy::Curvature::convex));
        const std::function<bool(double)> listener = [&](double value) { return told(value); };
        detail::NewtonDescent<detail::LinesEnergy> descent(energy, order, state, options_.seed, listener);
        field_.converged = descent.descend(energy_tolerance, options_.max_iterations);
        for (int i = 0; i < most_moves && field_.converged && move_points(energy, state); ++i)
            field_.converged = descent.start_anew() && descent.descend(energy_tolerance, options_.max_iterations);
        lines_ = energy.lines_of_state(state);
    }

    // Whether a singular point has a better place nearby.
    bool move_points(const detail::LinesEnergy& energy, Eigen::VectorXd& state) {
        const SurfaceDomain& domain = field_.domain;
        std::vector<TwoLines> lines = energy.lines_of_state(state), sorted;
        std::vector<bool> is_free(lines.size());
        for (Index v = 0; v < domain.vertex_count(); ++v) {
            sorted.push_back(ordered(lines[v]));
            is_free[v] = charts_.used(v) && !charts_.on_boundary(v);
        }
        const std::vector<int> indices = detail::triangle_indices(domain, charts_, sorted);
        std::vector<Index> vertices;
        for (Index t = 0; t < domain.triangle_count(); ++t)
            if (indices[t] != 0)
                for (const Index v : domain.mesh().triangles.row(t)) vertices.push_back(v);
        detail::LineMoves moves(links_, std::move(is_free), options_.lambda);
        if (moves.improve(vertices, lines) == 0) return false;
        state = energy.state_of(lines);
        return true;
    }

    void loop() {
        const auto result =
            projected_loop(links_, boundary_, charts_, options_, lines_, [&](double value) { return told(value); });
        field_.converged = result.converged;
    }

    // The line that the side of the boundary before the vertex, or after it, follows, and the next one
    // counter-clockwise.
    TwoLines following_boundary(Index v, bool arriving) const {
        const TwoLines& lines = lines_[v];
        const double first = arriving && boundary_.is_held[v] ? lines.second : lines.first;
        const double other = arriving && boundary_.is_held[v] ? lines.first : lines.second;
        return {first, other + pi * std::ceil((first - other) / pi)};
    }

    // Free lines that the boundary's direction has overtaken from one vertex to the next.
    void find_inversions() {
        field_.inverted.clear();
        const auto& domain = field_.domain;
        for (Index v = 0; v < domain.vertex_count(); ++v) {
            const Index next = boundary_.next[v];
            if (next < 0) continue;
            const Index corner = domain.fans().corners[charts_.fan(v).first];
            const Index e = domain.topology().triangle_edges(corner / 3, corner % 3);
            const double transport = (v < next ? 1 : -1) * charts_.transport(e);
            if (detail::line_shift(following_boundary(v, false), following_boundary(next, true), transport) % 2 != 0)
                field_.inverted.push_back(next);
        }
        std::sort(field_.inverted.begin(), field_.inverted.end());
    }

    void finish() {
        const Index count = field_.domain.vertex_count();
        field_.energy = lines_energy(links_, lines_, options_.lambda);
        find_inversions();
        field_.angles = Rows<double, 2>::Zero(count, 2);
        field_.first = field_.second = Points::Zero(count, 3);
        field_.smallest_angle = pi / 2;
        for (Index v = 0; v < count; ++v) {
            if (!charts_.used(v)) continue;
            const TwoLines lines = ordered(lines_[v]);
            field_.angles.row(v) << lines.first, lines.second;
            field_.first.row(v) = charts_.lifted(v, lines.first);
            field_.second.row(v) = charts_.lifted(v, lines.second);
            field_.smallest_angle = std::min(field_.smallest_angle, angle_between(lines));
        }
    }

    const NonOrthogonalFieldOptions& options_;
    const Progress& progress_;
    VertexCharts charts_;
    BoundaryLines boundary_;
    std::vector<VertexLink> links_;
    std::vector<TwoLines> lines_;
    NonOrthogonalField field_;
    bool stopped_ = false;
};

}  // namespace

const std::vector<NonOrthogonalFieldMethod>& non_orthogonal_field_methods() {
    static const std::vector<NonOrthogonalFieldMethod> methods = {
        {"angles", "descent by the angles of the lines to a local minimum"},
        {"projected", "minimise over vectors of any length, scale them to length 1, in turn (Dermine 2024)"},
        {"poly_vector", "linear: harmonic extension of PolyVector coefficients (Diamanti et al. 2014)"},
    };
    return methods;
}

NonOrthogonalField non_orthogonal_field(const SurfaceDomain& domain, const NonOrthogonalFieldOptions& options,
                                        const Progress& progress) {
    calm_library_threads();
    check(options);
    check(domain);
    return Work(domain, options, progress).run();
}

}  // namespace octafield::surface
