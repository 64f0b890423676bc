// Array types shared by all modules. Row-major, so that numpy arrays map onto them without a copy.
// Indices are 0-based; -1 means "none".
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace octafield {

using Index = std::int32_t;

template <class Scalar, int Columns>
using Rows = Eigen::Matrix<Scalar, Eigen::Dynamic, Columns, Eigen::RowMajor>;

using Points = Rows<double, 3>;       // (n, 3) positions or vectors x y z
using Edges = Rows<Index, 2>;         // (n, 2) vertex ids
using Triangles = Rows<Index, 3>;     // (n, 3) vertex ids, counter-clockwise seen from outside
using Tets = Rows<Index, 4>;          // (n, 4) vertex ids, det(p1-p0, p2-p0, p3-p0) > 0
using Quaternions = Rows<double, 4>;  // (n, 4) unit quaternions w x y z, scalar first

}  // namespace octafield
