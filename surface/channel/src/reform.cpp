#include "reform.hpp"

#include <algorithm>
#include <set>

namespace octafield::surface::detail {
namespace {

constexpr double worth_trying = 0.003;  // cost of a quad; a square's is 0
constexpr double dear = 0.15;           // of a quad for which decagons are tried as well
constexpr double least_saving = 1e-3;
constexpr std::size_t quads_between = 100;  // questions whether to go on

bool contains(const std::vector<Index>& ids, Index id) { return std::find(ids.begin(), ids.end(), id) != ids.end(); }

}  // namespace

Index Reformer::round(const std::function<void()>& ask) {
    tried_.resize(quads_.quad_slots(), false);
    std::vector<std::pair<double, Index>> order;
    for (Index q = 0; q < quads_.quad_slots(); ++q) {
        if (!quads_.alive(q) || quads_.kept(q) || tried_[q]) continue;
        const double cost = quads_.cost(q);
        if (cost > worth_trying) order.push_back({-cost, q});
    }
    std::sort(order.begin(), order.end());
    Index exchanged = 0;
    for (std::size_t at = 0; at < order.size(); ++at) {
        if (at % quads_between == 0) ask();
        if (quads_.alive(order[at].second)) exchanged += exchange(order[at].second);
    }
    return exchanged;
}

void Reformer::touch(Index q) {
    if (q < static_cast<Index>(tried_.size())) tried_[q] = false;
}

// Grown quad by quad; a group of m quads with i vertices inside has 2 (m - i) + 2 sides.
std::vector<Reformer::Group> Reformer::groups(Index q) const {
    const std::size_t sides = quads_.cost(q) > dear ? most_sides : 8;
    std::vector<Group> result;
    std::set<std::vector<Index>> seen{{q}};
    std::vector<std::vector<Index>> open{{q}};
    for (std::size_t at = 0; at < open.size(); ++at) {
        const std::vector<Index> ids = open[at];
        Group group{ids, {}, {}};
        if (!outlined(group) || group.outline.size() > sides) continue;
        if (ids.size() > 1) result.push_back(std::move(group));
        for (const Index member : ids)
            for (int k = 0; k < 4; ++k) {
                const Index next = quads_.neighbour(member, k);
                if (next < 0 || quads_.kept(next) || contains(ids, next)) continue;
                std::vector<Index> more = ids;
                more.insert(std::lower_bound(more.begin(), more.end(), next), next);
                if (seen.insert(more).second) open.push_back(std::move(more));
            }
    }
    return result;
}

// Whether the outline is one simple curve round free vertices.
bool Reformer::outlined(Group& group) const {
    std::vector<std::array<Index, 2>> sides;
    for (const Index q : group.quads)
        for (int k = 0; k < 4; ++k) {
            const Index beside = quads_.neighbour(q, k);
            if (beside < 0 || !contains(group.quads, beside))
                sides.push_back({quads_.quad(q)[k], quads_.quad(q)[(k + 1) % 4]});
        }
    Index at = sides[0][0];
    do {
        Index next = -1;
        for (const auto& side : sides)
            if (side[0] == at) {
                if (next >= 0) return false;
                next = side[1];
            }
        if (next < 0) return false;
        group.outline.push_back(at);
        at = next;
    } while (at != sides[0][0] && group.outline.size() <= sides.size());
    if (group.outline.size() != sides.size()) return false;
    for (const Index q : group.quads)
        for (const Index v : quads_.quad(q))
            if (!contains(group.outline, v) && !contains(group.inner, v)) {
                if (quads_.hold(v) != Hold::free) return false;
                group.inner.push_back(v);
            }
    return true;
}

Patch Reformer::patch_of(const Group& group) const {
    const int n = static_cast<int>(group.outline.size());
    Patch patch{{}, std::vector<int>(n, 0), std::vector<int>(n, -1), {}};
    for (int i = 0; i < n; ++i) {
        const Index v = group.outline[i];
        patch.corners.push_back(quads_.point(v));
        if (quads_.hold(v) == Hold::fixed) continue;
        int outside = 0;
        for (const Index q : quads_.quads_round(v)) outside += !contains(group.quads, q);
        patch.outer_quads[i] = outside;
        patch.least_quads[i] = outside == 1 ? 2 : 0;
    }
    patch.joined.assign(n, std::vector<char>(n, false));
    const auto outside = [&](Index q) { return q >= 0 && !contains(group.quads, q); };
    for (int i = 0; i < n; ++i)
        for (int j = i + 2; j < n; ++j)
            patch.joined[i][j] = outside(quads_.quad_at(group.outline[i], group.outline[j])) ||
                                 outside(quads_.quad_at(group.outline[j], group.outline[i]));
    return patch;
}

double Reformer::cost_of(const Group& group) const {
    double sum = 0;
    for (const Index q : group.quads) sum += quads_.cost(q);
    for (const auto* ids : {&group.outline, &group.inner})
        for (const Index v : *ids)
            if (quads_.hold(v) != Hold::fixed) sum += valence_cost(static_cast<int>(quads_.quads_round(v).size()));
    return sum;
}

bool Reformer::exchange(Index q) {
    tried_[q] = true;
    const Group* best = nullptr;
    Filling filling;
    double saved = least_saving;
    const std::vector<Group> all = groups(q);
    for (const Group& group : all) {
        const double now = cost_of(group);
        Filling found = filler_.fill(patch_of(group), now - saved);
        if (found.quads.empty()) continue;
        saved = now - found.cost;
        filling = std::move(found);
        best = &group;
    }
    if (best == nullptr) return false;
    put(*best, filling);
    return true;
}

void Reformer::put(const Group& group, const Filling& filling) {
    for (const Index q : group.quads) quads_.remove_quad(q);
    std::vector<Index> names = group.outline;
    for (const Vector2& at : filling.interior) names.push_back(quads_.add_vertex(at, Hold::free));
    for (const auto& q : filling.quads) quads_.add_quad({names[q[0]], names[q[1]], names[q[2]], names[q[3]]}, false);
    tried_.resize(quads_.quad_slots(), false);
    for (const Index v : names)
        for (const Index q : quads_.quads_round(v)) tried_[q] = false;
}

}  // namespace octafield::surface::detail
