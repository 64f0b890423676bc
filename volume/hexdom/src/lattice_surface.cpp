#include "lattice_surface.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "near_grid.hpp"

namespace octafield::volume {
namespace {

// Triangles of the surface by what a point of a tet lies on.
class SurfaceOfTets {
public:
    explicit SurfaceOfTets(const TetDomain& domain)
        : domain_(domain), of_row_(domain.triangles().triangles.rows(), -1), of_vertex_(domain.vertex_count(), -1) {
        const BoundarySurface& surface = domain.surface();
        for (Index f = static_cast<Index>(domain.surface_rows().size()) - 1; f >= 0; --f) {
            of_row_[domain.surface_rows()[f]] = f;
            for (int k = 0; k < 3; ++k) {
                const Index a = surface.vertex_map[surface.mesh.triangles(f, k)],
                            b = surface.vertex_map[surface.mesh.triangles(f, (k + 1) % 3)];
                of_vertex_[a] = f;
                of_edge_.push_back({std::minmax({a, b}), f});
            }
        }
        std::sort(of_edge_.begin(), of_edge_.end());
    }

    // A triangle of the surface with the point, or -1. weights: of the tet's corners.
    Index triangle(Index tet, const Eigen::RowVector4d& weights) const {
        std::array<int, 4> corner{};
        int count = 0, zero = -1;
        for (int k = 0; k < 4; ++k)
            if (weights[k] != 0)
                corner[count++] = k;
            else
                zero = k;
        if (count == 4) return -1;
        if (count == 3) return of_row_[domain_.triangles().tet_triangles(tet, zero)];
        const auto vertex = [&](int i) { return domain_.mesh().tets(tet, corner[i]); };
        if (count == 1) return of_vertex_[vertex(0)];
        const std::pair<Index, Index> edge = std::minmax({vertex(0), vertex(1)});
        const auto found = std::lower_bound(of_edge_.begin(), of_edge_.end(), std::pair(edge, Index(0)));
        return found != of_edge_.end() && found->first == edge ? found->second : -1;
    }

    Eigen::RowVector3d weights_in(Index triangle, Index tet, const Eigen::RowVector4d& weights) const {
        Eigen::RowVector3d result = Eigen::RowVector3d::Zero();
        const BoundarySurface& surface = domain_.surface();
        for (int k = 0; k < 4; ++k)
            for (int i = 0; i < 3; ++i)
                if (surface.vertex_map[surface.mesh.triangles(triangle, i)] == domain_.mesh().tets(tet, k))
                    result[i] = weights[k];
        return result;
    }

private:
    const TetDomain& domain_;
    std::vector<Index> of_row_, of_vertex_;
    std::vector<std::pair<std::pair<Index, Index>, Index>> of_edge_;
};

}  // namespace

LatticeSurface lattice_surface(const TetDomain& domain, const LatticeCells& cells, const EdgeLengths& lengths) {
    const SurfaceOfTets surface(domain);
    const Index count = static_cast<Index>(cells.points.rows());
    std::vector<Index> triangle(count);
    for (Index p = 0; p < count; ++p) triangle[p] = surface.triangle(cells.tet[p], cells.weights.row(p));
    std::vector<std::uint8_t> used(count, 0);
    for (const Index p : cells.hexahedra.reshaped()) used[p] = 1;

    LatticeSurface result;
    std::vector<Index> number(count, -1);
    const auto take = [&](Index p) {
        number[p] = static_cast<Index>(result.lattice_point.size());
        result.lattice_point.push_back(p);
    };
    NearGrids taken(lengths.shortest() / 2, lengths.longest() / 2);
    const auto half = [&](Index p) {
        return lengths.between(domain.mesh().tets.row(cells.tet[p]), cells.weights.row(p)) / 2;
    };
    for (const bool of_cells : {true, false})
        for (Index p = 0; p < count; ++p) {
            if (triangle[p] < 0 || bool(used[p]) != of_cells) continue;
            if (!of_cells && !cells.apart && taken.any(cells.points.row(p), half(p))) continue;
            take(p);
            taken.add(p, cells.points.row(p));
        }
    const Index taken_count = static_cast<Index>(result.lattice_point.size());
    result.points.triangle.resize(taken_count);
    result.points.weights.resize(taken_count, 3);
    for (Index i = 0; i < taken_count; ++i) {
        const Index p = result.lattice_point[i];
        result.points.triangle[i] = triangle[p];
        result.points.weights.row(i) = surface.weights_in(triangle[p], cells.tet[p], cells.weights.row(p));
    }
    std::vector<std::pair<std::array<Index, 4>, std::array<Index, 4>>> quads;  // sorted ids, and round the quad
    for (Index k = 0; k < cells.hexahedra.rows(); ++k)
        for (int f = 0; f < 6; ++f) {
            if (!(cells.on_surface[k] >> f & 1)) continue;
            std::array<Index, 4> quad;
            for (int c = 0; c < 4; ++c) quad[c] = number[cells.hexahedra(k, cell_face[f][c])];
            std::array<Index, 4> sorted = quad;
            std::sort(sorted.begin(), sorted.end());
            if (sorted[0] >= 0) quads.emplace_back(sorted, quad);
        }
    std::stable_sort(quads.begin(), quads.end(), [](const auto& x, const auto& y) { return x.first < y.first; });
    quads.erase(
        std::unique(quads.begin(), quads.end(), [](const auto& x, const auto& y) { return x.first == y.first; }),
        quads.end());
    result.quads.resize(static_cast<Eigen::Index>(quads.size()), 4);
    for (std::size_t q = 0; q < quads.size(); ++q)
        for (int c = 0; c < 4; ++c) result.quads(static_cast<Eigen::Index>(q), c) = quads[q].second[c];
    return result;
}

}  // namespace octafield::volume
