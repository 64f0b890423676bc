#include "surface_guide.hpp"

#include <CGAL/AABB_segment_primitive.h>
#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <vector>

#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

using Vector = Eigen::Vector3d;
using Place = SurfaceGuide::Place;
using Flat = CGAL::Simple_cartesian<double>;

Flat::Point_3 flat(const Vector& p) { return {p[0], p[1], p[2]}; }
Vector vector(const Flat::Point_3& p) { return {p[0], p[1], p[2]}; }

// Offsets are added to a corner, so that points stay in planes and on lines along the axes to the last bit.
Vector closest(const Vector& p, const Flat::Segment_3& segment) {
    const Vector a = vector(segment[0]), along = vector(segment[1]) - a;
    return a + std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0) * along;
}

Vector closest(const Vector& p, const Flat::Triangle_3& triangle) {
    const Vector a = vector(triangle[0]), b = vector(triangle[1]) - a, c = vector(triangle[2]) - a, d = p - a;
    const double bb = b.squaredNorm(), bc = b.dot(c), cc = c.squaredNorm(), db = d.dot(b), dc = d.dot(c);
    const double all = bb * cc - bc * bc, u = cc * db - bc * dc, v = bb * dc - bc * db;
    if (all > 0 && u >= 0 && v >= 0 && u + v <= all) return a + u / all * b + v / all * c;
    Vector best = closest(p, Flat::Segment_3(triangle[0], triangle[1]));
    for (int k = 1; k < 3; ++k) {
        const Vector other = closest(p, Flat::Segment_3(triangle[k], triangle[(k + 1) % 3]));
        if ((other - p).squaredNorm() < (best - p).squaredNorm()) best = other;
    }
    return best;
}

// Triangles or segments in pieces, with a tree over each and one over all.
template <class Shape, template <class...> class Primitive>
class Forest {
public:
    using Iterator = typename std::vector<Shape>::const_iterator;
    using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Flat, Primitive<Flat, Iterator>>>;

    // piece[i] of the element i, -1: left out.
    Forest(const std::vector<Shape>& shapes, const std::vector<Index>& piece) {
        for (std::size_t i = 0; i < shapes.size(); ++i)
            if (piece[i] >= 0) element_.push_back(static_cast<Index>(i));
        std::ranges::stable_sort(element_, {}, [&](Index i) { return piece[i]; });
        for (const Index i : element_) shapes_.push_back(shapes[i]), piece_.push_back(piece[i]);
        for (auto first = shapes_.cbegin(); first != shapes_.cend();) {
            const auto last = first + (std::ranges::upper_bound(piece_, piece_[first - shapes_.cbegin()]) -
                                       (piece_.cbegin() + (first - shapes_.cbegin())));
            pieces_.push_back(tree(first, last));
            first_of_piece_.push_back(first);
            first = last;
        }
        if (!shapes_.empty()) all_ = tree(shapes_.cbegin(), shapes_.cend());
    }
    bool empty() const { return shapes_.empty(); }
    Place nearest(const Vector& point) const {
        return place(point, all_->closest_point_and_primitive(flat(point), {shapes_[0][0], shapes_.cbegin()}).second);
    }
    // A tree's answer starts from what is known to be near, which shortens the search.
    Place nearest(const Vector& point, const Place& near) const {
        const Iterator known = first_of_piece_[near.piece] + row_in_piece(near);
        const auto hint = std::pair(flat(closest(point, *known)), known);
        return place(point, pieces_[near.piece]->closest_point_and_primitive(flat(point), hint).second);
    }

private:
    static std::unique_ptr<Tree> tree(Iterator first, Iterator last) {
        auto built = std::make_unique<Tree>(first, last);
        built->do_not_accelerate_distance_queries();
        built->build();  // now, not by the first of several threads
        return built;
    }
    std::ptrdiff_t row_in_piece(const Place& place) const {
        const auto first = element_.cbegin() + (first_of_piece_[place.piece] - shapes_.cbegin());
        const auto last = std::size_t(place.piece) + 1 < first_of_piece_.size()
                              ? element_.cbegin() + (first_of_piece_[place.piece + 1] - shapes_.cbegin())
                              : element_.cend();
        return std::lower_bound(first, last, place.element) - first;  // stably sorted: ascending in a piece
    }
    Place place(const Vector& point, Iterator shape) const {
        const auto row = shape - shapes_.cbegin();
        return {piece_[row], element_[row], closest(point, *shape)};
    }
    std::vector<Shape> shapes_;  // by piece
    std::vector<Index> element_, piece_;
    std::vector<Iterator> first_of_piece_;
    std::vector<std::unique_ptr<Tree>> pieces_;
    std::unique_ptr<Tree> all_;
};

