#include "graded_remesh.hpp"

#include <CGAL/exceptions.h>

#include <algorithm>
#include <cmath>

#include "graded_rounds.hpp"
#include "planned_sizes.hpp"

namespace octafield::surface {
namespace {

constexpr int kAttempts = 8;
constexpr double kBent = 0.05;        // radians along an edge, above which it takes volume
constexpr double kShorter = 0.25;     // than the shortest of the plan, where that is not enough
constexpr double kAtCrossings = 0.6;  // lengths there, of those before
constexpr double kMostPinned = 0.02;  // of the input's vertices
constexpr double kMostCells = 2;      // of max_cells, to be sound and to follow

Places crossings(const Background& ground, const GradedRounds& rounds, const Working& work, const RemeshJudge& judge) {
    Places places;
    for (const Index t : judge.crossing) {
        const Face face(static_cast<std::uint32_t>(t));
        Eigen::Vector3d centre = Eigen::Vector3d::Zero();
        for (const Vertex v : CGAL::vertices_around_face(work.marked.mesh.halfedge(face), work.marked.mesh))
            centre += work.at(v) / 3;
        for (const Index v :
             ground.mesh.triangles.row(rounds.trees().nearest(work.marked.patch[face], centre).triangle))
            places.emplace_back(v, kAtCrossings);
    }
    return places;
}

// Where the input's vertices lie too far off.
Places departures(const RemeshJudge& judge) {
    Places places;
    for (Index v = 0; v < judge.excess.size(); ++v)
        if (judge.excess[v] > 1) places.emplace_back(v, std::clamp(std::sqrt(0.7 / judge.excess[v]), 0.4, 0.9));
    return places;
}

std::vector<Index> bent(const Background& ground) {
    std::vector<Index> vertices;
    for (Index t = 0; t < ground.mesh.triangles.rows(); ++t)
        for (const Index v : ground.mesh.triangles.row(t))
            if (ground.bend[t] * ground.length[v] > kBent) vertices.push_back(v);
    return vertices;
}

}  // namespace

GradedResult graded_remesh(const TriangleMesh& mesh, const FeatureGraph& features, RemeshJudge& judge, double max_cells,
                           int rounds, const std::function<void(double)>& alive) {
    GradedResult graded;
    alive(0);
    Background ground = planned_ground(mesh, features, {.max_cells = max_cells});
    graded.field = fitted(ground, mesh, max_cells);
    graded.uniform = graded.field.uniform();
    if (graded.uniform) return graded;
    ground.shortest *= kShorter;
    const GradedRounds remesher(ground);
    const double volume = judge.closed() ? signed_volume(mesh) : 0;
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        Places places;
        bool pinned = false;
        try {
            Working work(ground.mesh, ground.features);
            remesher.run(work, rounds, alive);
            if (auto found = judge.judge(work.marked, ground.length.minCoeff())) {
                const double excess = judge.excess_of(*found), volume_excess = found->volume_change / kVolumeTold;
                if (!graded.best || excess < judge.excess_of(*graded.best)) {
                    graded.best = std::move(found);
                    graded.range = range_of(ground);
                }
                if (excess <= 1) break;
                places = departures(judge);
                // Tips, and what else shorter edges alone do not reach.
                if (attempt > 0 && places.size() <= 1 + kMostPinned * judge.excess.size()) {
                    for (const auto& [v, factor] : places) ground.pinned.push_back(v);
                    pinned = !places.empty();
                }
                if (volume_excess > 1) {
                    for (const Index v : bent(ground))
                        places.emplace_back(v, std::clamp(std::sqrt(0.8 / volume_excess), 0.5, 0.9));
                }
            } else {
                places = crossings(ground, remesher, work, judge);
            }
        } catch (const CGAL::Failure_exception& failure) {
            judge.fault = failure.what();
            break;
        }
        if (!(lower(ground, places) || pinned) || expected_cells(ground, volume, 1).most() > kMostCells * max_cells)
            break;
    }
    return graded;
}

}  // namespace octafield::surface
