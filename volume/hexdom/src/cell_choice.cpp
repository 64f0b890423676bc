#include "cell_choice.hpp"

#include <algorithm>
#include <numeric>

#include "octafield/parallel.hpp"

namespace octafield::volume::detail {
namespace {

constexpr int most_passes = 10;
constexpr int most_rivals = 64;    // of one cell, looked at together
constexpr int most_nodes = 20000;  // of their search
constexpr double gain_at_least = 1e-9;

// The heaviest set of which no two are joined in a graph of at most 64 vertices, by branch and bound.
class IndependentSet {
public:
    IndependentSet(std::vector<double> weights, std::vector<std::uint64_t> joined)
        : weights_(std::move(weights)), joined_(std::move(joined)) {}

    double weight = 0;
    std::uint64_t members = 0;

    void search() {
        const std::size_t n = weights_.size();
        visit(n == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << n) - 1, 0, 0);
    }

private:
    void visit(std::uint64_t open, double so_far, std::uint64_t chosen) {
        if (so_far > weight) weight = so_far, members = chosen;
        if (open == 0 || ++nodes_ > most_nodes || so_far + bound(open) <= weight) return;
        const int v = heaviest(open);
        const std::uint64_t bit = std::uint64_t{1} << v;
        visit(open & ~(bit | joined_[v]), so_far + weights_[v], chosen | bit);
        if (open & joined_[v]) visit(open & ~bit, so_far, chosen);  // else it is in some best set
    }

    int heaviest(std::uint64_t open) const {
        int best = -1;
        for (; open; open &= open - 1) {
            const int v = __builtin_ctzll(open);
            if (best < 0 || weights_[v] > weights_[best]) best = v;
        }
        return best;
    }

    // Cliques found one after the other give at most one member each.
    double bound(std::uint64_t open) const {
        double total = 0;
        while (open) {
            const int first = heaviest(open);
            total += weights_[first];
            std::uint64_t clique = std::uint64_t{1} << first, rest = open & joined_[first];
            while (rest) {
                const int v = __builtin_ctzll(rest);
                clique |= std::uint64_t{1} << v;
                rest &= joined_[v];
            }
            open &= ~clique;
        }
        return total;
    }

    const std::vector<double> weights_;
    const std::vector<std::uint64_t> joined_;
    int nodes_ = 0;
};

bool crosses(const FaceClaim& a, const FaceClaim& b) {
    if (a.key == b.key) return false;
    if (a.diagonal >= 0 && a.diagonal == b.diagonal) return true;
    const auto end = b.triangles.begin() + b.count;
    return std::find_first_of(b.triangles.begin(), end, a.triangles.begin(), a.triangles.begin() + a.count) != end;
}

// A diagonal of the first is an edge of the second.
bool cuts(const CellClaims& claims, const CellClaims& other) {
    const auto end = other.edges.begin() + other.edge_count;
    for (int f = 0; f < claims.count; ++f)
        if (claims.faces[f].diagonal >= 0 && std::find(other.edges.begin(), end, claims.faces[f].diagonal) != end)
            return true;
    return false;
}

bool in_the_way(std::span<const Index> tets, const CellClaims& claims, std::span<const Index> other_tets,
                const CellClaims& other) {
    if (std::find_first_of(tets.begin(), tets.end(), other_tets.begin(), other_tets.end()) != tets.end()) return true;
    for (int f = 0; f < claims.count; ++f)
        for (int g = 0; g < other.count; ++g)
            if (crosses(claims.faces[f], other.faces[g])) return true;
    return cuts(claims, other) || cuts(other, claims);
}

class Chooser {
public:
    Chooser(const TetSurroundings& surroundings, const CellShape& shape, const PotentialCells& cells,
            const std::vector<double>& weights, ClaimTable& table, int threads)
        : surroundings_(surroundings),
          shape_(shape),
          cells_(cells),
          weights_(weights),
          table_(table),
          threads_(threads),
          chosen_(cells.count(), 0),
          tried_(cells.count(), 0),
          looked_at_(cells.count(), 0),
          only_(cells.count(), ClaimTable::nobody),
          order_(cells.count()) {
        Index vertices = 0;
        for (const auto& ids : cells.ids) vertices = std::max(vertices, *std::max_element(ids.begin(), ids.end()) + 1);
        changed_.assign(vertices, 1);
        std::iota(order_.begin(), order_.end(), 0);
        std::stable_sort(order_.begin(), order_.end(), [&](Index a, Index b) { return weights[a] > weights[b]; });
    }

