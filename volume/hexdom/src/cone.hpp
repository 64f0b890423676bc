// A region filled anew: every face round it joined to one point inside, to tets and pyramids.
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

namespace octafield::volume::detail {

// A face of the region's boundary in outward order; three corners or four.
struct ConeFace {
    int corners;
    std::array<Eigen::Vector3d, 4> points;
};

// As scaled_jacobians has it, but negative where inverted, of pyramids too.
double tet_quality(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c,
                   const Eigen::Vector3d& d);
double pyramid_quality(const std::array<Eigen::Vector3d, 4>& base, const Eigen::Vector3d& apex);

// Of the tet or pyramid that joins a face to the apex.
double cone_quality(const ConeFace& face, const Eigen::Vector3d& apex);

struct Apex {
    Eigen::Vector3d place;
    double quality;  // the least of the cells; all corners are positive where this is
};

// Where the least quality is greatest: the best seed, then a pattern search of steps that are halved, from `step` to a
// 500th of it. The least quality is concave nowhere, so this may be a local maximum.
Apex best_apex(const std::vector<ConeFace>& faces, const std::vector<Eigen::Vector3d>& seeds, double step);

}  // namespace octafield::volume::detail
