#include "face_lines.hpp"

#include <algorithm>
#include <array>

#include "octafield/disjoint_sets.hpp"

namespace octafield::surface::detail {

int Face::count(int quads) const {
    return static_cast<int>(
        std::count_if(corners.begin(), corners.end(), [&](const Corner& c) { return c.quads == quads; }));
}

std::size_t Face::next(std::size_t corner) const {
    const std::size_t next = corner + 1;
    if (next < corners.size() && corners[next].loop == corners[corner].loop) return next;
    std::size_t first = corner;
    while (first > 0 && corners[first - 1].loop == corners[corner].loop) --first;
    return first;
}

std::size_t Face::previous(std::size_t corner) const {
    std::size_t result = corner;
    while (next(result) != corner) result = next(result);
    return result;
}

std::vector<Index> Face::side_after(std::size_t corner) const {
    const auto& loop = loops[corners[corner].loop];
    const auto count = static_cast<Index>(loop.size());
    const Index last = corners[next(corner)].place;
    std::vector<Index> result;
    for (Index i = (corners[corner].place + 1) % count;; i = (i + 1) % count) {
        result.push_back(loop[i]);
        if (i == last) return result;
    }
}

FaceLines::FaceLines(const QuadSides& sides, const std::vector<Index>& face_of)
    : sides_(sides), count_(static_cast<Index>(sides.mates.size())), face_of_(face_of) {
    find_nodes();
    find_edges();
    find_known();
    find_faces();
    add_loops();
    find_headings();
}

Index FaceLines::tail(Index dart) const {
    return dart < count_ ? sides_.from(dart) : sides_.from(QuadSides::turned(dart - count_, 1));
}

Index FaceLines::back(Index dart) const {
    if (dart >= count_) return dart - count_;
    return sides_.mates[dart] >= 0 ? sides_.mates[dart] : count_ + dart;
}

Index FaceLines::ahead(Index dart) const {
    for (int i = 0; i < 2; ++i) dart = back(QuadSides::turned(dart, 3));
    return dart;
}

bool FaceLines::is_feature(Index dart) const {
    if (dart >= count_ || sides_.mates[dart] < 0) return true;
    return face_of_[dart / 4] != face_of_[sides_.mates[dart] / 4];
}

std::vector<Index> FaceLines::turn(Index side) const {
    std::vector<Index> result = {QuadSides::turned(side, 1)};
    while (!is_feature(result.back())) result.push_back(QuadSides::turned(sides_.mates[result.back()], 1));
    return result;
}

std::vector<Index> FaceLines::spokes(Index side) const {
    std::vector<Index> result = turn(side);
    result.pop_back();
    if (!is_node_[tail(back(side))]) result.clear();
    return result;
}

void FaceLines::find_nodes() {
    std::vector<int> edges(sides_.out.size(), 0);
    is_node_.assign(edges.size(), false);
    on_feature_.assign(edges.size(), false);
    for (Index side = 0; side < count_; ++side) {
        if (!is_feature(side)) continue;
        ++edges[tail(side)];
        if (back(side) >= count_) ++edges[tail(back(side))];
        if (turn(side).size() != 2) is_node_[tail(back(side))] = true;
    }
    for (std::size_t v = 0; v < edges.size(); ++v) {
        on_feature_[v] = edges[v] > 0;
        if (on_feature_[v] && (edges[v] != 2 || sides_.is_irregular(static_cast<Index>(v)))) is_node_[v] = true;
    }
}

void FaceLines::find_edges() {
    DisjointSets sets(static_cast<std::size_t>(2 * count_));
    std::vector<Index> last(is_node_.size(), -1);
    std::vector<bool> is_edge(2 * count_, false);
    for (Index side = 0; side < count_; ++side) {
        if (!is_feature(side)) continue;
        for (const Index dart : {side, back(side)}) {
            is_edge[dart] = true;
            sets.join(side, dart);
            const Index v = tail(dart);
            if (is_node_[v]) continue;
            if (last[v] >= 0) sets.join(last[v], dart);
            last[v] = dart;
        }
    }
    edge_of_.assign(2 * count_, -1);
    for (Index dart = 0; dart < 2 * count_; ++dart) {
        if (!is_edge[dart]) continue;
        const Index first = sets.lowest(dart);
        if (first == dart) {
            edge_of_[dart] = edge_count();
            edge_on_boundary_.push_back(back(dart) >= count_);
        }
        edge_of_[dart] = edge_of_[first];
    }
    edge_is_line_.assign(edge_on_boundary_.size(), false);
}

// Lines start in all ways at irregular vertices, run along edges of features, and straight on at regular nodes.
void FaceLines::find_known() {
    known_.assign(2 * count_, false);
    std::vector<std::vector<Index>> ends(edge_count());
    std::vector<Index> waiting;
    const auto add = [&](Index dart) {
        if (known_[dart]) return;
        known_[dart] = true;
        waiting.push_back(dart);
    };
    for (Index dart = 0; dart < 2 * count_; ++dart) {
        if (dart >= count_ && sides_.mates[dart - count_] >= 0) continue;
        if (!is_node_[tail(dart)]) continue;
        if (edge_of_[dart] >= 0) ends[edge_of_[dart]].push_back(dart);
        if (sides_.is_irregular(tail(dart))) add(dart);
    }
    while (!waiting.empty()) {
        const Index dart = waiting.back(), v = tail(dart);
        waiting.pop_back();
        if (const Index edge = edge_of_[dart]; edge >= 0 && !edge_is_line_[edge]) {
            edge_is_line_[edge] = true;
            for (const Index end : ends[edge]) add(end);
        }
        if (!sides_.is_irregular(v) && !sides_.boundary[v]) add(ahead(dart));
    }
}

void FaceLines::find_faces() {
    const Index quads = count_ / 4;
    DisjointSets sets(static_cast<std::size_t>(quads));
    for (Index side = 0; side < count_; ++side)
        if (!is_feature(side)) sets.join(side / 4, sides_.mates[side] / 4);
    Index faces = 0;
    part_of_ = std::move(sets).numbers(faces);
    faces_.resize(faces);
    turns_.assign(faces, false);
    std::vector<int> inner_darts(faces, 0);
    for (Index q = 0; q < quads; ++q) faces_[part_of_[q]].euler += 1;
    for (Index side = 0; side < count_; ++side)
        if (!is_feature(side)) ++inner_darts[part_of_[side / 4]];
    for (Index f = 0; f < faces; ++f) faces_[f].euler -= inner_darts[f] / 2;
    for (std::size_t v = 0; v < sides_.out.size(); ++v) {
        const auto& out = sides_.out[v];
        if (out.empty() || on_feature_[v]) continue;
        Face& face = faces_[part_of_[out[0] / 4]];
        face.euler += 1;
        if (out.size() != 4) face.points.push_back(static_cast<int>(out.size()));
    }
}

void FaceLines::add_loops() {
    std::vector<bool> known(count_, false);
    for (const bool from_nodes : {true, false})
        for (Index side = 0; side < count_; ++side) {
            if (!is_feature(side) || known[side] || (from_nodes && !is_node_[tail(side)])) continue;
            Face& face = faces_[part_of_[side / 4]];
            auto& loop = face.loops.emplace_back();
            for (Index s = side; !known[s];) {
                known[s] = true;
                const std::vector<Index> round = turn(s);
                if (round.size() != 2)
                    face.corners.push_back({s, static_cast<int>(round.size()),
                                            static_cast<Index>(face.loops.size()) - 1,
                                            static_cast<Index>(loop.size())});
                loop.push_back(s);
                s = round.back();
            }
        }
}

void FaceLines::find_headings() {
    const Index quads = count_ / 4;
    turn_of_.assign(quads, -1);
    std::vector<Index> waiting;
    for (Index first = 0; first < quads; ++first) {
        if (turn_of_[first] >= 0) continue;
        turn_of_[first] = 0;
        waiting = {first};
        while (!waiting.empty()) {
            const Index q = waiting.back();
            waiting.pop_back();
            for (Index side = 4 * q; side < 4 * q + 4; ++side) {
                if (is_feature(side)) continue;
                const Index mate = sides_.mates[side];
                const int turn = (turn_of_[q] + side % 4 + 6 - mate % 4) % 4;
                int& known = turn_of_[mate / 4];
                if (known < 0) {
                    known = turn;
                    waiting.push_back(mate / 4);
                }
                if (known != turn) turns_[part_of_[q]] = true;
            }
        }
    }
    for (std::size_t f = 0; f < faces_.size(); ++f)
        faces_[f].has_headings = faces_[f].points.empty() && !turns_[f] && are_forced(faces_[f]);
}

// On an annulus a curve without corners runs as the other one does as a whole, and that is known where it runs back in
// one way only.
bool FaceLines::are_forced(const Face& face) const {
    if (face.is_disk() || face.is_ring()) return true;
    if (!face.is_annulus()) return false;
    for (const int straight : {0, 1}) {
        if (has_corners(face.loops[straight])) continue;
        std::array<bool, 4> there{};
        for (const Index side : face.loops[1 - straight]) there[heading(side)] = true;
        int ways = 0;
        for (int h = 0; h < 4; ++h) ways += there[h] && !there[(h + 2) % 4];
        return ways == 1;
    }
    return false;
}

int FaceLines::heading(Index dart) const {
    return dart < count_ ? (turn_of_[dart / 4] + dart % 4) % 4 : (turn_of_[(dart - count_) / 4] + dart % 4 + 2) % 4;
}

bool FaceLines::has_corners(const std::vector<Index>& loop) const {
    return std::any_of(loop.begin(), loop.end(), [&](Index side) { return turn(side).size() != 2; });
}

bool FaceLines::has_lines_at_reflex_corners(const Face& face) const {
    for (const Face::Corner& corner : face.corners) {
        if (corner.quads < 3) continue;
        for (const Index dart : spokes(corner.side))
            if (!known_[dart]) return false;
    }
    return true;
}

int FaceLines::bend_of_hole(const std::vector<Index>& loop) const {
    int result = 0;
    for (const Index side : loop) {
        const auto quads = static_cast<int>(turn(side).size());
        if (quads < 2) return -1;
        result += quads - 2;
    }
    return result;
}

double FaceLines::crossed_nodes() const {
    double result = 0;
    for (std::size_t v = 0; v < sides_.out.size(); ++v) {
        if (!is_node_[v] || sides_.is_irregular(static_cast<Index>(v))) continue;
        const auto& out = sides_.out[v];
        const auto known = std::count_if(out.begin(), out.end(), [&](Index side) { return known_[side]; });
        if (!sides_.boundary[v]) {
            result += known == 4 ? 1 : 0;
        } else {
            result += std::any_of(out.begin(), out.end(), [&](Index s) { return sides_.mates[s] >= 0 && known_[s]; })
                          ? 0.5
                          : 0;
        }
    }
    return result;
}

std::vector<std::vector<Index>> connected_parts(const Quads& quads) {
    const QuadSides sides(quads);
    DisjointSets sets(static_cast<std::size_t>(quads.rows()));
    for (Index s = 0; s < 4 * static_cast<Index>(quads.rows()); ++s)
        if (const Index mate = sides.mates[s]; mate >= 0) sets.join(s / 4, mate / 4);
    Index parts = 0;
    const std::vector<Index> part_of = std::move(sets).numbers(parts);
    std::vector<std::vector<Index>> result(parts);
    for (Index q = 0; q < static_cast<Index>(part_of.size()); ++q) result[part_of[q]].push_back(q);
    return result;
}

}  // namespace octafield::surface::detail
