#include <algorithm>
#include <cmath>
#include <string>

#include "grid_points.hpp"
#include "octafield/error.hpp"
#include "octafield/volume/all_hex.hpp"
#include "simplex_search.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

// Points of the grid of a block, with their places in its chart.
struct Lattice {
    Vector3i size;
    std::vector<Index> points;
    std::vector<Eigen::Vector3d> places;

    explicit Lattice(const Vector3i& edges) : size(edges) {
        const auto count = static_cast<std::size_t>((size.array() + 1).cast<std::size_t>().prod());
        points.assign(count, -1);
        places.resize(count);
    }
    std::size_t at(int i, int j, int k) const {
        return (static_cast<std::size_t>(i) * (size[1] + 1) + j) * (size[2] + 1) + k;
    }
};

void put(Lattice& lattice, const BlockComplex& blocks, const BlockGrids& grids, const BlockPatch& patch,
         const PatchPlace& place, const PatchGrid& grid, GridPoints& points) {
    const Vector3i origin = grids.places.at(place.corners[0]);
    const Eigen::Vector3d corner = blocks.places[place.corners[0]];
    std::array<Vector3i, 2> step;
    std::array<Eigen::Vector3d, 2> way;
    for (int d = 0; d < 2; ++d) {
        step[d] = (grids.places.at(place.corners[1 + d]) - origin) / std::max(grid.size[d], 1);
        way[d] = (blocks.places[place.corners[1 + d]] - corner) / (patch.high[d] - patch.low[d]);
    }
    for (int i = 0; i <= grid.size[0]; ++i)
        for (int j = 0; j <= grid.size[1]; ++j) {
            const Vector3i at = origin + i * step[0] + j * step[1];
            const std::size_t entry = lattice.at(at[0], at[1], at[2]);
            const Index point = grid.points[grid.at(i, j)];
            if (lattice.points[entry] < 0)
                lattice.points[entry] = point;
            else
                points.join(lattice.points[entry], point);
            const Eigen::Vector2d inside = grid.places[grid.at(i, j)] - patch.low;
            lattice.places[entry] = corner + inside[0] * way[0] + inside[1] * way[1];
        }
}

// Between the sides of the block's box: those of faces, less those of edges, and those of corners.
Eigen::Vector3d transfinite(const Lattice& lattice, const Vector3i& at) {
    const Eigen::Vector3d part = at.cast<double>().cwiseQuotient(lattice.size.cast<double>());
    Eigen::Vector3d sum = Eigen::Vector3d::Zero();
    for (int which = 1; which < 8; ++which) {  // the parameters that are taken from the ends of the box
        const int taken = (which & 1) + (which >> 1 & 1) + (which >> 2 & 1);
        for (int ends = 0; ends < 8; ++ends) {
            if (ends & ~which) continue;
            double weight = taken == 2 ? -1 : 1;
            Vector3i from = at;
            for (int i = 0; i < 3; ++i) {
                if (!(which >> i & 1)) continue;
                const bool high = ends >> i & 1;
                weight *= high ? part[i] : 1 - part[i];
                from[i] = high ? lattice.size[i] : 0;
            }
            sum += weight * lattice.places[lattice.at(from[0], from[1], from[2])];
        }
    }
    return sum;
}

class Fill {
public:
    Fill(const SeamlessMap& map, const BlockComplex& blocks, GridPoints& points)
        : map_(map), blocks_(blocks), points_(points), tets_(blocks.block_count()) {
        for (Index t = 0; t < map.mesh.tets.rows(); ++t) tets_[blocks.tet_block[t]].push_back(t);
    }

