#include "local_moves.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

#include <array>
#include <cmath>
#include <queue>

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kTurned = 0.5;       // cosine of the largest turn of a triangle in one step
constexpr double kThin = 0.15;        // quality below which a step may not lower it
constexpr double kFlatCosine = 0.94;  // 20 degrees: edges that turn less may be flipped freely

// Edges from v to its neighbours but `with`, once v has moved.
bool stays_short(const Working& work, Vertex v, const Vector& to, double length, Vertex with) {
    for (const Vertex w : CGAL::vertices_around_target(v, work.marked.mesh))
        if (w != with && (work.at(w) - to).norm() > kLong * (length + work.length[w]) / 2) return false;
    return true;
}

int valence_excess(const Working& work, Vertex v) {
    return static_cast<int>(work.marked.mesh.degree(v)) - (work.marked.mesh.is_border(v) ? 4 : 6);
}

bool worth_flipping(const Working& work, Edge edge) {
    if (!may_flip(work, edge)) return false;
    const SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf h = mesh.halfedge(edge);
    const Vertex a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)),
                 d = mesh.target(mesh.next(mesh.opposite(h)));
    const Flip flip = flip_of(work, edge);
    const double before = flip.before(), after = flip.after();
    const auto square = [&](Vertex v, int change) {
        const int excess = valence_excess(work, v) + change;
        return excess * excess;
    };
    const int change = square(a, -1) + square(b, -1) + square(c, 1) + square(d, 1) - square(a, 0) - square(b, 0) -
                       square(c, 0) - square(d, 0);
    const bool mends = before < kThin && after > 1.5 * before;
    if (!mends && (change >= 0 || after < std::min(before, 2 * kThin))) return false;
    if (before > 1e-3 && flip.turns()) return false;
    const double turn_before = flip.left.normal.normalized().dot(flip.right.normal.normalized());
    return flip.first.normal.normalized().dot(flip.second.normal.normalized()) >= std::min(kFlatCosine, turn_before);
}

bool collapse_one_way(Working& work, Edge edge, Vertex gone, Vertex kept, Collapse where) {
    if (!may_join(work, edge, gone, kept)) return false;
    const bool middle = where == Collapse::to_middle && kind_of(work, kept) == free_vertex;
    const Vector to = middle ? Vector((work.at(gone) + work.at(kept)) / 2) : work.at(kept);
    const double length = middle ? work.wanted(gone, kept) : work.length[kept];
    if (!stays_short(work, gone, to, length, kept) || !may_move(work, gone, to, kept)) return false;
    if (middle && (!stays_short(work, kept, to, length, gone) || !may_move(work, kept, to, gone))) return false;
    return join(work, gone, kept, to, length);
}

bool try_collapse(Working& work, Edge edge, Collapse where) {
    const HalfEdgeOf h = work.marked.mesh.halfedge(edge);
    Vertex gone = work.marked.mesh.source(h), kept = work.marked.mesh.target(h);
    const Kind lower = kind_of(work, gone), upper = kind_of(work, kept);
    if (lower > upper) std::swap(gone, kept);
    if (collapse_one_way(work, edge, gone, kept, where)) return true;
    return where == Collapse::to_end && lower == upper && collapse_one_way(work, edge, kept, gone, where);
}

}  // namespace

Kind kind_of(const Working& work, Vertex v) {
    if (work.marked.corner[v] || work.pinned[v]) return fixed_vertex;
    int features = 0;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, work.marked.mesh))
        features += work.marked.feature[work.marked.mesh.edge(h)];
    return features == 0 ? free_vertex : features == 2 ? on_curve : fixed_vertex;
}

Shape shape_of(const Vector& a, const Vector& b, const Vector& c) {
    const Vector normal = (b - a).cross(c - a);
    const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return {normal, sides > 0 ? 2 * std::sqrt(3.) * normal.norm() / sides : 0};
}

bool turned(const Vector& before, const Vector& after) {
    return !(before.dot(after) > kTurned * before.norm() * after.norm());
}

bool may_move(const Working& work, Vertex v, const Vector& to, Vertex with) {
    const SurfaceMesh& mesh = work.marked.mesh;
    double worst_before = 1, worst_after = 1;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh)) {
        if (mesh.is_border(h)) continue;
        const Vertex b = mesh.target(mesh.next(h)), c = mesh.source(h);
        const Shape before = shape_of(work.at(v), work.at(b), work.at(c));
        worst_before = std::min(worst_before, before.quality);
        if (b == with || c == with) continue;
        const Shape after = shape_of(to, work.at(b), work.at(c));
        if (before.quality > 1e-3 && turned(before.normal, after.normal)) return false;
        worst_after = std::min(worst_after, after.quality);
    }
    return worst_after >= std::min(kThin, worst_before);
}

