// Cells out of many that can stand together: an independent set of great weight.
#pragma once

#include <cstdint>
#include <vector>

#include "face_claims.hpp"

namespace octafield::volume::detail {

// Which tets and triangles the cells chosen so far need.
class ClaimTable {
public:
    ClaimTable(Index tets, Index triangles) : owner_(tets, nobody), claims_(triangles) {}

    static constexpr Index nobody = -1, settled = -2;  // settled: a cell that is not to be changed any more

    // The cells whose tets or claims are in the way, each once.
    void conflicts(std::span<const Index> tets, const CellClaims& claims, std::vector<Index>& cells) const;
    void add(Index cell, std::span<const Index> tets, const CellClaims& claims);
    void remove(Index cell, std::span<const Index> tets, const CellClaims& claims);
    // How many cells have claimed the triangle, all for the same face: 0, 1 or 2.
    int claimants(Index triangle) const {
        const auto& cells = claims_[triangle].cells;
        return (cells[0] != nobody) + (cells[1] != nobody);
    }
    bool claimed_as(Index triangle, const FaceKey& key) const {
        return claimants(triangle) > 0 && claims_[triangle].key == key;
    }
    void settle();                                               // all of them
    const std::vector<Index>& owners() const { return owner_; }  // of tets

private:
    struct Claim {
        FaceKey key{};
        std::array<Index, 2> cells{nobody, nobody};
    };
    std::vector<Index> owner_;
    std::vector<Claim> claims_;
};

// Cells with the weights' sum great: by weight first, then improved by exchanging cells for heavier ones and one cell
// for several, exactly among those that only that cell is in the way of; no times, so always the same. Adds them to the
// table; ascending.
std::vector<Index> choose_cells(const TetSurroundings& surroundings, const CellShape& shape,
                                const PotentialCells& cells, const std::vector<double>& weights, ClaimTable& table);

}  // namespace octafield::volume::detail
