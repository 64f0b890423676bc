#include "block_charts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "map_transitions.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double near = 1e-6;  // of the extent of a block's box

// Rows of the table that are walls, ascending: those of the map, and the boundary.
std::vector<Index> rows_of_walls(const SeamlessMap& map, const TriangleTable& table, std::vector<char>& is_wall) {
    const TriangleRows find(table);
    std::vector<Index> rows, unknown;
    is_wall.assign(table.triangles.rows(), 0);
    for (Index f = 0; f < table.triangles.rows(); ++f) is_wall[f] = table.sides(f, 1) < 0;
    for (Index w = 0; w < map.walls.rows(); ++w) {
        const Index row = find({map.walls(w, 0), map.walls(w, 1), map.walls(w, 2)});
        if (row < 0)
            unknown.push_back(w);
        else
            is_wall[row] = 1;
    }
    if (!unknown.empty())
        throw InvalidInput("walls " + first_few(unknown) + " are no triangles of the mesh; give its vertex ids",
                           "index_out_of_range", unknown);
    for (Index f = 0; f < table.triangles.rows(); ++f)
        if (is_wall[f]) rows.push_back(f);
    return rows;
}

class Filler {
public:
    Filler(const SeamlessMap& map, const TriangleTable& table, const std::vector<char>& is_wall, BlockCharts& result)
        : map_(map), table_(table), is_wall_(is_wall), result_(result), sets_(4 * map.mesh.tets.rows()) {
        result_.tet_block.assign(map.mesh.tets.rows(), -1);
        result_.charts.resize(map.mesh.tets.rows(), 12);
    }

    void fill() {
        Index blocks = 0;
        for (Index t = 0; t < map_.mesh.tets.rows(); ++t)
            if (result_.tet_block[t] < 0) fill_block(t, blocks++);
        number_vertices();
        bound(blocks);
    }

private:
    // Breadth first, so that few transitions lie between a tet and the first one.
    void fill_block(Index first, Index block) {
        std::vector<Index> reached{first};
        result_.tet_block[first] = block;
        result_.charts.row(first) = map_.parameters.row(first);
        for (std::size_t next = 0; next < reached.size(); ++next) {
            const Index tet = reached[next];
            for (int k = 0; k < 4; ++k) {
                const Index f = table_.tet_triangles(tet, k);
                if (is_wall_[f]) continue;
                const int side = table_.sides(f, 0) / 4 == tet ? 0 : 1;
                const Index other = table_.sides(f, 1 - side) / 4;
                for (int j = 0; j < 3; ++j)
                    sets_.join(4 * tet + corner_at(map_.mesh.tets, tet, table_.triangles(f, j)),
                               4 * other + corner_at(map_.mesh.tets, other, table_.triangles(f, j)));
                if (result_.tet_block[other] >= 0) continue;
                const Transition over =
                    transition(triangle_parameters(map_.parameters, map_.mesh.tets, table_, f, 1 - side),
                               triangle_parameters(result_.charts, map_.mesh.tets, table_, f, side));
                for (int c = 0; c < 4; ++c)
                    result_.charts.block<1, 3>(other, 3 * c) =
                        over(parameters_at(map_.parameters, other, c)).transpose();
                result_.tet_block[other] = block;
                reached.push_back(other);
            }
        }
    }

    // A vertex of a block has one place, or the block goes round a singular curve.
    void number_vertices() {
        Index count = 0;
        const std::vector<Index> numbers = std::move(sets_).numbers(count);
        result_.block_vertices.resize(map_.mesh.tets.rows(), 4);
        result_.places.assign(count, Eigen::Vector3d::Constant(std::nan("")));
        std::vector<Index> wound;
        for (Index t = 0; t < map_.mesh.tets.rows(); ++t)
            for (int k = 0; k < 4; ++k) {
                const Index v = result_.block_vertices(t, k) = numbers[4 * t + k];
                const Eigen::Vector3d here = parameters_at(result_.charts, t, k);
                if (!result_.places[v].allFinite())
                    result_.places[v] = here;
                else if ((result_.places[v] - here).norm() > near * extent(result_.charts, t))
                    wound.push_back(result_.tet_block[t]);
            }
        if (wound.empty()) return;
        std::sort(wound.begin(), wound.end());
        wound.erase(std::unique(wound.begin(), wound.end()), wound.end());
        throw GeometryError("blocks " + first_few(wound) +
                                " go round a singular curve: walls are missing; give the whole motorcycle complex",
                            "not_a_box", wound);
    }

    void bound(Index blocks) {
        result_.low = Rows<double, 3>::Constant(blocks, 3, std::numeric_limits<double>::infinity());
        result_.high = -result_.low;
        for (Index t = 0; t < map_.mesh.tets.rows(); ++t)
            for (int k = 0; k < 4; ++k) {
                const Index b = result_.tet_block[t];
                result_.low.row(b) = result_.low.row(b).cwiseMin(result_.charts.block<1, 3>(t, 3 * k));
                result_.high.row(b) = result_.high.row(b).cwiseMax(result_.charts.block<1, 3>(t, 3 * k));
            }
    }

    const SeamlessMap& map_;
    const TriangleTable& table_;
    const std::vector<char>& is_wall_;
    BlockCharts& result_;
    DisjointSets sets_;
};

// Side of its block's box that a wall lies in; -1: in none. Its normal decides: thin triangles are near two sides.
int side_of(const BlockCharts& charts, Index block, const std::array<Eigen::Vector3d, 3>& triangle) {
    const Eigen::Vector3d low = charts.low.row(block).transpose(), high = charts.high.row(block).transpose();
    const double tolerance = near * (high - low).maxCoeff();
    int axis = 0;
    (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).cwiseAbs().maxCoeff(&axis);
    for (int end = 0; end < 2; ++end) {
        const double at = end ? high[axis] : low[axis];
        bool inside = true;
        for (const auto& point : triangle) inside &= std::abs(point[axis] - at) < tolerance;
        if (inside) return 2 * axis + end;
    }
    return -1;
}

}  // namespace

BlockCharts block_charts(const SeamlessMap& map, const TriangleTable& table) {
    BlockCharts result;
    std::vector<char> is_wall;
    result.wall_rows = rows_of_walls(map, table, is_wall);
    Filler(map, table, is_wall, result).fill();
    result.wall_sides.assign(table.triangles.rows(), {-1, -1});
    std::vector<Index> bent;
    for (const Index f : result.wall_rows)
        for (int side = 0; side < 2 && table.sides(f, side) >= 0; ++side) {
            const Index tet = table.sides(f, side) / 4;
            const int found = side_of(result, result.tet_block[tet],
                                      triangle_parameters(result.charts, map.mesh.tets, table, f, side));
            result.wall_sides[f][side] = static_cast<std::int8_t>(found);
            if (found < 0) bent.push_back(tet);
        }
    if (!bent.empty())
        throw GeometryError("walls at tets " + first_few(bent) +
                                " do not lie in a side of the box of their block: walls are missing, or bend",
                            "bent_wall", bent);
    return result;
}

}  // namespace octafield::volume::detail
