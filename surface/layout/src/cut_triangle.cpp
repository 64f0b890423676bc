#include "cut_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace octafield::surface::detail {
namespace {

using Vector = Eigen::Vector3d;

class TriangleCutter {
public:
    TriangleCutter(const std::vector<RingNode>& ring, const std::vector<Chord>& chords, std::vector<Vector>& positions)
        : ring_(ring), chords_(chords), positions_(positions), size_(static_cast<int>(ring.size())) {}

    void find_crossings();
    void add_lengths(std::vector<std::vector<CurveNode>>& in_between) const;
    std::vector<std::vector<RingNode>> polygons();

private:
    struct Crossing {
        int other;    // chord
        int local;    // ring nodes come first
        double part;  // of the chord, by straight lines
    };
    int offset(int from, int to) const { return (to - from + size_) % size_; }
    bool alternate(int a, int b) const;
    double part_of(int a, int b) const;
    bool before(int chord, const Crossing& a, const Crossing& b) const;
    void link();

    const std::vector<RingNode>& ring_;
    const std::vector<Chord>& chords_;
    std::vector<Vector>& positions_;
    int size_;
    std::vector<std::pair<int, int>> ends_;         // places in the ring
    std::vector<std::vector<Crossing>> crossings_;  // of each chord, in order
    std::vector<Index> nodes_;                      // local to global
    std::vector<std::vector<int>> around_;          // neighbours of each local node, counter-clockwise
};

bool TriangleCutter::alternate(int a, int b) const {
    const int whole = offset(ends_[a].first, ends_[a].second);
    const int p = offset(ends_[a].first, ends_[b].first), q = offset(ends_[a].first, ends_[b].second);
    if (p == 0 || q == 0 || p == whole || q == whole) return false;
    return (p < whole) != (q < whole);
}

double TriangleCutter::part_of(int a, int b) const {
    const Vector p = positions_[chords_[a].from], u = positions_[chords_[a].to] - p;
    const Vector q = positions_[chords_[b].from], v = positions_[chords_[b].to] - q;
    const Vector normal = u.cross(v);
    const double part = (q - p).cross(v).dot(normal) / normal.squaredNorm();
    return part > 1e-6 ? std::min(part, 1 - 1e-6) : 1e-6;  // also where it is no number
}

// Chords that do not cross one another are met in the order of their ends; others by straight lines.
bool TriangleCutter::before(int chord, const Crossing& a, const Crossing& b) const {
    const int from = ends_[chord].first, whole = offset(from, ends_[chord].second);
    const auto sides = [&](int other) {
        int right = offset(from, ends_[other].first), left = offset(from, ends_[other].second);
        if (right > left) std::swap(right, left);
        return std::pair(right, size_ - left);  // both grow along the chord; right < whole < left
    };
    const auto [ar, al] = sides(a.other);
    const auto [br, bl] = sides(b.other);
    (void)whole;
    if (ar <= br && al <= bl && (ar != br || al != bl)) return true;
    if (br <= ar && bl <= al && (ar != br || al != bl)) return false;
    return a.part < b.part;
}

void TriangleCutter::find_crossings() {
    for (const RingNode& node : ring_) nodes_.push_back(node.node);
    const auto place = [&](Index node) {
        return static_cast<int>(std::find(nodes_.begin(), nodes_.begin() + size_, node) - nodes_.begin());
    };
    for (const Chord& chord : chords_) ends_.emplace_back(place(chord.from), place(chord.to));
    const auto count = static_cast<int>(chords_.size());
    crossings_.resize(count);
    for (int a = 0; a < count; ++a)
        for (int b = a + 1; b < count; ++b) {
            if (!alternate(a, b)) continue;
            const auto local = static_cast<int>(nodes_.size());
            const double part = part_of(a, b);
            crossings_[a].push_back({b, local, part});
            crossings_[b].push_back({a, local, part_of(b, a)});
            nodes_.push_back(static_cast<Index>(positions_.size()));
            positions_.push_back(positions_[chords_[a].from] +
                                 part * (positions_[chords_[a].to] - positions_[chords_[a].from]));
        }
    for (int c = 0; c < count; ++c)  // by insertion, as three chords through a point may be in no order
        for (std::size_t i = 1; i < crossings_[c].size(); ++i)
            for (std::size_t j = i; j > 0 && before(c, crossings_[c][j], crossings_[c][j - 1]); --j)
                std::swap(crossings_[c][j], crossings_[c][j - 1]);
}

void TriangleCutter::add_lengths(std::vector<std::vector<CurveNode>>& in_between) const {
    for (std::size_t c = 0; c < chords_.size(); ++c) {
        const Chord& chord = chords_[c];
        double last = 0;
        for (std::size_t i = 0; i < crossings_[c].size(); ++i) {
            // Increasing, and inside the chord, also where straight lines would have them in another order.
            const double room = (1 - last) / static_cast<double>(crossings_[c].size() - i + 1);
            const double part = std::clamp(crossings_[c][i].part, last + 1e-9 * room, 1 - 1e-9 * room);
            in_between[chord.curve].push_back(
                {nodes_[crossings_[c][i].local], chord.first_length + part * (chord.last_length - chord.first_length)});
            last = part;
        }
    }
}

void TriangleCutter::link() {
    around_.resize(nodes_.size());
    std::vector<std::vector<std::pair<int, int>>> at_ring(size_);  // offset of the far end, neighbour
    for (std::size_t c = 0; c < chords_.size(); ++c) {
        std::vector<int> chain = {ends_[c].first};
        for (const Crossing& crossing : crossings_[c]) chain.push_back(crossing.local);
        chain.push_back(ends_[c].second);
        at_ring[chain.front()].emplace_back(offset(chain.front(), chain.back()), chain[1]);
        at_ring[chain.back()].emplace_back(offset(chain.back(), chain.front()), chain[chain.size() - 2]);
        for (std::size_t i = 1; i + 1 < chain.size(); ++i) {
            // The first chord's neighbours go in with a gap for the other one's, which is to be found on the side of
            // its end.
            auto& around = around_[chain[i]];
            if (around.empty()) around.resize(4, -1);
            const Crossing& crossing = crossings_[c][i - 1];
            const bool first = static_cast<int>(c) < crossing.other;
            const int from = ends_[std::min<int>(c, crossing.other)].first;
            if (first) {
                around[0] = chain[i - 1];
                around[2] = chain[i + 1];
            } else {
                const int whole = offset(from, ends_[crossing.other].second);
                const bool start_is_right = offset(from, ends_[c].first) < whole;
                around[start_is_right ? 1 : 3] = chain[i - 1];
                around[start_is_right ? 3 : 1] = chain[i + 1];
            }
        }
    }
    for (int i = 0; i < size_; ++i) {
        std::sort(at_ring[i].begin(), at_ring[i].end());
        around_[i].push_back((i + 1) % size_);
        for (const auto& [far, neighbour] : at_ring[i]) around_[i].push_back(neighbour);
        around_[i].push_back((i + size_ - 1) % size_);
    }
}

std::vector<std::vector<RingNode>> TriangleCutter::polygons() {
    link();
    std::vector<std::vector<bool>> done;
    for (const auto& around : around_) done.emplace_back(around.size(), false);
    for (int i = 0; i < size_; ++i) done[i].back() = true;  // the outside
    std::vector<std::vector<RingNode>> result;
    for (int start = 0; start < static_cast<int>(around_.size()); ++start)
        for (std::size_t way = 0; way < around_[start].size(); ++way) {
            if (done[start][way]) continue;
            std::vector<RingNode> polygon;
            int at = start;
            std::size_t out = way;
            while (!done[at][out]) {
                done[at][out] = true;
                const int to = around_[at][out];
                const bool on_ring = at < size_ && to == (at + 1) % size_ && out == 0;
                polygon.push_back({nodes_[at], on_ring ? ring_[at].cut_after : true});
                const auto& around = around_[to];
                const auto back =
                    static_cast<std::size_t>(std::find(around.begin(), around.end(), at) - around.begin());
                out = (back + around.size() - 1) % around.size();
                at = to;
            }
            result.push_back(std::move(polygon));
        }
    return result;
}

}  // namespace

std::vector<std::vector<RingNode>> cut_triangle(const std::vector<RingNode>& ring, const std::vector<Chord>& chords,
                                                std::vector<Vector>& positions,
                                                std::vector<std::vector<CurveNode>>& in_between) {
    if (chords.empty()) return {ring};
    TriangleCutter cutter(ring, chords, positions);
    cutter.find_crossings();
    cutter.add_lengths(in_between);
    return cutter.polygons();
}

}  // namespace octafield::surface::detail
