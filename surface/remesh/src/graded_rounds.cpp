#include "graded_rounds.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

#include <cmath>

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kLong = 4. / 3, kShort = 4. / 5;  // of the wanted length
constexpr double kTurned = 0.5;                    // cosine of the largest turn of a triangle in one step
constexpr double kThin = 0.15;                     // quality below which a step may not lower it
constexpr double kFlatCosine = 0.94;               // 20 degrees: edges that turn less may be flipped freely

enum Kind { free_vertex, on_curve, fixed_vertex };

Kind kind_of(const Working& work, Vertex v) {
    if (work.marked.corner[v] || work.pinned[v]) return fixed_vertex;
    int features = 0;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, work.marked.mesh))
        features += work.marked.feature[work.marked.mesh.edge(h)];
    return features == 0 ? free_vertex : features == 2 ? on_curve : fixed_vertex;
}

struct Shape {
    Vector normal;   // of twice the area's length
    double quality;  // 1 for equilateral triangles
};

Shape shape_of(const Vector& a, const Vector& b, const Vector& c) {
    const Vector normal = (b - a).cross(c - a);
    const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return {normal, sides > 0 ? 2 * std::sqrt(3.) * normal.norm() / sides : 0};
}

bool turned(const Vector& before, const Vector& after) {
    return !(before.dot(after) > kTurned * before.norm() * after.norm());
}

// Whether the triangles round a vertex stay as they lie when it moves, other than those at `with`.
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

// Edges from v to its neighbours but `with`, once v has moved.
bool stays_short(const Working& work, Vertex v, const Vector& to, double length, Vertex with) {
    for (const Vertex w : CGAL::vertices_around_target(v, work.marked.mesh))
        if (w != with && (work.at(w) - to).norm() > kLong * (length + work.length[w]) / 2) return false;
    return true;
}

bool try_collapse(Working& work, Edge edge) {
    SurfaceMesh& mesh = work.marked.mesh;
    const HalfEdgeOf h = mesh.halfedge(edge);
    Vertex gone = mesh.source(h), kept = mesh.target(h);
    Kind lower = kind_of(work, gone), upper = kind_of(work, kept);
    if (lower > upper) {
        std::swap(gone, kept);
        std::swap(lower, upper);
    }
    if (lower == fixed_vertex || (lower == on_curve && !work.marked.feature[edge])) return false;
    const bool middle = upper == free_vertex;
    const Vector to = middle ? Vector((work.at(gone) + work.at(kept)) / 2) : work.at(kept);
    const double length = middle ? work.wanted(gone, kept) : work.length[kept];
    if (!stays_short(work, gone, to, length, kept) || !may_move(work, gone, to, kept)) return false;
    if (middle && (!stays_short(work, kept, to, length, gone) || !may_move(work, kept, to, gone))) return false;
    std::array<std::pair<Vertex, bool>, 2> joined;  // apex, and whether the edge to it is a feature afterwards
    int count = 0;
    for (const HalfEdgeOf side : {h, mesh.opposite(h)}) {
        if (mesh.is_border(side)) continue;
        const bool one = work.marked.feature[mesh.edge(mesh.next(side))],
                   two = work.marked.feature[mesh.edge(mesh.prev(side))];
        if (one && two) return false;
        joined[count++] = {mesh.target(mesh.next(side)), one || two};
    }
    if (!CGAL::Euler::does_satisfy_link_condition(edge, mesh)) return false;
    const bool corner = work.marked.corner[kept], pinned = work.pinned[kept];
    const Vertex v = CGAL::Euler::collapse_edge(edge, mesh);
    mesh.point(v) = Point(to[0], to[1], to[2]);
    work.length[v] = length;
    work.marked.corner[v] = corner;
    work.pinned[v] = pinned;
    for (int k = 0; k < count; ++k)
        work.marked.feature[mesh.edge(mesh.halfedge(joined[k].first, v))] = joined[k].second;
    return true;
}

int valence_excess(const Working& work, Vertex v) {
    return static_cast<int>(work.marked.mesh.degree(v)) - (work.marked.mesh.is_border(v) ? 4 : 6);
}

