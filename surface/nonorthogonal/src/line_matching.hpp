// Which line goes over into which from vertex to vertex.
#pragma once

#include <vector>

#include "octafield/surface/non_orthogonal_field.hpp"
#include "vertex_charts.hpp"

namespace octafield::surface::detail {

// The shift m along edge e, from its lower to its higher vertex: numbered counter-clockwise by all integers, from the
// ordered lines on and k + 2 being k turned by pi, branch k becomes branch k + m with the least sum of squared angles.
int line_shift(const TwoLines& from, const TwoLines& to, double transport);

// Quarter turns of the lines round each triangle: 4 times the index. lines: (V), `ordered`.
std::vector<int> triangle_indices(const SurfaceDomain& domain, const VertexCharts& charts,
                                  const std::vector<TwoLines>& lines);

}  // namespace octafield::surface::detail
