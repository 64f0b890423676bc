#include "feature_axes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <optional>

#include "boundary_star.hpp"

namespace octafield::volume {
namespace {

using frames::Matrix3;
using frames::Vector3;

constexpr double pi = std::numbers::pi;

// Both sides of an edge v -> w: the triangle that runs along it, and the one that runs against it.
struct EdgeSides {
    Index left, right;
};

class Builder {
public:
    Builder(const surface::TriangleMesh& surface, const surface::FeatureGraph& features, double corner_angle)
        : surface_(surface),
          corner_angle_(corner_angle),
          stars_(surface, features),
          neighbours_(stars_.vertex_count()) {
        for (Eigen::Index e = 0; e < features.edges.rows(); ++e)
            for (int k = 0; k < 2; ++k) neighbours_[features.edges(e, k)].push_back(features.edges(e, 1 - k));
        is_node_.assign(stars_.vertex_count(), 0);
        for (Index v = 0; v < stars_.vertex_count(); ++v)
            is_node_[v] = !neighbours_[v].empty() && neighbours_[v].size() != 2;
        for (const Index v : features.corners) is_node_[v] = 1;
    }

    std::vector<FeatureAxes> build() {
        seen_.assign(stars_.vertex_count(), 0);
        for (Index v = 0; v < stars_.vertex_count(); ++v) {
            if (!is_node_[v]) continue;
            add_corner(v);
            for (const Index next : neighbours_[v]) add_curve(chain(v, next));
        }
        for (Index v = 0; v < stars_.vertex_count(); ++v)  // closed curves
            if (neighbours_[v].size() == 2 && !is_node_[v] && !seen_[v]) add_curve(chain(v, neighbours_[v][0]));
        std::sort(found_.begin(), found_.end(),
                  [](const FeatureAxes& a, const FeatureAxes& b) { return a.vertex < b.vertex; });
        return std::move(found_);
    }

private:
    Vector3 place(Index vertex) const { return surface_.vertices.row(vertex).transpose(); }
    Vector3 direction(Index from, Index to) const { return (place(to) - place(from)).normalized(); }

    // From node to node, or round a closed curve back to its first vertex.
    std::vector<Index> chain(Index first, Index second) const {
        std::vector<Index> result{first, second};
        while (!is_node_[result.back()] && result.back() != first) {
            const std::vector<Index>& two = neighbours_[result.back()];
            result.push_back(two[two[0] == result[result.size() - 2] ? 1 : 0]);
        }
        return result;
    }

    bool is_odd(double angle) const {
        return angle <= pi - corner_angle_ || (angle > pi + corner_angle_ && angle <= 2 * pi - corner_angle_);
    }

    std::optional<EdgeSides> sides(Index v, Index w) const {
        EdgeSides result{-1, -1};
        int count = 0;
        for (const Index t : stars_.triangles(v))
            for (int k = 0; k < 3; ++k) {
                const Index a = surface_.triangles(t, k), b = surface_.triangles(t, (k + 1) % 3);
                if (a == v && b == w) result.left = t, ++count;
                if (a == w && b == v) result.right = t, ++count;
            }
        if (count != 2 || result.left < 0 || result.right < 0) return std::nullopt;
        return result;
    }

    Vector3 normal(Index triangle) const {
        const Vector3 a = place(surface_.triangles(triangle, 0));
        return (place(surface_.triangles(triangle, 1)) - a)
            .cross(place(surface_.triangles(triangle, 2)) - a)
            .normalized();
    }

    // Whether one or three hexahedra are round the edge.
    bool is_odd_edge(Index v, Index w) const {
        const std::optional<EdgeSides> beside = sides(v, w);
        if (!beside) return false;
        const Vector3 along = direction(v, w), from = normal(beside->left).cross(along);
        const Vector3 to = along.cross(normal(beside->right));
        const double angle = std::atan2(-to.dot(normal(beside->left)), to.dot(from));  // through the solid
        return is_odd(angle > 0 ? angle : angle + 2 * pi);
    }

    int place_in_star(Index v, Index triangle) const {
        const auto star = stars_.triangles(v);
        return static_cast<int>(std::find(star.begin(), star.end(), triangle) - star.begin());
    }

    double angle_at(Index v, Index triangle) const {
        const int k = static_cast<int>(
            std::find(surface_.triangles.row(triangle).begin(), surface_.triangles.row(triangle).end(), v) -
            surface_.triangles.row(triangle).begin());
        const Vector3 a = place(surface_.triangles(triangle, (k + 1) % 3)) - place(v);
        const Vector3 b = place(surface_.triangles(triangle, (k + 2) % 3)) - place(v);
        return std::atan2(a.cross(b).norm(), a.dot(b));
    }

