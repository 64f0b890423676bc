#include "far_triangles.hpp"

#include <algorithm>
#include <limits>
#include <queue>

namespace octafield::surface::detail {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();
constexpr double nearness = 0.8;  // distances from earlier triangles count less than those from the boundary

class Distances {
public:
    explicit Distances(const SurfaceDomain& domain) : domain_(domain), far_(domain.triangle_count(), infinite) {
        for (Index t = 0; t < domain.triangle_count(); ++t)
            for (int k = 0; k < 3; ++k) {
                const Index edge = domain.topology().triangle_edges(t, k);
                if (domain.topology().edge_triangles.row(edge).minCoeff() >= 0) continue;
                const Eigen::Vector3d a = domain.mesh().vertices.row(domain.topology().edges(edge, 0));
                const Eigen::Vector3d b = domain.mesh().vertices.row(domain.topology().edges(edge, 1));
                far_[t] = std::min(far_[t], ((a + b) / 2 - centre(t)).norm());
            }
        spread(far_, 1);
    }

    Index farthest() const { return static_cast<Index>(std::max_element(far_.begin(), far_.end()) - far_.begin()); }
    void add(Index triangle) {
        std::vector<double> from(far_.size(), infinite);
        from[triangle] = 0;
        spread(from, nearness);
        for (std::size_t t = 0; t < far_.size(); ++t) far_[t] = std::min(far_[t], from[t]);
    }

private:
    Eigen::Vector3d centre(Index t) const {
        Eigen::Vector3d sum = Eigen::Vector3d::Zero();
        for (int k = 0; k < 3; ++k) sum += domain_.mesh().vertices.row(domain_.mesh().triangles(t, k)).transpose() / 3;
        return sum;
    }

    void spread(std::vector<double>& distance, double scale) const {
        using Entry = std::pair<double, Index>;
        std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
        for (std::size_t t = 0; t < distance.size(); ++t)
            if (distance[t] < infinite) front.push({distance[t], static_cast<Index>(t)});
        while (!front.empty()) {
            const auto [here, t] = front.top();
            front.pop();
            if (here > distance[t]) continue;
            for (int k = 0; k < 3; ++k) {
                const auto beside = domain_.topology().edge_triangles.row(domain_.topology().triangle_edges(t, k));
                const Index next = beside[0] == t ? beside[1] : beside[0];
                if (next < 0) continue;
                const double there = here + scale * (centre(next) - centre(t)).norm();
                if (there >= distance[next]) continue;
                distance[next] = there;
                front.push({there, next});
            }
        }
    }

    const SurfaceDomain& domain_;
    std::vector<double> far_;
};

}  // namespace

std::vector<Index> far_triangles(const SurfaceDomain& domain, int count) {
    Distances distances(domain);
    std::vector<Index> result;
    while (static_cast<int>(result.size()) < std::min<Index>(count, domain.triangle_count())) {
        result.push_back(distances.farthest());
        distances.add(result.back());
    }
    return result;
}

}  // namespace octafield::surface::detail