bool worth_flipping(const Working& work, Edge edge) {
    const SurfaceMesh& mesh = work.marked.mesh;
    if (work.marked.feature[edge]) return false;
    const HalfEdgeOf h = mesh.halfedge(edge), o = mesh.opposite(h);
    const Vertex a = mesh.source(h), b = mesh.target(h), c = mesh.target(mesh.next(h)), d = mesh.target(mesh.next(o));
    if (c == d || mesh.halfedge(c, d) != SurfaceMesh::null_halfedge()) return false;
    if (mesh.degree(a) <= 3 || mesh.degree(b) <= 3) return false;
    const Shape left = shape_of(work.at(a), work.at(b), work.at(c)), right = shape_of(work.at(b), work.at(a), work.at(d));
    const Shape first = shape_of(work.at(d), work.at(b), work.at(c)), second = shape_of(work.at(a), work.at(d), work.at(c));
    const double before = std::min(left.quality, right.quality), after = std::min(first.quality, second.quality);
    const auto square = [&](Vertex v, int change) {
        const int excess = valence_excess(work, v) + change;
        return excess * excess;
    };
    const int change = square(a, -1) + square(b, -1) + square(c, 1) + square(d, 1) - square(a, 0) - square(b, 0) -
                       square(c, 0) - square(d, 0);
    const bool mends = before < kThin && after > 1.5 * before;
    if (!mends && (change >= 0 || after < std::min(before, 2 * kThin))) return false;
    if (before > 1e-3)
        for (const Shape* old : {&left, &right})
            for (const Shape* made : {&first, &second})
                if (turned(old->normal, made->normal)) return false;
    const double turn_before = left.normal.normalized().dot(right.normal.normalized());
    return first.normal.normalized().dot(second.normal.normalized()) >= std::min(kFlatCosine, turn_before);
}

}  // namespace

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
        split_long(work, kLong, [&](Vertex v) {
            if (kind_of(work, v) == on_curve) place_on_curve(work, v);
        });
        alive(fraction);
        collapse_short(work);
        alive(fraction);
        flip(work);
        relax(work, alive, fraction);
    }
}

void GradedRounds::place_on_curve(Working& work, Vertex v) const {
    const Vector p = work.at(v);
    const Flat::Point_3 at = curves_->closest_point({p[0], p[1], p[2]});
    const Vector to(at.x(), at.y(), at.z());
    if (may_move(work, v, to, v)) work.marked.mesh.point(v) = Point(at.x(), at.y(), at.z());
}

void GradedRounds::collapse_short(Working& work) const {
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
        if (!try_collapse(work, edge)) continue;
        const Vertex kept = work.marked.mesh.is_removed(a) ? b : a;
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(kept, work.marked.mesh)) look(work.marked.mesh.edge(h));
    }
}

void GradedRounds::flip(Working& work) const {
    for (const Edge e : work.marked.mesh.edges())
        if (!work.marked.mesh.is_border(e) && worth_flipping(work, e))
            CGAL::Euler::flip_edge(work.marked.mesh.halfedge(e), work.marked.mesh);
}

void GradedRounds::relax(Working& work, const std::function<void(double)>& alive, double fraction) const {
    SurfaceMesh& mesh = work.marked.mesh;
    int calls = 0;
    for (const Vertex v : mesh.vertices()) {
        if (mesh.is_isolated(v) || kind_of(work, v) != free_vertex) continue;
        if (++calls % 1000 == 0) alive(fraction);
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
        if (!(weight > 0) || normal.isZero(0)) continue;
        normal.normalize();
        Vector to = centre / weight;
        to += (p - to).dot(normal) * normal;
        const auto found = trees_.nearest(patch_at(work.marked, v), to);
        if (!may_move(work, v, found.point, v)) continue;
        mesh.point(v) = Point(found.point[0], found.point[1], found.point[2]);
        work.length[v] = trees_.length(found);
    }
}

}  // namespace octafield::surface
