#include "line_moves.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
constexpr std::size_t patch_vertices = 80;
constexpr int settling_sweeps = 40, holding_sweeps = 10;
constexpr double least_gain = 1e-3;   // the energy has no unit; a singular point costs some tens
constexpr double longest_step = 0.3;  // radians

}  // namespace

LineMoves::LineMoves(const std::vector<VertexLink>& links, std::vector<bool> is_free, double lambda)
    : links_(links),
      is_free_(std::move(is_free)),
      root_lambda_(std::sqrt(lambda)),
      links_of_(is_free_.size()),
      seen_vertex_(is_free_.size(), 0),
      seen_link_(links.size(), 0) {
    for (std::size_t l = 0; l < links.size(); ++l)
        for (const Index v : {links[l].i, links[l].j}) links_of_[v].push_back(static_cast<Index>(l));
}

void LineMoves::grow(Index center) {
    ++patches_;
    patch_ = {center};
    patch_links_.clear();
    seen_vertex_[center] = patches_;
    for (std::size_t i = 0; i < patch_.size(); ++i)
        for (const Index l : links_of_[patch_[i]]) {
            if (seen_link_[l] == patches_) continue;
            seen_link_[l] = patches_;
            patch_links_.push_back(l);
            const Index next = links_[l].i == patch_[i] ? links_[l].j : links_[l].i;
            if (!is_free_[next] || seen_vertex_[next] == patches_ || patch_.size() >= patch_vertices) continue;
            seen_vertex_[next] = patches_;
            patch_.push_back(next);
        }
}

LineMoves::Coefficients LineMoves::coefficients(const TwoLines& lines) const {
    const PowerSums sums = power_sums(lines);
    return {4 * root_lambda_ * sums.p1, sums.p2};
}

double LineMoves::energy(const std::vector<TwoLines>& lines) const {
    double sum = 0;
    for (const Index l : patch_links_) {
        const VertexLink& link = links_[l];
        const Coefficients from = coefficients(lines[link.i]), to = coefficients(lines[link.j]);
        sum +=
            link.weight * (std::norm(to[0] - link.turn * from[0]) + std::norm(to[1] - link.turn * link.turn * from[1]));
    }
    return sum;
}

// One step of Newton's method on the vertex's part of the energy, weight |c|^2 - 2 <pull, c>: downhill where it is not
// convex, no longer than longest_step.
void LineMoves::settle_vertex(Index vertex, std::vector<TwoLines>& lines) const {
    double weight = 0;
    Coefficients pull{0, 0};
    for (const Index l : links_of_[vertex]) {
        const VertexLink& link = links_[l];
        const bool low = link.i == vertex;
        const Coefficients there = coefficients(lines[low ? link.j : link.i]);
        const Complex turn = low ? std::conj(link.turn) : link.turn;
        weight += link.weight;
        pull[0] += link.weight * turn * there[0];
        pull[1] += link.weight * turn * turn * there[1];
    }
    const auto part = [&](const TwoLines& two) {
        const Coefficients c = coefficients(two);
        return weight * dot(c, c) - 2 * dot(pull, c);
    };
    TwoLines& here = lines[vertex];
    const Coefficients c = coefficients(here);
    const Coefficients force{weight * c[0] - pull[0], weight * c[1] - pull[1]};
    std::array<Coefficients, 2> change, bend;
    for (int k = 0; k < 2; ++k) {
        const Complex u = std::polar(1.0, 2 * (k == 0 ? here.first : here.second)), i(0, 1);
        change[k] = {8.0 * i * root_lambda_ * u, 4.0 * i * u * u};
        bend[k] = {-16.0 * root_lambda_ * u, -16.0 * u * u};
    }
    const Eigen::Vector2d gradient(dot(force, change[0]), dot(force, change[1]));
    Eigen::Matrix2d curvature;
    for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
            curvature(a, b) = weight * dot(change[a], change[b]) + (a == b ? dot(force, bend[a]) : 0);
    const double trace = curvature.trace();
    Eigen::Vector2d step = curvature.determinant() > 1e-6 * trace * trace && trace > 0
                               ? Eigen::Vector2d(-curvature.inverse() * gradient)
                               : Eigen::Vector2d(-gradient / (std::abs(trace) + curvature.norm() + 1e-300));
    if (step.norm() > longest_step) step *= longest_step / step.norm();
    const double before = part(here);
    for (int halvings = 0; halvings < 6; ++halvings, step /= 2) {
        const TwoLines next{here.first + step[0], here.second + step[1]};
        if (!(part(next) < before)) continue;
        here = next;
        return;
    }
}

// Never raises the energy, but for the vertex that is held at first.
void LineMoves::settle(std::vector<TwoLines>& lines) {
    for (int sweep = 0; sweep < settling_sweeps; ++sweep)
        for (const Index v : patch_)
            if (sweep >= holding_sweeps || v != patch_.front()) settle_vertex(v, lines);
}

bool LineMoves::try_move(Index vertex, std::vector<TwoLines>& lines) {
    grow(vertex);
    const double before = energy(lines);
    std::vector<TwoLines> kept;
    for (const Index v : patch_) kept.push_back(lines[v]);
    const TwoLines two = ordered(lines[vertex]);
    lines[vertex] = {(two.first + two.second) / 2, (two.first + two.second + pi) / 2};
    settle(lines);
    if (energy(lines) < before - least_gain) return true;
    for (std::size_t i = 0; i < patch_.size(); ++i) lines[patch_[i]] = kept[i];
    return false;
}

int LineMoves::improve(const std::vector<Index>& vertices, std::vector<TwoLines>& lines) {
    int moves = 0;
    for (const Index vertex : vertices)
        if (is_free_[vertex]) moves += try_move(vertex, lines);
    return moves;
}

}  // namespace octafield::surface::detail
