#include "octafield/volume/block_complex.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <functional>
#include <set>
#include <string>

#include "block_arcs.hpp"
#include "map_transitions.hpp"
#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "seen_patch.hpp"

namespace octafield::volume {
namespace {

using namespace detail;

class Assembly {
public:
    explicit Assembly(const SeamlessMap& map)
        : map_(map),
          table_(triangle_table(map.mesh)),
          charts_(block_charts(map, table_)),
          edges_(map, table_, charts_),
          chains_(edges_.chains(map.corners)) {}

    BlockComplex make() {
        result_.nodes = chains_.nodes;
        for (const auto& chain : chains_.arcs) result_.arcs.push_back({chain, {}, true, true});
        mark_arcs();
        for (const auto& rows : patches()) add_patch(rows);
        result_.tet_block = std::move(charts_.tet_block);
        result_.charts = std::move(charts_.charts);
        result_.low = std::move(charts_.low);
        result_.high = std::move(charts_.high);
        result_.block_vertices = std::move(charts_.block_vertices);
        result_.places = std::move(charts_.places);
        return std::move(result_);
    }

private:
    void mark_arcs() {
        std::set<EdgeKey> features;
        for (Index e = 0; e < map_.features.rows(); ++e)
            features.insert(edge_key(map_.features(e, 0), map_.features(e, 1)));
        for (BlockArc& arc : result_.arcs)
            for (std::size_t i = 0; i + 1 < arc.vertices.size(); ++i) {
                const EdgeKey edge = edge_key(arc.vertices[i], arc.vertices[i + 1]);
                arc.feature &= features.count(edge) != 0;
                const auto& walls = edges_.walls().at(edge);
                arc.boundary &=
                    std::any_of(walls.begin(), walls.end(), [&](Index f) { return table_.sides(f, 1) < 0; });
            }
    }

    // Walls that are joined by edges that are on no arc, by lowest row.
    std::vector<std::vector<Index>> patches() const {
        const auto& rows = charts_.wall_rows;
        const auto number = [&](Index f) {
            return static_cast<Index>(std::lower_bound(rows.begin(), rows.end(), f) - rows.begin());
        };
        DisjointSets sets(rows.size());
        for (const auto& [edge, walls] : edges_.walls())
            if (!edges_.on_arc(edge)) sets.join(number(walls[0]), number(walls[1]));
        Index count = 0;
        const std::vector<Index> of = std::move(sets).numbers(count);
        std::vector<std::vector<Index>> result(count);
        for (std::size_t i = 0; i < of.size(); ++i) result[of[i]].push_back(rows[i]);
        return result;
    }

    // The walls of a patch as what lies on one side of the first has them.
    std::vector<WallSide> seen_from(const std::vector<Index>& rows, int side) const {
        std::vector<WallSide> reached{{rows[0], side}};
        std::set<Index> known{rows[0]};
        for (std::size_t next = 0; next < reached.size(); ++next) {
            const WallSide wall = reached[next];
            for (int k = 0; k < 3; ++k) {
                const EdgeKey edge =
                    edge_key(table_.triangles(wall.triangle, k), table_.triangles(wall.triangle, (k + 1) % 3));
                if (edges_.on_arc(edge)) continue;
                const auto& both = edges_.walls().at(edge);
                const Index other = both[0] == wall.triangle ? both[1] : both[0];
                if (!known.insert(other).second) continue;
                const bool second =
                    table_.sides(other, 1) >= 0 && edges_.seen({other, 1}, edge) == edges_.seen(wall, edge);
                reached.push_back({other, second ? 1 : 0});
            }
        }
        return reached;
    }

