#include "graded_rounds.hpp"

#include "local_moves.hpp"

namespace octafield::surface {

using Vector = Eigen::Vector3d;

GradedRounds::GradedRounds(const Background& ground) : ground_(ground), trees_(ground) {
    const Edges& edges = ground.features.edges;
    const auto point = [&](Index v) {
        const auto row = ground.mesh.vertices.row(v);
        return Flat::Point_3(row[0], row[1], row[2]);
    };
    for (const auto edge : edges.rowwise()) segments_.emplace_back(point(edge[0]), point(edge[1]));
    curves_ = std::make_unique<Tree>(segments_.cbegin(), segments_.cend());
}

void GradedRounds::run(Working& work, int rounds, const std::function<void(double)>& alive) const {
    for (const Face f : work.marked.mesh.faces()) work.marked.patch[f] = ground_.patch[static_cast<Index>(f)];
    for (const Vertex v : work.marked.mesh.vertices()) work.length[v] = ground_.length[static_cast<Index>(v)];
    for (const Index v : ground_.pinned) work.pinned[Vertex(static_cast<std::uint32_t>(v))] = true;
    for (int round = 0; round < rounds; ++round) {
        const double fraction = static_cast<double>(round) / rounds;
        alive(fraction);
        split_long(work, kLong, [&](Edge e) {
            const Vertex v = split(work, e);
            if (kind_of(work, v) == on_curve) place_on_curve(work, v);
            return std::optional(v);
        });
        alive(fraction);
        collapse_short(work, Collapse::to_middle);
        alive(fraction);
        flip_better(work);
        relax(work, alive, fraction);
    }
}

void GradedRounds::place_on_curve(Working& work, Vertex v) const {
    const Vector p = work.at(v);
    const Flat::Point_3 at = curves_->closest_point({p[0], p[1], p[2]});
    const Vector to(at.x(), at.y(), at.z());
    if (may_move(work, v, to, v)) work.marked.mesh.point(v) = Point(at.x(), at.y(), at.z());
}

void GradedRounds::relax(Working& work, const std::function<void(double)>& alive, double fraction) const {
    SurfaceMesh& mesh = work.marked.mesh;
    int calls = 0;
    for (const Vertex v : mesh.vertices()) {
        if (mesh.is_isolated(v) || kind_of(work, v) != free_vertex) continue;
        if (++calls % 1000 == 0) alive(fraction);
        const auto to = centre_of_star(work, v);
        if (!to) continue;
        const auto found = trees_.nearest(patch_at(work.marked, v), *to);
        if (!may_move(work, v, found.point, v)) continue;
        mesh.point(v) = Point(found.point[0], found.point[1], found.point[2]);
        work.length[v] = trees_.length(found);
    }
}

}  // namespace octafield::surface
