// Faces and corners of the four kinds of cells, in the numbering of cell_arrays.hpp.
#pragma once

#include <array>
#include <span>

#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume::detail {

struct CellFace {
    int corners;               // 3 or 4
    std::array<int, 4> local;  // outward; the last of a triangle's is -1
};

// A corner and its three neighbours: right-handed where the cell is positively oriented.
using CellCorner = std::array<int, 4>;

struct CellShape {
    const char* name;
    int vertices;
    std::span<const CellFace> faces;
    std::span<const CellCorner> corners;  // with three edges each: of a pyramid, those of the base
};

extern const CellShape tet_shape, hexahedron_shape, wedge_shape, pyramid_shape;

// One cell of a mesh.
struct Cell {
    const CellShape& shape;
    const Index* ids;
    Index number;
};

// visit(cell), in the order of the cells' numbers.
template <class Visit>
void for_each_cell(const MixedMesh& mesh, const Visit& visit) {
    Index number = 0;
    const auto all = [&](const auto& rows, const CellShape& shape) {
        for (Eigen::Index i = 0; i < rows.rows(); ++i) visit(Cell{shape, rows.row(i).data(), number++});
    };
    all(mesh.tets, tet_shape);
    all(mesh.hexahedra, hexahedron_shape);
    all(mesh.wedges, wedge_shape);
    all(mesh.pyramids, pyramid_shape);
}

}  // namespace octafield::volume::detail
