// Where separatrices of a non-orthogonal field leave singular points.
#pragma once

#include "charted_lines.hpp"
#include "separatrix_starts.hpp"

namespace octafield::surface::detail {

// Of a point inside a triangle: the directions in which a line at about an edge length from the point runs straight
// away from it. Counter-clockwise.
std::vector<SeparatrixStart> starts_of_point(const ChartedLines& field, const SurfaceSingularity& point,
                                             const LinesTracer& tracer);

// Of a boundary vertex: its lines inside its two boundary edges.
std::vector<SeparatrixStart> starts_of_corner(const ChartedLines& field, const NonOrthogonalField& lines,
                                              const VertexCharts& vertices, Index vertex);

}  // namespace octafield::surface::detail
