#include "octafield/surface/base_complex.hpp"

#include <algorithm>
#include <array>
#include <tuple>

#include "octafield/disjoint_sets.hpp"
#include "octafield/error.hpp"
#include "quad_sides.hpp"

namespace octafield::surface {
namespace {

class Complex {
public:
    explicit Complex(const Quads& quads) : quads_(quads), sides_(quads), mates_(sides_.mates), out_(sides_.out) {
        result_.irregular = sides_.irregular;
        marked_.assign(mates_.size(), false);
        for (const Index v : result_.irregular) mark_from(v);
    }

    BaseComplex result() &&;

private:
    Index from(Index side) const { return quads_(side / 4, side % 4); }
    static Index turned(Index side, int steps) { return detail::QuadSides::turned(side, steps); }
    void mark_from(Index vertex);
    bool lay_out_blocks();
    bool lay_out(Index first);
    void add_cut();
    void add_chords();

    const Quads& quads_;
    const detail::QuadSides sides_;
    const std::vector<Index>& mates_;
    const std::vector<std::vector<Index>>& out_;
    std::vector<bool> marked_;  // of each side
    BaseComplex result_;
    std::vector<int> turns_;  // of each quad: its side k is side (k + turn) % 4 of the block
    std::vector<std::array<Index, 2>> places_, sizes_;
    Index open_block_ = -1;  // lowest quad of one that is no disk
};

// Straight on over regular vertices, to the boundary or a line that is there.
void Complex::mark_from(Index vertex) {
    for (const Index start : out_[vertex])
        for (Index side = start; side >= 0 && mates_[side] >= 0 && !marked_[side];) {
            marked_[side] = marked_[mates_[side]] = true;
            const Index end = from(turned(side, 1)), left = mates_[turned(side, 1)];
            const bool regular = out_[end].size() == 4 && left >= 0 && end != vertex && !sides_.is_irregular(end);
            side = regular ? turned(left, 1) : -1;
        }
}

// Gives the block of quad `first` its places; false if it is no rectangle.
bool Complex::lay_out(Index first) {
    const auto block = static_cast<Index>(sizes_.size());
    std::vector<Index> waiting = {first};
    result_.blocks[first] = block;
    places_[first] = {0, 0};
    std::array<Index, 2> low = {0, 0}, high = {0, 0};
    constexpr int ways[4][2] = {{0, -1}, {1, 0}, {0, 1}, {-1, 0}};
    for (std::size_t i = 0; i < waiting.size(); ++i) {
        const Index q = waiting[i];
        for (int k = 0; k < 4; ++k) {
            const Index mate = mates_[4 * q + k];
            if (mate < 0 || marked_[4 * q + k]) continue;
            const int side = (k + turns_[q]) % 4;
            const std::array<Index, 2> place = {places_[q][0] + ways[side][0], places_[q][1] + ways[side][1]};
            const int turn = (side + 6 - mate % 4) % 4;
            if (result_.blocks[mate / 4] >= 0) {
                if (places_[mate / 4] != place || turns_[mate / 4] != turn) return false;
                continue;
            }
            result_.blocks[mate / 4] = block;
            turns_[mate / 4] = turn;
            places_[mate / 4] = place;
            for (int d = 0; d < 2; ++d) {
                low[d] = std::min(low[d], place[d]);
                high[d] = std::max(high[d], place[d]);
            }
            waiting.push_back(mate / 4);
        }
    }
    sizes_.push_back({high[0] - low[0] + 1, high[1] - low[1] + 1});
    return static_cast<std::size_t>(sizes_.back()[0]) * sizes_.back()[1] == waiting.size();
}

bool Complex::lay_out_blocks() {
    const Index count = static_cast<Index>(quads_.rows());
    result_.blocks.assign(count, -1);
    turns_.assign(count, 0);
    places_.assign(count, {0, 0});
    sizes_.clear();
    for (Index q = 0; q < count; ++q) {
        if (result_.blocks[q] >= 0 || lay_out(q)) continue;
        open_block_ = q;
        return false;
    }
    return true;
}

// Lines from a vertex of the block, at the boundary or on another line if it can be: they are fewer there.
void Complex::add_cut() {
    const Index block = result_.blocks[open_block_];
    Index best = -1;
    int best_rank = 3;
    for (Index q = 0; q < quads_.rows(); ++q) {
        if (result_.blocks[q] != block) continue;
        for (int k = 0; k < 4; ++k) {
            const Index side = 4 * q + k, v = from(side);
            const auto& out = out_[v];
            if (std::none_of(out.begin(), out.end(), [&](Index s) { return mates_[s] >= 0 && !marked_[s]; })) continue;
            const int rank = mates_[side] < 0 ? 0 : marked_[side] ? 1 : 2;
            if (std::tie(rank, v) < std::tie(best_rank, best)) {
                best_rank = rank;
                best = v;
            }
        }
    }
    if (best < 0) throw GeometryError("a block of the quads has no four corners", "bad_blocks", {open_block_});
    ++result_.cut_vertices;
    mark_from(best);
}

void Complex::add_chords() {
    const auto blocks = static_cast<Index>(sizes_.size());
    DisjointSets sets(2 * static_cast<std::size_t>(blocks));
    const auto direction = [&](Index side) { return 2 * result_.blocks[side / 4] + (side % 4 + turns_[side / 4]) % 2; };
    for (Index s = 0; s < static_cast<Index>(mates_.size()); ++s)
        if (marked_[s]) sets.join(direction(s), direction(mates_[s]));
    Index count = 0;
    const std::vector<Index> chords = std::move(sets).numbers(count);
    result_.chord_counts.resize(count);
    result_.block_sizes.resize(blocks, 2);
    result_.block_chords.resize(blocks, 2);
    for (Index b = 0; b < blocks; ++b)
        for (int d = 0; d < 2; ++d) {
            result_.block_sizes(b, d) = sizes_[b][d];
            result_.block_chords(b, d) = chords[2 * b + d];
            result_.chord_counts[chords[2 * b + d]] = sizes_[b][d];
        }
}

BaseComplex Complex::result() && {
    while (!lay_out_blocks()) add_cut();
    add_chords();
    return std::move(result_);
}

}  // namespace

BaseComplex base_complex(const QuadMesh& mesh) {
    detail::require_only_quads(mesh);
    return Complex(mesh.quads).result();
}

}  // namespace octafield::surface
