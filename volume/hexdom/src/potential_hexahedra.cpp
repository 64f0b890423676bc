#include <cmath>

#include "vertex_search.hpp"

namespace octafield::volume::detail {
namespace {

// The least over the eight corners and the middle, as scaled_jacobians has it.
double hexahedron_quality(const Points& vertices, const std::array<Index, 8>& ids) {
    std::array<Eigen::Vector3d, 8> p;
    for (int k = 0; k < 8; ++k) p[k] = vertices.row(ids[k]);
    const auto scaled = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
        return a.cross(b).dot(c) / (a.norm() * b.norm() * c.norm());
    };
    const auto sum = [&](int i, int j, int k, int l) -> Eigen::Vector3d { return p[i] + p[j] + p[k] + p[l]; };
    double least =
        scaled(sum(1, 2, 5, 6) - sum(0, 3, 4, 7), sum(2, 3, 6, 7) - sum(0, 1, 4, 5), sum(4, 5, 6, 7) - sum(0, 1, 2, 3));
    for (const CellCorner& c : hexahedron_shape.corners)
        least = std::min(least, scaled(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]], p[c[3]] - p[c[0]]));
    return least;
}

// Cells whose lowest vertex is given: corner 0. Corner 1 is the lowest of its three neighbours.
class HexahedronFinder {
public:
    HexahedronFinder(const TetSearch& search, PotentialCells& cells)
        : search_(search), topology_(search.topology), test_(search.vertices, search.min_quality), cells_(cells) {}

    void find(Index lowest) {
        v_[0] = lowest;
        const std::span<const Index> all = topology_.around(lowest);
        around_ = all.subspan(std::upper_bound(all.begin(), all.end(), lowest) - all.begin());
        edges_ = topology_.neighbour_edges.data() + topology_.neighbour_start[lowest] + (all.size() - around_.size());
        collect_quads();
        const int n = static_cast<int>(around_.size());
        for (int i = 0; i < n; ++i)
            for (int j = i + 1; j < n; ++j) {
                if (quads_at(i, j).empty()) continue;
                for (int k = j + 1; k < n; ++k) {
                    if (quads_at(i, k).empty() || quads_at(j, k).empty()) continue;
                    if (test_.corner(lowest, around_[i], around_[j], around_[k]))
                        grow(i, j, k);
                    else if (test_.corner(lowest, around_[i], around_[k], around_[j]))
                        grow(i, k, j);
                }
            }
    }

private:
    // Quads (lowest, around[i], across, around[j]).
    struct Quad {
        Index pair, across;
        bool operator<(const Quad& other) const {
            return std::pair(pair, across) < std::pair(other.pair, other.across);
        }
        bool operator==(const Quad&) const = default;
    };

    int position(Index vertex) const {
        const auto found = std::lower_bound(around_.begin(), around_.end(), vertex);
        return found != around_.end() && *found == vertex ? static_cast<int>(found - around_.begin()) : -1;
    }

    void collect_quads() {
        quads_.clear();
        const int n = static_cast<int>(around_.size());
        for (int k = 0; k < n; ++k) {
            const std::span<const Index> link = topology_.link(edges_[k]);
            for (std::size_t x = 0; x < link.size(); ++x) {
                if (link[x] < v_[0]) continue;
                // Triangles (lowest, x, k) and (lowest, k, y): the diagonal at this vertex.
                for (std::size_t y = x + 1; y < link.size(); ++y)
                    add_quad(position(link[x]), position(link[y]), around_[k]);
                // Triangle (lowest, k, x) and one across its edge k-x: the other diagonal.
                if (link[x] < around_[k]) continue;
                for (const Index z : topology_.link(topology_.edge(around_[k], link[x])))
                    if (z > v_[0]) add_quad(k, position(link[x]), z);
            }
        }
        std::sort(quads_.begin(), quads_.end());
        quads_.erase(std::unique(quads_.begin(), quads_.end()), quads_.end());
        first_.assign(static_cast<std::size_t>(n) * n + 1, 0);
        for (const Quad& quad : quads_) ++first_[quad.pair + 1];
        for (std::size_t i = 1; i < first_.size(); ++i) first_[i] += first_[i - 1];
    }

    void add_quad(int i, int j, Index across) {
        if (i > j) std::swap(i, j);
        const Index x = around_[i], y = around_[j];
        if (test_.angle(v_[0], x, y) && test_.angle(x, v_[0], across) && test_.angle(y, v_[0], across) &&
            test_.angle(across, x, y))
            quads_.push_back({static_cast<Index>(i * static_cast<int>(around_.size()) + j), across});
    }

    std::span<const Quad> quads_at(int i, int j) const {
        const std::size_t pair = std::size_t(std::min(i, j)) * around_.size() + std::max(i, j);
        return {quads_.data() + first_[pair], quads_.data() + first_[pair + 1]};
    }

    bool corner(int k) const {
        const CellCorner& c = hexahedron_shape.corners[k];
        return test_.corner(v_[c[0]], v_[c[1]], v_[c[2]], v_[c[3]]);
    }

    // around[i], [j], [k] are corners 1, 3 and 4.
    void grow(int i, int j, int k) {
        v_[1] = around_[i], v_[3] = around_[j], v_[4] = around_[k];
        for (const Quad& bottom : quads_at(i, j)) {
            v_[2] = bottom.across;
            if (v_[2] == v_[4]) continue;
            for (const Quad& front : quads_at(i, k)) {
                v_[5] = front.across;
                if (v_[5] == v_[3] || v_[5] == v_[2] || !corner(1)) continue;
                for (const Quad& left : quads_at(j, k)) {
                    v_[7] = left.across;
                    if (v_[7] != v_[1] && v_[7] != v_[2] && v_[7] != v_[5] && corner(3) && corner(4)) close();
                }
            }
        }
    }

    // The vertex across from the lowest.
    void close() {
        const std::span<const Index> third = topology_.around(v_[7]);
        for_each_common(topology_.around(v_[2]), topology_.around(v_[5]), v_[0], [&](Index last) {
            if (last == v_[1] || last == v_[3] || last == v_[4] || last == v_[7]) return;
            if (!std::binary_search(third.begin(), third.end(), last)) return;
            v_[6] = last;
            if (corner(2) && corner(5) && corner(7) && corner(6))
                add_if_filled(
                    search_, hexahedron_shape, v_,
                    [&](const std::array<Index, 8>& ids) { return hexahedron_quality(search_.vertices, ids); }, cells_);
        });
    }

    const TetSearch& search_;
    const TetTopology& topology_;
    const CornerTest test_;
    PotentialCells& cells_;
    std::array<Index, 8> v_{};
    std::span<const Index> around_;  // vertices above the lowest
    const Index* edges_ = nullptr;   // to these
    std::vector<Quad> quads_;
    std::vector<Index> first_;  // (pairs + 1) where the quads of each begin
};

}  // namespace

PotentialCells potential_hexahedra(const TetSearch& search) { return search_vertices<HexahedronFinder>(search); }

}  // namespace octafield::volume::detail
