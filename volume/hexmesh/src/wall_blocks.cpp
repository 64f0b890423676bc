#include "wall_blocks.hpp"

#include <algorithm>
#include <map>

#include "octafield/disjoint_sets.hpp"

namespace octafield::volume::detail {
namespace {

constexpr double far = 1000;  // tolerances; what a vertex is away from itself after a way round is no rounding

Transition then(const Transition& first, const Transition& second) {
    return {second.rotation * first.rotation, second.rotation * first.translation + second.translation, 0};
}

Transition inverse(const Transition& t) {
    return {t.rotation.transpose(), -(t.rotation.transpose() * t.translation), 0};
}

// Axes along which the way round leads: that of its turn, or those of its translation.
std::vector<int> axes_of(const Transition& way, double tolerance) {
    std::vector<int> result;
    for (int i = 0; i < 3; ++i)
        if (way.rotation(i, i) > 0.5 && std::abs(way.translation[i]) > tolerance) result.push_back(i);
    if (!result.empty()) return result;
    int axis = 0;
    way.translation.cwiseAbs().maxCoeff(&axis);
    return {axis};
}

class Removal {
public:
    explicit Removal(CutTets& tets) : tets_(tets), blocks_(cut_blocks(tets)), joined_(blocks_.count) {}

    bool pass() {
        collect();
        std::sort(patches_.begin(), patches_.end(), [](const Patch& a, const Patch& b) {
            return std::pair(-a.distance, a.walls[0]) < std::pair(-b.distance, b.walls[0]);
        });
        bool any = false;
        for (const Patch& patch : patches_)
            if (removable(patch)) {
                remove(patch);
                any = true;
            }
        return any;
    }

private:
    struct Patch {
        std::vector<Index> walls;
        std::vector<std::pair<EdgeKey, Index>> rim;  // edges on arcs, with a tet there
        double distance = 0;
    };

    template <class Visit>
    void for_edges(Index wall, const Visit& visit) const {
        const auto v = tets_.triangle(tets_.walls()[wall].tet, tets_.walls()[wall].face);
        for (int k = 0; k < 3; ++k) visit(edge_key(v[k], v[(k + 1) % 3]));
    }

    // Walls that are joined by edges where they go straight on and no other wall is.
    void collect() {
        std::map<EdgeKey, std::vector<Index>> at;
        const auto& walls = tets_.walls();
        for (Index w = 0; w < static_cast<Index>(walls.size()); ++w)
            if (walls[w].kept) for_edges(w, [&](const EdgeKey& edge) { at[edge].push_back(w); });
        const auto straight = [&](const EdgeKey& edge, const std::vector<Index>& here) {
            return here.size() == 2 && !tets_.irregular.count(edge);
        };
        DisjointSets sets(walls.size());
        for (const auto& [edge, here] : at)
            if (straight(edge, here)) sets.join(here[0], here[1]);
        std::map<Index, Patch> found;
        for (Index w = 0; w < static_cast<Index>(walls.size()); ++w)
            if (walls[w].kept) {
                Patch& patch = found[sets.lowest(w)];
                patch.walls.push_back(w);
                patch.distance = std::max(patch.distance, distance_to_source(tets_, w));
            }
        for (const auto& [edge, here] : at)
            if (!straight(edge, here))
                for (const Index w : here) found[sets.lowest(w)].rim.emplace_back(edge, walls[w].tet);
        patches_.clear();
        if (getenv("DBGW"))
            for (const auto& [edge, here] : at) {
                const WallsAround around = walls_around(tets_, edge, walls[here[0]].tet);
                std::array<int, 5> n{};
                for (const auto& [wall, quarter] : around.places) ++n[quarter];
                bool bad = false;
                for (int i = 0; i < 5; ++i) bad |= n[i] > 1;
                if (around.closed && !tets_.irregular.count(edge)) {
                    for (int i = 0; i < 4; ++i)
                        bad |= n[i] && !n[(i + 2) % 4] && !(n[(i + 1) % 4] && n[(i + 3) % 4]);
                    bad |= around.quarters != 4;
                }
                if (!around.closed && !tets_.irregular.count(edge)) bad |= around.quarters != 2 || here.size() != 1;
                if (tets_.irregular.count(edge)) bad |= (int)here.size() != around.quarters-(around.closed?0:1);
                if (bad) {
                    fprintf(stderr, "edge %d %d closed %d quarters %d irr %d:", edge[0], edge[1], around.closed, around.quarters,
                            (int)tets_.irregular.count(edge));
                    for (const auto& [wall, quarter] : around.places) fprintf(stderr, " %d@%d", wall, quarter);
                    const auto& T=tets_.tet(walls[here[0]].tet);
                    auto P=T.at[T.corner(edge[0])],Q=T.at[T.corner(edge[1])];
                    fprintf(stderr, "  %.12g %.12g %.12g - %.12g %.12g %.12g tol %g\n",P[0],P[1],P[2],Q[0],Q[1],Q[2],tets_.tolerance());
                }
            }
        for (auto& [unused, patch] : found) patches_.push_back(std::move(patch));
    }

