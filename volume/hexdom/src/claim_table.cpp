#include <algorithm>

#include "cell_choice.hpp"

namespace octafield::volume::detail {

void ClaimTable::conflicts(std::span<const Index> tets, const CellClaims& claims, std::vector<Index>& cells) const {
    cells.clear();
    const auto add = [&](Index cell) {
        if (cell != nobody && std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    };
    for (const Index tet : tets) add(owner_[tet]);
    for (int f = 0; f < claims.count; ++f)
        for (int k = 0; k < claims.faces[f].count; ++k) {
            const Claim& claim = claims_[claims.faces[f].triangles[k]];
            if (claim.key == claims.faces[f].key) continue;
            for (const Index cell : claim.cells) add(cell);
        }
}

void ClaimTable::add(Index cell, std::span<const Index> tets, const CellClaims& claims) {
    for (const Index tet : tets) owner_[tet] = cell;
    for (int f = 0; f < claims.count; ++f)
        for (int k = 0; k < claims.faces[f].count; ++k) {
            Claim& claim = claims_[claims.faces[f].triangles[k]];
            claim.key = claims.faces[f].key;
            claim.cells[claim.cells[0] == nobody ? 0 : 1] = cell;
        }
}

void ClaimTable::remove(Index cell, std::span<const Index> tets, const CellClaims& claims) {
    for (const Index tet : tets) owner_[tet] = nobody;
    for (int f = 0; f < claims.count; ++f)
        for (int k = 0; k < claims.faces[f].count; ++k) {
            auto& of = claims_[claims.faces[f].triangles[k]].cells;
            of[of[0] == cell ? 0 : 1] = nobody;
        }
}

void ClaimTable::settle() {
    const auto fix = [](Index& cell) {
        if (cell != nobody) cell = settled;
    };
    std::for_each(owner_.begin(), owner_.end(), fix);
    for (Claim& claim : claims_) std::for_each(claim.cells.begin(), claim.cells.end(), fix);
}

}  // namespace octafield::volume::detail