std::optional<Vector> centre_of_star(const Working& work, Vertex v) {
    const SurfaceMesh& mesh = work.marked.mesh;
    const Vector p = work.at(v);
    Vector centre = Vector::Zero(), normal = Vector::Zero();
    double weight = 0;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh)) {
        const Vertex b = mesh.target(mesh.next(h)), c = mesh.source(h);
        const Vector twice = (work.at(b) - p).cross(work.at(c) - p);
        // Areas measured by the wanted length there are even when triangles are as large as wanted.
        const double length = (work.length[v] + work.length[b] + work.length[c]) / 3;
        const double by = twice.norm() / (length * length * length);
        centre += by * (p + work.at(b) + work.at(c)) / 3;
        normal += twice;
        weight += by;
    }
    if (!(weight > 0) || normal.isZero(0)) return std::nullopt;
    normal.normalize();
    Vector to = centre / weight;
    to += (p - to).dot(normal) * normal;
    return to;
}

bool may_join(const Working& work, Edge edge, Vertex gone, Vertex kept) {
    const Kind lower = kind_of(work, gone);
    return lower != fixed_vertex && lower <= kind_of(work, kept) && (lower == free_vertex || work.marked.feature[edge]);
}

bool join(Working& work, Vertex gone, Vertex kept, const Vector& to, double length) {
    SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf h = mesh.halfedge(gone, kept);
    struct Joined {
        Vertex apex;
        bool feature;  // the edge to it, afterwards
        int curve;
    };
    std::array<Joined, 2> joined;
    int count = 0;
    for (const HalfEdgeOf side : {h, mesh.opposite(h)}) {
        if (mesh.is_border(side)) continue;
        const Edge one = mesh.edge(mesh.next(side)), two = mesh.edge(mesh.prev(side));
        if (work.marked.feature[one] && work.marked.feature[two]) return false;
        joined[count++] = {mesh.target(mesh.next(side)), work.marked.feature[one] || work.marked.feature[two],
                           std::max(work.curve[one], work.curve[two])};
    }
    if (!CGAL::Euler::does_satisfy_link_condition(mesh.edge(h), mesh)) return false;
    const bool corner = work.marked.corner[kept], pinned = work.pinned[kept];
    const Carrier carrier = work.carrier[kept];
    const Vertex v = CGAL::Euler::collapse_edge(mesh.edge(h), mesh);
    mesh.point(v) = Point(to[0], to[1], to[2]);
    work.length[v] = length;
    work.carrier[v] = carrier;
    work.marked.corner[v] = corner;
    work.pinned[v] = pinned;
    for (int k = 0; k < count; ++k) {
        const Edge edge = mesh.edge(mesh.halfedge(joined[k].apex, v));
        work.marked.feature[edge] = joined[k].feature;
        work.curve[edge] = joined[k].curve;
    }
    return true;
}

void collapse_short(Working& work, Collapse where) {
    using Entry = std::pair<double, std::uint32_t>;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> shortest;
    const auto look = [&](Edge e) {
        if (const double ratio = work.ratio(e); ratio < kShort) shortest.emplace(ratio, static_cast<std::uint32_t>(e));
    };
    for (const Edge e : work.marked.mesh.edges()) look(e);
    while (!shortest.empty()) {
        const auto [ratio, id] = shortest.top();
        shortest.pop();
        const Edge edge(id);
        if (work.marked.mesh.is_removed(edge) || work.ratio(edge) != ratio) continue;
        const Vertex a = work.marked.mesh.vertex(edge, 0), b = work.marked.mesh.vertex(edge, 1);
        if (!try_collapse(work, edge, where)) continue;
        const Vertex kept = work.marked.mesh.is_removed(a) ? b : a;
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(kept, work.marked.mesh)) look(work.marked.mesh.edge(h));
    }
}

bool may_flip(const Working& work, Edge edge) {
    const SurfaceMesh& mesh = work.marked.mesh;
    if (work.marked.feature[edge] || mesh.is_border(edge)) return false;
    const HalfEdgeOf h = mesh.halfedge(edge), o = mesh.opposite(h);
    const Vertex c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(o));
    if (c == d || mesh.halfedge(c, d) != SurfaceMesh::null_halfedge()) return false;
    return mesh.degree(mesh.source(h)) > 3 && mesh.degree(mesh.target(h)) > 3;
}

bool Flip::turns() const {
    return turned(left.normal, first.normal) || turned(left.normal, second.normal) ||
           turned(right.normal, first.normal) || turned(right.normal, second.normal);
}

Flip flip_of(const Working& work, Edge edge) {
    const SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf h = mesh.halfedge(edge), o = mesh.opposite(h);
    const Vector a = work.at(mesh.source(h)), b = work.at(mesh.target(h)), c = work.at(mesh.target(mesh.next(h))),
                 d = work.at(mesh.target(mesh.next(o)));
    return {shape_of(a, b, c), shape_of(b, a, d), shape_of(d, b, c), shape_of(a, d, c)};
}

void flip_better(Working& work) {
    for (const Edge e : work.marked.mesh.edges())
        if (worth_flipping(work, e)) CGAL::Euler::flip_edge(work.marked.mesh.halfedge(e), work.marked.mesh);
}

}  // namespace octafield::surface
