#include "cut_surface.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "cut_triangle.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double off_vertices = 1e-4;

class Cutter {
public:
    Cutter(const Charts& charts, const std::vector<LayoutCurve>& curves) : charts_(charts), curves_(curves) {}
    CutSurface result(const CurveEnds& ends) &&;

private:
    void place_nodes();
    void cut_triangles();
    void order_curves();
    void drop_tails(const std::vector<std::size_t>& last);
    void join_polygons();

    const Charts& charts_;
    const std::vector<LayoutCurve>& curves_;
    CutSurface cut_;
    std::vector<Eigen::Vector3d> positions_;
    std::vector<std::vector<Index>> point_nodes_;     // of each curve's points
    std::vector<std::vector<Chord>> chords_;          // (F)
    std::vector<std::vector<CurveNode>> in_between_;  // crossings along each curve, in any order
};

void Cutter::place_nodes() {
    struct OnEdge {
        Index edge;
        double fraction;
        Index curve, point;
    };
    std::vector<OnEdge> found;
    point_nodes_.resize(curves_.size());
    for (Index c = 0; c < static_cast<Index>(curves_.size()); ++c) {
        const auto& points = curves_[c].points;
        point_nodes_[c].resize(points.size());
        for (Index i = 0; i < static_cast<Index>(points.size()); ++i) {
            point_nodes_[c][i] = points[i].vertex;
            if (points[i].vertex < 0) found.push_back({points[i].edge, points[i].fraction, c, i});
        }
    }
    std::sort(found.begin(), found.end(), [](const OnEdge& a, const OnEdge& b) {
        return std::tuple(a.edge, a.fraction, a.curve, a.point) < std::tuple(b.edge, b.fraction, b.curve, b.point);
    });
    const Points& vertices = charts_.mesh().vertices;
    for (Eigen::Index v = 0; v < vertices.rows(); ++v) positions_.push_back(vertices.row(v));
    cut_.edge_nodes.resize(charts_.topology().edges.rows());
    for (const OnEdge& at : found) {
        const auto ends = charts_.topology().edges.row(at.edge);
        const double fraction = off_vertices + (1 - 2 * off_vertices) * at.fraction;
        point_nodes_[at.curve][at.point] = static_cast<Index>(positions_.size());
        cut_.edge_nodes[at.edge].push_back(static_cast<Index>(positions_.size()));
        positions_.push_back((1 - fraction) * vertices.row(ends[0]) + fraction * vertices.row(ends[1]));
    }
    chords_.resize(charts_.mesh().triangles.rows());
    for (Index c = 0; c < static_cast<Index>(curves_.size()); ++c)
        for (std::size_t i = 0; i < curves_[c].triangles.size(); ++i)
            chords_[curves_[c].triangles[i]].push_back({c, point_nodes_[c][i], point_nodes_[c][i + 1],
                                                        curves_[c].points[i].length, curves_[c].points[i + 1].length});
}

void Cutter::cut_triangles() {
    cut_.first.push_back(0);
    in_between_.resize(curves_.size());
    const auto on_edges = static_cast<Index>(positions_.size());
    for (Index t = 0; t < charts_.mesh().triangles.rows(); ++t) {
        std::vector<RingNode> ring;
        for (int k = 0; k < 3; ++k) {
            const Index edge = charts_.topology().triangle_edges(t, k);
            const bool boundary = charts_.topology().edge_triangles.row(edge).minCoeff() < 0;
            const Index from = charts_.mesh().triangles(t, k);
            ring.push_back({from, boundary});
            std::vector<Index> nodes = cut_.edge_nodes[edge];
            if (from != charts_.topology().edges(edge, 0)) std::reverse(nodes.begin(), nodes.end());
            for (const Index node : nodes) ring.push_back({node, boundary});
        }
        for (const auto& polygon : cut_triangle(ring, chords_[t], positions_, in_between_)) {
            for (const RingNode& corner : polygon) {
                cut_.nodes.push_back(corner.node);
                cut_.is_cut.push_back(corner.cut_after);
            }
            cut_.first.push_back(static_cast<Index>(cut_.nodes.size()));
            cut_.triangles.push_back(t);
        }
    }
    cut_.is_crossing.assign(positions_.size(), false);
    std::fill(cut_.is_crossing.begin() + on_edges, cut_.is_crossing.end(), true);
    cut_.positions.resize(static_cast<Eigen::Index>(positions_.size()), 3);
    for (std::size_t n = 0; n < positions_.size(); ++n)
        cut_.positions.row(static_cast<Eigen::Index>(n)) = positions_[n];
}

