#include "octafield/surface/winslow.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>

#include "octafield/error.hpp"
#include "remesh_checks.hpp"
#include "surface_walk.hpp"

namespace octafield::surface {
namespace {

using Vector = Eigen::Vector3d;

constexpr double kOnFeature = 1e-6;  // diagonals
constexpr double kProbe = 1e-3;      // of the edges: distance of the differences that the step comes from
constexpr double kFlat = 1e-3;       // of the squared edges: areas below are counted as if they were a little above 0

// A triangle, or a corner of a quad: the vertex between its sides first.
struct Corner {
    std::array<Index, 3> at;
    bool square;
};

std::vector<Corner> corners_of(const Triangles& triangles, const Quads& quads) {
    std::vector<Corner> corners;
    for (const auto t : triangles.rowwise()) corners.push_back({{t[0], t[1], t[2]}, false});
    for (const auto q : quads.rowwise())
        for (int k = 0; k < 4; ++k) corners.push_back({{q[k], q[(k + 1) % 4], q[(k + 3) % 4]}, true});
    return corners;
}

// Vertices on sides of one cell.
std::set<Index> boundary_of(const Triangles& triangles, const Quads& quads) {
    std::vector<std::pair<Index, Index>> sides;
    const auto add = [&](const auto& cells) {
        for (Index c = 0; c < cells.rows(); ++c)
            for (Index k = 0; k < cells.cols(); ++k)
                sides.push_back(std::minmax(Index(cells(c, k)), Index(cells(c, (k + 1) % cells.cols()))));
    };
    add(triangles);
    add(quads);
    std::ranges::sort(sides);
    std::set<Index> found;
    for (std::size_t i = 0; i < sides.size();) {
        std::size_t end = i;
        while (end < sides.size() && sides[end] == sides[i]) ++end;
        if (end - i == 1) found.insert({sides[i].first, sides[i].second});
        i = end;
    }
    return found;
}

template <class Cells>
void require_ids(const Cells& cells, Index count, const char* what) {
    for (Index c = 0; c < cells.rows(); ++c)
        for (Index k = 0; k < cells.cols(); ++k)
            if (cells(c, k) < 0 || cells(c, k) >= count)
                throw InvalidInput(std::string(what) + " " + std::to_string(c) + " names vertex " +
                                       std::to_string(cells(c, k)) + ", and there are " + std::to_string(count),
                                   "index_out_of_range", {static_cast<Index>(c)});
}

class Smoother {
public:
    Smoother(const Background& ground, const Points& points, const Triangles& triangles, const Quads& quads)
        : ground_(ground),
          walk_(ground),
          points_(points),
          corners_(corners_of(triangles, quads)),
          round_(points.rows()),
          carriers_(points.rows()),
          patch_(points.rows()),
          fixed_(points.rows(), false) {
        for (std::size_t i = 0; i < corners_.size(); ++i)
            for (const Index v : corners_[i].at) round_[v].push_back(i);
    }

    void hold(Index v) { fixed_[v] = true; }

    // On the surface, and where features are near, held.
    void place() {
        const GroundTrees trees(ground_);
        const double near = kOnFeature * bounding_box_diagonal(ground_.mesh.vertices);
        const Edges& lines = ground_.features.edges;
        for (Index v = 0; v < points_.rows(); ++v) {
            if (round_[v].empty()) fixed_[v] = true;
            if (fixed_[v]) continue;
            double best = std::numeric_limits<double>::infinity();
            GroundTrees::Nearest found{};
            for (int patch = 0; patch < ground_.patches; ++patch) {
                const auto nearest = trees.nearest(patch, points_.row(v));
                const double distance = (nearest.point - at(v)).norm();
                if (distance >= best) continue;
                best = distance;
                found = nearest;
                patch_[v] = patch;
            }
            carriers_[v] = {Carrier::On::triangle, found.triangle};
            points_.row(v) = found.point;
        }
        for (Index v = 0; v < points_.rows(); ++v)
            for (Index e = 0; !fixed_[v] && e < lines.rows(); ++e) {
                const Vector a = ground_.mesh.vertices.row(lines(e, 0)), b = ground_.mesh.vertices.row(lines(e, 1));
                fixed_[v] = (nearest_on_segment(at(v), a, b) - at(v)).norm() < near;
            }
    }

    double mean() const {
        double sum = 0;
        for (const Corner& corner : corners_) sum += value(corner, normal_of(corner), -1, Vector::Zero());
        return corners_.empty() ? 0 : sum / static_cast<double>(corners_.size());
    }

    void round(const std::function<void()>& alive) {
        int calls = 0;
        for (Index v = 0; v < points_.rows(); ++v) {
            if (++calls % 500 == 0) alive();
            if (!fixed_[v]) move(v);
        }
    }

    const Points& points() const { return points_; }

private:
    Vector at(Index v) const { return points_.row(v); }

    Vector normal_at(Index v) const {
        const auto t = ground_.mesh.triangles.row(carriers_[v].id);
        const auto p = [&](int k) -> Vector { return ground_.mesh.vertices.row(t[k]); };
        return (p(1) - p(0)).cross(p(2) - p(0)).normalized();
    }

