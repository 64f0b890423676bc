#include "octafield/surface/direction_field.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

#include "alignment.hpp"
#include "angle_descent.hpp"
#include "continuation.hpp"
#include "definiteness.hpp"
#include "ginzburg_landau.hpp"
#include "mbo.hpp"
#include "octafield/library_threads.hpp"
#include "octafield/surface/principal_directions.hpp"
#include "short_number.hpp"

namespace octafield::surface {
namespace {

using namespace detail;

// A component whose |f| is below this everywhere has collapsed: minimisers that have not come near 1 somewhere.
constexpr double least_length = 0.1;

class Solver;

struct Method {
    DirectionFieldMethod known;
    bool wants_epsilon;  // on the scale of the edges: its singular points have cores
    // From the eigenvector field, with its diffusion; and from a field |f| = 1 (E) to the local minimum beside it,
    // without diffusion and continuation, or nothing, where there is no such minimum.
    void (*run)(Solver& solver);
    void (*run_from)(Solver& solver);
};
const Method& method_of(const DirectionFieldOptions& options);  // throws InvalidInput that lists the names

void require_usable(const SurfaceDomain& domain, const DirectionFieldOptions& options) {
    const DirectionConstraints& given = options.constraints;
    if (domain.has_own_lengths() &&
        (given.edges.rows() > 0 || !given.vertices.empty() || options.guide.directions.rows() > 0))
        throw InvalidInput(
            "constraints and guides are directions on the surface in space, without edge lengths of its "
            "own; leave them out",
            "own_lengths");
    const auto is_length = [](double length) { return length >= 0 && std::isfinite(length); };
    if (options.symmetry < 1 || options.symmetry > largest_symmetry)
        throw InvalidInput("the symmetry of a direction field must be at least 1 and at most " +
                           std::to_string(largest_symmetry) + ", not " + std::to_string(options.symmetry));
    if (!is_length(options.epsilon)) throw InvalidInput("epsilon must be a length, or 0 for the default");
    if (!is_length(options.first_epsilon)) throw InvalidInput("first_epsilon must be a length, or 0 for none");
    if (!is_length(options.alignment_length))
        throw InvalidInput("alignment_length must be a length, or 0 for the default");
    if (options.max_iterations < 0) throw InvalidInput("max_iterations must not be negative");
    if (!(options.tolerance >= 0) || !(options.energy_tolerance >= 0))
        throw InvalidInput("tolerances must not be negative");
    if (!(options.least_feature_angle >= 0))
        throw InvalidInput("least_feature_angle must be an angle in radians, 0 or more");
    if (!(options.corner_tolerance >= 0 && options.corner_tolerance <= 1))
        throw InvalidInput("corner_tolerance must lie between 0 and 1");
    method_of(options);
    if (domain.triangle_count() == 0) throw GeometryError("the surface has no triangles", "empty");
}

// Of the components that nothing aligns, the only ones that a large epsilon makes vanish; infinity if there are none.
double smallest_free_size(const Components& components) {
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < components.size(); ++c)
        if (!components.anchored[c]) smallest = std::min(smallest, components.sizes[c]);
    return smallest;
}

void require_not_below_edges(const DirectionFieldOptions& options, double epsilon, double mean) {
    if (!method_of(options).wants_epsilon || epsilon >= mean / 100) return;
    throw InvalidInput(
        "an epsilon of " + short_number(epsilon) + " is below 1/100 of the mean edge length, " + short_number(mean) +
            ": singular points would stay where they start; choose 1/100 or more, 2 mean edge lengths are usual, "
            "or the methods mbo and eigen, which need no epsilon",
        "epsilon_too_small");
}

// Whether squares of length / mean and of their ratio to areas are numbers.
bool is_scale(double length, double mean) { return length >= 1e-60 * mean && length <= 1e60 * mean; }

// (E)
Eigen::VectorXd chosen_epsilon(const SurfaceDomain& domain, const Components& components,
                               const DirectionFieldOptions& options) {
    const Index edges = domain.edge_count();
    const double mean = domain.mean_edge_length();
    if (options.edge_epsilon.size() != 0) {
        const Eigen::VectorXd& given = options.edge_epsilon;
        if (given.size() != edges)
            throw InvalidInput("edge_epsilon must hold one length above 0 per edge, " + std::to_string(edges) +
                                   "; it has " + std::to_string(given.size()) + " entries",
                               "wrong_size");
        std::vector<Index> bad;
        for (Index e = 0; e < edges; ++e)
            if (!is_scale(given[e], mean)) bad.push_back(e);
        if (!bad.empty())
            throw InvalidInput("edge_epsilon must hold lengths above 0; it does not at " + std::to_string(bad.size()) +
                                   " edges (" + first_few(bad) + ")",
                               "bad_epsilon", bad);
        require_not_below_edges(options, given.minCoeff(), mean);
        return given;
    }
    double epsilon = options.epsilon;
    if (epsilon == 0)
        epsilon = std::min({2 * mean, domain.size() / 10, std::max(smallest_free_size(components) / 10, mean / 4)});
    else
        require_not_below_edges(options, epsilon, mean);
    if (!is_scale(epsilon, mean))
        throw InvalidInput("an epsilon of " + short_number(epsilon) +
                               " is no length on the scale of the mesh, whose mean edge length is " +
                               short_number(mean) + "; 2 mean edge lengths are usual",
                           "bad_epsilon");
    return Eigen::VectorXd::Constant(edges, epsilon);
}

// Where epsilon is large against a component, f = 0 minimises E, and the directions are rounding noise.
void require_not_collapsed(const DirectionField& field, const Components& components,
                           const std::vector<bool>& is_held) {
    std::vector<double> longest(components.size(), -1);  // by component, of its free edges
    for (std::size_t e = 0; e < is_held.size(); ++e) {
        double& most = longest[components.of_edge[e]];
        if (!is_held[e]) most = std::max(most, std::abs(field.values[e]));
    }
    const auto collapsed = [&](Index c) { return longest[c] >= 0 && longest[c] < least_length; };
    std::vector<Index> triangles;
    for (Index t = 0; t < field.domain.triangle_count(); ++t)
        if (collapsed(components.of_edge[field.domain.topology().triangle_edges(t, 0)])) triangles.push_back(t);
    if (triangles.empty()) return;
    throw SolverError("the direction field vanishes on " + std::to_string(triangles.size()) + " triangles (" +
                          first_few(triangles) + "): epsilon, " + short_number(field.epsilon) +
                          ", is too large against the connected part of the surface they form; choose a smaller "
                          "epsilon, 1/10 of that part's size (shape_size) or less",
                      "epsilon_too_large", triangles);
}

constexpr double stage_tolerance = 1e-4;  // of residual and energy, before the last stage

// Everything a field is computed from, and the computation of its values.
class Solver {
public:
    Solver(const DirectionFieldOptions& options, DirectionField& field, const Progress& progress)
        : options_(options),
          field_(field),
          progress_([this, &progress](std::string_view phase, double fraction, double merit) {
              cancelled_ = cancelled_ || !report(progress, phase, fraction, merit);
              return !cancelled_;
          }),
          silent_([this](std::string_view phase, double, double) {
              return progress_(phase, 0, std::numeric_limits<double>::quiet_NaN());
          }),
          links_(corner_links(field.domain, options.symmetry)),
          masses_(edge_masses(field.domain)),
          components_(components(field.domain, links_, masses_)),
          aligned_(aligned_edges(field.domain, links_, options)),
          system_(links_, aligned_.is_held) {
        const auto anchor = [&](Index e) { components_.anchored[components_.of_edge[e]] = true; };
        for (Index e = 0; e < masses_.size(); ++e)
            if (aligned_.is_held[e] || aligned_.pull.weights[e] > 0) anchor(e);
        for (const WeakEdge& weak : aligned_.weak) anchor(weak.edge);
        epsilon_ = chosen_epsilon(field.domain, components_, options);
        add_weak_edges(aligned_, options.alignment_length, epsilon_);
        release_negligible(components_, aligned_);
        field.epsilon = epsilon_.minCoeff();
    }

