#include "zero_arcs.hpp"

#include <algorithm>
#include <map>
#include <set>

#include "quad_rows.hpp"

namespace octafield::surface::detail {
namespace {

// Places of vertices of quads, as long as no two are one: vertices of the layout inside the surface, stops of seams,
// and what lies between them.
class Places {
public:
    Places(const QuadLayout& layout, const Seams& seams, const std::vector<int>& counts,
           const std::vector<int>& part_counts)
        : layout_(layout), seams_(seams), counts_(counts), part_counts_(part_counts) {
        add_seams();
        add_arcs();
        for (const LayoutPatch& patch : layout.patches) add_patch(patch);
    }

    std::vector<std::vector<Index>> wrong() const {
        std::vector<std::vector<Index>> result;
        std::set<std::vector<Index>> known;
        for (const auto& [place, what] : held_) {
            std::vector<Index> way = way_to_wrong(place, what);
            if (!way.empty() && known.insert(way).second) result.push_back(std::move(way));
        }
        return result;
    }

private:
    // Of one vertex of the mesh: a node of seams, or a singular point inside; or the inside of a seam.
    struct Held {
        Index node = -1, point = -1, seam = -1;
    };
    struct Link {
        Index to;
        std::vector<Index> length;  // arcs and parts that it is as long as
    };

    Index add_place() {
        links_.emplace_back();
        return static_cast<Index>(links_.size() - 1);
    }
    void link(Index a, Index b, const std::vector<Index>& length) {
        if (a == b) return;
        links_[a].push_back({b, length});
        links_[b].push_back({a, length});
    }
    void add_seams();
    void add_arcs();
    void add_patch(const LayoutPatch& patch);
    std::vector<Index> along(const std::vector<DirectedSide>& sides) const;
    bool are_wrong(const Held& a, const Held& b) const;
    std::vector<Index> way_to_wrong(Index from, const Held& what) const;

