// The unknowns of a map to the integer grid: with the whole numbers' conditions solved for.
#pragma once

#include "charted_mesh.hpp"

namespace octafield::surface::detail {

// One coordinate of a triangle's corner: sign times an unknown, and a whole number; value -1: that number alone.
struct GridValue {
    Index value = -1;
    int sign = 1;
    int offset = 0;
    double at(const Eigen::VectorXd& values) const { return value < 0 ? offset : sign * values[value] + offset; }
    bool operator==(const GridValue&) const = default;
};

struct GridValues {
    std::vector<std::array<GridValue, 2>> corners;  // of corner k of triangle t at 3 t + k
    std::vector<int> freedom;                       // of each vertex: 2, on seams 1, 0 at singular points and nodes
    Index count = 0;
    Vector2 place(Index corner, const Eigen::VectorXd& values) const {
        return {corners[corner][0].at(values), corners[corner][1].at(values)};
    }
};

// The values that are nearest to given places of the corners.
Eigen::VectorXd values_at(const GridValues& values, const std::vector<Vector2>& places);

// Vertices on the two sides of a seam have the same coordinate along it. Throws GeometryError (kind "bad_subdivision")
// where planes do not fit round a vertex.
GridValues grid_values(const ChartedMesh& mesh);

}  // namespace octafield::surface::detail