    // The surface's at one of the corner's vertices, or the corner's own where all are held.
    Vector normal_of(const Corner& corner) const {
        for (const Index v : corner.at)
            if (!fixed_[v]) return normal_at(v);
        return (at(corner.at[1]) - at(corner.at[0])).cross(at(corner.at[2]) - at(corner.at[0])).normalized();
    }

    // Winslow's of a corner, with v at a place.
    double value(const Corner& corner, const Vector& normal, Index v, const Vector& place) const {
        std::array<Vector, 3> p;
        for (int k = 0; k < 3; ++k) p[k] = corner.at[k] == v ? place : at(corner.at[k]);
        const Vector a = p[1] - p[0], b = p[2] - p[0];
        const double squares = a.squaredNorm() + b.squaredNorm(), twice = a.cross(b).dot(normal);
        const double sides = corner.square ? squares : (squares + (a - b).squaredNorm()) / std::numbers::sqrt3;
        const double flat = kFlat * squares;
        // The same area but for what is nearly flat or turned over, which becomes dear instead of impossible.
        const double area = twice > flat ? twice : flat * flat / (2 * flat - twice);
        return area > 0 ? sides / (2 * area) : std::numeric_limits<double>::infinity();
    }

    double round_value(Index v, const Vector& normal, const Vector& place) const {
        double sum = 0;
        for (const std::size_t i : round_[v]) sum += value(corners_[i], normal, v, place);
        return sum;
    }

    void move(Index v) {
        const Vector normal = normal_at(v), p = at(v);
        double edge = 0;
        for (const std::size_t i : round_[v])
            for (const Index w : corners_[i].at) edge = std::max(edge, (at(w) - p).norm());
        const Vector first = normal.unitOrthogonal(), second = normal.cross(first);
        const double h = kProbe * edge;
        const auto probe = [&](double x, double y) { return round_value(v, normal, p + x * first + y * second); };
        const double here = probe(0, 0), east = probe(h, 0), west = probe(-h, 0), north = probe(0, h),
                     south = probe(0, -h), corner = probe(h, h);
        const Eigen::Vector2d slope((east - west) / (2 * h), (north - south) / (2 * h));
        Eigen::Matrix2d bend;
        bend(0, 0) = (east - 2 * here + west) / (h * h);
        bend(1, 1) = (north - 2 * here + south) / (h * h);
        bend(0, 1) = bend(1, 0) = (corner - east - north + here) / (h * h);
        if (!slope.allFinite() || !bend.allFinite() || slope.isZero(0)) return;
        Eigen::Vector2d step = -slope / slope.norm() * 0.3 * edge;
        if (bend(0, 0) > 0 && bend.determinant() > 0) step = -bend.inverse() * slope;
        if (step.norm() > edge) step *= edge / step.norm();
        for (const double share : {1., 0.5, 0.2, 0.05}) {
            const std::array start{carriers_[v]};
            const auto found = walk_.on_surface(start, patch_[v], p + share * (step[0] * first + step[1] * second));
            if (!found || !(round_value(v, normal, found->point) < here)) continue;
            points_.row(v) = found->point;
            carriers_[v] = found->carrier;
            return;
        }
    }

    const Background& ground_;
    SurfaceWalk walk_;
    Points points_;
    std::vector<Corner> corners_;
    std::vector<std::vector<std::size_t>> round_;  // corners at each vertex
    std::vector<Carrier> carriers_;
    std::vector<int> patch_;
    std::vector<bool> fixed_;
};

}  // namespace

WinslowResult winslow_smooth(const TriangleMesh& surface, const FeatureGraph& features, const Points& points,
                             const Triangles& triangles, const Quads& quads, const std::vector<Index>& fixed,
                             const WinslowOptions& options, const Progress& progress) {
    require_remeshable(surface, features);
    const Index count = static_cast<Index>(points.rows());
    require_ids(triangles, count, "triangle");
    require_ids(quads, count, "quad");
    if (!points.allFinite()) throw InvalidInput("a vertex is not finite; correct it", "non_finite_vertex");
    if (options.rounds < 0 || !(options.tolerance >= 0))
        throw InvalidInput("rounds and tolerance of smoothing must not be negative", "invalid_option");
    const double far = 2 * bounding_box_diagonal(surface.vertices);
    const Background ground =
        background_of(surface, features, Eigen::VectorXd::Constant(surface.vertices.rows(), far), far, far);
    Smoother smoother(ground, points, triangles, quads);
    for (const Index v : fixed) {
        if (v < 0 || v >= count)
            throw InvalidInput("vertex " + std::to_string(v) + " is to stay, and there are " + std::to_string(count),
                               "index_out_of_range", {v});
        smoother.hold(v);
    }
    for (const Index v : boundary_of(triangles, quads)) smoother.hold(v);
    smoother.place();
    WinslowResult result;
    result.before = result.after = smoother.mean();
    while (result.rounds < options.rounds) {
        const auto alive = [&] {
            report_or_throw(progress, "smooth", static_cast<double>(result.rounds) / options.rounds, result.after);
        };
        alive();
        smoother.round(alive);
        ++result.rounds;
        const double last = std::exchange(result.after, smoother.mean());
        if (!(result.after < last * (1 - options.tolerance))) break;
    }
    result.points = smoother.points();
    for (Index v = 0; v < count; ++v) result.moved += (result.points.row(v) - points.row(v)).norm() > 0;
    return result;
}

}  // namespace octafield::surface
