#include "grid_map.hpp"

#include <Eigen/LU>
#include <cmath>
#include <numbers>

#include "charts.hpp"
#include "layout_pieces.hpp"

namespace octafield::surface::detail {
namespace {

constexpr int smoothing_rounds = 60;
constexpr double own_share = 3;       // of a triangle's size against those of its neighbours
constexpr double least_known = 1e-8;  // areas below say nothing of the size

// Sides inside with ends that may not move freely could be mapped to nothing.
void split_held_sides(ChartedMesh& mesh, const GridValues& values) {
    std::vector<Index> sides;
    for (Index s = 0; s < mesh.side_count(); ++s)
        if (mesh.mates[s] > s && values.freedom[mesh.from(s)] < 2 &&
            values.freedom[mesh.from(ChartedMesh::next(s))] < 2)
            sides.push_back(s);
    for (const Index s : sides) mesh.split(s);
}

// The triangle's two edges from corner 0 where quads are unit squares along the field.
Eigen::Matrix2d edges_in_quads(const QuadLayout& layout, const ChartedMesh& mesh, std::size_t t, double size) {
    const auto& corners = mesh.triangles[t];
    const Index origin = mesh.origins[t];
    const auto in_plane = [&](const Eigen::Vector3d& v) { return vector_by_own_lengths(layout.domain, origin, v); };
    const Complex step = in_plane(layout.pieces->steps.row(origin)) * size *
                         std::polar(1.0, mesh.quarters[origin] * std::numbers::pi / 2);
    Eigen::Matrix2d result;
    for (int k = 0; k < 2; ++k) {
        const Complex edge = in_plane(mesh.positions[corners[k + 1]] - mesh.positions[corners[0]]) / step;
        result.col(k) << edge.real(), edge.imag();
    }
    return result;
}

// The field's sizes can be off by orders of magnitude where whole numbers ask for a quad: those of the start are taken,
// smoothed.
void scale_targets(const GridMap& map, MapProblem& problem) {
    const std::size_t count = map.mesh.triangles.size();
    Eigen::VectorXd logs = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(count));
    std::vector<bool> known(count, false);
    for (std::size_t t = 0; t < count; ++t) {
        Eigen::Matrix2d edges;
        for (int k = 0; k < 2; ++k)
            edges.col(k) = map.place(static_cast<Index>(3 * t + k + 1)) - map.place(static_cast<Index>(3 * t));
        const double area = (edges * problem.to_unit[t]).determinant();
        known[t] = area > least_known;
        if (known[t]) logs[static_cast<Eigen::Index>(t)] = std::log(area) / 2;
    }
    for (int round = 0; round < smoothing_rounds; ++round) {
        Eigen::VectorXd next = logs;
        std::vector<bool> now = known;
        for (std::size_t t = 0; t < count; ++t) {
            double weight = known[t] ? own_share : 0, sum = weight * logs[static_cast<Eigen::Index>(t)];
            for (int k = 0; k < 3; ++k) {
                const Index mate = map.mesh.mates[3 * t + k];
                if (mate < 0 || !known[mate / 3]) continue;
                sum += logs[mate / 3];
                weight += 1;
            }
            now[t] = weight > 0;
            if (weight > 0) next[static_cast<Eigen::Index>(t)] = sum / weight;
        }
        logs = std::move(next);
        known = std::move(now);
    }
    for (std::size_t t = 0; t < count; ++t) {
        const double scale = std::exp(logs[static_cast<Eigen::Index>(t)]);
        problem.to_unit[t] /= scale;
        problem.areas[t] *= scale * scale;
    }
}

}  // namespace

GridMap grid_map(const QuadLayout& layout, const Seams& seams, const GridCounts& counts, double size,
                 const Progress& progress) {
    GridMap result{charted_mesh(layout, seams, counts), {}, {}};
    split_held_sides(result.mesh, grid_values(result.mesh));
    result.values = grid_values(result.mesh);
    result.found.values = values_at(result.values, result.mesh.start);
    MapProblem problem{result.values, {}, {}};
    for (std::size_t t = 0; t < result.mesh.triangles.size(); ++t) {
        const Eigen::Matrix2d edges = edges_in_quads(layout, result.mesh, t, size);
        problem.to_unit.push_back(edges.inverse());
        problem.areas.push_back(edges.determinant() / 2);
    }
    scale_targets(result, problem);
    result.found = unfolded_map(problem, std::move(result.found.values), progress);
    return result;
}

}  // namespace octafield::surface::detail
