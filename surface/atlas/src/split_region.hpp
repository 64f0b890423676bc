// A connected chart split in two.
#pragma once

#include "chart_mesh.hpp"

namespace octafield::surface::detail {

// By triangle of the chart, 2 at least, which part it is in: both are connected. The parts grow from two ends far apart
// along the chart; where they meet, between a share of the area of 0.25 and one of 0.75, or less where there are many
// triangles, the cut of least cost is taken. share: of the triangles, that the first part is to have, about. costs: by
// edge of the surface.
std::vector<bool> split_in_two(const SurfaceDomain& domain, const ChartMesh& chart, const Eigen::VectorXd& costs,
                               double share = 0.5);

}  // namespace octafield::surface::detail
