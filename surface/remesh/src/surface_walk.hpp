// Places on the input found by walking on it from where one is: what is near in space but far along the surface, as the
// other side of a thin wall or the next layer of a roll, is never taken.
#pragma once

#include <array>
#include <optional>
#include <span>

#include "background.hpp"
#include "working_surface.hpp"

namespace octafield::surface {

struct Place {
    Eigen::Vector3d point;
    Carrier carrier;
    double length;  // wanted there
};

// From the elements where the walk starts, always on to the one nearest to the target, no farther away than the start,
// until so many were no nearer (a count: the same each run). Not for several threads at once.
class SurfaceWalk {
public:
    // Refers to the background.
    explicit SurfaceWalk(const Background& ground);

    Carrier carrier_of(Index v) const;  // of a vertex of the background
    // On the triangles of a patch. starts: where one may be; none where none of them touches
    // the patch.
    std::optional<Place> on_surface(std::span<const Carrier> starts, int patch, const Eigen::Vector3d& target);
    // On a feature curve, not past its ends.
    std::optional<Place> on_curve(std::span<const Carrier> starts, int curve, const Eigen::Vector3d& target);
    double length(const Carrier& carrier, const Eigen::Vector3d& point) const;
    int curve(Index segment) const { return static_cast<int>(curves_.of_edge[segment]); }

private:
    template <class Neighbours, class Nearest>
    std::optional<std::pair<Index, Eigen::Vector3d>> walk(std::span<const Index> starts, const Eigen::Vector3d& target,
                                                          std::vector<int>& seen, const Neighbours& neighbours,
                                                          const Nearest& nearest);
    void start_triangles(const Carrier& start, int patch, std::vector<Index>& found) const;
    Eigen::Vector3d vertex(Index v) const { return ground_.mesh.vertices.row(v); }

    const Background& ground_;
    Curves curves_;
    std::vector<std::vector<Index>> round_;         // (V) triangles
    std::vector<std::array<Index, 3>> neighbours_;  // (F) across the side from corner k, -1: none
    std::vector<int> seen_triangle_, seen_segment_;
    int walks_ = 0;
};

Eigen::Vector3d nearest_on_segment(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b);
Eigen::Vector3d nearest_on_triangle(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                                    const Eigen::Vector3d& c);

}  // namespace octafield::surface
