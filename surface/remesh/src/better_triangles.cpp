#include "better_triangles.hpp"

#include <CGAL/boost/graph/Euler_operations.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "local_moves.hpp"
#include "octafield/surface/triangle_quality.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kGain = 1e-3;  // by which a step must raise the least quality, so that rounds end
constexpr int kDirections = 8;
constexpr std::array kSteps = {0.3, 0.12, 0.04};  // of the wanted length

std::array<Vector, 3> corners_of(const Working& work, Face face) {
    std::array<Vector, 3> at;
    int k = 0;
    for (const Vertex v : CGAL::vertices_around_face(work.marked.mesh.halfedge(face), work.marked.mesh))
        at[k++] = work.at(v);
    return at;
}

// The least quality of the triangles round v, once it is at a place; below 0 where one is turned over. Those at
// `without` are left out.
double least_round(const Working& work, Vertex v, const Vector& at, Vertex without) {
    const SurfaceMesh& mesh = work.marked.mesh;
    double least = 1;
    for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh)) {
        if (mesh.is_border(h)) continue;
        const Vertex b = mesh.target(mesh.next(h)), c = mesh.source(h);
        if (b == without || c == without) continue;
        const Shape old = shape_of(work.at(v), work.at(b), work.at(c)), made = shape_of(at, work.at(b), work.at(c));
        if (old.quality > 1e-3 && turned(old.normal, made.normal)) return -1;
        least = std::min(least, radius_ratio(at, work.at(b), work.at(c)));
    }
    return least;
}

double least_round(const Working& work, Vertex v) { return least_round(work, v, work.at(v), v); }

// Tries what may mend one triangle.
class Mending {
public:
    Mending(Working& work, CloseRounds& on_input) : work_(work), mesh_(work.marked.mesh), on_input_(on_input) {}

    bool mend(Face face) {
        const HalfEdgeOf first = mesh_.halfedge(face);
        std::array sides{first, mesh_.next(first), mesh_.prev(first)};
        std::ranges::sort(sides, [&](HalfEdgeOf a, HalfEdgeOf b) {
            return work_.edge_length(mesh_.edge(a)) < work_.edge_length(mesh_.edge(b));
        });
        for (const HalfEdgeOf h : {sides[2], sides[1], sides[0]})
            if (flip(mesh_.edge(h))) return true;
        for (const HalfEdgeOf h : sides)
            if (collapse(mesh_.source(h), mesh_.target(h)) || collapse(mesh_.target(h), mesh_.source(h))) return true;
        bool moved = false;
        for (const HalfEdgeOf h : sides) moved = move(mesh_.target(h)) || moved;
        return moved || split(mesh_.edge(sides[2])) || split(mesh_.edge(sides[1]));
    }

private:
    bool flip(Edge edge) {
        if (!may_flip(work_, edge)) return false;
        const HalfEdgeOf h = mesh_.halfedge(edge), o = mesh_.opposite(h);
        const Vector a = work_.at(mesh_.source(h)), b = work_.at(mesh_.target(h)),
                     c = work_.at(mesh_.target(mesh_.next(h))), d = work_.at(mesh_.target(mesh_.next(o)));
        const double before = std::min(radius_ratio(a, b, c), radius_ratio(b, a, d));
        if (std::min(radius_ratio(d, b, c), radius_ratio(a, d, c)) < before + kGain) return false;
        const Flip both = flip_of(work_, edge);
        // What is no thinner than rounding shows how the surface lies.
        if (both.left.quality > 1e-3 &&
            (turned(both.left.normal, both.first.normal) || turned(both.left.normal, both.second.normal)))
            return false;
        if (both.right.quality > 1e-3 &&
            (turned(both.right.normal, both.first.normal) || turned(both.right.normal, both.second.normal)))
            return false;
        CGAL::Euler::flip_edge(h, mesh_);
        return true;
    }

    bool collapse(Vertex gone, Vertex kept) {
        const Edge edge = mesh_.edge(mesh_.halfedge(gone, kept));
        if (!may_join(work_, edge, gone, kept)) return false;
        const double before = least_round(work_, gone);
        if (least_round(work_, gone, work_.at(kept), kept) < before + kGain) return false;
        return join(work_, gone, kept, work_.at(kept), work_.length[kept]);
    }

