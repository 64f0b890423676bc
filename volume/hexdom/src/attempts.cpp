#include "attempts.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "cavity.hpp"
#include "near_grid.hpp"
#include "not_joined.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/cell_quality.hpp"
#include "octafield/volume/recombination.hpp"

namespace octafield::volume {
namespace {

constexpr int most_places = 3, most_layers = 3, most_surfaces = 4, most_refillings = 4, most_rounds = 3, most_joins = 6;

std::vector<std::uint8_t> all_hexahedra(const MixedMesh& mesh) {
    return std::vector<std::uint8_t>(mesh.hexahedra.rows(), 1);
}

std::vector<std::uint8_t> hexahedra_at(const std::vector<Index>& vertices, const CellsOnSurface& cells) {
    std::vector<std::uint8_t> at(cells.vertices.rows(), 0), marked;
    for (const Index v : vertices) at[v] = 1;
    for (Eigen::Index k = 0; k < cells.hexahedra.rows(); ++k)
        for (const Index v : cells.hexahedra.row(k)) {
            if (!at[v]) continue;
            marked.resize(cells.hexahedra.rows(), 0);
            marked[k] = 1;
        }
    return marked;
}

// Vertices of the surface within `distance` of corners of the triangles.
void mark_near(const surface::TriangleMesh& mesh, const std::vector<Index>& triangles, double distance,
               std::vector<std::uint8_t>& marked) {
    NearGrid corners(distance);
    for (const Index t : triangles)
        for (const Index v : mesh.triangles.row(t)) corners.add(v, mesh.vertices.row(v));
    for (Eigen::Index v = 0; v < mesh.vertices.rows(); ++v)
        if (corners.any(mesh.vertices.row(v), distance)) marked[v] = 1;
}

}  // namespace

MixedMesh filled_by_layers(CellsOnSurface& cells, const Progress& progress) {
    int places = 0;
    for (int layer = 0;; ++layer) {
        std::vector<std::uint8_t> there;
        try {
            return filled(cells, progress);
        } catch (const GeometryError& error) {
            if (error.kind() != "tetgen_failed" || cells.hexahedra.rows() == 0) throw;
            if (places++ < most_places) there = hexahedra_at(error.elements(), cells);
        }
        if (!there.empty()) {
            leave_out(cells, there);
            --layer;
            continue;
        }
        leave_out(cells,
                  layer < most_layers ? beside_cavity(cells) : std::vector<std::uint8_t>(cells.hexahedra.rows(), 1));
    }
}

namespace {

Triangles walls_of(const CellsOnSurface& cells) {
    std::vector<Index> walls;
    for (std::size_t t = 0; t < cells.two_sided.size(); ++t)
        if (cells.two_sided[t]) walls.push_back(static_cast<Index>(t));
    return cells.surface.mesh.triangles(walls, Eigen::all);
}

MixedMesh joined(const FilledCells& filled, const NotJoined& not_joined, const HexDominantOptions& options,
                 HexDominantCounts& counts) {
    RecombineOptions join;
    join.min_scaled_jacobian = options.min_scaled_jacobian;
    join.kept_edges = filled.cells.surface.features.edges;
    join.walls = walls_of(filled.cells);
    join.threads = options.threads;
    MixedMesh mesh = filled.mesh;
    std::vector<Index> kept, rest;
    for (Index t = 0; t < filled.mesh.tets.rows(); ++t)
        (not_joined.has(filled.mesh.tets.row(t)) ? kept : rest).push_back(t);
    mesh.tets = filled.mesh.tets(rest, Eigen::all);
    mesh = recombine(mesh, join);
    const Eigen::Index others = mesh.tets.rows();
    mesh.tets.conservativeResize(others + static_cast<Eigen::Index>(kept.size()), 4);
    mesh.tets.bottomRows(static_cast<Eigen::Index>(kept.size())) = filled.mesh.tets(kept, Eigen::all);
    counts.recombined_hexahedra = static_cast<Index>(mesh.hexahedra.rows() - filled.mesh.hexahedra.rows());
    counts.recombined_wedges = static_cast<Index>(mesh.wedges.rows());
    return mesh;
}

// Hexahedra of the lattice among cells that conform named.
std::vector<std::uint8_t> lattice_hexahedra(const std::vector<Index>& cells, const MixedMesh& mesh, Index count) {
    std::vector<std::uint8_t> marked;
    for (const Index cell : cells) {
        const Index k = cell - static_cast<Index>(mesh.tets.rows());
        if (k < 0 || k >= count) continue;
        marked.resize(count, 0);
        marked[k] = 1;
    }
    return marked;
}

std::vector<Index> vertices_of(const std::vector<Index>& cells, const MixedMesh& mesh) {
    std::vector<std::uint8_t> named(mesh.cell_count(), 0);
    for (const Index cell : cells)
        if (cell >= 0 && cell < mesh.cell_count()) named[cell] = 1;
    std::vector<Index> vertices;
    detail::for_each_cell(mesh, [&](const detail::Cell& cell) {
        if (named[cell.number]) vertices.insert(vertices.end(), cell.ids, cell.ids + cell.shape.vertices);
    });
    return vertices;
}

std::vector<Index> unproven_cells(const MixedMesh& mesh, int threads) {
    const std::vector<std::uint8_t> proven = proven_positive(mesh, 8, threads);
    std::vector<Index> cells;
    for (std::size_t c = 0; c < proven.size(); ++c)
        if (!proven[c]) cells.push_back(static_cast<Index>(c));
    return cells;
}

std::pair<Index, Index> ascending(Index a, Index b) { return std::minmax({a, b}); }

// Throws where an edge of a feature is no edge of a cell's face.
void require_features(const MixedMesh& mesh, const Edges& features) {
    std::vector<std::uint8_t> at_feature(mesh.vertices.rows(), 0);
    for (const Index v : features.reshaped()) at_feature[v] = 1;
    std::vector<std::pair<Index, Index>> edges;
    detail::for_each_cell(mesh, [&](const detail::Cell& cell) {
        for (const detail::CellFace& face : cell.shape.faces)
            for (int k = 0; k < face.corners; ++k) {
                const Index a = cell.ids[face.local[k]], b = cell.ids[face.local[(k + 1) % face.corners]];
                if (at_feature[a] && at_feature[b]) edges.push_back(ascending(a, b));
            }
    });
    std::sort(edges.begin(), edges.end());
    std::vector<Index> lost;
    for (const auto edge : features.rowwise())
        if (!std::binary_search(edges.begin(), edges.end(), ascending(edge[0], edge[1])))
            lost.insert(lost.end(), {edge[0], edge[1]});
    if (!lost.empty())
        throw GeometryError("features between vertices " + first_few(lost) +
                                " of the mesh are no edges of cells; give another edge length",
                            "lost_feature", lost);
}

// Throws where a triangle between regions is no face of a cell and no half of one: cells reach across. Elements: its
// vertices.
void require_interfaces(const MixedMesh& mesh, const CellsOnSurface& cells) {
    using Triple = std::array<Index, 3>;
    const auto sorted = [](Triple t) {
        std::sort(t.begin(), t.end());
        return t;
    };
    std::vector<Triple> walls, found;
    std::vector<std::uint8_t> at_wall(mesh.vertices.rows(), 0);
    for (Index t = 0; t < cells.surface.mesh.triangles.rows(); ++t) {
        if (!cells.two_sided[t]) continue;
        const auto row = cells.surface.mesh.triangles.row(t);
        walls.push_back(sorted({row[0], row[1], row[2]}));
        for (const Index v : row) at_wall[v] = 1;
    }
    if (walls.empty()) return;
    detail::for_each_cell(mesh, [&](const detail::Cell& cell) {
        for (const detail::CellFace& face : cell.shape.faces)
            for (int k = 0; k < (face.corners == 3 ? 1 : 4); ++k) {
                const auto id = [&](int i) { return cell.ids[face.local[(k + i) % face.corners]]; };
                if (at_wall[id(0)] && at_wall[id(1)] && at_wall[id(2)]) found.push_back(sorted({id(0), id(1), id(2)}));
            }
    });
    std::sort(found.begin(), found.end());
    std::vector<Index> lost;
    for (const Triple& wall : walls)
        if (!std::binary_search(found.begin(), found.end(), wall)) lost.insert(lost.end(), wall.begin(), wall.end());
    if (!lost.empty())
        throw GeometryError("cells reach through the interface between regions at vertices " + first_few(lost) +
                                " of the mesh; give another edge length",
                            "lost_interface", lost);
}

bool good(const MixedMesh& mesh, int threads) {
    return find_cell_defects(mesh).empty() && unproven_cells(mesh, threads).empty();
}

// Regions by number, volumes of each; all together where there are none.
std::map<Index, double> volumes_of(const Eigen::VectorXd& volumes, const std::vector<Index>& regions) {
    std::map<Index, double> sums;
    for (Eigen::Index c = 0; c < volumes.size(); ++c) sums[regions.empty() ? 0 : regions[c]] += volumes[c];
    return sums;
}

bool farther(const std::map<Index, double>& moved, const std::map<Index, double>& before,
             const std::map<Index, double>& wanted) {
    for (const auto& [region, volume] : wanted) {
        const auto error = [&](const std::map<Index, double>& sums) {
            const auto found = sums.find(region);
            return std::abs((found == sums.end() ? 0 : found->second) / volume - 1);
        };
        if (!(error(moved) <= error(before) + 0.005)) return true;
    }
    return false;
}

double longest_at(const TetDomain& domain, const std::vector<Index>& triangles, const EdgeLengths& lengths) {
    if (!lengths.vary()) return lengths.longest();
    double longest = 0;
    for (const Index t : triangles)
        for (const Index v : domain.surface().mesh.triangles.row(t))
            longest = std::max(longest, lengths.at(domain.surface().vertex_map[v]));
    return longest;
}

}  // namespace

FilledCells filled_cells(const TetDomain& domain, const LatticeCells& lattice, const EdgeLengths& lengths,
                         const Progress& progress) {
    const surface::TriangleMesh& old = domain.surface().mesh;
    std::vector<std::uint8_t> stays;
    for (int round = 0;; ++round) {
        report_or_throw(progress, "surface", 0, 0);
        CellsOnSurface cells = cells_on_surface(domain, lattice, lengths, stays);
        try {
            report_or_throw(progress, "tetrahedralize", 0, 0);
            MixedMesh mesh = filled_by_layers(cells, progress);
            return {std::move(cells), std::move(mesh)};
        } catch (const GeometryError& error) {
            if (round == most_surfaces) throw;
            stays.resize(old.vertices.rows(), 0);
            if (error.kind() == "self_intersection" && round + 1 < most_surfaces) {
                mark_near(old, error.elements(), std::ldexp(longest_at(domain, error.elements(), lengths), round),
                          stays);
            } else {
                round = most_surfaces - 1;
                std::fill(stays.begin(), stays.end(), 1);
            }
        }
    }
}

MixedMesh conforming(FilledCells& filled, const HexDominantOptions& options, HexDominantCounts& counts,
                     const Progress& progress) {
    bool join = options.recombine;
    int joins = 0, refillings = 0;
    NotJoined not_joined(filled.mesh);
    for (;;) {
        MixedMesh mesh = filled.mesh;
        const Index of_lattice = static_cast<Index>(mesh.hexahedra.rows());
        counts.recombined_hexahedra = counts.recombined_wedges = 0;
        std::vector<std::uint8_t> marked;
        try {
            if (join && mesh.tets.rows() > 0) {
                report_or_throw(progress, "recombine", 0, 0);
                mesh = joined(filled, not_joined, options, counts);
            }
            report_or_throw(progress, "conform", 0, 0);
            counts.pyramids = {};
            MixedMesh result =
                without_unproven(conform(mesh, &counts.pyramids, walls_of(filled.cells)), options.threads);
            require_features(result, filled.cells.surface.features.edges);
            require_interfaces(result, filled.cells);
            return result;
        } catch (const GeometryError& error) {
            const bool interface = error.kind() == "lost_interface",
                       names_cells = !interface && error.kind() != "unproven_cell" && error.kind() != "lost_feature";
            if (interface && refillings < most_refillings) marked = hexahedra_at(error.elements(), filled.cells);
            if (names_cells && refillings < most_refillings)
                marked = lattice_hexahedra(error.elements(), mesh, of_lattice);
            if (marked.empty() && join && ++joins < most_joins) {
                not_joined.add(names_cells ? vertices_of(error.elements(), mesh) : error.elements(),
                               interface || error.kind() == "lost_feature");
                continue;
            }
            if (marked.empty() && !std::exchange(join, false)) {
                if (of_lattice == 0) throw;
                marked = all_hexahedra(filled.mesh);
            }
        }
        if (marked.empty()) continue;
        ++refillings;
        leave_out(filled.cells, marked);
        report_or_throw(progress, "tetrahedralize", 0, 0);
        filled.mesh = filled_by_layers(filled.cells, progress);
        not_joined = NotJoined(filled.mesh);
    }
}

MixedMesh without_unproven(MixedMesh mesh, int threads) {
    for (int round = 0;; ++round) {
        const std::vector<Index> cells = unproven_cells(mesh, threads);
        if (cells.empty()) return mesh;
        if (round == most_rounds)
            throw GeometryError("the Jacobian is not proven to be above 0 all through " + std::to_string(cells.size()) +
                                    " cells, at vertices " + first_few(vertices_of(cells, mesh)) +
                                    " of the mesh; give another edge length",
                                "unproven_cell", vertices_of(cells, mesh));
        detail::CellComplex complex(mesh);
        for (const Index cell : cells) {
            if (!complex.alive(cell) || complex.shape(cell).vertices < 5) continue;
            detail::Region region;
            detail::add_to_region(complex, cell, region);
            Eigen::Vector3d centre = Eigen::Vector3d::Zero();
            const int corners = complex.shape(cell).vertices;
            for (int k = 0; k < corners; ++k) centre += complex.point(complex.ids(cell)[k]) / corners;
            const detail::Filling filling = detail::best_filling(complex, std::move(region), {centre});
            if (filling.apex.quality > 1e-9) detail::fill(complex, filling);
        }
        mesh = complex.mesh(static_cast<Index>(mesh.vertices.rows()));
    }
}

MixedMesh improved(const MixedMesh& mesh, const TetDomain& domain, const std::vector<std::uint8_t>& support,
                   const std::vector<Index>& regions, double edge_length, int threads) {
    const std::map<Index, double> wanted = volumes_of(tet_volumes(domain.mesh()), domain.regions()),
                                  before = volumes_of(cell_volumes(mesh), regions);
    for (const bool held : {false, true}) {
        VertexSupport where;
        for (const std::uint8_t kind : support)
            where.kind.push_back(held && kind > 0 ? VertexSupport::Kind::fixed
                                                  : static_cast<VertexSupport::Kind>(kind));
        ImproveOptions how;
        how.tolerance = 0.1 * edge_length;
        how.good = 0.5;
        how.fit_surface = !held;
        how.hexahedra_first = true;
        how.threads = threads;
        MixedMesh moved = improve_cells(mesh, where, domain.surface().mesh, domain.features(), how);
        if (good(moved, threads) && !farther(volumes_of(cell_volumes(moved), regions), before, wanted)) return moved;
    }
    return mesh;
}

}  // namespace octafield::volume
