// Cells out of many that can stand together: an independent set of great weight.
#pragma once

#include <cstdint>
#include <vector>

#include "face_claims.hpp"

namespace octafield::volume::detail {

// Which tets, triangles and edges the cells chosen so far need.
class ClaimTable {
public:
    explicit ClaimTable(const TetTopology& topology)
        : owner_(topology.tet_triangles.size(), nobody),
          claims_(topology.triangle_count()),
          diagonals_(topology.edge_count()),
          edge_users_(topology.edge_count()) {}

    static constexpr Index nobody = -1, settled = -2;  // settled: a cell that is not to be changed any more

    // The cells whose tets or claims are in the way, each once.
    void conflicts(std::span<const Index> tets, const CellClaims& claims, std::vector<Index>& cells) const;
    void add(Index cell, std::span<const Index> tets, const CellClaims& claims);
    void remove(Index cell, std::span<const Index> tets, const CellClaims& claims);
    void settle();                                               // all of them
    const std::vector<Index>& owners() const { return owner_; }  // of tets

private:
    struct Claim {
        FaceKey key{};
        std::array<Index, 2> cells{nobody, nobody};
    };
    static void put(Claim& claim, Index cell, const FaceKey& key);
    static void drop(Claim& claim, Index cell);

    std::vector<Index> owner_;                    // (tets)
    std::vector<Claim> claims_;                   // (triangles)
    std::vector<Claim> diagonals_;                // (edges) of faces they are diagonals on
    std::vector<std::vector<Index>> edge_users_;  // (edges)
};

// Cells with the weights' sum great: by weight first, then improved by exchanging cells for heavier ones and one cell
// for several, exactly among those that only that cell is in the way of; no times, so always the same. Adds them to the
// table; ascending.
std::vector<Index> choose_cells(const TetSurroundings& surroundings, const CellShape& shape,
                                const PotentialCells& cells, const std::vector<double>& weights, ClaimTable& table,
                                int threads);

}  // namespace octafield::volume::detail