    bool removable(const Patch& patch) {
        const WallTriangle& first = tets_.walls()[patch.walls[0]];
        const Index beyond = tets_.tet(first.tet).next[first.face];
        if (joined_.lowest(blocks_.of[first.tet]) == joined_.lowest(blocks_.of[beyond])) return false;
        return std::all_of(patch.rim.begin(), patch.rim.end(),
                           [&](const auto& end) { return sound_without(patch, end.first, end.second); });
    }

    // Each wall that is left at the edge goes straight on or ends at one that does.
    bool sound_without(const Patch& patch, const EdgeKey& edge, Index tet) const {
        if (tets_.irregular.count(edge)) return false;
        const WallsAround around = walls_around(tets_, edge, tet);
        if (!around.closed) return true;
        std::array<bool, 4> left{};
        for (const auto& [wall, quarter] : around.places)
            if (!std::binary_search(patch.walls.begin(), patch.walls.end(), wall)) left[quarter % 4] = true;
        for (int i = 0; i < 4; ++i)
            if (left[i] && !left[(i + 2) % 4] && !(left[(i + 1) % 4] && left[(i + 3) % 4])) return false;
        return true;
    }

    void remove(const Patch& patch) {
        const WallTriangle first = tets_.walls()[patch.walls[0]];
        joined_.join(blocks_.of[first.tet], blocks_.of[tets_.tet(first.tet).next[first.face]]);
        for (const Index wall : patch.walls) tets_.remove_wall(wall);
    }

    CutTets& tets_;
    CutBlocks blocks_;
    DisjointSets joined_;
    std::vector<Patch> patches_;
};

}  // namespace

CutBlocks cut_blocks(const CutTets& tets) {
    CutBlocks result;
    result.of.assign(tets.tet_count(), -1);
    result.charts.resize(tets.tet_count());
    auto& charts = result.charts;
    const double apart = far * tets.tolerance();
    for (Index first = 0; first < tets.tet_count(); ++first) {
        if (result.of[first] >= 0) continue;
        std::vector<Index> reached{first};
        result.of[first] = result.count;
        bool winds = false;
        for (std::size_t i = 0; i < reached.size(); ++i) {
            const Index here = reached[i];
            const CutTet& tet = tets.tet(here);
            for (int k = 0; k < 4; ++k) {
                if (tet.next[k] < 0 || tet.wall[k] >= 0) continue;
                const Index next = tet.next[k];
                const Transition chart = then(tets.over(next, tets.back(here, k)), charts[here]);
                if (result.of[next] < 0) {
                    result.of[next] = result.count;
                    charts[next] = chart;
                    reached.push_back(next);
                    continue;
                }
                if (winds) continue;
                const Transition round = then(inverse(charts[next]), chart);  // of the block's parameters
                const Eigen::Vector3d moved = round.rotation * charts[next](tets.tet(next).at[0]) + round.translation;
                if (!round.rotation.isIdentity(1e-9) || (moved - charts[next](tets.tet(next).at[0])).norm() > apart) {
                    winds = true;
                    result.windings.push_back({result.count, axes_of(round, apart)});
                }
            }
        }
        ++result.count;
    }
    return result;
}

void remove_walls(CutTets& tets) {
    Removal removal(tets);
    while (removal.pass()) {
    }
}

}  // namespace octafield::volume::detail
