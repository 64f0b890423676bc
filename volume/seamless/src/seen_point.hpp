// A point that sees all triangles of a cell of tets.
#pragma once

#include <optional>
#include <vector>

#include "octafield/volume/triangle_table.hpp"

namespace octafield::volume::detail {

// Inside all planes of the outer triangles of the tets (ascending), as deep as moves away from the nearest of them take
// it; none where no such point is found. inner: rows of triangles between the tets, ascending.
std::optional<Eigen::Vector3d> seen_point(const TetMesh& mesh, const TriangleTable& table,
                                          const std::vector<Index>& tets, const std::vector<Index>& inner);

}  // namespace octafield::volume::detail
