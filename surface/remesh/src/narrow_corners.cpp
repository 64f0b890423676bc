#include "narrow_corners.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "marked_surface.hpp"
#include "surface_walk.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kAcute = 12 * std::numbers::pi / 180;  // needles of 9.4 degrees have a quality of 0.3
constexpr double kApart = 0.25;                         // of the length wanted
constexpr double kAhead = 1.5;                          // so much farther one follows the curve that stays

class NarrowCorners {
public:
    NarrowCorners(const Background& ground, double most)
        : ground_(ground), most_(most), marked_(mark(ground.mesh, ground.features)), mesh_(marked_.mesh) {}

    int let_go() {
        int count = 0;
        for (const Vertex v : mesh_.vertices())
            while (const auto pair = acute_at(v)) {
                follow(pair->first, pair->second);
                ++count;
            }
        return count;
    }

    void write(Background& ground) {
        Edges& edges = ground.features.edges;
        Index kept = 0;
        for (Index e = 0; e < edges.rows(); ++e) {
            const Eigen::RowVector2i ends = edges.row(e);
            if (marked_.feature[mesh_.edge(mesh_.halfedge(Vertex(ends[0]), Vertex(ends[1])))]) edges.row(kept++) = ends;
        }
        edges.conservativeResize(kept, Eigen::NoChange);
        number_patches(marked_);
        for (const Face f : mesh_.faces()) ground.patch[static_cast<Index>(f)] = marked_.patch[f];
        ground.patches = marked_.patches;
    }

private:
    Vector at(Vertex v) const { return ground_.mesh.vertices.row(static_cast<Index>(v)); }
    bool feature(HalfEdgeOf h) const { return marked_.feature[mesh_.edge(h)]; }

    // Two feature half-edges into v next to one another: the one to let go, the one that stays.
    std::optional<std::pair<HalfEdgeOf, HalfEdgeOf>> acute_at(Vertex v) const {
        std::vector<std::pair<HalfEdgeOf, double>> features;  // and the angle from each to the next
        if (mesh_.is_isolated(v)) return std::nullopt;
        HalfEdgeOf first = mesh_.halfedge(v);
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(v, mesh_))
            if (feature(h)) first = h;
        for (const HalfEdgeOf h : CGAL::halfedges_around_target(first, mesh_)) {
            if (feature(h)) features.emplace_back(h, 0);
            if (!features.empty()) features.back().second += mesh_.is_border(h) ? 9 : angle(h);
        }
        if (features.size() < 2) return std::nullopt;
        for (std::size_t k = 0; k < features.size(); ++k) {
            if (features[k].second >= kAcute) continue;
            const HalfEdgeOf a = features[k].first, b = features[(k + 1) % features.size()].first;
            const double bend_a = bend(a), bend_b = bend(b);
            if (bend_a < bend_b) return std::pair(a, b);
            if (std::isfinite(bend_b)) return std::pair(b, a);
        }
        return std::nullopt;
    }

    double angle(HalfEdgeOf into) const {
        const Vector v = at(mesh_.target(into)), a = at(mesh_.source(into)) - v,
                     b = at(mesh_.target(mesh_.next(into))) - v;
        return std::atan2(a.cross(b).norm(), a.dot(b));
    }

    // Of the surface along an edge; of rims infinite.
    double bend(HalfEdgeOf h) const {
        if (mesh_.is_border(mesh_.edge(h))) return std::numeric_limits<double>::infinity();
        const auto normal = [&](HalfEdgeOf side) -> Vector {
            const Vector a = at(mesh_.source(side)), b = at(mesh_.target(side));
            return (b - a).cross(at(mesh_.target(mesh_.next(side))) - a);
        };
        const Vector one = normal(h), two = normal(mesh_.opposite(h));
        return std::atan2(one.cross(two).norm(), one.dot(two));
    }

    // The next half-edge along a curve, away from where it began; none at its end.
    std::optional<HalfEdgeOf> next(HalfEdgeOf h) const {
        const Vertex end = mesh_.source(h);
        std::optional<HalfEdgeOf> found;
        if (marked_.corner[end]) return found;
        for (const HalfEdgeOf into : CGAL::halfedges_around_target(end, mesh_)) {
            if (!feature(into) || mesh_.edge(into) == mesh_.edge(h)) continue;
            if (found) return std::nullopt;
            found = into;
        }
        return found;
    }

    double length(HalfEdgeOf h) const { return (at(mesh_.source(h)) - at(mesh_.target(h))).norm(); }

    void follow(HalfEdgeOf weak, HalfEdgeOf strong) {
        std::vector<HalfEdgeOf> staying{strong};
        double gone = 0, stays = length(strong);
        for (std::optional<HalfEdgeOf> h = weak; h && feature(*h);) {
            const Vertex begin = mesh_.target(*h);
            const double wanted = ground_.length[static_cast<Index>(begin)];
            while (stays < kAhead * gone + wanted) {
                const auto more = next(staying.back());
                if (!more || staying.size() > mesh_.number_of_edges()) break;  // the latter: a loop
                staying.push_back(*more);
                stays += length(*more);
            }
            double apart = std::numeric_limits<double>::infinity();
            for (const HalfEdgeOf s : staying)
                apart = std::min(
                    apart,
                    (nearest_on_segment(at(begin), at(mesh_.source(s)), at(mesh_.target(s))) - at(begin)).norm());
            const bool stays_itself =
                std::ranges::any_of(staying, [&](HalfEdgeOf s) { return mesh_.edge(s) == mesh_.edge(*h); });
            if (apart > std::min(kApart * wanted, most_) || stays_itself) return;
            gone += length(*h);
            const auto after = next(*h);
            marked_.feature[mesh_.edge(*h)] = false;
            h = after;
            if (h && !std::isfinite(bend(*h))) return;
        }
    }

    const Background& ground_;
    double most_;
    Marked marked_;
    SurfaceMesh& mesh_;
};

}  // namespace

int let_go_narrow_corners(Background& ground, double most) {
    if (ground.features.edges.rows() == 0) return 0;
    NarrowCorners corners(ground, most);
    const int count = corners.let_go();
    if (count > 0) corners.write(ground);
    return count;
}

}  // namespace octafield::surface
