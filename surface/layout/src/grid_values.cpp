#include "grid_values.hpp"

#include <map>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"

namespace octafield::surface::detail {
namespace {

constexpr double same_place = 1e-9;

using Place = std::array<GridValue, 2>;

Place fixed_place(const GridPoint& at) { return {GridValue{-1, 1, at[0]}, GridValue{-1, 1, at[1]}}; }

Place moved(const QuarterTurn& turn, Place place) {
    for (int i = 0; i < turn.quarters; ++i) {
        std::swap(place[0], place[1]);
        if (place[0].value >= 0) place[0].sign = -place[0].sign;
        place[0].offset = -place[0].offset;
    }
    for (int k = 0; k < 2; ++k) place[k].offset += turn.shift[k];
    return place;
}

class Numbering {
public:
    explicit Numbering(const ChartedMesh& mesh) : mesh_(mesh), on_seam_(mesh.positions.size()) {
        for (Index s = 0; s < mesh.side_count(); ++s) {
            const Index twin = mesh.on_seams[s].twin;
            if (twin < 0) continue;
            on_seam_.join(mesh.from(s), mesh.from(ChartedMesh::next(twin)));
            on_seam_.join(mesh.from(ChartedMesh::next(s)), mesh.from(twin));
        }
        choose_fixed();
    }

    GridValues values() && {
        result_.corners.resize(mesh_.side_count());
        result_.freedom.assign(mesh_.positions.size(), 0);
        std::vector<bool> done(mesh_.positions.size(), false);
        for (Index c = 0; c < mesh_.side_count(); ++c) {
            if (done[mesh_.from(c)]) continue;
            done[mesh_.from(c)] = true;
            go_round(mesh_.corners_round(c));
        }
        return std::move(result_);
    }

private:
    // Points inside; of a closed surface without any, a vertex, as nothing else holds the map.
    void choose_fixed() {
        DisjointSets parts(mesh_.triangles.size());
        for (Index s = 0; s < mesh_.side_count(); ++s)
            if (mesh_.mates[s] >= 0) parts.join(s / 3, mesh_.mates[s] / 3);
        std::vector<bool> held(mesh_.triangles.size(), false);
        for (Index s = 0; s < mesh_.side_count(); ++s)
            if (mesh_.mates[s] < 0) held[parts.lowest(s / 3)] = true;
        for (const auto& f : mesh_.fixed) {
            if (!f.singular) continue;
            held[parts.lowest(f.corner / 3)] = true;
            fixed_[mesh_.from(f.corner)] = &f;
        }
        for (const auto& f : mesh_.fixed) {
            const Index part = parts.lowest(f.corner / 3);
            if (held[part]) continue;
            held[part] = true;
            fixed_[mesh_.from(f.corner)] = &f;
        }
    }

    // At one end of a side on a seam.
    Place on_line(const ChartedMesh::OnSeam& on, bool end) {
        const auto& seam = mesh_.seams[on.seam];
        const double at = end ? on.to : on.from, apart = same_place * seam.length;
        const bool first = at<apart, last = at> seam.length - apart;
        if (!seam.closed && (first || last)) return fixed_place(on.line.point(first ? 0 : seam.count));
        const GridPoint start = on.line.point(last ? seam.count : 0);
        Place place = fixed_place(start);
        const int axis = on.line.way[0] == 0;
        place[axis].value = seam_value_;
        place[axis].sign = on.line.way[axis];
        return place;
    }

    void go_round(const std::vector<Index>& corners) {
        const Index vertex = mesh_.from(corners[0]);
        std::vector<QuarterTurn> frames = {{}};
        for (std::size_t i = 0; i + 1 < corners.size(); ++i)
            frames.push_back(mesh_.across[ChartedMesh::before(corners[i])].after(frames.back()));
        const Index last = ChartedMesh::before(corners.back());
        Place place;
        if (mesh_.mates[last] < 0) {
            const auto [found, is_new] = value_of_seam_vertex_.emplace(on_seam_.lowest(vertex), result_.count);
            seam_value_ = found->second;
            place = on_line(mesh_.on_seams[corners[0]], false);
            const bool free = place[0].value >= 0 || place[1].value >= 0;
            if (is_new && free) ++result_.count;
            if (is_new && !free) value_of_seam_vertex_.erase(found);
            result_.freedom[vertex] = free;
            require(moved(frames.back(), place) == on_line(mesh_.on_seams[last], true), vertex);
        } else if (const auto found = fixed_.find(vertex); found != fixed_.end()) {
            for (std::size_t i = 0; i < corners.size(); ++i)
                if (corners[i] == found->second->corner) place = fixed_place(frames[i].inverse()(found->second->at));
            require(moved(mesh_.across[last].after(frames.back()), place) == place, vertex);
        } else {
            require(mesh_.across[last].after(frames.back()) == QuarterTurn{}, vertex);
            place = {GridValue{result_.count, 1, 0}, GridValue{result_.count + 1, 1, 0}};
            result_.count += 2;
            result_.freedom[vertex] = 2;
        }
        for (std::size_t i = 0; i < corners.size(); ++i) result_.corners[corners[i]] = moved(frames[i], place);
    }

    static void require(bool fits, Index vertex) {
        if (!fits)
            throw GeometryError("whole numbers do not fit round vertex " + std::to_string(vertex), "bad_subdivision",
                                {vertex});
    }

    const ChartedMesh& mesh_;
    DisjointSets on_seam_;
    std::map<Index, const ChartedMesh::Fixed*> fixed_;
    std::map<Index, Index> value_of_seam_vertex_;
    Index seam_value_ = -1;
    GridValues result_;
};

}  // namespace

Eigen::VectorXd values_at(const GridValues& values, const std::vector<Vector2>& places) {
    Eigen::VectorXd sums = Eigen::VectorXd::Zero(values.count), uses = sums;
    for (std::size_t c = 0; c < places.size(); ++c)
        for (int k = 0; k < 2; ++k) {
            const GridValue& v = values.corners[c][k];
            if (v.value < 0) continue;
            sums[v.value] += v.sign * (places[c][k] - v.offset);
            uses[v.value] += 1;
        }
    return sums.cwiseQuotient(uses);
}

GridValues grid_values(const ChartedMesh& mesh) { return Numbering(mesh).values(); }

}  // namespace octafield::surface::detail
