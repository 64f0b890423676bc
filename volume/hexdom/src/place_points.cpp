#include "place_points.hpp"

#include <CGAL/Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

#include <algorithm>
#include <cmath>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<Index, Kernel>;
using Triangulation = CGAL::Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase>>;

// A point this near an edge or corner, in weights, is on it.
constexpr double on_border = 1e-9;

// A place along an edge. The two parts add up to 1 exactly, so that in the plane of weights all places of an edge are
// on one line for exact predicates too.
struct OnEdge {
    Index edge, point;
    double high;  // part of the higher vertex
    bool operator<(const OnEdge& other) const {
        return edge != other.edge ? edge < other.edge : high != other.high ? high < other.high : point < other.point;
    }
};
double exact_part(double part) { return part < 0.5 ? 1 - (1 - part) : part; }

struct OldEdge {
    Index low, high;
    bool curve, feature;
};

struct Side {
    std::pair<Index, Index> edge;  // lower vertex first
    Index triangle;
    int corner;  // it runs from
    bool forward;
};

std::vector<Side> sorted_sides(const Triangles& triangles) {
    std::vector<Side> sides;
    sides.reserve(3 * triangles.rows());
    for (Index t = 0; t < triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const Index a = triangles(t, k), b = triangles(t, (k + 1) % 3);
            sides.push_back({std::minmax({a, b}), t, k, a < b});
        }
    std::stable_sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.edge < b.edge; });
    return sides;
}

class Placing {
public:
    Placing(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features, const std::vector<Index>& groups,
            const SurfacePoints& points)
        : mesh_(mesh), groups_(groups), points_(points), edge_of_(mesh.triangles.rows(), 3) {
        find_edges(features);
        sort_points();
    }

    PlacedPoints run() {
        require_apart();
        PlacedPoints result = numbered_vertices();
        add_curves(result);
        add_triangles(result);
        require_apart();
        return result;
    }

private:
    Vector corner(Index t, int k) const { return mesh_.vertices.row(mesh_.triangles(t, k)); }
    Vector area_vector(Index t) const { return (corner(t, 1) - corner(t, 0)).cross(corner(t, 2) - corner(t, 0)); }

    void find_edges(const surface::FeatureGraph& features) {
        neighbours_.setConstant(mesh_.triangles.rows(), 3, -1);
        const std::vector<Side> sides = sorted_sides(mesh_.triangles);
        Index feature = 0;  // the first that is not below the edge
        for (auto first = sides.begin(), last = first; first != sides.end(); first = last) {
            while (last != sides.end() && last->edge == first->edge) ++last;
            const bool inner = last - first == 2 && first->forward != first[1].forward &&
                               groups_[first->triangle] == groups_[first[1].triangle];
            const auto row = [&](Index e) { return std::pair(features.edges(e, 0), features.edges(e, 1)); };
            while (feature < features.edges.rows() && row(feature) < first->edge) ++feature;
            const bool is_feature = feature < features.edges.rows() && row(feature) == first->edge;
            for (auto side = first; side != last; ++side)
                edge_of_(side->triangle, side->corner) = static_cast<Index>(edges_.size());
            if (inner && !is_feature) {
                neighbours_(first->triangle, first->corner) = first[1].triangle;
                neighbours_(first[1].triangle, first[1].corner) = first->triangle;
            }
            edges_.push_back({first->edge.first, first->edge.second, is_feature || !inner, is_feature});
        }
    }

