#include "wall_blocks.hpp"

#include <algorithm>
#include <map>
#include <set>

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

// Breadth first from a tet that is in no block yet.
void fill_block(const CutTets& tets, Index first, CutBlocks& blocks) {
    const double apart = far * tets.tolerance();
    std::set<int> axes;
    std::vector<Index> reached{first};
    blocks.of[first] = blocks.count;
    for (std::size_t i = 0; i < reached.size(); ++i) {
        const Index here = reached[i];
        for (int k = 0; k < 4; ++k) {
            const Index next = tets.tet(here).next[k];
            if (next < 0 || tets.tet(here).wall[k] >= 0) continue;
            const Transition chart = then(tets.over(next, tets.back(here, k)), blocks.charts[here]);
            if (blocks.of[next] < 0) {
                blocks.of[next] = blocks.count;
                blocks.charts[next] = chart;
                reached.push_back(next);
                continue;
            }
            const Transition round = then(inverse(blocks.charts[next]), chart);  // of the block's chart
            if (round.rotation.isIdentity(1e-9) && round.translation.norm() <= apart) continue;
            for (const int axis : axes_of(round, apart)) axes.insert(axis);
        }
    }
    if (!axes.empty()) blocks.windings.push_back({blocks.count, {axes.begin(), axes.end()}});
    ++blocks.count;
}

class Removal {
public:
    explicit Removal(CutTets& tets) : tets_(tets), blocks_(cut_blocks(tets)), joined_(blocks_.count) {}

    bool pass() {
        collect();
        std::sort(patches_.begin(), patches_.end(), [](const Patch& a, const Patch& b) {
            return std::pair(a.area, a.walls[0]) < std::pair(b.area, b.walls[0]);
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
        double area = 0;                             // in parameters
    };

    template <class Visit>
    void for_edges(Index wall, const Visit& visit) const {
        const auto v = tets_.triangle(tets_.walls()[wall].tet, tets_.walls()[wall].face);
        for (int k = 0; k < 3; ++k) visit(edge_key(v[k], v[(k + 1) % 3]));
    }

    double area(const WallTriangle& wall) const {
        const auto& at = tets_.tet(wall.tet).at;
        const auto& [a, b, c] = tet_face[wall.face];
        return (at[b] - at[a]).cross(at[c] - at[a]).norm() / 2;
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
                patch.area += area(walls[w]);
            }
        for (const auto& [edge, here] : at)
            if (!straight(edge, here))
                for (const Index w : here) found[sets.lowest(w)].rim.emplace_back(edge, walls[w].tet);
        patches_.clear();
        for (auto& [unused, patch] : found) patches_.push_back(std::move(patch));
    }

    bool removable(const Patch& patch) {
        const WallTriangle& first = tets_.walls()[patch.walls[0]];
        const Index beyond = tets_.tet(first.tet).next[first.face];
        if (joined_.lowest(blocks_.of[first.tet]) == joined_.lowest(blocks_.of[beyond])) return false;
        return std::all_of(patch.rim.begin(), patch.rim.end(),
                           [&](const auto& end) { return sound_without(patch, end.first, end.second); });
    }

    // No block gets an angle of more than two quarters at the edge. Walls at irregular edges of the boundary stay:
    // without them the boundary's part of the side of a box need not be a rectangle.
    bool sound_without(const Patch& patch, const EdgeKey& edge, Index tet) const {
        const bool irregular = tets_.irregular.count(edge) != 0;
        const WallsAround around = walls_around(tets_, edge, tet);
        if (!around.closed) return !irregular;
        std::vector<int> left;
        for (const auto& [wall, quarter] : around.places)
            if (!std::binary_search(patch.walls.begin(), patch.walls.end(), wall)) left.push_back(quarter);
        if (left.empty()) return !irregular;
        left.push_back(left[0] + around.quarters);
        for (std::size_t i = 0; i + 1 < left.size(); ++i)
            if (left[i + 1] - left[i] > 2) return false;
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
    for (Index first = 0; first < tets.tet_count(); ++first)
        if (result.of[first] < 0) fill_block(tets, first, result);
    return result;
}

void remove_walls(CutTets& tets) {
    Removal removal(tets);
    while (removal.pass()) {
    }
}

}  // namespace octafield::volume::detail