// Sets of what is joined, numbered by their lowest elements.
class Sets {
public:
    explicit Sets(std::size_t n) : parent_(n) { std::iota(parent_.begin(), parent_.end(), 0); }
    void join(Index a, Index b) {
        a = root(a), b = root(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }
    // -1 for those to be left out.
    std::vector<Index> numbers(const std::vector<bool>& used) {
        std::vector<Index> number(parent_.size(), -1), result(parent_.size(), -1);
        Index count = 0;
        for (std::size_t i = 0; i < parent_.size(); ++i) {
            if (!used[i]) continue;
            Index& of_set = number[root(static_cast<Index>(i))];
            if (of_set < 0) of_set = count++;
            result[i] = of_set;
        }
        return result;
    }

private:
    Index root(Index i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    std::vector<Index> parent_;
};

struct Side {
    Index low, high, triangle;
};

// The triangles that feature edges, and edges of three triangles or more, enclose.
Sets patches(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    std::vector<std::pair<Index, Index>> cuts;
    for (const auto edge : features.edges.rowwise()) cuts.push_back(std::minmax(edge[0], edge[1]));
    std::ranges::sort(cuts);
    std::vector<Side> sides;
    for (Index t = 0; t < mesh.triangles.rows(); ++t)
        for (int k = 0; k < 3; ++k) {
            const auto [low, high] = std::minmax(mesh.triangles(t, k), mesh.triangles(t, (k + 1) % 3));
            if (!std::ranges::binary_search(cuts, std::pair(low, high))) sides.push_back({low, high, t});
        }
    std::ranges::sort(sides, {}, [](const Side& side) { return std::tie(side.low, side.high, side.triangle); });
    Sets sets(mesh.triangles.rows());
    for (auto first = sides.cbegin(); first != sides.cend();) {
        const auto last = std::find_if(first, sides.cend(), [&](const Side& side) {
            return std::tie(side.low, side.high) != std::tie(first->low, first->high);
        });
        if (last - first == 2) sets.join(first->triangle, (first + 1)->triangle);
        first = last;
    }
    return sets;
}

// The feature edges between corners.
Sets curves(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    std::vector<Index> last(mesh.vertices.rows(), -1);
    std::vector<bool> corner(mesh.vertices.rows());
    for (const Index v : features.corners) corner[v] = true;
    Sets sets(features.edges.rows());
    for (Index e = 0; e < features.edges.rows(); ++e)
        for (const Index v : features.edges.row(e)) {
            if (corner[v]) continue;
            if (last[v] >= 0) sets.join(last[v], e);
            last[v] = e;
        }
    return sets;
}

template <class Rows>
void require_ids(const Rows& rows, Eigen::Index vertices, const char* what) {
    std::vector<Index> lost;
    for (Index i = 0; i < rows.rows(); ++i)
        if ((rows.row(i).array() < 0).any() || (rows.row(i).array() >= vertices).any()) lost.push_back(i);
    if (!lost.empty())
        throw InvalidInput(std::string(what) + " name vertices that the surface does not have (" + first_few(lost) +
                               "); ids count from 0 to " + std::to_string(vertices - 1),
                           "index_out_of_range", lost);
}

void require_sound(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    require_ids(mesh.triangles, mesh.vertices.rows(), "triangles of the surface");
    require_ids(features.edges, mesh.vertices.rows(), "feature edges");
    require_ids(
        Eigen::Map<const Eigen::VectorXi>(features.corners.data(), static_cast<Eigen::Index>(features.corners.size())),
        mesh.vertices.rows(), "corners of the features");
    std::vector<Index> lost;
    for (const Index v : mesh.triangles.reshaped())
        if (!mesh.vertices.row(v).allFinite()) lost.push_back(v);
    for (const Index v : features.edges.reshaped())
        if (!mesh.vertices.row(v).allFinite()) lost.push_back(v);
    std::ranges::sort(lost);
    lost.erase(std::unique(lost.begin(), lost.end()), lost.end());
    if (!lost.empty())
        throw InvalidInput("vertices of the surface are not finite (" + first_few(lost) + "); correct or remove them",
                           "non_finite_vertex", lost);
}

using TriangleForest = Forest<Flat::Triangle_3, CGAL::AABB_triangle_primitive>;
using SegmentForest = Forest<Flat::Segment_3, CGAL::AABB_segment_primitive>;

TriangleForest triangle_forest(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    std::vector<Flat::Triangle_3> triangles;
    std::vector<bool> used;
    for (const auto t : mesh.triangles.rowwise()) {
        const Vector a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
        triangles.emplace_back(flat(a), flat(b), flat(c));
        used.push_back((b - a).cross(c - a).squaredNorm() > 0);
    }
    return {triangles, patches(mesh, features).numbers(used)};
}

SegmentForest segment_forest(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    std::vector<Flat::Segment_3> segments;
    std::vector<bool> used;
    for (const auto e : features.edges.rowwise()) {
        const Vector a = mesh.vertices.row(e[0]), b = mesh.vertices.row(e[1]);
        segments.emplace_back(flat(a), flat(b));
        used.push_back((b - a).squaredNorm() > 0);
    }
    return {segments, curves(mesh, features).numbers(used)};
}

}  // namespace

struct SurfaceGuide::Trees {
    Trees(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features)
        : mesh(mesh),
          features(features),
          triangles(triangle_forest(mesh, features)),
          segments(segment_forest(mesh, features)) {}
    const surface::TriangleMesh& mesh;
    const surface::FeatureGraph& features;
    TriangleForest triangles;
    SegmentForest segments;
};

SurfaceGuide::SurfaceGuide(const surface::TriangleMesh& mesh, const surface::FeatureGraph& features) {
    require_sound(mesh, features);
    trees_ = std::make_unique<Trees>(mesh, features);
}
SurfaceGuide::~SurfaceGuide() = default;

bool SurfaceGuide::has_triangles() const { return !trees_->triangles.empty(); }
bool SurfaceGuide::has_edges() const { return !trees_->segments.empty(); }
Place SurfaceGuide::nearest_on_surface(const Vector& point) const { return trees_->triangles.nearest(point); }
Place SurfaceGuide::nearest_on_curves(const Vector& point) const { return trees_->segments.nearest(point); }
Place SurfaceGuide::nearest_in_patch(const Vector& point, const Place& near) const {
    return trees_->triangles.nearest(point, near);
}
Place SurfaceGuide::nearest_in_curve(const Vector& point, const Place& near) const {
    return trees_->segments.nearest(point, near);
}

bool SurfaceGuide::at_corner(const Place& place, double tolerance) const {
    return std::ranges::any_of(trees_->features.edges.row(place.element), [&](Index v) {
        return (trees_->mesh.vertices.row(v).transpose() - place.point).norm() <= tolerance &&
               std::ranges::find(trees_->features.corners, v) != trees_->features.corners.end();
    });
}

Vector SurfaceGuide::normal(Index triangle) const {
    const auto t = trees_->mesh.triangles.row(triangle);
    const auto edge = [&](int k) -> Vector {
        return trees_->mesh.vertices.row(t[k]) - trees_->mesh.vertices.row(t[0]);
    };
    return edge(1).cross(edge(2)).normalized();
}

Vector SurfaceGuide::tangent(Index edge) const {
    const auto e = trees_->features.edges.row(edge);
    return (trees_->mesh.vertices.row(e[1]) - trees_->mesh.vertices.row(e[0])).transpose().normalized();
}

}  // namespace octafield::volume::detail
