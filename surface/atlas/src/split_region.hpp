// A connected chart split in two.
#pragma once

#include "chart_mesh.hpp"

namespace octafield::surface::detail {

// How many triangles the first part may have.
struct SplitBounds {
    Index least, most;
};

// By triangle of the chart, 2 at least, which part it is in: both are connected. The parts grow from two ends far apart
// along the chart, and within the bounds they meet at the cut of least cost; where there are many triangles, it is
// looked for in the middle only. costs: by edge of the surface.
std::vector<bool> split_in_two(const SurfaceDomain& domain, const ChartMesh& chart, const Eigen::VectorXd& costs,
                               SplitBounds bounds);

}  // namespace octafield::surface::detail
