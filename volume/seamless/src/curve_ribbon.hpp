// A strip of surface swept along an axis of the frames, and the edges of a mesh that cross it.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "octafield/volume/tet_domain.hpp"

namespace octafield::volume::detail {

struct Ribbon {
    std::vector<std::vector<Eigen::Vector3d>> rows;  // the first is where it begins; each next one is moved by `along`
    std::vector<Eigen::Vector3d> along;              // unit, per row
};

// From the line through points of the given tets along the axis that is nearest to `along` there, as it goes on, until
// all of it has left the mesh, becoming wider by the factor `spread`; none where it does not leave within `most_steps`.
std::optional<Ribbon> swept_ribbon(const TetDomain& domain, const Quaternions& frames,
                                   const std::vector<Eigen::Vector3d>& line, const std::vector<Index>& tets,
                                   const Eigen::Vector3d& along, double step, double spread, int most_steps);

// From one line to another, the first end to the first. Both are divided alike by length.
Ribbon straight_ribbon(const std::vector<Eigen::Vector3d>& first, const std::vector<Eigen::Vector3d>& last,
                       double step);

struct EdgeCrossing {
    Index from, to;         // lower vertex first
    int times;              // from behind the ribbon to its front less those back
    Eigen::Vector3d along;  // the ribbon's direction there
};
std::vector<EdgeCrossing> ribbon_crossings(const TetDomain& domain, const Ribbon& ribbon);

}  // namespace octafield::volume::detail
