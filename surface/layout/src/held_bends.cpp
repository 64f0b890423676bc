#include "held_bends.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace octafield::surface::detail {
namespace {

constexpr double most_straight = 0.7071;  // cosine of 45 degrees
constexpr double least_left = 0.25;       // of an edge, beside a vertex that moves along it

}  // namespace

std::vector<double> bends(const Seam& seam) {
    std::vector<double> result;
    const auto count = seam.knots.size();
    for (std::size_t i = seam.closed ? 0 : 1; i + 1 < count; ++i) {
        const Eigen::Vector3d& here = seam.knots[i].position;
        const Eigen::Vector3d before = here - seam.knots[i > 0 ? i - 1 : count - 2].position;
        const Eigen::Vector3d after = seam.knots[i + 1].position - here;
        if (before.dot(after) < most_straight * before.norm() * after.norm()) result.push_back(seam.knots[i].at);
    }
    return result;
}

namespace {

// A vertex on the seam; -1: a node, which stays.
struct OnIt {
    double at;
    Index vertex;
};

std::vector<OnIt> in_order(const Seam& seam, Index number, const std::vector<SideGrids::OnSeam>& on_seams) {
    std::vector<OnIt> result;
    for (std::size_t v = 0; v < on_seams.size(); ++v) {
        if (on_seams[v].seam != number) continue;
        const double at = on_seams[v].at;
        result.push_back({seam.closed ? at - seam.length * std::floor(at / seam.length) : at, static_cast<Index>(v)});
    }
    std::stable_sort(result.begin(), result.end(), [](const OnIt& a, const OnIt& b) { return a.at < b.at; });
    if (!seam.closed) {
        result.insert(result.begin(), {0, -1});
        result.push_back({seam.length, -1});
    } else if (!result.empty()) {  // the last before the first, and the first behind the last
        const OnIt first = result.front(), last = result.back();
        result.insert(result.begin(), {last.at - seam.length, last.vertex});
        result.push_back({first.at + seam.length, first.vertex});
    }
    return result;
}

}  // namespace

void hold_bends(const Seams& seams, QuadMesh& mesh, std::vector<SideGrids::OnSeam>& on_seams) {
    for (std::size_t s = 0; s < seams.seams.size(); ++s) {
        const Seam& seam = seams.seams[s];
        for (const double bend : bends(seam)) {
            const std::vector<OnIt> vertices = in_order(seam, static_cast<Index>(s), on_seams);
            const auto after =
                std::find_if(vertices.begin(), vertices.end(), [&](const OnIt& v) { return v.at >= bend; });
            if (after == vertices.begin() || after == vertices.end()) continue;
            const auto before = after - 1;
            const double length = after->at - before->at;
            std::array<std::pair<double, Index>, 2> beside = {
                {{bend - before->at, before->vertex}, {after->at - bend, after->vertex}}};
            std::sort(beside.begin(), beside.end());
            for (const auto& [way, v] : beside) {
                if (v < 0 || on_seams[v].held || way > (1 - least_left) * length) continue;
                on_seams[v].at = bend;
                on_seams[v].held = true;
                mesh.vertices.row(v) = position_on(seam, bend);
                break;
            }
        }
    }
}

}  // namespace octafield::surface::detail
