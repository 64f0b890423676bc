#include "core_moves.hpp"

#include <cmath>

namespace octafield::surface::detail {
namespace {

// A core is where f turns by more than acos of this across a corner: a winding of one spread over the six corners of a
// vertex makes 60 degrees each, over the three of a triangle 120.
constexpr double core_cosine = 0.75;
constexpr std::size_t patch_edges = 150;
constexpr int settling_sweeps = 40, holding_sweeps = 10;
constexpr double least_gain = 1e-4;  // the energy has no unit; a core costs some units

}  // namespace

CoreMoves::CoreMoves(const Problem& problem)
    : problem_(problem),
      links_of_(problem.masses.size(), {-1, -1, -1, -1}),
      is_free_(problem.masses.size(), false),
      seen_edge_(problem.masses.size(), 0),
      seen_link_(problem.links.size(), 0) {
    for (const Index e : problem.system.edges()) is_free_[e] = true;
    for (std::size_t l = 0; l < problem.links.size(); ++l)
        for (const Index e : {problem.links[l].first, problem.links[l].second})
            for (Index& place : links_of_[e])
                if (place < 0) {
                    place = static_cast<Index>(l);
                    break;
                }
}

Index CoreMoves::other(Index link, Index edge) const {
    return problem_.links[link].first == edge ? problem_.links[link].second : problem_.links[link].first;
}

// Free edges beside a corner across which f turns fast, ascending.
std::vector<Index> CoreMoves::cores(const Eigen::VectorXcd& values) const {
    std::vector<bool> fast(values.size(), false);
    for (const CornerLink& link : problem_.links) {
        const Complex first = link.first_sign * values[link.first], second = link.second_turn * values[link.second];
        if ((std::conj(first) * second).real() < core_cosine) fast[link.first] = fast[link.second] = true;
    }
    std::vector<Index> result;
    for (const Index e : problem_.system.edges())
        if (fast[e]) result.push_back(e);
    return result;
}

void CoreMoves::grow(Index center) {
    ++patches_;
    patch_.edges = {center};
    patch_.links.clear();
    seen_edge_[center] = patches_;
    for (std::size_t i = 0; i < patch_.edges.size(); ++i)
        for (const Index link : links_of_[patch_.edges[i]]) {
            if (link < 0 || seen_link_[link] == patches_) continue;
            seen_link_[link] = patches_;
            patch_.links.push_back(link);
            const Index next = other(link, patch_.edges[i]);
            if (!is_free_[next] || seen_edge_[next] == patches_ || patch_.edges.size() >= patch_edges) continue;
            seen_edge_[next] = patches_;
            patch_.edges.push_back(next);
        }
}

// Of what the patch can change.
double CoreMoves::energy(const Eigen::VectorXcd& values) const {
    double sum = 0;
    for (const Index l : patch_.links) {
        const CornerLink& link = problem_.links[l];
        sum += link.weight / 2 * std::norm(link.first_sign * values[link.first] - link.second_turn * values[link.second]);
    }
    for (const Index e : patch_.edges) sum -= (std::conj(problem_.pull.targets[e]) * values[e]).real();
    return sum;
}

// Each edge in turn takes the direction that is best beside its neighbours: never raises the energy.
void CoreMoves::settle(Eigen::VectorXcd& values) const {
    for (int sweep = 0; sweep < settling_sweeps; ++sweep)
        for (const Index e : patch_.edges) {
            if (sweep < holding_sweeps && e == patch_.edges.front()) continue;
            Complex best = problem_.pull.targets[e];
            for (const Index l : links_of_[e]) {
                if (l < 0) continue;
                const CornerLink& link = problem_.links[l];
                best += link.first == e
                            ? link.weight * std::conj(link.first_sign) * link.second_turn * values[link.second]
                            : link.weight * std::conj(link.second_turn) * link.first_sign * values[link.first];
            }
            const double length = std::abs(best);
            if (length > 0) values[e] = best / length;
        }
}

bool CoreMoves::try_move(Index edge, Eigen::VectorXcd& values) {
    grow(edge);
    const double before = energy(values);
    const Eigen::VectorXcd kept = values(patch_.edges);
    values[edge] = -values[edge];
    settle(values);
    if (energy(values) < before - least_gain) return true;
    values(patch_.edges) = kept;
    return false;
}

int CoreMoves::improve(Eigen::VectorXcd& values) {
    int moves = 0;
    for (const Index edge : cores(values)) moves += try_move(edge, values);
    return moves;
}

}  // namespace octafield::surface::detail
