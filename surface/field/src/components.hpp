// The connected components of a surface, by edge.
#pragma once

#include <vector>

#include "crouzeix_raviart.hpp"

namespace octafield::surface::detail {

struct Components {
    std::vector<Index> of_edge;  // (E), 0, 1, ... by lowest edge
    std::vector<double> sizes;   // as shape_size
    std::vector<double> areas;
    std::vector<bool> anchored;  // whether an edge is held or pulled

    std::size_t size() const { return sizes.size(); }
};

// Nothing is anchored yet. `masses` (E): a third of the adjacent triangles' areas.
Components components(const SurfaceDomain& domain, const std::vector<CornerLink>& links, const Eigen::VectorXd& masses);

}  // namespace octafield::surface::detail
