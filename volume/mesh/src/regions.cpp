#include "octafield/volume/regions.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

#include "boundary_star.hpp"
#include "octafield/error.hpp"
#include "triangle_table.hpp"

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

RegionSurface region_surface(const TetMesh& mesh, const std::vector<Index>& regions) {
    if (!regions.empty() && static_cast<Eigen::Index>(regions.size()) != mesh.tets.rows())
        throw InvalidInput("regions has " + std::to_string(regions.size()) + " ids; give one per tet, " +
                               std::to_string(mesh.tets.rows()) + ", or none",
                           "wrong_size");
    RegionSurface result;
    result.surface.mesh = {};
    for (Eigen::Index t = 0; t < mesh.tets.rows(); ++t)
        if (mesh.tets.row(t).minCoeff() < 0 || mesh.tets.row(t).maxCoeff() >= mesh.vertices.rows())
            throw GeometryError("tet " + std::to_string(t) + " refers to a vertex that does not exist; vertex ids " +
                                    "count from 0 to " + std::to_string(mesh.vertices.rows() - 1),
                                "index_out_of_range", {static_cast<Index>(t)});
    const TriangleTable table = triangle_table(mesh);
    const std::vector<OrientedTriangle> listed = boundary_then_interfaces(table, regions);

    std::vector<Index> compact(mesh.vertices.rows(), -1);
    for (const auto& [row, behind] : listed)
        for (int k = 0; k < 3; ++k) compact[table.triangles(row, k)] = 0;
    BoundarySurface& surface = result.surface;
    surface.vertex_map = number_marked(compact);
    surface.mesh.vertices = mesh.vertices(surface.vertex_map, Eigen::all);
    surface.mesh.triangles.resize(listed.size(), 3);
    result.sides.resize(listed.size(), 2);
    for (std::size_t i = 0; i < listed.size(); ++i) {
        const auto [row, behind] = listed[i];
        const Index side = table.sides(row, behind), other = table.sides(row, 1 - behind);
        for (int k = 0; k < 3; ++k) surface.mesh.triangles(i, k) = compact[mesh.tets(side / 4, tet_face[side % 4][k])];
        result.sides.row(i) << side / 4, other < 0 ? -1 : other / 4;
        result.interface_triangles += other >= 0;
    }
    return result;
}

Sheets cut_into_sheets(const surface::TriangleMesh& surface) {
    const BoundaryStars stars(surface, {});
    Sheets sheets;
    sheets.mesh.triangles = surface.triangles;
    for (Index v = 0; v < stars.vertex_count(); ++v) {
        const auto star = stars.triangles(v);
        const std::vector<int> sector = stars.sectors(v);
        std::vector<Index> copy(star.size());
        for (std::size_t i = 0; i < star.size(); ++i) {
            if (sector[i] == static_cast<int>(i)) {
                copy[i] = static_cast<Index>(sheets.vertex_map.size());
                sheets.vertex_map.push_back(v);
            }
            for (int k = 0; k < 3; ++k)
                if (surface.triangles(star[i], k) == v) sheets.mesh.triangles(star[i], k) = copy[sector[i]];
        }
    }
    sheets.mesh.vertices = surface.vertices(sheets.vertex_map, Eigen::all);

    std::vector<std::pair<Index, Index>> sides;
    for (const auto triangle : surface.triangles.rowwise())
        for (int k = 0; k < 3; ++k) sides.push_back(std::minmax({triangle[k], triangle[(k + 1) % 3]}));
    std::sort(sides.begin(), sides.end());
    std::vector<std::pair<Index, Index>> cuts;
    for (std::size_t i = 0, end; i < sides.size(); i = end) {
        end = i + 1;
        while (end < sides.size() && sides[end] == sides[i]) ++end;
        if (end - i > 2) cuts.push_back(sides[i]);
    }
    sheets.cuts.resize(cuts.size(), 2);
    for (std::size_t i = 0; i < cuts.size(); ++i) sheets.cuts.row(i) << cuts[i].first, cuts[i].second;
    return sheets;
}

}  // namespace octafield::volume