    void sort_points() {
        at_vertex_.assign(mesh_.vertices.rows(), -1);
        weights_ = points_.weights;
        for (Index p = 0; p < weights_.rows(); ++p) {
            Vector w = weights_.row(p);
            w = (w.array() < on_border).select(0, w);
            w /= w.sum();
            weights_.row(p) = w;
            const auto zeros = (w.array() == 0).count();
            if (zeros == 2)
                put_at_vertex(p, w);
            else if (zeros == 1)
                put_on_edge(p, w);
            else
                inside_.push_back(p);
        }
        std::sort(on_edges_.begin(), on_edges_.end());
        for (std::size_t i = 1; i < on_edges_.size(); ++i)
            if (on_edges_[i].edge == on_edges_[i - 1].edge && on_edges_[i].high - on_edges_[i - 1].high < 1e-12)
                coincident_.insert(coincident_.end(), {on_edges_[i - 1].point, on_edges_[i].point});
        std::stable_sort(inside_.begin(), inside_.end(),
                         [&](Index p, Index q) { return points_.triangle[p] < points_.triangle[q]; });
    }

    void put_at_vertex(Index p, const Vector& w) {
        int corner;
        w.maxCoeff(&corner);
        Index& there = at_vertex_[mesh_.triangles(points_.triangle[p], corner)];
        if (there >= 0) coincident_.insert(coincident_.end(), {there, p});
        there = p;
    }

    void put_on_edge(Index p, const Vector& w) {
        int opposite;
        w.minCoeff(&opposite);
        const Index t = points_.triangle[p];
        const int side = (opposite + 1) % 3;
        const Index edge = edge_of_(t, side);
        const bool starts_high = mesh_.triangles(t, side) == edges_[edge].high;
        on_edges_.push_back({edge, p, exact_part(w[starts_high ? side : (side + 1) % 3])});
    }

    void require_apart() {
        if (coincident_.empty()) return;
        std::sort(coincident_.begin(), coincident_.end());
        coincident_.erase(std::unique(coincident_.begin(), coincident_.end()), coincident_.end());
        throw InvalidInput("points lie at one place (" + first_few(coincident_) + "); give each place once",
                           "coincident_points", coincident_);
    }

    PlacedPoints numbered_vertices() const {
        const Index points = static_cast<Index>(weights_.rows());
        std::vector<Index> vertex_of(mesh_.vertices.rows(), -1), source(points, -1);
        for (Index t = 0; t < mesh_.triangles.rows(); ++t)
            for (int k = 0; k < 3; ++k) vertex_of[mesh_.triangles(t, k)] = 0;
        for (Index v = 0; v < mesh_.vertices.rows(); ++v) {
            if (vertex_of[v] < 0) continue;
            vertex_of[v] = at_vertex_[v];
            if (vertex_of[v] >= 0) {
                source[vertex_of[v]] = v;
                continue;
            }
            vertex_of[v] = static_cast<Index>(source.size());
            source.push_back(v);
        }
        Points places(source.size(), 3);
        for (Index p = 0; p < points; ++p) {
            Vector sum = Vector::Zero();
            for (int k = 0; k < 3; ++k) sum += weights_(p, k) * corner(points_.triangle[p], k);
            places.row(p) = sum;
        }
        for (std::size_t v = points; v < source.size(); ++v) places.row(v) = mesh_.vertices.row(source[v]);
        return {TriangleComplex(std::move(places)), std::move(source), std::move(vertex_of)};
    }

    // Points along an edge, low to high.
    std::pair<const OnEdge*, const OnEdge*> along(Index edge) const {
        const auto low = std::lower_bound(on_edges_.begin(), on_edges_.end(), OnEdge{edge, -1, -1});
        auto high = low;
        while (high != on_edges_.end() && high->edge == edge) ++high;
        return {on_edges_.data() + (low - on_edges_.begin()), on_edges_.data() + (high - on_edges_.begin())};
    }

