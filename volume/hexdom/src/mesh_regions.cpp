#include "mesh_regions.hpp"

#include <algorithm>
#include <array>
#include <map>

#include "cell_shapes.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/volume/locate_points.hpp"

namespace octafield::volume {
namespace {

using Triple = std::array<Index, 3>;

Triple ascending(Index a, Index b, Index c) {
    Triple t{a, b, c};
    std::sort(t.begin(), t.end());
    return t;
}

struct CellSide {
    std::array<Index, 4> sorted;  // -1 first for triangles
    Index cell;
    auto operator<=>(const CellSide&) const = default;
};

}  // namespace

std::vector<std::uint8_t> vertex_support(const PointSurface& surface, Index vertices) {
    std::vector<std::uint8_t> support(vertices, 0);
    for (const Index v : surface.mesh.triangles.reshaped()) support[v] = 1;
    for (const Index v : surface.features.edges.reshaped()) support[v] = 2;
    for (const Index v : surface.features.corners) support[v] = 3;
    return support;
}

std::vector<Index> cell_regions(const TetDomain& domain, const PointSurface& surface, const MixedMesh& mesh) {
    std::vector<Triple> walls;  // triangles of the surface, half quads included
    for (Eigen::Index t = 0; t < surface.mesh.triangles.rows(); ++t) {
        const auto row = surface.mesh.triangles.row(t);
        walls.push_back(ascending(row[0], row[1], row[2]));
    }
    std::sort(walls.begin(), walls.end());
    const auto wall = [&](Index a, Index b, Index c) {
        return std::binary_search(walls.begin(), walls.end(), ascending(a, b, c));
    };
    std::vector<CellSide> sides;
    Points middles(mesh.cell_count(), 3);
    detail::for_each_cell(mesh, [&](const detail::Cell& cell) {
        middles.row(cell.number).setZero();
        for (int k = 0; k < cell.shape.vertices; ++k)
            middles.row(cell.number) += mesh.vertices.row(cell.ids[k]) / cell.shape.vertices;
        for (const detail::CellFace& face : cell.shape.faces) {
            std::array<Index, 4> f{-1, -1, -1, -1};
            for (int k = 0; k < face.corners; ++k) f[k] = cell.ids[face.local[k]];
            const bool on_wall = face.corners == 3 ? wall(f[0], f[1], f[2])
                                                   : (wall(f[0], f[1], f[2]) && wall(f[0], f[2], f[3])) ||
                                                         (wall(f[0], f[1], f[3]) && wall(f[1], f[2], f[3]));
            if (on_wall) continue;
            std::sort(f.begin(), f.end());
            sides.push_back({f, cell.number});
        }
    });
    std::sort(sides.begin(), sides.end());
    DisjointSets sets(mesh.cell_count());
    for (std::size_t i = 1; i < sides.size(); ++i)
        if (sides[i].sorted == sides[i - 1].sorted) sets.join(sides[i].cell, sides[i - 1].cell);
    const LocatedPoints located = locate_points(domain, middles);
    const Eigen::VectorXd volumes = cell_volumes(mesh);
    std::vector<std::map<Index, double>> votes(mesh.cell_count());
    for (Index c = 0; c < mesh.cell_count(); ++c)
        if (located.tet[c] >= 0) votes[sets.lowest(c)][domain.regions()[located.tet[c]]] += volumes[c];
    std::vector<Index> regions(mesh.cell_count(), -1);
    for (Index c = 0; c < mesh.cell_count(); ++c) {
        double most = -1;
        for (const auto& [region, volume] : votes[sets.lowest(c)])
            if (volume > most) most = volume, regions[c] = region;
    }
    return regions;
}

}  // namespace octafield::volume
