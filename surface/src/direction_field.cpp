#include "octafield/surface/direction_field.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "crouzeix_raviart.hpp"
#include "free_system.hpp"
#include "ginzburg_landau.hpp"
#include "octafield/library_threads.hpp"
#include "short_number.hpp"
#include "start_field.hpp"

namespace octafield::surface {
namespace {

// A component whose |f| is below this everywhere has collapsed: minimisers that have not come near 1 somewhere.
constexpr double least_length = 0.1;

void require_usable(const TriangleMesh& mesh, const DirectionFieldOptions& options) {
    if (options.symmetry < 1) throw InvalidInput("the symmetry of a direction field must be at least 1");
    if (!(options.epsilon >= 0) || !std::isfinite(options.epsilon))
        throw InvalidInput("epsilon must be a length, or 0 for the default");
    if (options.max_iterations < 0) throw InvalidInput("max_iterations must not be negative");
    if (!(options.tolerance >= 0) || !(options.energy_tolerance >= 0))
        throw InvalidInput("tolerances must not be negative");
    if (mesh.triangles.rows() == 0) throw GeometryError("the surface has no triangles", "empty");
    if (mesh.triangles.minCoeff() < 0 || mesh.triangles.maxCoeff() >= mesh.vertices.rows())
        throw GeometryError("a triangle names a vertex that does not exist; there are " +
                                std::to_string(mesh.vertices.rows()) + " vertices, numbered from 0",
                            "index_out_of_range");
}

Index find_edge(const EdgeTopology& topology, Index low, Index high) {
    Index first = 0, last = static_cast<Index>(topology.edges.rows());
    while (first < last) {
        const Index middle = first + (last - first) / 2;
        const bool below = std::pair(topology.edges(middle, 0), topology.edges(middle, 1)) < std::pair(low, high);
        (below ? first : last) = below ? middle + 1 : middle;
    }
    const bool found =
        first < topology.edges.rows() && topology.edges(first, 0) == low && topology.edges(first, 1) == high;
    return found ? first : -1;
}

struct Held {
    std::vector<bool> is_held;  // (E)
    Eigen::VectorXcd values;    // (E), 1 unless N is odd
};

// Feature and boundary edges. With odd N an edge's two senses differ: the boundary is run with the surface on its left.
Held held_edges(const EdgeTopology& topology, const FeatureGraph& features, int symmetry) {
    Held held{std::vector<bool>(topology.edges.rows(), false), Eigen::VectorXcd::Ones(topology.edges.rows())};
    for (Index e = 0; e < topology.edges.rows(); ++e) {
        if (topology.edge_triangles.row(e).minCoeff() >= 0) continue;
        held.is_held[e] = true;
        if (symmetry % 2 == 1 && topology.edge_triangles(e, 0) < 0) held.values[e] = -1;
    }
    std::vector<Index> unknown;
    for (Index i = 0; i < features.edges.rows(); ++i) {
        const auto [low, high] = std::minmax(features.edges(i, 0), features.edges(i, 1));
        const Index e = find_edge(topology, low, high);
        if (e < 0) {
            unknown.insert(unknown.end(), {low, high});
        } else if (!held.is_held[e]) {
            if (symmetry % 2 == 1)
                throw InvalidInput(
                    "edge " + std::to_string(low) + "-" + std::to_string(high) +
                        " is a feature inside the surface: it has no sense to run in, so the symmetry must be even",
                    "odd_symmetry", {low, high});
            held.is_held[e] = true;
        }
    }
    if (!unknown.empty())
        throw InvalidInput(std::to_string(unknown.size() / 2) + " feature edges are no edges of the mesh (vertices " +
                               first_few(unknown) + ")",
                           "unknown_edge", unknown);
    return held;
}

// Of the components without held edges, the only ones that a large epsilon makes vanish; infinity if there are none.
double smallest_free_diagonal(const TriangleMesh& mesh, const EdgeTopology& topology,
                              const std::vector<Index>& component, const std::vector<bool>& is_held) {
    std::vector<Eigen::AlignedBox3d> boxes(component.size());
    std::vector<bool> anchored(component.size(), false);
    for (std::size_t e = 0; e < component.size(); ++e) {
        anchored[component[e]] = anchored[component[e]] || is_held[e];
        for (int k = 0; k < 2; ++k) boxes[component[e]].extend(mesh.vertices.row(topology.edges(e, k)).transpose());
    }
    double smallest = std::numeric_limits<double>::infinity();
    for (std::size_t c = 0; c < boxes.size(); ++c)
        if (!boxes[c].isEmpty() && !anchored[c]) smallest = std::min(smallest, boxes[c].diagonal().norm());
    return smallest;
}

double chosen_epsilon(const TriangleMesh& mesh, const EdgeTopology& topology, const std::vector<Index>& component,
                      const std::vector<bool>& is_held, const DirectionFieldOptions& options) {
    double sum = 0;
    for (Index e = 0; e < topology.edges.rows(); ++e)
        sum += (mesh.vertices.row(topology.edges(e, 0)) - mesh.vertices.row(topology.edges(e, 1))).norm();
    const double mean = sum / topology.edges.rows();
    if (options.epsilon == 0) {
        const double smallest = smallest_free_diagonal(mesh, topology, component, is_held);
        return std::min({2 * mean, bounding_box_diagonal(mesh.vertices) / 10, std::max(smallest / 10, mean / 4)});
    }
    if (options.method == DirectionFieldMethod::ginzburg_landau && options.epsilon < mean / 100)
        throw InvalidInput(
            "an epsilon of " + short_number(options.epsilon) + " is below 1/100 of the mean edge length, " +
                short_number(mean) +
                ": singular points would stay where they start; choose 1/100 or more, 2 mean edge lengths are usual, "
                "or the eigenvector method, which needs no epsilon",
            "epsilon_too_small");
    return options.epsilon;
}

// Where epsilon is large against a component, f = 0 minimises E, and the directions are rounding noise.
void require_not_collapsed(const DirectionField& field, const std::vector<Index>& component,
                           const std::vector<bool>& is_held) {
    std::vector<double> longest(component.size(), -1);  // by component, of its free edges
    for (std::size_t e = 0; e < component.size(); ++e)
        if (!is_held[e]) longest[component[e]] = std::max(longest[component[e]], std::abs(field.values[e]));
    const auto collapsed = [&](Index c) { return longest[c] >= 0 && longest[c] < least_length; };
    std::vector<Index> triangles;
    for (Index t = 0; t < field.topology.triangle_edges.rows(); ++t)
        if (collapsed(component[field.topology.triangle_edges(t, 0)])) triangles.push_back(t);
    if (triangles.empty()) return;
    throw SolverError("the direction field vanishes on " + std::to_string(triangles.size()) + " triangles (" +
                          first_few(triangles) + "): epsilon, " + short_number(field.epsilon) +
                          ", is too large against the connected part of the surface they form; choose a smaller "
                          "epsilon, 1/10 of that part's bounding-box diagonal or less",
                      "epsilon_too_large", triangles);
}

}  // namespace

DirectionField direction_field(const TriangleMesh& mesh, const FeatureGraph& features,
                               const DirectionFieldOptions& options, const Progress& progress) {
    require_usable(mesh, options);
    calm_library_threads();
    DirectionField field;
    field.symmetry = options.symmetry;
    field.topology = edge_topology(mesh);

    const std::vector<detail::CornerLink> links = detail::corner_links(mesh, field.topology, options.symmetry);
    const Held held = held_edges(field.topology, features, options.symmetry);
    const std::vector<Index> component = detail::edge_components(links, field.topology.edges.rows());
    field.epsilon = chosen_epsilon(mesh, field.topology, component, held.is_held, options);
    const detail::FreeSystem system(links, held.is_held);
    const Eigen::VectorXd masses = detail::edge_masses(mesh, field.topology);
    const detail::GinzburgLandau functional(links, masses, system, field.epsilon);
    bool cancelled = false;
    const Progress latched = [&](std::string_view phase, double fraction, double merit) {
        cancelled = cancelled || !report(progress, phase, fraction, merit);
        return !cancelled;
    };
    field.values = detail::start_field(links, system, masses, held.is_held, held.values, options.seed, latched);

    if (options.method == DirectionFieldMethod::ginzburg_landau && system.size() > 0) {
        const detail::DescentOptions descent{options.max_iterations, options.tolerance, options.energy_tolerance,
                                             options.seed};
        const detail::DescentResult result = detail::minimise(functional, field.values, descent, latched);
        field.iterations = result.iterations;
        field.converged = result.converged;
        field.energy_history = result.energy_history;
        if (!cancelled) require_not_collapsed(field, component, held.is_held);
    }
    const detail::GinzburgLandau::Slope slope = functional.slope(field.values);
    field.energy = slope.energy;
    field.residual = slope.residual;
    field.dirichlet_energy = detail::dirichlet_energy(links, field.values);
    if (field.energy_history.empty()) {
        field.converged = !cancelled;
        field.energy_history = {field.energy};
    }
    return field;
}

}  // namespace octafield::surface