    // Of the face at the vertex that the triangle belongs to.
    double sector_angle(Index v, Index triangle) const {
        const auto star = stars_.triangles(v);
        const std::vector<int> sectors = stars_.sectors(v);
        const int own = sectors[place_in_star(v, triangle)];
        double sum = 0;
        for (std::size_t i = 0; i < star.size(); ++i)
            if (sectors[i] == own) sum += angle_at(v, star[i]);
        return sum;
    }

    Vector3 sector_normal(Index v, Index triangle) const {
        const std::vector<int> sectors = stars_.sectors(v);
        const int own = sectors[place_in_star(v, triangle)];
        int before = 0;  // sector_normals has one per sector, in the order of their lowest triangles
        for (int i = 0; i < own; ++i) before += sectors[i] == i;
        return stars_.sector_normals(v)[before];
    }

    void add_corner(Index v) {
        if (neighbours_[v].size() != 3 || stars_.sector_normals(v).size() != 3) return;
        Matrix3 axes;
        for (int k = 0; k < 3; ++k) {
            const Index end = neighbours_[v][k];
            const std::optional<EdgeSides> beside = sides(v, end);
            if (!beside || !is_odd_edge(v, end) || !is_odd(sector_angle(v, beside->left))) return;
            axes.col(k) = direction(v, end);
        }
        found_.push_back({v, axes});
    }

    // Angle from the chain's direction to the line that the end asks for in the face of the triangle, in (0, pi).
    double wanted_angle(Index node, Index triangle, bool at_begin) const {
        if (!is_node_[node]) return pi / 2;
        const double angle = sector_angle(node, triangle);
        if (!is_odd(angle)) return pi / 2;
        const double line = angle > pi ? angle - pi : angle;
        return at_begin ? line : pi - line;
    }

    void add_curve(const std::vector<Index>& chain) {
        const std::size_t last = chain.size() - 1;
        if (last < 2 || seen_[chain[1]]) return;
        for (std::size_t i = 0; i <= last; ++i) seen_[chain[i]] = 1;
        const std::optional<EdgeSides> begin = sides(chain[0], chain[1]), end = sides(chain[last - 1], chain[last]);
        if (!begin || !end) return;
        const double left[] = {wanted_angle(chain[0], begin->left, true), wanted_angle(chain[last], end->left, false)};
        const double right[] = {wanted_angle(chain[0], begin->right, true),
                                wanted_angle(chain[last], end->right, false)};
        std::vector<double> length(chain.size(), 0);
        for (std::size_t i = 1; i <= last; ++i)
            length[i] = length[i - 1] + (place(chain[i]) - place(chain[i - 1])).norm();
        for (std::size_t i = 1; i < last; ++i) {
            const double part = length[i] / length[last];
            add_on_curve(chain[i - 1], chain[i], chain[i + 1], std::lerp(left[0], left[1], part),
                         std::lerp(right[0], right[1], part));
        }
        if (!is_node_[chain[0]]) add_on_curve(chain[last - 1], chain[0], chain[1], pi / 2, pi / 2);
    }

    void add_on_curve(Index before, Index v, Index after, double left, double right) {
        if (stars_.sector_normals(v).size() != 2 || !is_odd_edge(before, v) || !is_odd_edge(v, after)) return;
        const EdgeSides beside = *sides(v, after);
        const Vector3 along = (direction(before, v) + direction(v, after)).normalized();
        const Vector3 to_left = sector_normal(v, beside.left).cross(along).normalized();
        const Vector3 to_right = along.cross(sector_normal(v, beside.right)).normalized();
        Matrix3 axes;
        axes << along, std::cos(left) * along + std::sin(left) * to_left,
            std::cos(right) * along + std::sin(right) * to_right;
        if (axes.allFinite()) found_.push_back({v, axes});
    }

    const surface::TriangleMesh& surface_;
    double corner_angle_;
    BoundaryStars stars_;
    std::vector<std::vector<Index>> neighbours_;  // other ends of feature edges
    std::vector<std::uint8_t> is_node_, seen_;
    std::vector<FeatureAxes> found_;
};

}  // namespace

std::vector<FeatureAxes> feature_axes(const surface::TriangleMesh& surface, const surface::FeatureGraph& features,
                                      double corner_angle) {
    return Builder(surface, features, corner_angle).build();
}

}  // namespace octafield::volume