    void add_curves(PlacedPoints& result) const {
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            const OldEdge& edge = edges_[e];
            if (!edge.curve) continue;
            const Vector direction = (mesh_.vertices.row(edge.high) - mesh_.vertices.row(edge.low)).normalized();
            Index before = result.vertex_of[edge.low];
            const auto [first, last] = along(static_cast<Index>(e));
            for (const OnEdge* p = first; p != last; before = p++->point)
                result.complex.add_curve_edge(before, p->point, edge.feature, direction);
            result.complex.add_curve_edge(before, result.vertex_of[edge.high], edge.feature, direction);
        }
    }

    // Of slivers, whose own normals may be turned anyhow: of the surface around.
    Vector reliable_normal(Index t) const {
        Vector sum = area_vector(t);
        double lengths = 0;
        for (int k = 0; k < 3; ++k) lengths += (corner(t, k) - corner(t, (k + 1) % 3)).squaredNorm();
        if (2 * std::sqrt(3.0) * sum.norm() < 0.02 * lengths)
            for (int k = 0; k < 3; ++k)
                if (neighbours_(t, k) >= 0) sum += area_vector(neighbours_(t, k));
        return sum.norm() > 0 ? sum.normalized() : area_vector(t).normalized();
    }

    void add_triangles(PlacedPoints& result) {
        Triangulation plane;
        auto inside = inside_.begin();
        for (Index t = 0; t < mesh_.triangles.rows(); ++t) {
            const auto last = std::find_if(inside, inside_.end(), [&](Index p) { return points_.triangle[p] != t; });
            const Vector normal = reliable_normal(t);
            const Corners whole{result.vertex_of[mesh_.triangles(t, 0)], result.vertex_of[mesh_.triangles(t, 1)],
                                result.vertex_of[mesh_.triangles(t, 2)]};
            if (inside == last && !has_edge_points(t)) {
                result.complex.add(whole, groups_[t], t, normal);
                continue;
            }
            plane.clear();
            insert(plane, 0, 0, whole[0]), insert(plane, 1, 0, whole[1]), insert(plane, 0, 1, whole[2]);
            insert_edge_points(plane, t);
            for (; inside != last; ++inside) {
                const Index other = insert(plane, weights_(*inside, 1), weights_(*inside, 2), *inside);
                if (other != *inside) coincident_.insert(coincident_.end(), {other, *inside});
            }
            for (const auto& face : plane.finite_face_handles())
                result.complex.add({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()},
                                   groups_[t], t, normal);
        }
    }

    // The vertex that is at this place, which is the one given if none was before.
    static Index insert(Triangulation& plane, double x, double y, Index vertex) {
        const std::size_t before = plane.number_of_vertices();
        const auto handle = plane.insert(Kernel::Point_2(x, y));
        if (plane.number_of_vertices() > before) handle->info() = vertex;
        return handle->info();
    }

    bool has_edge_points(Index t) const {
        for (int k = 0; k < 3; ++k)
            if (const auto [first, last] = along(edge_of_(t, k)); first != last) return true;
        return false;
    }

    void insert_edge_points(Triangulation& plane, Index t) const {
        for (int k = 0; k < 3; ++k) {
            const auto [first, last] = along(edge_of_(t, k));
            const bool runs_up = mesh_.triangles(t, k) == edges_[edge_of_(t, k)].low;
            for (const OnEdge* p = first; p != last; ++p) {
                Eigen::Vector3d w = Eigen::Vector3d::Zero();
                w[k] = runs_up ? 1 - p->high : p->high;
                w[(k + 1) % 3] = runs_up ? p->high : 1 - p->high;
                insert(plane, w[1], w[2], p->point);
            }
        }
    }

    const surface::TriangleMesh& mesh_;
    const std::vector<Index>& groups_;
    const SurfacePoints& points_;
    Points weights_;        // borders exact
    Triangles edge_of_;     // (F, 3) of sides
    Triangles neighbours_;  // (F, 3) across sides that are on no curve; -1
    std::vector<OldEdge> edges_;
    std::vector<Index> at_vertex_, inside_, coincident_;
    std::vector<OnEdge> on_edges_;
};

}  // namespace

PlacedPoints place_points(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features,
                          const std::vector<Index>& groups, const SurfacePoints& points) {
    return Placing(mesh, features, groups, points).run();
}

}  // namespace octafield::volume::detail