    std::vector<Index> run() {
        // The first round of exchanges puts in all that nothing is in the way of, the heaviest first.
        for (int pass = 0; pass < most_passes; ++pass) {
            const bool exchanged = exchange_for_one();
            if (!exchange_for_several() && !exchanged) break;
        }
        std::vector<Index> result;
        for (Index cell = 0; cell < cells_.count(); ++cell)
            if (chosen_[cell]) result.push_back(cell);
        return result;
    }

private:
    std::optional<CellClaims> claims(Index cell) const {
        return surroundings_.claims(shape_, cells_.ids[cell].data(), cells_.inner_pairs[cell]);
    }

    void put(Index cell, const CellClaims& claims) {
        table_.add(cell, cells_.tets_of(cell), claims);
        chosen_[cell] = 1;
        touch(cell);
    }
    void take_out(Index cell) {
        table_.remove(cell, cells_.tets_of(cell), *claims(cell));
        chosen_[cell] = 0;
        touch(cell);
    }

    // Cells in each other's way share a vertex: where none has changed since a cell was looked at, nothing else has.
    void touch(Index cell) {
        ++now_;
        for (int k = 0; k < shape_.vertices; ++k) changed_[cells_.ids[cell][k]] = now_;
    }
    bool changed_since(Index cell, std::int64_t then) const {
        const auto& ids = cells_.ids[cell];
        return std::any_of(ids.begin(), ids.begin() + shape_.vertices, [&](Index v) { return changed_[v] > then; });
    }

    // The weight of chosen cells in the way; infinite where one is settled.
    double weight_in_the_way(Index cell, const CellClaims& claims) {
        table_.conflicts(cells_.tets_of(cell), claims, conflicts_);
        double total = 0;
        for (const Index other : conflicts_)
            total += other == ClaimTable::settled ? std::numeric_limits<double>::infinity() : weights_[other];
        return total;
    }

    bool exchange_for_one() {
        bool any = false;
        for (const Index cell : order_) {
            if (chosen_[cell] || !changed_since(cell, tried_[cell])) continue;
            tried_[cell] = now_;
            if (!light_owners(cell)) continue;
            const std::optional<CellClaims> claim = claims(cell);
            if (!claim || !(weights_[cell] > weight_in_the_way(cell, *claim) + gain_at_least)) continue;
            for (const Index other : std::vector<Index>(conflicts_)) take_out(other);
            put(cell, *claim);
            any = true;
        }
        return any;
    }

    // No owner of its tets is as heavy as the cell: quicker to see than all that is in the way.
    bool light_owners(Index cell) const {
        for (const Index tet : cells_.tets_of(cell)) {
            const Index owner = table_.owners()[tet];
            if (owner == ClaimTable::settled || (owner >= 0 && weights_[owner] >= weights_[cell])) return false;
        }
        return true;
    }

    bool one_owner(Index cell) const {
        Index only = ClaimTable::nobody;
        for (const Index tet : cells_.tets_of(cell)) {
            const Index owner = table_.owners()[tet];
            if (owner == ClaimTable::nobody) continue;
            if (owner == ClaimTable::settled || (only != ClaimTable::nobody && only != owner)) return false;
            only = owner;
        }
        return true;
    }

