#include "lines_energy.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace octafield::surface::detail {
namespace {

using std::numbers::pi;
// Added to the second derivative, over the number of unknowns: far below its other eigenvalues.
constexpr double smallest_shift = 1e-6;
// Of a negative weight, what the convex second derivative has instead.
constexpr double part_of_negative = 0.1;

std::array<Complex, 2> moved(const VertexLink& link, const std::array<Complex, 2>& c) {
    return {link.turn * c[0], link.turn * link.turn * c[1]};
}

}  // namespace

LinesEnergy::LinesEnergy(const std::vector<VertexLink>& links, const BoundaryLines& boundary,
                         const VertexCharts& charts, double lambda, double least_angle, double freedom)
    : links_(links),
      boundary_(boundary),
      root_lambda_(std::sqrt(lambda)),
      unknown_(boundary.lines.size(), {-1, -1}),
      between_(boundary.lines.size()) {
    for (std::size_t v = 0; v < unknown_.size(); ++v) {
        const auto vertex = static_cast<Index>(v);
        if (!charts.used(vertex)) continue;
        if (!charts.on_boundary(vertex)) {
            unknown_[v] = {size_, size_ + 1};
            size_ += 2;
        } else if (freedom > 0 && !boundary.is_held[v]) {
            unknown_[v][1] = size_++;
            const double given = boundary.lines[v].second - boundary.lines[v].first;
            const double least = std::min({least_angle, given / 2, (pi - given) / 2});
            const double low = given + freedom * (least - given), high = given + freedom * (pi - least - given);
            between_[v] = {(low + high) / 2, (high - low) / 2};
        }
    }
    shift_ = size_ > 0 ? smallest_shift / size_ : 0;
    const double unit = std::numeric_limits<double>::epsilon();
    for (const VertexLink& link : links_) {
        positive_weights_.push_back(std::max(link.weight, -part_of_negative * link.weight));
        rounding_ += unit * unit * std::abs(link.weight) * (64 * lambda + 4);
    }
}

LinesEnergy::State LinesEnergy::state_of(const std::vector<TwoLines>& lines) const {
    State state(size_);
    for (std::size_t v = 0; v < unknown_.size(); ++v) {
        const auto [first, second] = unknown_[v];
        if (first >= 0) {
            state[first] = lines[v].first;
            state[second] = lines[v].second;
        } else if (second >= 0) {
            const double between = lines[v].second - lines[v].first, angle = between - pi * std::floor(between / pi);
            const double part = (angle - between_[v].middle) / between_[v].half;
            state[second] = std::tan(pi / 2 * std::clamp(part, -0.98, 0.98));
        }
    }
    return state;
}

std::vector<TwoLines> LinesEnergy::lines_of_state(const State& state) const {
    std::vector<TwoLines> lines = boundary_.lines;
    for (std::size_t v = 0; v < unknown_.size(); ++v) {
        const auto [first, second] = unknown_[v];
        if (first >= 0) {
            lines[v] = {state[first], state[second]};
        } else if (second >= 0) {
            lines[v].second =
                lines[v].first + between_[v].middle + 2 / pi * between_[v].half * std::atan(state[second]);
        }
    }
    return lines;
}

std::vector<LinesEnergy::VertexLines> LinesEnergy::vertex_lines(const State& state) const {
    const std::vector<TwoLines> lines = lines_of_state(state);
    std::vector<VertexLines> vertices(lines.size());
    for (std::size_t v = 0; v < lines.size(); ++v)
        for (int k = 0; k < 2; ++k) {
            Line& line = vertices[v][k];
            line.unknown = unknown_[v][k];
            const Complex u = std::polar(1.0, 2 * (k == 0 ? lines[v].first : lines[v].second)), i(0, 1);
            line.value = {4 * root_lambda_ * u, u * u};
            double rate = 1, bend = 0;  // of the angle by the unknown
            if (line.unknown >= 0 && unknown_[v][0] < 0) {
                const double x = state[line.unknown];
                rate = 2 / pi * between_[v].half / (1 + x * x);
                bend = -2 * x * rate / (1 + x * x);
            }
            for (int c = 0; c < 2; ++c) {
                const Complex by_angle = 2.0 * (c + 1) * i * line.value[c];
                line.change[c] = rate * by_angle;
                line.second_change[c] = rate * rate * 2.0 * (c + 1) * i * by_angle + bend * by_angle;
            }
        }
    return vertices;
}

// Half the derivative of E_s by c2 sqrt(lambda) and c4 of each vertex.
std::vector<std::array<Complex, 2>> LinesEnergy::forces(const std::vector<VertexLines>& vertices,
                                                        double& energy) const {
    std::vector<std::array<Complex, 2>> force(vertices.size(), {0, 0});
    energy = 0;
    for (const VertexLink& link : links_) {
        const VertexLines &from = vertices[link.i], &to = vertices[link.j];
        const auto there = moved(link, {from[0].value[0] + from[1].value[0], from[0].value[1] + from[1].value[1]});
        const std::array<Complex, 2> step{to[0].value[0] + to[1].value[0] - there[0],
                                          to[0].value[1] + to[1].value[1] - there[1]};
        energy += link.weight * dot(step, step);
        const Complex back = std::conj(link.turn);
        for (int c = 0; c < 2; ++c) force[link.j][c] += link.weight * step[c];
        force[link.i][0] -= link.weight * back * step[0];
        force[link.i][1] -= link.weight * back * back * step[1];
    }
    return force;
}

LinesEnergy::Slope LinesEnergy::slope(const State& state) const {
    const std::vector<VertexLines> vertices = vertex_lines(state);
    Slope slope{0, Eigen::VectorXd(size_)};
    const auto force = forces(vertices, slope.energy);
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (const Line& line : vertices[v])
            if (line.unknown >= 0) slope.gradient[line.unknown] = 2 * dot(force[v], line.change);
    return slope;
}

const LinesEnergy::Matrix& LinesEnergy::hessian(const State& state, Curvature curvature) {
    const bool convex = curvature == Curvature::convex;
    const std::vector<VertexLines> vertices = vertex_lines(state);
    double energy = 0;
    const auto force = forces(vertices, energy);
    std::vector<Eigen::Triplet<double>> entries;
    const auto add = [&](const Line& a, const Line& b, double value) {
        if (a.unknown >= 0 && b.unknown >= 0)
            entries.emplace_back(std::max(a.unknown, b.unknown), std::min(a.unknown, b.unknown), value);
    };
    const auto add_own = [&](const VertexLines& vertex, double weight) {
        for (const Line& line : vertex) add(line, line, 2 * weight * dot(line.change, line.change));
        add(vertex[0], vertex[1], 2 * weight * dot(vertex[0].change, vertex[1].change));
    };
    for (std::size_t l = 0; l < links_.size(); ++l) {
        const VertexLink& link = links_[l];
        const double weight = convex ? positive_weights_[l] : link.weight;
        const VertexLines &from = vertices[link.i], &to = vertices[link.j];
        add_own(from, weight);
        add_own(to, weight);
        for (const Line& a : from)
            for (const Line& b : to) add(a, b, -2 * weight * dot(moved(link, a.change), b.change));
    }
    for (std::size_t v = 0; v < vertices.size(); ++v)
        for (const Line& line : vertices[v]) {
            const double bend = 2 * dot(force[v], line.second_change);
            add(line, line, shift_ + (convex ? std::max(bend, 0.0) : bend));
        }
    matrix_.resize(size_, size_);
    matrix_.setFromTriplets(entries.begin(), entries.end());
    return matrix_;
}

}  // namespace octafield::surface::detail