    // Points inside the block.
    void operator()(Lattice& lattice, Index block) {
        const Vector3i& size = lattice.size;
        if (size.minCoeff() < 2) return;
        std::vector<SimplexSearch<3>::Simplex> simplices;
        for (const Index t : tets_[block]) {
            SimplexSearch<3>::Simplex tet;
            for (int k = 0; k < 4; ++k) tet[k] = blocks_.places[blocks_.block_vertices(t, k)];
            simplices.push_back(tet);
        }
        const SimplexSearch<3> search(std::move(simplices));
        const Eigen::Vector3d low = blocks_.low.row(block).transpose(), high = blocks_.high.row(block).transpose();
        for (int i = 1; i < size[0]; ++i)
            for (int j = 1; j < size[1]; ++j)
                for (int k = 1; k < size[2]; ++k) {
                    const auto found = search.find(transfinite(lattice, {i, j, k}).cwiseMax(low).cwiseMin(high));
                    const Index tet = tets_[block][found.simplex];
                    Eigen::Vector3d at = Eigen::Vector3d::Zero();
                    for (int c = 0; c < 4; ++c)
                        at += found.weights[c] * map_.mesh.vertices.row(map_.mesh.tets(tet, c)).transpose();
                    lattice.points[lattice.at(i, j, k)] = points_.add(at, 0, PointOf::block);
                }
    }

private:
    const SeamlessMap& map_;
    const BlockComplex& blocks_;
    GridPoints& points_;
    std::vector<std::vector<Index>> tets_;
};

void add_cells(const Lattice& lattice, std::vector<std::array<Index, 8>>& cells) {
    const auto& p = lattice.points;
    for (int i = 0; i < lattice.size[0]; ++i)
        for (int j = 0; j < lattice.size[1]; ++j)
            for (int k = 0; k < lattice.size[2]; ++k)
                cells.push_back({p[lattice.at(i, j, k)], p[lattice.at(i + 1, j, k)], p[lattice.at(i + 1, j + 1, k)],
                                 p[lattice.at(i, j + 1, k)], p[lattice.at(i, j, k + 1)], p[lattice.at(i + 1, j, k + 1)],
                                 p[lattice.at(i + 1, j + 1, k + 1)], p[lattice.at(i, j + 1, k + 1)]});
}

}  // namespace

BlockHexahedra block_hexahedra(const SeamlessMap& map, const BlockComplex& blocks, const std::vector<int>& numbers) {
    if (numbers.size() != blocks.arcs.size())
        throw InvalidInput("numbers: " + std::to_string(numbers.size()) + " for " + std::to_string(blocks.arcs.size()) +
                               " arcs; give one for each",
                           "wrong_size");
    const auto below = std::find_if(numbers.begin(), numbers.end(), [](int n) { return n < 0; });
    if (below != numbers.end())
        throw InvalidInput("numbers: arc " + std::to_string(below - numbers.begin()) + " has fewer than 0 edges",
                           "wrong_size", {static_cast<Index>(below - numbers.begin())});
    const BlockGrids grids = block_grids(blocks, numbers);
    GridPoints points;
    PatchGrids patch_grids(map, blocks, numbers, points);
    std::vector<Lattice> lattices(grids.sizes.begin(), grids.sizes.end());
    for (const BlockPatch& patch : blocks.patches) {
        const PatchGrid grid = patch_grids.grid(patch);
        for (const PatchPlace& place : patch.places)
            put(lattices[place.block], blocks, grids, patch, place, grid, points);
    }
    Fill fill(map, blocks, points);
    std::vector<std::array<Index, 8>> cells;
    std::vector<Index> of_blocks;
    for (Index b = 0; b < blocks.block_count(); ++b) {
        const Vector3i& size = lattices[b].size;
        for (std::size_t e = 0; e < lattices[b].points.size(); ++e) {
            const auto k = static_cast<int>(e % (size[2] + 1)), j = static_cast<int>(e / (size[2] + 1) % (size[1] + 1));
            const auto i = static_cast<int>(e / (size[2] + 1) / (size[1] + 1));
            const bool inside = i % std::max(size[0], 1) && j % std::max(size[1], 1) && k % std::max(size[2], 1);
            if (!inside && lattices[b].points[e] < 0)
                throw GeometryError("the patches of block " + std::to_string(b) + " do not cover its sides",
                                    "not_a_box", {b});
        }
        fill(lattices[b], b);
        add_cells(lattices[b], cells);
        of_blocks.resize(cells.size(), b);
    }
    return points.mesh(cells, std::move(of_blocks));
}

}  // namespace octafield::volume
