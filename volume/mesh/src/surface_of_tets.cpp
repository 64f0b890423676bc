#include "surface_of_tets.hpp"

namespace octafield::volume {
namespace {

// Row of `table` and which of its sides the triangle faces away from.
struct OrientedTriangle {
    Eigen::Index row;
    int behind;
};

std::vector<OrientedTriangle> boundary_then_interfaces(const TriangleTable& table, const std::vector<Index>& regions) {
    std::vector<OrientedTriangle> listed, interfaces;
    for (Eigen::Index t = 0; t < table.sides.rows(); ++t) {
        if (table.sides(t, 1) < 0) {
            listed.push_back({t, 0});
        } else if (!regions.empty()) {
            const Index first = regions[table.sides(t, 0) / 4], second = regions[table.sides(t, 1) / 4];
            if (first != second) interfaces.push_back({t, first < second ? 0 : 1});
        }
    }
    listed.insert(listed.end(), interfaces.begin(), interfaces.end());
    return listed;
}

// Numbers the marked vertices in ascending order; returns their ids.
std::vector<Index> number_marked(std::vector<Index>& mark) {
    std::vector<Index> ids;
    for (std::size_t v = 0; v < mark.size(); ++v)
        if (mark[v] >= 0) {
            mark[v] = static_cast<Index>(ids.size());
            ids.push_back(static_cast<Index>(v));
        }
    return ids;
}

}  // namespace

SurfaceOfTets surface_of_tets(const TetMesh& mesh, const TriangleTable& table, const std::vector<Index>& regions) {
    SurfaceOfTets result;
    const std::vector<OrientedTriangle> listed = boundary_then_interfaces(table, regions);

    std::vector<Index> compact(mesh.vertices.rows(), -1);
    for (const auto& [row, behind] : listed)
        for (int k = 0; k < 3; ++k) compact[table.triangles(row, k)] = 0;
    BoundarySurface& surface = result.surface;
    surface.vertex_map = number_marked(compact);
    surface.mesh.vertices = mesh.vertices(surface.vertex_map, Eigen::all);
    surface.mesh.triangles.resize(listed.size(), 3);
    result.sides.resize(listed.size(), 2);
    result.rows.resize(listed.size());
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const auto [row, behind] = listed[i];
        const Index side = table.sides(row, behind), other = table.sides(row, 1 - behind);
        for (int k = 0; k < 3; ++k) surface.mesh.triangles(i, k) = compact[mesh.tets(side / 4, tet_face[side % 4][k])];
        result.sides.row(i) << side / 4, other < 0 ? -1 : other / 4;
        result.rows[i] = static_cast<Index>(row);
        result.interface_triangles += other >= 0;
    }
    return result;
}

}  // namespace octafield::volume
