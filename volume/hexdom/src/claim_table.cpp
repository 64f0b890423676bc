#include <algorithm>

#include "cell_choice.hpp"

namespace octafield::volume::detail {

void ClaimTable::conflicts(std::span<const Index> tets, const CellClaims& claims, std::vector<Index>& cells) const {
    cells.clear();
    const auto add = [&](Index cell) {
        if (cell != nobody && std::find(cells.begin(), cells.end(), cell) == cells.end()) cells.push_back(cell);
    };
    const auto add_others = [&](const Claim& claim, const FaceKey& key) {
        if (claim.key == key) return;
        for (const Index cell : claim.cells) add(cell);
    };
    for (const Index tet : tets) add(owner_[tet]);
    for (int f = 0; f < claims.count; ++f) {
        const FaceClaim& face = claims.faces[f];
        for (int k = 0; k < face.count; ++k) add_others(claims_[face.triangles[k]], face.key);
        if (face.diagonal < 0) continue;
        add_others(diagonals_[face.diagonal], face.key);
        for (const Index cell : edge_users_[face.diagonal]) add(cell);
    }
    for (int e = 0; e < claims.edge_count; ++e)
        for (const Index cell : diagonals_[claims.edges[e]].cells) add(cell);
}

void ClaimTable::put(Claim& claim, Index cell, const FaceKey& key) {
    claim.key = key;
    claim.cells[claim.cells[0] == nobody ? 0 : 1] = cell;
}

void ClaimTable::drop(Claim& claim, Index cell) { claim.cells[claim.cells[0] == cell ? 0 : 1] = nobody; }

void ClaimTable::add(Index cell, std::span<const Index> tets, const CellClaims& claims) {
    for (const Index tet : tets) owner_[tet] = cell;
    for (int f = 0; f < claims.count; ++f) {
        const FaceClaim& face = claims.faces[f];
        for (int k = 0; k < face.count; ++k) put(claims_[face.triangles[k]], cell, face.key);
        if (face.diagonal >= 0) put(diagonals_[face.diagonal], cell, face.key);
    }
    for (int e = 0; e < claims.edge_count; ++e) edge_users_[claims.edges[e]].push_back(cell);
}

void ClaimTable::remove(Index cell, std::span<const Index> tets, const CellClaims& claims) {
    for (const Index tet : tets) owner_[tet] = nobody;
    for (int f = 0; f < claims.count; ++f) {
        const FaceClaim& face = claims.faces[f];
        for (int k = 0; k < face.count; ++k) drop(claims_[face.triangles[k]], cell);
        if (face.diagonal >= 0) drop(diagonals_[face.diagonal], cell);
    }
    for (int e = 0; e < claims.edge_count; ++e) {
        std::vector<Index>& users = edge_users_[claims.edges[e]];
        users.erase(std::find(users.begin(), users.end(), cell));
    }
}

void ClaimTable::settle() {
    const auto fix = [](Index& cell) {
        if (cell != nobody) cell = settled;
    };
    std::for_each(owner_.begin(), owner_.end(), fix);
    for (std::vector<Claim>* claims : {&claims_, &diagonals_})
        for (Claim& claim : *claims) std::for_each(claim.cells.begin(), claim.cells.end(), fix);
    for (std::vector<Index>& users : edge_users_) std::for_each(users.begin(), users.end(), fix);
}

}  // namespace octafield::volume::detail