    // The only chosen cell in the way; nobody: none, or not one only.
    Index only_in_the_way(Index cell) const {
        if (!one_owner(cell)) return ClaimTable::nobody;
        const std::optional<CellClaims> claim = claims(cell);
        if (!claim) return ClaimTable::nobody;
        std::vector<Index> conflicts;
        table_.conflicts(cells_.tets_of(cell), *claim, conflicts);
        return conflicts.size() == 1 && conflicts[0] >= 0 ? conflicts[0] : ClaimTable::nobody;
    }

    bool exchange_for_several() {
        std::vector<std::uint8_t> looked(cells_.count(), 0);
        parallel_for(cells_.count(), threads_, [&](std::int64_t i) {
            const Index cell = static_cast<Index>(i);
            if (chosen_[cell] || !changed_since(cell, looked_at_[cell])) return;
            looked_at_[cell] = now_;
            only_[cell] = only_in_the_way(cell);
            looked[cell] = only_[cell] >= 0;
        });
        std::vector<std::pair<Index, Index>> rivals;  // a chosen cell and one that only this is in the way of
        std::vector<std::uint8_t> news(cells_.count(),
                                       0);  // of chosen cells: 1 where rivals are not those of last time
        for (const Index cell : order_) {
            if (chosen_[cell] || only_[cell] < 0) continue;
            if (looked[cell]) news[only_[cell]] = 1;
            rivals.emplace_back(only_[cell], cell);
        }
        std::stable_sort(rivals.begin(), rivals.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        bool any = false;
        for (auto first = rivals.begin(); first != rivals.end();) {
            const auto last = std::find_if(first, rivals.end(), [&](const auto& r) { return r.first != first->first; });
            if (news[first->first] && last - first > 1 && exchange(first->first, first, last)) any = true;
            first = last;
        }
        return any;
    }

    template <class Iterator>
    bool exchange(Index cell, Iterator first, Iterator last) {
        std::vector<Index> rivals;
        std::vector<CellClaims> claimed;
        std::vector<double> weights;
        for (; first != last && rivals.size() < most_rivals; ++first) {
            const std::optional<CellClaims> claim = claims(first->second);
            table_.conflicts(cells_.tets_of(first->second), *claim, conflicts_);  // others may have come
            if (conflicts_.size() != 1 || conflicts_[0] != cell) continue;
            rivals.push_back(first->second);
            claimed.push_back(*claim);
            weights.push_back(weights_[first->second]);
        }
        std::vector<std::uint64_t> joined(rivals.size(), 0);
        for (std::size_t i = 0; i < rivals.size(); ++i)
            for (std::size_t j = 0; j < i; ++j)
                if (in_the_way(cells_.tets_of(rivals[i]), claimed[i], cells_.tets_of(rivals[j]), claimed[j])) {
                    joined[i] |= std::uint64_t{1} << j;
                    joined[j] |= std::uint64_t{1} << i;
                }
        IndependentSet best(std::move(weights), std::move(joined));
        best.search();
        if (!(best.weight > weights_[cell] + gain_at_least)) return false;
        take_out(cell);
        for (std::size_t i = 0; i < rivals.size(); ++i)
            if (best.members >> i & 1u) put(rivals[i], claimed[i]);
        return true;
    }

    const TetSurroundings& surroundings_;
    const CellShape& shape_;
    const PotentialCells& cells_;
    const std::vector<double>& weights_;
    ClaimTable& table_;
    const int threads_;
    std::vector<std::uint8_t> chosen_;
    std::int64_t now_ = 1;               // changes so far
    std::vector<std::int64_t> changed_;  // (vertices) when a cell there was put in or taken out
    std::vector<std::int64_t> tried_;    // (cells) when exchange_for_one looked at it
    std::vector<std::int64_t> looked_at_;
    std::vector<Index> only_;  // (cells) only_in_the_way then
    std::vector<Index> order_, conflicts_;
};

}  // namespace

std::vector<Index> choose_cells(const TetSurroundings& surroundings, const CellShape& shape,
                                const PotentialCells& cells, const std::vector<double>& weights, ClaimTable& table,
                                int threads) {
    return Chooser(surroundings, shape, cells, weights, table, threads).run();
}

}  // namespace octafield::volume::detail
