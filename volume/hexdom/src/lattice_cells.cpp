#include "octafield/volume/lattice_cells.hpp"

#include <algorithm>
#include <array>

#include "lattice_points.hpp"
#include "octafield/parallel.hpp"
#include "octafield/volume/mixed_mesh.hpp"

namespace octafield::volume {
namespace {

using Way = std::array<int, 3>;

// Corners of a hexahedron in the order of cell_arrays.hpp, and its faces in that of cell_face, as half-cells from its
// middle.
constexpr std::array<Way, 8> corner_way{
    {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1}, {-1, -1, 1}, {1, -1, 1}, {1, 1, 1}, {-1, 1, 1}}};
constexpr std::array<Way, 6> face_way{{{0, 0, -1}, {0, 0, 1}, {0, -1, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}};

// Starting points in general position, off the middle of a cell, in units of the map; and how far beyond a face the
// search for the surface goes.
constexpr std::array<Coordinate, 6> offsets{
    {{211, 83, 149}, {-97, 331, -53}, {157, -269, 317}, {-401, -113, 241}, {59, 47, -613}, {-37, -29, -17}}};
constexpr std::int64_t beyond = 640;

struct Cell {
    std::array<Index, 8> corners;
    WalkEnd worst = WalkEnd::reached;
    std::uint8_t on_surface = 0;
};

Coordinate ahead(Coordinate at, const Way& way, std::int64_t length) {
    for (int i = 0; i < 3; ++i) at[i] += way[i] * length;
    return at;
}

// From near the middle of a cell, in its tet, to a point in the coordinates of that tet.
Walk walk_from_middle(const MapCharts& charts, const Place& middle, const Coordinate& to) {
    Walk last{WalkEnd::edge, {}, {}};
    for (const Coordinate& offset : offsets) {
        // The tet of the starting point: from inside the middle's tet.
        const TetCoordinates corners = coordinates_of(charts.map(), middle.tet);
        Coordinate inside, from = middle.at;
        for (int i = 0; i < 3; ++i) {
            inside[i] = (corners[0][i] + corners[1][i] + corners[2][i] + corners[3][i]) / 4;
            from[i] += offset[i];
        }
        const Walk start = walk(charts, middle.tet, inside, from, to);
        if (start.end != WalkEnd::reached) continue;
        last = walk(charts, start.place.tet, start.place.at, start.carried);
        if (last.end != WalkEnd::edge) return last;
    }
    return last;
}

Cell cell_at(const MapCharts& charts, const LatticePoints& points, const Place& middle) {
    Cell cell;
    for (int c = 0; c < 8; ++c) {
        const Walk way = walk_from_middle(charts, middle, ahead(middle.at, corner_way[c], periodic_unit / 2));
        cell.corners[c] = way.end == WalkEnd::reached ? points.find(way.place) : -1;
        if (cell.corners[c] < 0 && (cell.worst == WalkEnd::reached || way.end == WalkEnd::surface))
            cell.worst = way.end == WalkEnd::reached ? WalkEnd::unusable : way.end;
    }
    if (cell.worst != WalkEnd::reached) return cell;
    for (int f = 0; f < 6; ++f) {
        const Coordinate to = ahead(middle.at, face_way[f], periodic_unit / 2 + beyond);
        if (walk_from_middle(charts, middle, to).end == WalkEnd::surface)
            cell.on_surface |= static_cast<std::uint8_t>(1 << f);
    }
    return cell;
}

bool degenerate(const Cell& cell) {
    std::array<Index, 8> sorted = cell.corners;
    std::sort(sorted.begin(), sorted.end());
    return std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end();
}

void place_points(const TetDomain& domain, const PeriodicMap& map, const LatticePoints& points, LatticeCells& result) {
    const TetMesh& mesh = domain.mesh();
    result.points.setZero(points.count(), 3);
    result.weights.resize(points.count(), 4);
    result.tet.resize(points.count());
    for (Index p = 0; p < points.count(); ++p) {
        const Place& place = points.place(p);
        const std::array<Wide, 4> weights = barycentric(coordinates_of(map, place.tet), place.at);
        const double whole = static_cast<double>(weights[0] + weights[1] + weights[2] + weights[3]);
        result.tet[p] = place.tet;
        for (int k = 0; k < 4; ++k) {
            result.weights(p, k) = static_cast<double>(weights[k]) / whole;
            result.points.row(p) += result.weights(p, k) * mesh.vertices.row(mesh.tets(place.tet, k));
        }
    }
}

}  // namespace

LatticeCells lattice_cells(const TetDomain& domain, const PeriodicMap& map, double min_scaled_jacobian, int threads) {
    const MapCharts charts(domain, map);
    const LatticePoints points(charts, 0), middles(charts, periodic_unit / 2);
    std::vector<Cell> cells(middles.count());
    parallel_for(middles.count(), threads,
                 [&](std::int64_t k) { cells[k] = cell_at(charts, points, middles.place(static_cast<Index>(k))); });
    LatticeCells result;
    place_points(domain, map, points, result);
    const auto lose = [&](const Cell& cell) {
        if (cell.worst == WalkEnd::surface) return ++result.lost.outside, true;
        if (cell.worst != WalkEnd::reached) return ++result.lost.unusable, true;
        if (degenerate(cell)) return ++result.lost.degenerate, true;
        return false;
    };
    std::erase_if(cells, lose);
    MixedMesh mesh;
    mesh.vertices = result.points;
    mesh.hexahedra.resize(static_cast<Eigen::Index>(cells.size()), 8);
    for (std::size_t k = 0; k < cells.size(); ++k)
        for (int c = 0; c < 8; ++c) mesh.hexahedra(static_cast<Eigen::Index>(k), c) = cells[k].corners[c];
    const Eigen::VectorXd quality = scaled_jacobians(mesh);
    std::vector<Index> good;
    for (Index k = 0; k < quality.size(); ++k) {
        if (!(quality[k] >= min_scaled_jacobian)) {
            ++result.lost.poor;
            continue;
        }
        good.push_back(k);
        result.on_surface.push_back(cells[k].on_surface);
    }
    result.hexahedra = mesh.hexahedra(good, Eigen::all);
    return result;
}

}  // namespace octafield::volume