    const QuadLayout& layout_;
    const Seams& seams_;
    const std::vector<int>&counts_, &part_counts_;
    std::vector<std::vector<Link>> links_;
    std::map<Index, Held> held_;                   // by place
    std::vector<std::vector<Index>> seam_places_;  // by whole numbers along each
    std::vector<std::vector<Index>> seam_stops_;   // by stop
    std::vector<Index> place_of_;                  // vertex of the layout
    std::vector<std::vector<Index>> arc_places_;   // from end to end
};

void Places::add_seams() {
    const auto arcs = static_cast<Index>(layout_.sides.size());
    place_of_.assign(layout_.vertices.size(), -1);
    std::map<Index, Index> first_of_node;
    for (Index s = 0; s < static_cast<Index>(seams_.seams.size()); ++s) {
        const Seam& seam = seams_.seams[s];
        std::vector<Index> stops, places;
        for (std::size_t i = 0; i < seam.stops.size(); ++i) {
            const bool again = seam.closed && i + 1 == seam.stops.size();
            const Index place = again ? stops[0] : add_place();
            stops.push_back(place);
            for (const Index v : seam.stops[i].vertices) place_of_[v] = place;
            if (const Index node = seam.stops[i].node; node >= 0) {
                held_[place] = {node, -1, -1};
                link(place, first_of_node.emplace(node, place).first->second, {});
            } else {
                held_[place] = {-1, -1, s};
            }
            if (i == 0) {
                places.push_back(place);
                continue;
            }
            const Index part = seam.first_part + static_cast<Index>(i) - 1;
            for (int k = 1; k < part_counts_[part]; ++k) {
                places.push_back(add_place());
                held_[places.back()] = {-1, -1, s};
            }
            if (part_counts_[part] > 0) {
                places.push_back(place);
            } else {
                link(stops[i - 1], place, {arcs + part});
            }
        }
        if (seam.closed) places.back() = places.front();
        seam_stops_.push_back(std::move(stops));
        seam_places_.push_back(std::move(places));
    }
    for (std::size_t v = 0; v < place_of_.size(); ++v) {
        if (place_of_[v] >= 0) continue;
        place_of_[v] = add_place();
        if (layout_.vertices[v].index_times_four != 0) held_[place_of_[v]] = {-1, static_cast<Index>(v), -1};
    }
}

void Places::add_arcs() {
    std::vector<std::vector<int>> at_stop;
    for (const Seam& seam : seams_.seams) {
        at_stop.push_back({0});
        for (Index i = 0; i < seam.part_count(); ++i)
            at_stop.back().push_back(at_stop.back().back() + part_counts_[seam.first_part + i]);
    }
    for (Index a = 0; a < static_cast<Index>(layout_.sides.size()); ++a) {
        const LayoutSide& side = layout_.sides[a];
        std::vector<Index> places = {place_of_[side.first]};
        if (seams_.uses[a].empty()) {
            for (int k = 1; k < counts_[a]; ++k) places.push_back(add_place());
        } else {
            for (const SeamUse& use : seams_.uses[a]) {
                const Index i = use.part - seams_.seams[use.seam].first_part;
                const int low = at_stop[use.seam][i], high = at_stop[use.seam][i + 1];
                for (int k = low + 1; k <= high; ++k)
                    places.push_back(seam_places_[use.seam][use.forward ? k : high + low - k]);
            }
            if (counts_[a] > 0) places.pop_back();
        }
        if (counts_[a] > 0) {
            places.push_back(place_of_[side.last]);
        } else {
            link(place_of_[side.first], place_of_[side.last], {a});
        }
        arc_places_.push_back(std::move(places));
    }
}

std::vector<Index> Places::along(const std::vector<DirectedSide>& sides) const {
    std::vector<Index> result;
    for (const DirectedSide& s : sides) {
        std::vector<Index> places = arc_places_[s.side];
        if (s.reversed) std::reverse(places.begin(), places.end());
        result.insert(result.end(), places.begin() + (result.empty() ? 0 : 1), places.end());
    }
    return result;
}

// Of a patch no quad wide, what is opposite is one.
void Places::add_patch(const LayoutPatch& patch) {
    const auto sides = four_sides(patch);
    for (int k = 0; k < 2; ++k) {
        std::vector<Index> width;
        int count = 0;
        for (const DirectedSide& s : sides[k]) {
            width.push_back(s.side);
            count += counts_[s.side];
        }
        if (count > 0) continue;
        const std::vector<Index> near = along(sides[k + 1]), far = along(sides[(k + 3) % 4]);
        for (std::size_t i = 0; i < near.size() && i < far.size(); ++i) link(near[i], far[far.size() - 1 - i], width);
    }
}

bool Places::are_wrong(const Held& a, const Held& b) const {
    if (a.point >= 0 || b.point >= 0) return a.point != b.point;
    if (a.node >= 0 && b.node >= 0) return a.node != b.node;
    if (a.node < 0 && b.node < 0) return a.seam != b.seam;
    const auto& stops = seams_.seams[std::max(a.seam, b.seam)].stops;
    const Index node = std::max(a.node, b.node);
    return stops.front().node != node && stops.back().node != node;
}

// Breadth first. What lies behind a node is seen from there.
std::vector<Index> Places::way_to_wrong(Index from, const Held& what) const {
    std::map<Index, std::pair<Index, const Link*>> came = {{from, {-1, nullptr}}};
    std::vector<Index> front = {from};
    for (std::size_t i = 0; i < front.size(); ++i) {
        if (const auto at = held_.find(front[i]); what.seam >= 0 && at != held_.end() && at->second.node >= 0) continue;
        for (const Link& link : links_[front[i]]) {
            if (!came.emplace(link.to, std::pair(front[i], &link)).second) continue;
            front.push_back(link.to);
            const auto found = held_.find(link.to);
            if (found == held_.end() || !are_wrong(what, found->second)) continue;
            std::vector<Index> way;
            for (Index at = link.to; at != from; at = came.at(at).first) {
                const auto& length = came.at(at).second->length;
                way.insert(way.end(), length.begin(), length.end());
            }
            std::sort(way.begin(), way.end());
            way.erase(std::unique(way.begin(), way.end()), way.end());
            return way;
        }
    }
    return {};
}

}  // namespace

std::vector<std::vector<Index>> wrongly_merged(const QuadLayout& layout, const Seams& seams,
                                               const std::vector<int>& counts, const std::vector<int>& part_counts) {
    return Places(layout, seams, counts, part_counts).wrong();
}

}  // namespace octafield::surface::detail
