#include "remesh_judge.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include "octafield/surface/validate.hpp"
#include "shells.hpp"
#include "short_number.hpp"

namespace octafield::surface {

RemeshJudge::RemeshJudge(const TriangleMesh& mesh, const FeatureGraph& features)
    : mesh_(mesh),
      topology_(topology_of(mesh)),
      told_(deviation_told * shape_size(mesh)),
      input_(mark(mesh, features)) {}

RemeshJudge::Topology RemeshJudge::topology_of(const TriangleMesh& mesh) {
    const std::vector<Index> piece = connected_pieces(mesh, sorted_half_edges(mesh.triangles));
    const EdgeTopology edges = edge_topology(mesh);
    return {euler_characteristic(mesh), *std::ranges::max_element(piece) + 1, edges.edge_triangles.minCoeff() >= 0};
}

std::optional<RemeshResult> RemeshJudge::sound(Marked& marked) {
    fault.clear();
    crossing.clear();
    RemeshResult result = to_arrays(marked);
    const auto defects = find_defects(result.mesh, {.closed = topology_.closed});
    if (!defects.empty()) {
        fault = defects.front().message.substr(0, defects.front().message.find("; "));
        for (const Defect& defect : defects)
            if (defect.kind == "self_intersection") crossing = defect.elements;
    } else if (topology_of(result.mesh) != topology_) {
        fault = "holes or pieces of the surface were lost";
    }
    return fault.empty() ? std::optional(std::move(result)) : std::nullopt;
}

std::optional<Attempt> RemeshJudge::judge(Marked& marked, double length) {
    auto result = sound(marked);
    if (!result) return std::nullopt;
    Attempt attempt{std::move(*result), length};
    measure(marked, attempt);
    return attempt;
}

void RemeshJudge::measure(const Marked& marked, Attempt& attempt) {
    const PatchTrees trees(marked);
    excess = Eigen::VectorXd::Zero(mesh_.vertices.rows());
    for (const Vertex v : input_.mesh.vertices()) {
        if (input_.mesh.is_isolated(v)) continue;
        const int patch = patch_at(input_, v);
        if (trees.empty(patch)) continue;
        const Point& p = input_.mesh.point(v);
        const double distance = std::sqrt(CGAL::squared_distance(p, trees.closest(patch, p)));
        excess[static_cast<Index>(v)] = distance / told_;
        if (!(distance > attempt.result.deviation)) continue;
        attempt.result.deviation = distance;
        attempt.place = Eigen::Vector3d(p.x(), p.y(), p.z());
    }
    const double volume = signed_volume(mesh_);
    if (topology_.closed && volume != 0)
        attempt.volume_change = std::abs(signed_volume(attempt.result.mesh) / volume - 1);
}

double RemeshJudge::excess_of(const Attempt& attempt) const {
    return std::max(attempt.result.deviation / told_, attempt.volume_change / kVolumeTold);
}

std::string RemeshJudge::departure(const Attempt& attempt) const {
    std::ostringstream text;
    text.precision(4);
    const Eigen::Vector3d& at = attempt.place;
    text << "it leaves it by up to " << short_number(attempt.result.deviation) << " at (" << at[0] << ", " << at[1]
         << ", " << at[2] << ")";
    if (topology_.closed) text << ", and its volume differs by " << short_number(100 * attempt.volume_change) << " %";
    return text.str();
}

}  // namespace octafield::surface