    void add_patch(const std::vector<Index>& rows) {
        const bool boundary = table_.sides(rows[0], 1) < 0;
        const std::vector<WallSide> walls = seen_from(rows, 0);
        const SeenPatch own(table_, charts_, edges_, chains_, walls);
        BlockPatch patch;
        for (const WallSide wall : walls) patch.faces.push_back(table_.sides(wall.triangle, wall.side));
        patch.low = own.low();
        patch.high = own.high();
        for (int s = 0; s < 4; ++s) {
            patch.sides[s] = own.side(s).arcs;
            measure(own, s);
        }
        const std::array<Eigen::Vector2d, 4> corners{own.low(), Eigen::Vector2d(own.high()[0], own.low()[1]),
                                                     Eigen::Vector2d(own.low()[0], own.high()[1]), own.high()};
        PatchPlace place{own.block(), own.box_side(), {}};
        for (int c = 0; c < 4; ++c) {
            place.corners[c] = own.corner_at(corners[c]);
            patch.corners[c] = node_at(own, c);
        }
        patch.places.push_back(place);
        if (!boundary) {
            const SeenPatch other(table_, charts_, edges_, chains_, seen_from(rows, 1));
            const auto over = across(own, other, rows[0]);
            PatchPlace far{other.block(), other.box_side(), {}};
            for (int c = 0; c < 4; ++c) far.corners[c] = other.corner_at(over(corners[c]));
            patch.places.push_back(far);
        }
        result_.patches.push_back(std::move(patch));
    }

    // Isometry of the parameters of one side to those of the other, from the vertices of a wall.
    std::function<Eigen::Vector2d(const Eigen::Vector2d&)> across(const SeenPatch& own, const SeenPatch& other,
                                                                  Index row) const {
        Eigen::Matrix<double, 2, 3> a, b;
        for (int k = 0; k < 3; ++k) {
            const Index vertex = table_.triangles(row, k);
            a.col(k) = own.place(edges_.block_vertex({row, 0}, vertex));
            b.col(k) = other.place(edges_.block_vertex({row, 1}, vertex));
        }
        Eigen::Matrix2d from, to;
        from << a.col(1) - a.col(0), a.col(2) - a.col(0);
        to << b.col(1) - b.col(0), b.col(2) - b.col(0);
        const Eigen::Matrix2d turn = (to * from.inverse()).array().round().matrix();
        const Eigen::Vector2d middle = (own.low() + own.high()) / 2, there = (other.low() + other.high()) / 2;
        return
            [turn, middle, there](const Eigen::Vector2d& x) -> Eigen::Vector2d { return turn * (x - middle) + there; };
    }

    Index node_at(const SeenPatch& patch, int corner) const {
        const SeenSide& side = patch.side(corner / 2);
        const SideArc end = corner % 2 ? side.arcs.back() : side.arcs.front();
        const auto& chain = chains_.arcs[end.arc];
        return (corner % 2 == 1) == end.along ? chain.back() : chain.front();
    }

    // Parameters of the vertices of the arcs of a side, where they are not known yet.
    void measure(const SeenPatch& patch, int s) {
        const SeenSide& side = patch.side(s);
        for (std::size_t i = 0; i < side.arcs.size(); ++i) {
            BlockArc& arc = result_.arcs[side.arcs[i].arc];
            if (!arc.parameters.empty()) continue;
            const double from = patch.place(side.ends[i])[s / 2], to = patch.place(side.ends[i + 1])[s / 2];
            arc.parameters = vertex_parameters(arc, to - from);
        }
    }

    // From 0 to the length, by the parameters of the tets along the arc: edges keep their length across transitions.
    std::vector<double> vertex_parameters(const BlockArc& arc, double length) {
        std::vector<double> result{0};
        for (std::size_t i = 0; i + 1 < arc.vertices.size(); ++i) {
            const Index f = edges_.walls().at(edge_key(arc.vertices[i], arc.vertices[i + 1])).front();
            const Index tet = table_.sides(f, 0) / 4;
            result.push_back(result.back() +
                             (parameters_at(charts_.charts, tet, corner_at(map_.mesh.tets, tet, arc.vertices[i + 1])) -
                              parameters_at(charts_.charts, tet, corner_at(map_.mesh.tets, tet, arc.vertices[i])))
                                 .norm());
        }
        for (double& value : result) value *= length / result.back();
        return result;
    }

    const SeamlessMap& map_;
    TriangleTable table_;
    BlockCharts charts_;
    WallEdges edges_;
    WallEdges::Chains chains_;
    BlockComplex result_;
};

}  // namespace

BlockComplex block_complex(const SeamlessMap& map) {
    require_seamless(map);
    return Assembly(map).make();
}

}  // namespace octafield::volume