void Cutter::order_curves() {
    // cut_triangle gives the crossings of each chord in its order, one chord after another by triangle; those of a
    // curve are put in place by the lengths at the chords' ends, and kept in order within.
    cut_.curves.resize(curves_.size());
    for (std::size_t c = 0; c < curves_.size(); ++c) {
        auto& crossings = in_between_[c];
        std::stable_sort(crossings.begin(), crossings.end(),
                         [](const CurveNode& a, const CurveNode& b) { return a.length < b.length; });
        auto next = crossings.begin();
        for (std::size_t i = 0; i < point_nodes_[c].size(); ++i) {
            const double length = curves_[c].points[i].length;
            for (; next != crossings.end() && next->length < length; ++next) cut_.curves[c].push_back(*next);
            cut_.curves[c].push_back({point_nodes_[c][i], length});
        }
    }
}

void Cutter::drop_tails(const std::vector<std::size_t>& last) {
    std::vector<std::pair<Index, Index>> dropped;
    std::vector<int> uses(cut_.is_crossing.size(), 0);
    for (std::size_t c = 0; c < cut_.curves.size(); ++c) {
        auto& nodes = cut_.curves[c];
        for (std::size_t i = last[c]; i + 1 < nodes.size(); ++i)
            dropped.push_back(std::minmax(nodes[i].node, nodes[i + 1].node));
        nodes.resize(last[c] + 1);
        for (const CurveNode& at : nodes) ++uses[at.node];
    }
    for (std::size_t n = 0; n < uses.size(); ++n) cut_.is_crossing[n] = cut_.is_crossing[n] && uses[n] == 2;
    std::sort(dropped.begin(), dropped.end());
    for (Index p = 0; p < cut_.polygon_count(); ++p)
        for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) {
            const std::pair<Index, Index> side = std::minmax(cut_.nodes[c], cut_.nodes[cut_.next(p, c)]);
            if (std::binary_search(dropped.begin(), dropped.end(), side)) cut_.is_cut[c] = false;
        }
}

void Cutter::join_polygons() {
    struct Side {
        Index low, high;
        bool forward;
        Index c, next, polygon;
    };
    std::vector<Side> sides;
    for (Index p = 0; p < cut_.polygon_count(); ++p)
        for (Index c = cut_.first[p]; c < cut_.first[p + 1]; ++c) {
            const Index a = cut_.nodes[c], b = cut_.nodes[cut_.next(p, c)];
            sides.push_back({std::min(a, b), std::max(a, b), a < b, c, cut_.next(p, c), p});
        }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) {
        return std::tuple(a.low, a.high, a.forward, a.c) < std::tuple(b.low, b.high, b.forward, b.c);
    });
    cut_.mates.assign(cut_.nodes.size(), -1);
    DisjointSets points(cut_.nodes.size()), patches(cut_.polygon_count());
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i + 1;
        while (end < sides.size() && sides[end].low == sides[i].low && sides[end].high == sides[i].high) ++end;
        const Side &a = sides[i], &b = sides[end - 1];
        const bool pair = end - i == 2 && a.forward != b.forward && cut_.is_cut[a.c] == cut_.is_cut[b.c];
        if (!pair && !(end - i == 1 && cut_.is_cut[a.c]))
            throw GeometryError(
                "the curves of the layout do not cut the surface into polygons, near vertex " + std::to_string(a.low),
                "bad_subdivision");
        if (pair) {
            cut_.mates[a.c] = b.c;
            cut_.mates[b.c] = a.c;
            if (!cut_.is_cut[a.c]) {
                points.join(a.c, b.next);
                points.join(a.next, b.c);
                patches.join(a.polygon, b.polygon);
            }
        }
        i = end;
    }
    cut_.points = std::move(points).numbers(cut_.point_count);
    cut_.patches = std::move(patches).numbers(cut_.patch_count);
}

CutSurface Cutter::result(const CurveEnds& ends) && {
    place_nodes();
    cut_triangles();
    order_curves();
    if (ends) drop_tails(ends(cut_));
    join_polygons();
    return std::move(cut_);
}

}  // namespace

CutSurface cut_surface(const Charts& charts, const std::vector<LayoutCurve>& curves, const CurveEnds& ends) {
    return Cutter(charts, curves).result(ends);
}

}  // namespace octafield::surface::detail
