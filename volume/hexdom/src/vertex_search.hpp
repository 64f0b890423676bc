// What the searches for hexahedra and wedges share.
#pragma once

#include <Eigen/Geometry>
#include <algorithm>

#include "cell_facets.hpp"
#include "octafield/parallel.hpp"
#include "potential_cells.hpp"

namespace octafield::volume::detail {

// Corners above a scaled Jacobian, without roots; what is at the limit passes, as it is measured again.
class CornerTest {
public:
    CornerTest(const Points& vertices, double min_scaled)
        : vertices_(vertices), square_((1 - 1e-12) * min_scaled * min_scaled) {}

    Eigen::Vector3d edge(Index from, Index to) const { return vertices_.row(to) - vertices_.row(from); }
    // Right-handed enough.
    bool corner(Index at, Index a, Index b, Index c) const {
        const Eigen::Vector3d x = edge(at, a), y = edge(at, b), z = edge(at, c);
        const double determinant = x.cross(y).dot(z);
        return determinant > 0 &&
               determinant * determinant >= square_ * x.squaredNorm() * y.squaredNorm() * z.squaredNorm();
    }
    // No corner with this angle can be good where its sine is too low already.
    bool angle(Index at, Index a, Index b) const {
        const Eigen::Vector3d x = edge(at, a), y = edge(at, b);
        return x.cross(y).squaredNorm() >= square_ * x.squaredNorm() * y.squaredNorm();
    }

private:
    const Points& vertices_;
    const double square_;
};

// visit(vertex) for vertices that are in all lists, ascending, and greater than `above`.
template <class Visit>
void for_each_common(std::span<const Index> a, std::span<const Index> b, Index above, const Visit& visit) {
    auto x = std::upper_bound(a.begin(), a.end(), above);
    auto y = std::upper_bound(b.begin(), b.end(), above);
    while (x != a.end() && y != b.end()) {
        if (*x < *y)
            ++x;
        else if (*y < *x)
            ++y;
        else {
            visit(*x);
            ++x, ++y;
        }
    }
}

// The cell, if its faces are there and enclose tets; quality(ids) is asked for only then.
template <class Quality>
void add_if_filled(const TetSearch& search, const CellShape& shape, const std::array<Index, 8>& ids,
                   const Quality& quality, PotentialCells& cells) {
    std::optional<CellFacets> facets = cell_facets(search.topology, shape, ids.data());
    InnerTets inner;
    if (!facets ||
        !find_inner_tets(search.topology, search.tets, shape, ids.data(), search.taken, search.walls, *facets, inner))
        return;
    const double found = quality(ids);
    if (!(found >= search.min_quality)) return;
    cells.ids.push_back(ids);
    cells.quality.push_back(found);
    unsigned pairs = 0;
    for (std::size_t f = 0; f < shape.faces.size(); ++f) pairs |= unsigned((*facets)[f].inner) << f;
    cells.inner_pairs.push_back(static_cast<std::uint8_t>(pairs));
    cells.tets.insert(cells.tets.end(), inner.tets.begin(), inner.tets.begin() + inner.count);
    cells.tet_start.push_back(static_cast<Index>(cells.tets.size()));
}

// Cells of all vertices; find(vertex, cells) appends those whose lowest vertex it is.
template <class Finder>
PotentialCells search_vertices(const TetSearch& search) {
    constexpr Index block = 256;
    const Index vertices = static_cast<Index>(search.vertices.rows());
    std::vector<PotentialCells> parts(vertices / block + 1);
    parallel_for(
        static_cast<std::int64_t>(parts.size()), search.threads,
        [&](std::int64_t part) {
            Finder finder(search, parts[part]);
            const Index first = static_cast<Index>(part) * block;
            for (Index v = first; v < std::min(vertices, first + block); ++v) finder.find(v);
        },
        1);
    PotentialCells all;
    for (PotentialCells& part : parts) {
        const Index offset = static_cast<Index>(all.tets.size());
        all.ids.insert(all.ids.end(), part.ids.begin(), part.ids.end());
        all.quality.insert(all.quality.end(), part.quality.begin(), part.quality.end());
        all.inner_pairs.insert(all.inner_pairs.end(), part.inner_pairs.begin(), part.inner_pairs.end());
        all.tets.insert(all.tets.end(), part.tets.begin(), part.tets.end());
        for (Index c = 0; c < part.count(); ++c) all.tet_start.push_back(offset + part.tet_start[c + 1]);
        part = {};
    }
    return all;
}

}  // namespace octafield::volume::detail
