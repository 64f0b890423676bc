#include "close_rounds.hpp"

#include <array>

#include "local_moves.hpp"

namespace octafield::surface {

using Vector = Eigen::Vector3d;

constexpr double kShorterBy = 0.95;  // at least, of an edge, are both its parts

Vector centre_on_curve(const Working& work, Vertex v) {
    Vector sum = Vector::Zero();
    double weight = 0;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, work.marked.mesh)) {
        if (!work.marked.feature[work.marked.mesh.edge(h)]) continue;
        const Vertex w = work.marked.mesh.source(h);
        sum += work.at(w) / work.wanted(v, w);
        weight += 1 / work.wanted(v, w);
    }
    return sum / weight;
}

CloseRounds::CloseRounds(const Background& ground) : ground_(ground), walk_(ground) {}

void CloseRounds::begin(Working& work) {
    const SurfaceMesh& mesh = work.marked.mesh;
    for (const Face f : mesh.faces()) work.marked.patch[f] = ground_.patch[static_cast<Index>(f)];
    for (const Vertex v : mesh.vertices()) work.carrier[v] = walk_.carrier_of(static_cast<Index>(v));
    const Edges& edges = ground_.features.edges;
    for (Index i = 0; i < edges.rows(); ++i)
        work.curve[mesh.edge(mesh.halfedge(Vertex(edges(i, 0)), Vertex(edges(i, 1))))] = walk_.curve(i);
    take_lengths(work);
}

void CloseRounds::take_lengths(Working& work) {
    for (const Vertex v : work.marked.mesh.vertices()) work.length[v] = walk_.length(work.carrier[v], work.at(v));
}

std::optional<Place> CloseRounds::place_on(const Working& work, Edge edge, const Vector& target) {
    const SurfaceMesh& mesh = work.marked.mesh;
    const std::array<Carrier, 2> ends{work.carrier[mesh.vertex(edge, 0)], work.carrier[mesh.vertex(edge, 1)]};
    if (work.marked.feature[edge]) return walk_.on_curve(ends, work.curve[edge], target);
    return walk_.on_surface(ends, work.marked.patch[mesh.face(mesh.halfedge(edge))], target);  // no rim: it has a face
}

std::optional<Place> CloseRounds::place_of(const Working& work, Vertex v, const Vector& target) {
    const std::array<Carrier, 1> at{work.carrier[v]};
    const Kind kind = kind_of(work, v);
    if (kind == free_vertex) return walk_.on_surface(at, patch_at(work.marked, v), target);
    if (kind == fixed_vertex || at[0].on != Carrier::On::segment) return std::nullopt;
    return walk_.on_curve(at, walk_.curve(at[0].id), target);
}

void CloseRounds::put(Working& work, Vertex v, const Place& place) {
    work.marked.mesh.point(v) = Point(place.point[0], place.point[1], place.point[2]);
    work.carrier[v] = place.carrier;
    work.length[v] = place.length;
}

std::optional<Place> CloseRounds::place_near(const Working& work, Face face, const Vector& target) {
    std::array<Carrier, 3> at;
    int k = 0;
    for (const Vertex v : CGAL::vertices_around_face(work.marked.mesh.halfedge(face), work.marked.mesh))
        at[k++] = work.carrier[v];
    return walk_.on_surface(at, work.marked.patch[face], target);
}

std::optional<Vertex> CloseRounds::split_at(Working& work, Edge edge, const Place& place) {
    const SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf side = mesh.halfedge(edge);
    // An edge from fold to fold whose middle comes to lie at one of its ends could be split for ever.
    for (const Vertex end : {mesh.source(side), mesh.target(side)})
        if ((work.at(end) - place.point).norm() > kShorterBy * work.edge_length(edge)) return std::nullopt;
    for (const HalfEdgeOf h : {side, mesh.opposite(side)}) {
        if (mesh.is_border(h)) continue;
        const Vector a = work.at(mesh.source(h)), b = work.at(mesh.target(h)), c = work.at(mesh.target(mesh.next(h)));
        const Shape old = shape_of(a, b, c);
        if (old.quality > 1e-3 && (turned(old.normal, shape_of(a, place.point, c).normal) ||
                                   turned(old.normal, shape_of(place.point, b, c).normal)))
            return std::nullopt;
    }
    const Vertex v = split(work, edge);
    put(work, v, place);
    return v;
}

std::optional<Vertex> CloseRounds::split_middle(Working& work, Edge edge) {
    const SurfaceMesh& mesh = work.marked.mesh;
    const auto place = place_on(work, edge, (work.at(mesh.vertex(edge, 0)) + work.at(mesh.vertex(edge, 1))) / 2);
    return place ? split_at(work, edge, *place) : std::nullopt;
}

void CloseRounds::run(Working& work, int rounds, const std::function<void(double)>& alive) {
    for (int round = 0; round < rounds; ++round) {
        const double fraction = static_cast<double>(round) / rounds;
        alive(fraction);
        split_long(work, kLong, [&](Edge e) { return split_middle(work, e); });
        alive(fraction);
        collapse_short(work, Collapse::to_end);
        alive(fraction);
        flip_better(work);
        relax(work, alive, fraction);
    }
}

void CloseRounds::relax(Working& work, const std::function<void(double)>& alive, double fraction) {
    const SurfaceMesh& mesh = work.marked.mesh;
    int calls = 0;
    for (const Vertex v : mesh.vertices()) {
        if (mesh.is_isolated(v)) continue;
        const Kind kind = kind_of(work, v);
        if (kind == fixed_vertex) continue;
        if (++calls % 1000 == 0) alive(fraction);
        const auto to = kind == on_curve ? std::optional(centre_on_curve(work, v)) : centre_of_star(work, v);
        if (!to) continue;
        const auto place = place_of(work, v, *to);
        if (place && may_move(work, v, place->point, v)) put(work, v, *place);
    }
}

}  // namespace octafield::surface
