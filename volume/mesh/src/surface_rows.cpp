#include "surface_rows.hpp"

#include <algorithm>
#include <array>
#include <string>

#include "octafield/error.hpp"

namespace octafield::volume {
namespace {

// The table's rows are in lexicographic order; -1: none.
Index find_row(const TriangleTable& table, std::array<Index, 3> ids) {
    std::sort(ids.begin(), ids.end());
    const auto row = [&](Index t) {
        return std::array{table.triangles(t, 0), table.triangles(t, 1), table.triangles(t, 2)};
    };
    Index low = 0, high = static_cast<Index>(table.triangles.rows());
    while (low < high) {
        const Index middle = low + (high - low) / 2;
        if (row(middle) < ids)
            low = middle + 1;
        else
            high = middle;
    }
    return low < table.triangles.rows() && row(low) == ids ? low : -1;
}

}  // namespace

std::vector<Index> surface_rows(const TetMesh& mesh, const TriangleTable& table, const BoundarySurface& surface) {
    const Index count = static_cast<Index>(surface.vertex_map.size());
    for (const Index v : surface.vertex_map)
        if (v < 0 || v >= mesh.vertices.rows())
            throw InvalidInput("vertex_map refers to vertex " + std::to_string(v) + ", which the mesh does not have",
                               "index_out_of_range", {v});
    std::vector<Index> rows, missing;
    for (Index f = 0; f < surface.mesh.triangles.rows(); ++f) {
        const auto corners = surface.mesh.triangles.row(f);
        if (corners.minCoeff() < 0 || corners.maxCoeff() >= count)
            throw InvalidInput("triangle " + std::to_string(f) + " refers to a vertex that is not in vertex_map",
                               "index_out_of_range", {f});
        std::array<Index, 3> ids;
        for (int k = 0; k < 3; ++k) ids[k] = surface.vertex_map[corners[k]];
        rows.push_back(find_row(table, ids));
        if (rows.back() < 0) missing.push_back(f);
    }
    if (!missing.empty())
        throw InvalidInput("triangles " + first_few(missing) + " of the surface are none of the tet mesh; give the " +
                               "surface of this mesh",
                           "wrong_mesh", missing);
    return rows;
}

}  // namespace octafield::volume
