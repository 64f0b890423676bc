#include "holonomy.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "octafield/disjoint_sets.hpp"
#include "vertex_laplacian.hpp"

namespace octafield::surface::detail {

constexpr double quarter = std::numbers::pi / 2;

double within_quarter(double angle) {
    const double rest = angle - quarter * std::round(angle / quarter);
    return rest <= -quarter / 2 ? quarter / 2 : rest;
}

Holonomy::Holonomy(const SurfaceDomain& domain, const Structure& structure)
    : domain_(domain),
      closing_of_edge_(domain.edge_count(), -1),
      parents_(domain.triangle_count()),
      seen_(domain.triangle_count(), false) {
    std::vector<bool> known(domain.edge_count(), false);
    for (const Structure::Component& component : structure.components) {
        if (component.curves.empty()) {
            walk_from(component.triangle, domain.topology().triangle_edges(component.triangle, 0), known);
        } else {
            const Index edge = component.curves.front().edge;
            walk_from(domain.topology().edge_triangles.row(edge).maxCoeff(), edge, known);
        }
    }
    add_conditions(structure);
}

void Holonomy::walk_from(Index triangle, Index edge, std::vector<bool>& known) {
    const EdgeTopology& topology = domain_.topology();
    struct Entry {
        Index triangle, edge;
    };
    std::vector<Entry> queue = {{triangle, edge}};
    known[edge] = true;
    seen_[triangle] = true;
    for (std::size_t next = 0; next < queue.size(); ++next) {
        const auto [t, entry] = queue[next];
        int side = 0;
        while (topology.triangle_edges(t, side) != entry) ++side;
        // Forward over corner `side`, backward over the next one.
        const Step reached[] = {{3 * t + side, entry, topology.triangle_edges(t, (side + 2) % 3), 1},
                                {3 * t + (side + 1) % 3, entry, topology.triangle_edges(t, (side + 1) % 3), -1}};
        for (const Step& step : reached) {
            if (known[step.to]) {
                closing_of_edge_[step.to] = static_cast<Index>(closings_.size());
                closings_.push_back(step);
                continue;
            }
            known[step.to] = true;
            steps_.push_back(step);
        }
        for (const Step& step : reached) {
            const auto beside = topology.edge_triangles.row(step.to);
            const Index other = beside[0] == t ? beside[1] : beside[0];
            if (other < 0 || seen_[other]) continue;
            seen_[other] = true;
            parents_[other] = {t, step.to, parents_[t].depth + 1};
            queue.push_back({other, step.to});
        }
    }
    // A closed component's root edge is reached again by the triangle on its other side, as any edge not in the tree.
}

void Holonomy::add_conditions(const Structure& structure) {
    const EdgeTopology& topology = domain_.topology();
    std::vector<bool> in_tree(domain_.edge_count(), false);
    for (const Parent& parent : parents_)
        if (parent.edge >= 0) in_tree[parent.edge] = true;
    DisjointSets sets(domain_.vertex_count());
    for (Index e = 0; e < domain_.edge_count(); ++e)
        if (topology.edge_triangles.row(e).minCoeff() < 0) sets.join(topology.edges(e, 0), topology.edges(e, 1));
    for (std::size_t c = 0; c < structure.components.size(); ++c)
        for (std::size_t curve = 1; curve < structure.components[c].curves.size(); ++curve)
            conditions_.push_back(
                {static_cast<Index>(c), true, static_cast<Index>(curve), structure.components[c].curves[curve].edge});
    for (Index e = 0; e < domain_.edge_count(); ++e) {
        if (in_tree[e] || topology.edge_triangles.row(e).minCoeff() < 0) continue;
        const Index a = topology.edges(e, 0), b = topology.edges(e, 1);
        if (sets.lowest(a) == sets.lowest(b)) conditions_.push_back({structure.of_vertex[a], false, -1, e});
        sets.join(a, b);
    }
    std::stable_sort(conditions_.begin(), conditions_.end(),
                     [](const Condition& a, const Condition& b) { return a.component < b.component; });
}

Eigen::VectorXd Holonomy::walked(const std::vector<double>& turns) const {
    Eigen::VectorXd angles = Eigen::VectorXd::Zero(domain_.edge_count());
    for (const Step& step : steps_) angles[step.to] = angles[step.from] + step.sign * turns[step.corner];
    return angles;
}

Eigen::VectorXd Holonomy::missed(const std::vector<double>& turns, const Eigen::VectorXd& angles) const {
    Eigen::VectorXd result(static_cast<Eigen::Index>(conditions_.size()));
    for (std::size_t i = 0; i < conditions_.size(); ++i) {
        const Index edge = conditions_[i].edge;
        result[static_cast<Eigen::Index>(i)] =
            conditions_[i].boundary ? angles[edge] : misfit(closings_[closing_of_edge_[edge]], turns, angles);
    }
    return result;
}

double Holonomy::closure(const std::vector<double>& turns, const Eigen::VectorXd& angles) const {
    double largest = 0;
    for (const Step& step : closings_)
        largest = std::max(largest, std::abs(within_quarter(misfit(step, turns, angles))));
    for (Index e = 0; e < domain_.edge_count(); ++e)
        if (domain_.topology().edge_triangles.row(e).minCoeff() < 0)
            largest = std::max(largest, std::abs(within_quarter(angles[e])));
    return largest;
}

Eigen::VectorXd Holonomy::crossings(const Condition& generator) const {
    const Edges& beside = domain_.topology().edge_triangles;
    Eigen::VectorXd result = Eigen::VectorXd::Zero(domain_.edge_count());
    const auto cross = [&](Index edge, Index from) { result[edge] += beside(edge, 0) == from ? 1 : -1; };
    // Over the edge, up the tree from its right, and down to its left.
    Index left = beside(generator.edge, 0), right = beside(generator.edge, 1);
    cross(generator.edge, left);
    while (left != right) {
        Index& deeper = parents_[left].depth > parents_[right].depth ? left : right;
        const Parent& parent = parents_[deeper];
        cross(parent.edge, &deeper == &right ? right : parent.triangle);
        deeper = parent.triangle;
    }
    return result;
}

std::vector<double> form_turns(const SurfaceDomain& domain, const Eigen::VectorXd& form) {
    const EdgeTopology& topology = domain.topology();
    std::vector<double> turns(3 * static_cast<std::size_t>(domain.triangle_count()));
    for (Index t = 0; t < domain.triangle_count(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index edge = topology.triangle_edges(t, (k + 1) % 3);
            turns[3 * t + k] = (topology.edge_triangles(edge, 0) == t ? 1 : -1) * form[edge] / 2;
        }
    return turns;
}

std::vector<Eigen::VectorXd> harmonic_forms(const SurfaceDomain& domain, const Structure& structure,
                                            const Holonomy& holonomy) {
    std::vector<Eigen::VectorXd> forms;
    if (holonomy.conditions().empty()) return forms;
    std::vector<bool> held = structure.on_boundary, seen;
    for (const auto& component : structure.components) seen.push_back(!component.curves.empty());
    for (Index v = 0; v < domain.vertex_count(); ++v) {
        const Index c = structure.of_vertex[v];
        if (c < 0 || !seen[c]) held[v] = true;
        if (c >= 0) seen[c] = true;
    }
    const Edges& edges = domain.topology().edges;
    const Eigen::VectorXd weights = cotangent_weights(domain);
    VertexLaplacian laplacian(domain, held);
    for (const Holonomy::Condition& condition : holonomy.conditions()) {
        Eigen::VectorXd form = Eigen::VectorXd::Zero(domain.edge_count());
        Eigen::VectorXd right = Eigen::VectorXd::Zero(domain.vertex_count()), values = right;
        if (condition.boundary) {
            for (Index v = 0; v < domain.vertex_count(); ++v)
                if (structure.of_vertex[v] == condition.component && structure.curve_of_vertex[v] == condition.curve)
                    values[v] = 1;
        } else {
            form = holonomy.crossings(condition);
            for (Index e = 0; e < domain.edge_count(); ++e) {
                right[edges(e, 0)] += weights[e] * form[e];
                right[edges(e, 1)] -= weights[e] * form[e];
            }
        }
        values = laplacian.solve(right, values);
        for (Index e = 0; e < domain.edge_count(); ++e) form[e] += values[edges(e, 1)] - values[edges(e, 0)];
        forms.push_back(std::move(form));
    }
    return forms;
}

}  // namespace octafield::surface::detail
