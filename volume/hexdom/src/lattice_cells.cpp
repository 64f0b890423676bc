#include "octafield/volume/lattice_cells.hpp"

#include <algorithm>
#include <array>

#include "lattice_points.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {
namespace {

// Corners of a hexahedron in the order of cell_arrays.hpp, as half-cells from its middle.
constexpr std::array<std::array<int, 3>, 8> corner_way{{{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
                                                        {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}}};

using Corners = std::array<Index, 8>;

// Starting points in general position: some units off the middle.
constexpr std::array<Coordinate, 4> offsets{{{211, 83, 149}, {-97, 331, -53}, {157, -269, 317}, {-401, -113, 241}}};

Index corner_point(const MapCharts& charts, const LatticePoints& points, const Place& middle, int c) {
    Coordinate to = middle.at;
    for (int i = 0; i < 3; ++i) to[i] += corner_way[c][i] * (periodic_unit / 2);
    for (const Coordinate& offset : offsets) {
        Coordinate from = middle.at;
        for (int i = 0; i < 3; ++i) from[i] += offset[i];
        const Place near = walk(charts, middle.tet, middle.at, from);
        if (near.tet < 0) continue;
        // In the chart of the tet that `near` is in.
        Coordinate goal = to;
        Place start = near;
        if (near.tet != middle.tet) continue;
        const Index found = points.find(walk(charts, start.tet, from, goal));
        if (found >= 0) return found;
    }
    return -1;
}

}  // namespace

LatticeCells lattice_cells(const TetDomain& domain, const PeriodicMap& map, double min_scaled_jacobian, int threads) {
    const MapCharts charts(domain, map);
    const LatticePoints points(charts, 0), middles(charts, periodic_unit / 2);
    std::vector<Corners> corners(middles.count());
    parallel_for(middles.count(), threads, [&](std::int64_t k) {
        for (int c = 0; c < 8; ++c)
            corners[k][c] = corner_point(charts, points, middles.place(static_cast<Index>(k)), c);
    });
    LatticeCells result;
    std::vector<Corners> sound;
    for (const Corners& cell : corners) {
        if (std::find(cell.begin(), cell.end(), -1) != cell.end()) {
            ++result.lost.outside;
            continue;
        }
        Corners sorted = cell;
        std::sort(sorted.begin(), sorted.end());
        if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end()) {
            ++result.lost.degenerate;
            continue;
        }
        sound.push_back(cell);
    }
    const Index count = points.count();
    result.points.resize(count, 3);
    result.weights.resize(count, 4);
    result.tet.resize(count);
    for (Index p = 0; p < count; ++p) {
        const Place& place = points.place(p);
        const TetCoordinates in = coordinates_of(map, place.tet);
        const std::array<Wide, 4> weights = barycentric(in, place.at);
        const double whole = static_cast<double>(weights[0] + weights[1] + weights[2] + weights[3]);
        result.tet[p] = place.tet;
        result.points.row(p).setZero();
        for (int k = 0; k < 4; ++k) {
            result.weights(p, k) = static_cast<double>(weights[k]) / whole;
            result.points.row(p) += result.weights(p, k) * domain.mesh().vertices.row(domain.mesh().tets(place.tet, k));
        }
    }
    MixedMesh mesh;
    mesh.vertices = result.points;
    mesh.hexahedra.resize(sound.size(), 8);
    for (std::size_t k = 0; k < sound.size(); ++k)
        for (int c = 0; c < 8; ++c) mesh.hexahedra(k, c) = sound[k][c];
    const Eigen::VectorXd quality = scaled_jacobians(mesh);
    std::vector<Index> good;
    for (Index k = 0; k < quality.size(); ++k) {
        if (quality[k] >= min_scaled_jacobian)
            good.push_back(k);
        else
            ++result.lost.poor;
    }
    result.hexahedra = mesh.hexahedra(good, Eigen::all);
    return result;
}

}  // namespace octafield::volume