    bool move(Vertex v) {
        const Kind kind = kind_of(work_, v);
        if (kind == fixed_vertex) return false;
        double best = least_round(work_, v) + kGain;
        std::optional<Place> found;
        const auto look = [&](const Vector& target) {
            const auto place = on_input_.place_of(work_, v, target);
            if (!place) return;
            const double least = least_round(work_, v, place->point, v);
            if (least <= best) return;
            best = least;
            found = place;
        };
        const Vector p = work_.at(v);
        if (kind == on_curve) {
            const Vector centre = centre_on_curve(work_, v);
            for (const double share : {1., 0.5, -0.5, 0.2, -0.2}) look(p + share * (centre - p));
            for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh_))
                if (work_.marked.feature[mesh_.edge(h)])
                    for (const double share : {0.4, 0.2, 0.1}) look(p + share * (work_.at(mesh_.source(h)) - p));
        } else {
            if (const auto centre = centre_of_star(work_, v)) look(*centre);
            for (const double step : kSteps)
                for (const Vector& direction : directions(v)) look(p + step * work_.length[v] * direction);
        }
        if (found) CloseRounds::put(work_, v, *found);
        return found.has_value();
    }

    std::vector<Vector> directions(Vertex v) const {
        Vector normal = Vector::Zero(), first = Vector::Zero();
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh_)) {
            const Vector b = work_.at(mesh_.target(mesh_.next(h))) - work_.at(v),
                         c = work_.at(mesh_.source(h)) - work_.at(v);
            normal += b.cross(c);
            if (c.squaredNorm() > first.squaredNorm()) first = c;
        }
        if (normal.isZero(0)) return {};
        normal.normalize();
        first = (first - first.dot(normal) * normal).normalized();
        const Vector second = normal.cross(first);
        std::vector<Vector> all;
        for (int k = 0; k < kDirections; ++k) {
            const double angle = 2 * std::numbers::pi * k / kDirections;
            all.push_back(std::cos(angle) * first + std::sin(angle) * second);
        }
        return all;
    }

    // The quality of the triangle of p and a side, or, where that is not enough, the least of those that p has once the
    // side is flipped; and whether it is flipped.
    std::pair<double, bool> half(const Vector& p, HalfEdgeOf side, double enough) const {
        const Vector a = work_.at(mesh_.source(side)), b = work_.at(mesh_.target(side));
        const double own = radius_ratio(a, b, p);
        if (own >= enough || !may_flip(work_, mesh_.edge(side))) return {own, false};
        const Vector c = work_.at(mesh_.target(mesh_.next(mesh_.opposite(side))));
        const Shape first = shape_of(a, c, p), second = shape_of(c, b, p);
        for (const Shape& old : {shape_of(a, b, p), shape_of(b, a, c)})
            if (turned(old.normal, first.normal) || turned(old.normal, second.normal)) return {own, false};
        const double flipped = std::min(radius_ratio(a, c, p), radius_ratio(c, b, p));
        return flipped > own ? std::pair(flipped, true) : std::pair(own, false);
    }

    // At the foot of the apex of its worse triangle, or in the middle.
    bool split(Edge edge) {
        const HalfEdgeOf side = mesh_.halfedge(edge);
        const Vector a = work_.at(mesh_.source(side)), b = work_.at(mesh_.target(side));
        double before = 1, at = 0.5;
        for (const HalfEdgeOf h : {side, mesh_.opposite(side)}) {
            if (mesh_.is_border(h)) continue;
            const Vector c = work_.at(mesh_.target(mesh_.next(h)));
            const double quality = radius_ratio(a, b, c);
            if (quality < before) at = (c - a).dot(b - a) / (b - a).squaredNorm();
            before = std::min(before, quality);
        }
        for (const double share : {std::clamp(at, 0.2, 0.8), 0.5}) {
            const auto place = on_input_.place_on(work_, edge, a + share * (b - a));
            if (!place) continue;
            double after = 1;
            std::vector<Edge> flips;
            for (const HalfEdgeOf h : {side, mesh_.opposite(side)}) {
                if (mesh_.is_border(h)) continue;
                for (const HalfEdgeOf outer : {mesh_.next(h), mesh_.prev(h)}) {
                    const auto [quality, flipped] = half(place->point, outer, before + kGain);
                    after = std::min(after, quality);
                    if (flipped) flips.push_back(mesh_.edge(outer));
                }
            }
            if (after < before + kGain || !on_input_.split_at(work_, edge, *place)) continue;
            for (const Edge outer : flips) flip(outer);
            return true;
        }
        return false;
    }

    Working& work_;
    SurfaceMesh& mesh_;
    CloseRounds& on_input_;
};

}  // namespace

double radius_ratio(const Vector& a, const Vector& b, const Vector& c) {
    const double u = (b - a).norm(), v = (c - b).norm(), w = (a - c).norm();
    const double twice = (b - a).cross(c - a).norm(), product = u * v * w * (u + v + w);
    return product > 0 ? 4 * twice * twice / product : 0;
}

Eigen::VectorXd triangle_qualities(const TriangleMesh& mesh) {
    Eigen::VectorXd qualities(mesh.triangles.rows());
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        qualities[t] = radius_ratio(mesh.vertices.row(mesh.triangles(t, 0)), mesh.vertices.row(mesh.triangles(t, 1)),
                                    mesh.vertices.row(mesh.triangles(t, 2)));
    return qualities;
}

double quality_of(const Working& work, Face face) {
    const auto [a, b, c] = corners_of(work, face);
    return radius_ratio(a, b, c);
}

void better_triangles(Working& work, CloseRounds& on_input, double bound, int rounds,
                      const std::function<void()>& alive) {
    Mending mending(work, on_input);
    for (int round = 0; round < rounds; ++round) {
        alive();
        std::vector<std::pair<double, std::uint32_t>> worst;
        for (const Face f : work.marked.mesh.faces())
            if (const double quality = quality_of(work, f); quality < bound)
                worst.emplace_back(quality, static_cast<std::uint32_t>(f));
        std::ranges::sort(worst);
        bool better = false;
        int calls = 0;
        for (const auto& [quality, id] : worst) {
            const Face face(id);
            if (++calls % 1000 == 0) alive();
            if (work.marked.mesh.is_removed(face) || quality_of(work, face) >= bound) continue;
            better = mending.mend(face) || better;
        }
        if (!better) return;
    }
}

}  // namespace octafield::surface