    void run();
    void run_from(const Eigen::VectorXcd& values);
    // Whether a component is free of anything to follow.
    bool has_free_component() const {
        return std::find(components_.anchored.begin(), components_.anchored.end(), false) != components_.anchored.end();
    }

    // What methods are made of.
    void start(bool diffused);  // the eigenvector field, diffused and projected or not
    void settle();              // by the angles, to the local minimum beside a field |f| = 1
    void descend_through_epsilons() { descend(continuation(epsilon_, options_.first_epsilon, components_)); }
    void descend_at_epsilon() { descend({epsilon_}); }

private:
    Problem problem() const { return {links_, system_, masses_, components_, aligned_.held, aligned_.pull}; }
    void tell();
    void diffuse(const Problem& problem, DiffusionSolver& diffusion);
    void descend(const std::vector<Eigen::VectorXd>& stages);

    const DirectionFieldOptions& options_;
    DirectionField& field_;
    const Progress progress_;  // remembers a cancellation
    const Progress silent_;    // the same without energies, which are not those of the final epsilon
    std::vector<CornerLink> links_;
    Eigen::VectorXd masses_;
    Components components_;
    AlignedEdges aligned_;
    FreeSystem system_;
    Eigen::VectorXd epsilon_;
    Eigen::VectorXi order_;
    bool cancelled_ = false;
};

void Solver::run() {
    field_.values = aligned_.held;
    field_.converged = true;
    if (system_.size() > 0) method_of(options_).run(*this);
    tell();
}

void Solver::run_from(const Eigen::VectorXcd& values) {
    field_.values = values;
    field_.converged = true;
    order_ = system_.elimination_order();
    method_of(options_).run_from(*this);
    tell();
}

void Solver::tell() {
    const GinzburgLandau functional(links_, masses_, system_, aligned_.pull, epsilon_);
    const GinzburgLandau::Slope slope = functional.slope(field_.values);
    field_.energy = slope.energy;
    field_.residual = slope.residual;
    field_.dirichlet_energy = dirichlet_energy(links_, field_.values);
    if (field_.energy_history.empty()) field_.energy_history = {field_.energy};
}

// The methods of length 1. Their factorizations are gone before that of the descent needs the memory.
void Solver::start(bool diffused) {
    const Problem problem = this->problem();
    DiffusionSolver diffusion(system_);
    order_ = diffusion.order();
    field_.values = start_field(problem, diffusion, options_.seed, progress_);
    if (diffused && !cancelled_) diffuse(problem, diffusion);
    field_.converged = field_.converged && !cancelled_;
}

constexpr double diffusion_part = 0.7;  // of the progress of mbo

void Solver::diffuse(const Problem& problem, DiffusionSolver& diffusion) {
    const Progress told = [this](std::string_view phase, double fraction, double energy) {
        return progress_(phase, diffusion_part * fraction, energy);
    };
    DiffusionResult result =
        diffuse_and_project(problem, diffusion, field_.values, options_.max_iterations, options_.seed, told);
    field_.iterations = result.iterations;
    field_.converged = result.converged;
    field_.energy_history = std::move(result.energy_history);
}

// From the projected field to the local minimum beside it.
void Solver::settle() {
    if (!field_.converged) return;
    int steps = 0;
    const auto told = [&](double energy) {
        field_.energy_history.push_back(energy);
        ++field_.iterations;
        const double left = 1 / (1 + ++steps / 8.0);
        return progress_("cross field", 1 - (1 - diffusion_part) * left, energy) &&
               field_.iterations < options_.max_iterations;
    };
    const bool more = field_.iterations < options_.max_iterations;
    field_.converged = more && descend_angles(problem(), order_, field_.values, options_.seed, told) && !cancelled_;
}

// By the coherence lengths of the stages, one after the other.
void Solver::descend(const std::vector<Eigen::VectorXd>& stages) {
    for (std::size_t i = 0; i < stages.size(); ++i) {
        const bool last = i + 1 == stages.size();
        if (i > 0) narrow_cores(field_.values, aligned_.is_held, stages[i - 1], stages[i]);
        const GinzburgLandau functional(links_, masses_, system_, aligned_.pull, stages[i]);
        const DescentOptions descent{options_.max_iterations,
                                     last ? options_.tolerance : stage_tolerance,
                                     last ? options_.energy_tolerance : stage_tolerance,
                                     options_.seed,
                                     last,
                                     i == 0 && !last};
        const Progress& told = last ? progress_ : silent_;
        DescentResult result = minimise(functional, order_, field_.values, descent, told);
        field_.iterations = result.iterations;
        field_.converged = last && result.converged;
        field_.energy_history = std::move(result.energy_history);
        if (cancelled_) return;
    }
    require_not_collapsed(field_, components_, aligned_.is_held);
}

constexpr double least_anisotropy = 0.05;  // mean over the area, for principal directions to mean something

// Along the principal directions as far as a linear solve follows them, |f| = 1 (E); nothing where the surface bends
// nearly alike in all directions.
std::optional<Eigen::VectorXcd> along_curvature(const SurfaceDomain& domain, const DirectionFieldOptions& options) {
    const PrincipalDirections curvature = principal_directions(domain);
    const Eigen::VectorXd areas = triangle_areas(domain.mesh());
    if (!(areas.dot(curvature.anisotropy) > least_anisotropy * areas.sum())) return {};
    DirectionFieldOptions guided = options;
    guided.method = "eigen";
    guided.guide = {.directions = curvature.directions, .weights = curvature.anisotropy};
    DirectionField field;
    field.symmetry = options.symmetry;
    field.domain = domain;
    Solver(guided, field, {}).run();
    return field.values;
}

Progress part(const Progress& progress, double begin, double end) {
    return [&progress, begin, end](std::string_view phase, double fraction, double merit) {
        return report(progress, phase, begin + (end - begin) * fraction, merit);
    };
}

constexpr double first_part = 0.8;  // of the progress, where two starts are tried

// Where nothing tells the field which way to run there are local minima of very different kind: a torus has one without
// singular points, along its lines of curvature, which neither diffusion nor continuation from a large epsilon finds.
void improve_from_curvature(const DirectionFieldOptions& options, DirectionField& field, const Progress& progress) {
    const std::optional<Eigen::VectorXcd> start = along_curvature(field.domain, options);
    if (!start) return;
    DirectionField other;
    other.symmetry = field.symmetry;
    other.domain = field.domain;
    Solver(options, other, part(progress, first_part, 1)).run_from(*start);
    if (other.converged && other.energy < field.energy) field = std::move(other);
}

// A row each.
const std::vector<Method>& methods() {
    static const std::vector<Method> table = {
        {{"gl", "Ginzburg-Landau"},
         true,
         [](Solver& solver) {
             solver.start(false);
             solver.descend_through_epsilons();
         },
         [](Solver& solver) { solver.descend_at_epsilon(); }},
        {{"mbo", "diffusion, faster"},
         false,
         [](Solver& solver) {
             solver.start(true);
             solver.settle();
         },
         [](Solver& solver) { solver.settle(); }},
        {{"eigen", "smoothest eigenvector"}, false, [](Solver& solver) { solver.start(false); }, nullptr},
    };
    return table;
}

const Method& method_of(const DirectionFieldOptions& options) {
    std::string names;
    for (const Method& method : methods()) {
        if (method.known.name == options.method) return method;
        names += (names.empty() ? "" : ", ") + method.known.name;
    }
    throw InvalidInput("method '" + options.method + "' is not one of: " + names, "unknown_word");
}

}  // namespace

const std::vector<DirectionFieldMethod>& direction_field_methods() {
    static const std::vector<DirectionFieldMethod> known = [] {
        std::vector<DirectionFieldMethod> all;
        for (const Method& method : methods()) all.push_back(method.known);
        return all;
    }();
    return known;
}

DirectionField direction_field(const SurfaceDomain& domain, const DirectionFieldOptions& options,
                               const Progress& progress) {
    require_usable(domain, options);
    calm_library_threads();
    DirectionField field;
    field.symmetry = options.symmetry;
    field.domain = domain;
    explaining_failure(domain, [&] {
        bool free = false;
        {
            const Progress told = part(progress, 0, first_part);
            Solver solver(options, field, told);
            free = solver.has_free_component();
            solver.run();
        }
        const bool in_space = !domain.has_own_lengths();  // as principal directions are
        if (free && in_space && field.converged && options.symmetry % 2 == 0 && method_of(options).run_from)
            improve_from_curvature(options, field, progress);
    });
    return field;
}

}  // namespace octafield::surface
