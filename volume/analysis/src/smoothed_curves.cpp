#include "octafield/volume/smoothed_curves.hpp"

#include <string>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

constexpr double shrink = 0.5, grow = -0.53;  // Taubin's lambda and mu: waves longer than 20 or so segments stay

void require_curves(const SingularGraph& graph, int steps) {
    if (steps < 0) throw InvalidInput("steps is " + std::to_string(steps) + "; give 0 or more", "option_out_of_range");
    for (const auto& curve : graph.curves) {
        if (curve.size() < 2) throw InvalidInput("a singular curve has fewer than two points", "wrong_size");
        for (const Index p : curve)
            if (p < 0 || p >= graph.points.rows())
                throw InvalidInput(
                    "the singular graph uses point " + std::to_string(p) + " of " + std::to_string(graph.points.rows()),
                    "index_out_of_range", {p});
    }
}

// Moves every point towards the middle of its neighbours (weight > 0) or away from it.
void average(std::vector<Eigen::Vector3d>& line, bool closed, double weight) {
    const std::size_t n = line.size();
    const std::vector<Eigen::Vector3d> old = line;
    for (std::size_t i = 1; i + 1 < n; ++i) line[i] += weight * ((old[i - 1] + old[i + 1]) / 2 - old[i]);
    if (closed) line.front() = line.back() = old[0] + weight * ((old[n - 2] + old[1]) / 2 - old[0]);
}

}  // namespace

SmoothedCurves smoothed_curves(const SingularGraph& graph, int steps) {
    require_curves(graph, steps);
    std::vector<int> ends(graph.points.rows(), 0);  // ends of curves at each point
    for (const auto& curve : graph.curves) ++ends[curve.front()], ++ends[curve.back()];
    SmoothedCurves result{graph.points, Eigen::VectorXd(static_cast<Eigen::Index>(graph.curves.size())), 0};
    for (std::size_t c = 0; c < graph.curves.size(); ++c) {
        const std::vector<Index>& curve = graph.curves[c];
        const bool closed = curve.front() == curve.back() && ends[curve.front()] == 2;
        std::vector<Eigen::Vector3d> line;
        for (const Index p : curve) line.emplace_back(graph.points.row(p).transpose());
        for (int step = 0; step < steps; ++step) {
            average(line, closed, shrink);
            average(line, closed, grow);
        }
        double length = 0;
        for (std::size_t i = 0; i < line.size(); ++i) {
            result.points.row(curve[i]) = line[i].transpose();
            if (i > 0) length += (line[i] - line[i - 1]).norm();
        }
        result.lengths[static_cast<Eigen::Index>(c)] = length;
        result.length += length;
    }
    return result;
}

}  // namespace octafield::volume
