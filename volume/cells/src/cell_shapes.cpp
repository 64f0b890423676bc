#include "cell_shapes.hpp"

namespace octafield::volume::detail {
namespace {

constexpr CellFace tet_faces[] = {{3, {0, 2, 1, -1}}, {3, {0, 1, 3, -1}}, {3, {1, 2, 3, -1}}, {3, {0, 3, 2, -1}}};
constexpr CellCorner tet_corners[] = {{0, 1, 2, 3}, {1, 0, 3, 2}, {2, 0, 1, 3}, {3, 0, 2, 1}};

constexpr CellFace hexahedron_faces[] = {{4, {0, 3, 2, 1}}, {4, {4, 5, 6, 7}}, {4, {0, 1, 5, 4}},
                                         {4, {1, 2, 6, 5}}, {4, {2, 3, 7, 6}}, {4, {3, 0, 4, 7}}};
constexpr CellCorner hexahedron_corners[] = {{0, 1, 3, 4}, {1, 2, 0, 5}, {2, 3, 1, 6}, {3, 0, 2, 7},
                                             {4, 7, 5, 0}, {5, 4, 6, 1}, {6, 5, 7, 2}, {7, 6, 4, 3}};

constexpr CellFace wedge_faces[] = {
    {3, {0, 2, 1, -1}}, {3, {3, 4, 5, -1}}, {4, {0, 1, 4, 3}}, {4, {1, 2, 5, 4}}, {4, {2, 0, 3, 5}}};
constexpr CellCorner wedge_corners[] = {{0, 1, 2, 3}, {1, 2, 0, 4}, {2, 0, 1, 5},
                                        {3, 5, 4, 0}, {4, 3, 5, 1}, {5, 4, 3, 2}};

constexpr CellFace pyramid_faces[] = {
    {4, {0, 3, 2, 1}}, {3, {0, 1, 4, -1}}, {3, {1, 2, 4, -1}}, {3, {2, 3, 4, -1}}, {3, {3, 0, 4, -1}}};
constexpr CellCorner pyramid_corners[] = {{0, 1, 3, 4}, {1, 2, 0, 4}, {2, 3, 1, 4}, {3, 0, 2, 4}};

}  // namespace

const CellShape tet_shape{"tet", 4, tet_faces, tet_corners};
const CellShape hexahedron_shape{"hexahedron", 8, hexahedron_faces, hexahedron_corners};
const CellShape wedge_shape{"wedge", 6, wedge_faces, wedge_corners};
const CellShape pyramid_shape{"pyramid", 5, pyramid_faces, pyramid_corners};

}  // namespace octafield::volume::detail
